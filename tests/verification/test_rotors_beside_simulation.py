"""Random mechanisms whose joints turn rotors, with friction, stops and ropes: beside the event-driven simulation."""

import pytest

from benchmarks.bounded.compare import ROWS, Reference, examined
from benchmarks.bounded.draw import KINDS
from benchmarks.bounded.rotors import geared


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_random_mechanisms_with_rotors(kind: str) -> None:
    against, verdicts = examined(geared(kind, 101), ("dop853", "joint dop853", ROWS), 0.5)
    assert isinstance(against, Reference)
    assert [verdict for verdict in verdicts if verdict.outcome not in ("right", "coarse")] == []
