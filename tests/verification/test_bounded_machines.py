"""Machines that leave their stops: no row fails, and all leave at times that are linear in what varies."""

import pytest

from benchmarks.bounded.machines import MACHINES, SETTINGS, examined


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", MACHINES)
def test_rows_leave_at_one_smooth_time(name: str, coordinates: str) -> None:
    found = examined(MACHINES[name], False, coordinates, SETTINGS["dop853"], 61, 10)
    assert (dict(found.statuses), found.never) == ({"ok": 61}, 0)
    assert found.differences < 1e-12 and found.span > 1e-2


@pytest.mark.by_turns(16)
@pytest.mark.slow
@pytest.mark.parametrize("integrator", SETTINGS)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", MACHINES)
def test_all_rows_leave_with_dry_pins(name: str, coordinates: str, integrator: str) -> None:
    rows = 301 if integrator != "radau5" else 20
    found = examined(MACHINES[name], True, coordinates, SETTINGS[integrator], rows, 20)
    assert (set(found.statuses), found.never) == ({"ok"}, 0)
    assert found.differences < 1e-9 and found.span > 1e-2
