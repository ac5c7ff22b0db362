"""Derivatives of a step while a parameter of a machine varies: smooth, and those of differences."""

from dataclasses import replace

import pytest

from benchmarks.step_sweeps import MACHINES, examined

#: Second differences of 300 values are some thousandths of those of five.
ROWS = 5


@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_derivatives_of_steps_are_smooth_in_a_parameter(name: str) -> None:
    found = examined(MACHINES[name], ROWS)
    assert not found.failed
    assert found.apart < 1e-9 and 0.0 < found.bend < 0.3


def test_a_step_without_its_event_is_said() -> None:
    machine = replace(MACHINES["press"], dt=1e-2)  # it ends on the stop
    found = examined(machine, 3)
    assert len(found.failed) == 3 and "events []" in found.failed[0]
