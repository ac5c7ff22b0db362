"""Methods where stops are left: right, or a sentence, never `ok` and wrong, never an exception."""

import pytest

from benchmarks.bounded.methods import examine
from symgen.methods import METHODS

#: Beside all methods that fit it, an integrator with adaptive and one with constant steps.
BOTH = ["dop853", "rk4"]


@pytest.mark.parametrize("file", ["backlash", "pushed", "lifted"])
def test_stops_are_left(file: str) -> None:
    methods = ["lagrange", "direct-correction", "penalty", "invariant-stabilization", "braun-goldfarb"]
    lines = examine(methods, BOTH, [file])
    assert len(lines) == 10
    assert [line for line in lines if line.outcome in ("WRONG", "raised", "failed")] == []


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS.names)
def test_stops_are_left_by_all_methods(method: str) -> None:
    lines = examine([method], [], [])
    assert lines
    assert [line for line in lines if line.outcome in ("WRONG", "raised", "failed")] == []
