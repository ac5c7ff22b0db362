"""Derivatives of runs with contacts over a parameter: those of differences, and in doubt where events change."""

import pytest

from benchmarks.contact_sweeps import MACHINES, between, derivative, examined, from_one_side

#: `python -m benchmarks.contact_sweeps` has 300 values.
ROWS = 5


@pytest.mark.by_turns(7)
@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_derivatives_over_a_parameter_are_those_of_differences(name: str) -> None:
    sweep = examined(MACHINES[name], ROWS, changes=1, adjoints=2)
    assert not sweep.wrong and sweep.statuses["ok"] >= ROWS - 1
    assert sweep.apart < 1e-6 and sweep.adjoint < 1e-9


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_an_impact_that_just_takes_the_slip_of_an_edge_has_two_derivatives() -> None:
    """With less friction the edge slides on before it turns back; with more it sticks in the impact."""
    machine, at = MACHINES["rock"], 0.0796414
    sides = between(machine, derivative(machine, at - 1e-5), derivative(machine, at + 1e-5))
    assert [side.status for side in sides] == ["unverified", "unverified"]
    assert "'left.hit' and 'left.reverse'" in sides[0].reason and "for these numbers only" in sides[0].reason
    assert "left comes to rest" in sides[1].reason and "for these numbers only" in sides[1].reason
    slopes = []
    for side, way in zip(sides, (-1.0, 1.0), strict=True):
        near = derivative(machine, side.value + way * 1e-9)
        reference, error = from_one_side(machine, near.value, way)
        assert near.status == "ok" and abs(near.slope - reference) < 1e-5 and error < 1e-5
        slopes.append(near.slope)
    assert abs(slopes[1] - slopes[0]) > 5e-3
