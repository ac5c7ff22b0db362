"""Random mechanisms over floors with corners, beside an event-driven simulation that tries every piece."""

from collections import Counter

import numpy as np
import pytest

from benchmarks.bounded.compare import Reference, examined
from benchmarks.bounded.corners import cornered, over_slope
from benchmarks.bounded.motion import Simulation
from benchmarks.bounded.rows import Bounded
from benchmarks.bounded.tree import GROUND, Link, Point, Tree

NOTHING = np.zeros(3)


def block() -> Tree:
    """Return a point in the plane, by two slides."""
    axes = np.eye(3)
    first = Link(GROUND, True, axes[0], np.eye(3), NOTHING, NOTHING, 0.0, np.zeros((3, 3)))
    second = Link(0, True, axes[1], np.eye(3), NOTHING, NOTHING, 1.0, np.zeros((3, 3)))
    return Tree([first, second], [], np.array([0.0, -9.81, 0.0]))


@pytest.mark.slow
def test_the_simulation_flies_off_an_edge_and_lands() -> None:
    """A block slides at 2 m/s, leaves the edge at 0.5 s and lands on the slope."""
    point = Point(1, NOTHING)
    flat, tilted = over_slope(point, 0.0, 0.0, 0.0), over_slope(point, 0.0, -1.0, 1.0)
    hill = Bounded("hill", flat, lower=0.0, pieces=(flat, tilted))
    motion = Simulation(block(), [hill]).run(np.zeros(2), np.array([2.0, 0.0]), [0.0, 0.5, 0.7, 1.2])
    assert [event.kind for event in motion.events] == ["corner", "lower.hit"]
    assert motion.events[0].t == pytest.approx(0.5, abs=1e-12)
    assert motion.events[1].t == pytest.approx(0.5 + 4.0 / 9.81, abs=1e-11)
    assert motion.u[2] == pytest.approx([1.4, -0.5 * 9.81 * 0.04], abs=1e-11)
    landed = 0.5 * (2.0 + 4.0)  # what is left along the slope, of (2, -4), by each axis
    t = 1.2 - motion.events[1].t
    assert motion.u[3][0] == pytest.approx(1.0 + 8.0 / 9.81 + landed * t + 0.25 * 9.81 * t * t, abs=1e-10)


def test_the_simulation_hits_the_foot_of_a_ramp() -> None:
    """Both pieces of a valley are rows of their own: the ramp takes what goes into it, and the flat part lets go."""
    point = Point(1, NOTHING)
    rows = [Bounded("hill", over_slope(point, 0.0, slope, 1.0), lower=0.0) for slope in (0.0, 1.0)]
    motion = Simulation(block(), rows).run(np.zeros(2), np.array([2.0, 0.0]), [0.0, 0.6])
    assert motion.events[0].t == pytest.approx(0.5, abs=1e-12)
    assert motion.u[1][0] == pytest.approx(1.0 + 0.1 - 0.25 * 9.81 * 0.01, abs=1e-11)


@pytest.mark.by_turns(12)
@pytest.mark.slow
@pytest.mark.parametrize(("kind", "seed"), [("chain", 5), ("loop", 3), ("chain", 1), ("loop", 7)])
def test_random_mechanisms_over_corners(kind: str, seed: int) -> None:
    against, verdicts = examined(cornered(kind, seed), ("default", "dop853", "joint dop853"), 1.0)
    assert isinstance(against, Reference)
    assert Counter(verdict.outcome for verdict in verdicts) == {"right": 3}, verdicts
