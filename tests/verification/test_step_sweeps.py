"""Derivatives of a step while a parameter of a machine varies: smooth, and those of differences."""

from dataclasses import replace

import pytest

from benchmarks.step_sweeps import MACHINES, examined

#: Second differences of 300 values are some thousandths of those of five.
ROWS = 5


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_derivatives_of_steps_are_smooth_in_a_parameter(name: str) -> None:
    sweep = examined(MACHINES[name], ROWS)
    assert not sweep.failed
    assert sweep.apart < 1e-9 and 0.0 < sweep.bend < 0.3


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["joint", "absolute"])
def test_an_event_that_passes_to_the_next_step_of_the_scheme_leaves_a_kink_alone(coordinates: str) -> None:
    # the bucket leaves its stop within 1e-4 of a step before and behind its end
    machine = replace(MACHINES["bucket"], values=(22186.40, 22186.46))
    sweep = examined(machine, 4, coordinates)
    assert not sweep.failed
    assert sweep.apart < 1e-9 and 1e-7 < sweep.bend < 1e-4


@pytest.mark.slow
def test_a_step_without_its_event_is_said() -> None:
    machine = replace(MACHINES["press"], dt=1e-2)  # it ends on the stop
    sweep = examined(machine, 3)
    assert len(sweep.failed) == 3 and "events []" in sweep.failed[0]
