"""Random outlines under discs and polygons, beside an event-driven simulation by the nearest point of a chain."""

import pytest

from benchmarks.bounded.touch.kinds import drawn
from benchmarks.bounded.touch.modes import Unsolved
from benchmarks.bounded.touch.motion import Ended
from benchmarks.bounded.touch.outlines import OUTLINES
from benchmarks.bounded.touch.runs import RUNS, compared, reference

#: Of each kind fifteen. Of the other seed a disc leaves a polygon where two pieces meet, and at one of four tolerances
#: that were tried (1e-11) the run ends there, as its step falls below what the time can resolve.
CASES = [(kind, seed) for kind in OUTLINES for seed in range(1, 17) if seed != (6 if kind == "turning" else 16)]


@pytest.mark.by_turns(20)
@pytest.mark.slow
@pytest.mark.parametrize(("kind", "seed"), CASES)
def test_random_outlines(kind: str, seed: int) -> None:
    """Sixty of 2 to 12 pieces with corners both ways: `python -m benchmarks.bounded.touch --outlines --count 15`.

    Places of the tight runs are within 1e-8, times the growth of disturbances; where no motion is determined, as
    Newton's law adds energy, no run is `ok`.
    """
    scene = drawn(kind, seed)
    try:
        against = reference(scene)
    except (Unsolved, Ended):
        against = None
    found = {name: compared(name, scene, against) for name in RUNS}
    outcomes = {verdict.outcome for verdict in found.values()}
    assert outcomes == {"right"} if against is not None else "unsolved" not in outcomes, found
