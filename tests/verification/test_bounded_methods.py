"""Methods where stops are left: right, or a sentence, never `ok` and wrong, never an exception."""

import pytest
from support.rotation import of_turn

from benchmarks.bounded.methods import Line, examine
from symgen.derive.methods import METHODS

#: An integrator with adaptive steps, and one with constant ones.
BOTH = ["dop853", "rk4"]


def wrong(lines: list[Line]) -> list[Line]:
    """Return lines of runs that are `ok` and wrong, raise, or do not get over a stop; coarse steps may lose energy."""
    bad = [line for line in lines if line.outcome in ("WRONG", "raised", "failed")]
    return [line for line in bad if line.outcome != "failed" or "energy" not in line.reason]


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("file", ["backlash", "pushed", "lifted"])
def test_stops_are_left(file: str) -> None:
    methods = ["lagrange", "direct-correction", "penalty", "invariant-stabilization", "braun-goldfarb"]
    lines = examine(methods, BOTH, [file])
    assert len(lines) == 10
    assert wrong(lines) == []


@pytest.mark.slow
@pytest.mark.parametrize("method", of_turn(METHODS.names, 15))
def test_stops_are_left_by_all_methods(method: str) -> None:
    lines = examine([method], [], [])
    assert lines
    assert wrong(lines) == []
