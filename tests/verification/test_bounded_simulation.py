"""The event-driven simulation of friction, stops and ropes against closed forms and its own differences."""

import math

import numpy as np
import pytest

from benchmarks.bounded.draw import KINDS, drawn
from benchmarks.bounded.forms import Forms
from benchmarks.bounded.modes import impulses
from benchmarks.bounded.motion import Motion, Simulation
from benchmarks.bounded.rows import Bounded, angle, height, joint, rope
from benchmarks.bounded.tree import GROUND, Array, Closure, Link, Point, Tree

Z, NOTHING = np.array([0.0, 0.0, 1.0]), np.zeros(3)
DOWN = np.array([0.0, -9.81, 0.0])


def pin(parent: int, before: Array, behind: Array, mass: float, inertia: float) -> Link:
    return Link(parent, False, Z, np.eye(3), before, behind, mass, np.diag([0.0, 0.0, inertia]))


def slide(axis: Array, mass: float, force: Array = NOTHING, frequency: float = 0.0, phase: float = 0.0) -> Link:
    return Link(GROUND, True, axis, np.eye(3), NOTHING, NOTHING, mass, np.zeros((3, 3)), force, frequency, phase)


def moved(
    tree: Tree, rows: list[Bounded], u: list[float], v: list[float], until: float, count: int = 4, rtol: float = 1e-12
) -> Motion:
    times = [float(t) for t in np.linspace(0.0, until, count + 1)]
    return Simulation(tree, rows, rtol, 0.1 * rtol).run(np.array(u), np.array(v), times)


def x(length: float) -> Array:
    return np.array([length, 0.0, 0.0])


def test_block_that_is_pushed_up_a_slope_stays_there() -> None:
    up = np.array([0.8, 0.6, 0.0])
    tree = Tree([slide(up, 2.0)], [], np.array([0.0, -10.0, 0.0]))
    motion = moved(tree, [Bounded("slope", joint(0), sliding=4.0, static=12.8)], [0.0], [2.0], 1.0)
    (event,) = motion.events
    assert (event.kind, event.name) == ("rest", "slope")
    assert event.t == pytest.approx(0.25, abs=1e-12)
    assert motion.u[-1][0] == pytest.approx(0.25, abs=1e-12)


@pytest.mark.slow
def test_static_friction_breaks_and_sliding_friction_holds_what_comes_to_rest() -> None:
    tree = Tree([slide(x(1.0), 1.0, force=x(6.0), frequency=2.0)], [], NOTHING)
    motion = moved(tree, [Bounded("guide", joint(0), sliding=3.0, static=4.5)], [0.0], [0.0], 2.0)
    breaks = 0.5 * math.asin(0.75)

    def rate(t: float) -> float:
        return 3.0 * (math.cos(2.0 * breaks) - math.cos(2.0 * t)) - 3.0 * (t - breaks)

    assert [e.kind for e in motion.events[:2]] == ["break", "rest"]
    assert motion.events[0].t == pytest.approx(breaks, abs=1e-11)
    assert abs(rate(motion.events[1].t)) < 1e-10


@pytest.mark.parametrize("static", [2.0, 3.0])
def test_what_is_at_its_bound_at_the_start_breaks_loose(static: float) -> None:
    """A force of 4 sin(t + c) that is at the bound when t is 0, and grows."""
    phase = math.asin(static / 4.0)
    tree = Tree([slide(x(1.0), 1.0, force=x(4.0), frequency=1.0, phase=phase)], [], NOTHING)
    motion = moved(tree, [Bounded("guide", joint(0), sliding=2.0, static=static)], [0.0], [0.0], 0.5)
    ahead = 4.0 * (math.cos(phase) * 0.5 - math.sin(0.5 + phase) + math.sin(phase)) - 0.25
    assert motion.u[-1][0] == pytest.approx(ahead, abs=1e-11)


@pytest.mark.slow
def test_impacts_accumulate() -> None:
    tree = Tree([slide(np.array([0.0, 1.0, 0.0]), 2.0)], [], DOWN)
    ball = [Bounded("floor", joint(0), lower=0.0, restitution=0.7)]
    motion = moved(tree, ball, [1.0], [0.0], 3.0)
    end = math.sqrt(2.0 / 9.81) * 1.7 / 0.3
    assert motion.events[0].t == pytest.approx(math.sqrt(2.0 / 9.81), abs=1e-12)
    assert end - 1e-5 < motion.events[-1].t < end
    assert motion.u[-1][0] == 0.0
    fifth = math.sqrt(2.0 / 9.81) * (1.0 + 2.0 * sum(0.7**k for k in range(1, 5)))
    assert motion.events[4].t == pytest.approx(fifth, abs=1e-11)


@pytest.mark.parametrize(("restitution", "behind"), [(1.0, 3.0), (0.5, 1.75), (0.0, 0.5)])
def test_an_impact_on_a_rising_floor(restitution: float, behind: float) -> None:
    tree = Tree([slide(np.array([0.0, 1.0, 0.0]), 2.0)], [], np.array([0.0, -10.0, 0.0]))
    floor = height(Point(0, NOTHING), np.array([0.0, 1.0, 0.0]), 0.0, 0.5)
    motion = moved(tree, [Bounded("floor", floor, lower=0.0, restitution=restitution)], [0.3], [0.0], 0.25)
    assert motion.events[0].t == pytest.approx(0.2, abs=1e-12)
    falls = 10.0 if restitution else 0.0
    assert motion.u[-1][0] == pytest.approx(0.1 + 0.05 * behind - 0.5 * falls * 0.05**2, abs=1e-11)


def test_a_winch_takes_up_its_rope() -> None:
    tree = Tree([slide(np.array([0.0, 1.0, 0.0]), 2.0)], [], NOTHING)
    taut = rope(Point(GROUND, NOTHING), Point(0, NOTHING), 1.0, -0.5)
    motion = moved(tree, [Bounded("rope", taut, lower=0.0)], [-0.7], [0.0], 1.0)
    assert motion.events[0].t == pytest.approx(0.6, abs=1e-12)
    assert motion.u[-1][0] == pytest.approx(-0.5, abs=1e-12)


def test_two_blocks_in_a_row_strike_by_one_law() -> None:
    """Newton's law with all that touch: a wall behind a ball takes its share at once."""
    masses = np.diag([1.0, 0.5])
    slopes = np.array([[1.0, 0.0], [-1.0, 1.0]])  # a wall, then the first ball
    push = impulses(slopes @ masses @ slopes.T, np.array([0.0, -2.0]), np.array([0.5, 0.5]))
    assert slopes @ (masses @ (slopes.T @ push)) + [0.0, -2.0] == pytest.approx([0.0, 1.0], abs=1e-12)
    assert (push > 0.0).all()


@pytest.mark.slow
def test_a_pendulum_between_stops() -> None:
    tree = Tree([pin(GROUND, NOTHING, np.array([0.0, 0.5, 0.0]), 1.0, 0.05)], [], DOWN)
    stops = [Bounded("pin", joint(0), lower=-1.0, upper=1.0, restitution=0.5)]
    motion = moved(tree, stops, [0.0], [5.0], 5.0)
    hits = [0.2300567, 0.8471425, 1.5644604, 2.3363334, 3.1363051, 3.9504880, 4.7718111]
    assert [e.t for e in motion.events] == pytest.approx(hits, abs=1e-7)


def test_a_knee_of_points_without_inertia() -> None:
    up = np.array([0.0, 1.0, 0.0])
    tree = Tree([pin(GROUND, NOTHING, up, 1.0, 0.0), pin(0, NOTHING, up, 1.0, 0.0)], [], DOWN)
    motion = moved(tree, [Bounded("knee", joint(1), lower=0.0, restitution=0.5)], [1.0, 0.5], [0.0, 0.0], 1.0)
    assert [e.t for e in motion.events] == pytest.approx([0.604396464058, 0.969906743564], abs=1e-9)


@pytest.mark.slow
def test_a_point_on_a_rod_without_inertia_sticks() -> None:
    tree = Tree([pin(GROUND, NOTHING, np.array([0.0, 0.5, 0.0]), 1.0, 0.0)], [], DOWN)
    motion = moved(tree, [Bounded("pin", joint(0), sliding=2.0, static=2.0)], [1.5], [0.0], 4.0)
    assert [e.t for e in motion.events] == pytest.approx([0.81384, 1.55638], abs=1e-5)
    assert motion.u[-1][0] == pytest.approx(-0.350494319, abs=1e-9)


#: Lengths, masses, inertias, angles and rates of three rods.
THREE = (
    [1.0496701620480328, 0.8218210053283745, 0.5689714419059371],
    [1.5554282921262756, 1.4365596318982274, 2.0915998610776465],
    [0.1570228663686158, 0.11591343040619317, 0.02343850448085113],
    [0.5207734537989164, 0.562853496736631, 0.7396766099421558],
    [0.12265899828282434, 0.6570172637255739, 0.0],
)


def three_rods() -> Tree:
    lengths, masses, inertias, *_ = THREE
    links = [
        pin(k - 1, x(lengths[k - 1] / 2 if k else 0.0), x(-lengths[k] / 2), masses[k], inertias[k]) for k in range(3)
    ]
    return Tree(links, [], DOWN)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_joint_that_leaves_its_stop_and_slips() -> None:
    """Times and angles of another simulation of the same chain."""
    rows = [
        Bounded("j0", joint(0), lower=0.17914486559809, upper=1.185522006937984),
        Bounded("j1", joint(1), 2.1997301038007246, 2.859649134940942, 0.0, -0.35383720535831487, 1.3753181067522937),
    ]
    motion = moved(three_rods(), rows, THREE[3], THREE[4], 3.0)
    events = [(e.t, e.name, e.kind) for e in motion.events[-3:]]
    assert [kind for *_, kind in events] == ["break", "rest", "lower.hit"]
    assert [t for t, *_ in events] == pytest.approx([2.4953841573, 2.5868540264, 2.6191580134], abs=1e-7)


def four_bar(torque: float) -> tuple[Tree, list[Bounded], Array]:
    """Return a four-bar linkage of four dry pins, and coordinates in which it is closed."""
    lengths, end = [2.0, 4.0, 3.0], NOTHING
    angles = np.array([1.0, 0.3, -1.2])
    for length, a in zip(lengths, np.cumsum(angles), strict=True):
        end = end + length * np.array([math.cos(a), math.sin(a), 0.0])
    links = [pin(k - 1, x(lengths[k - 1] / 2 if k else 0.0), x(-lengths[k] / 2), 1.0 + k, 1.0) for k in range(3)]
    tree = Tree(links, [Closure(Point(2, x(1.5)), Point(GROUND, end), (0, 1))], DOWN)
    measures = [joint(0), joint(1), joint(2), angle({0: 1.0, 1: 1.0, 2: 1.0}, 0.0)]
    return tree, [Bounded(f"j{k}", of, sliding=torque, static=torque) for k, of in enumerate(measures)], angles


@pytest.mark.parametrize(("share", "held"), [(1.0 + 1e-6, 4), (1.0 - 1e-6, 0)])
def test_four_dry_pins_of_one_freedom_hold_together(share: float, held: int) -> None:
    tree, rows, u = four_bar(1.0)
    forms = Forms(tree, rows, 0.0, u, np.zeros(3))
    direction = forms.free[:, 0]
    needed = abs(direction @ forms.dynamics[1]) / np.abs(forms.slopes @ direction).sum()
    tree, rows, u = four_bar(share * needed)
    forms = Forms(tree, rows, 0.0, u, np.zeros(3))
    modes = forms.choose(set())
    assert sum(modes.held) == held
    assert held == 0 or min(forms.margins(modes)) == pytest.approx(1e-6 * needed, rel=1e-3)


@pytest.mark.slow
def test_a_dry_four_bar_swings_and_rests() -> None:
    """The loop stays closed, and all four pins come to rest together."""
    tree, rows, u = four_bar(7.0)
    motion = moved(tree, rows, list(u), [0.0, 0.0, 0.0], 2.0, rtol=1e-10)
    assert [e.kind for e in motion.events[-4:]] == ["rest"] * 4
    assert np.ptp([e.t for e in motion.events[-4:]]) < 1e-11
    assert motion.v[-1] == pytest.approx(np.zeros(3), abs=1e-14)
    ends = [tree.closed(tree.at(0.0, u, np.zeros(3)))[0] for u in motion.u]
    assert float(np.abs(ends).max()) < 1e-9
    assert np.linalg.norm(motion.u[-1] - motion.u[0]) > 0.05


@pytest.mark.parametrize("kind", KINDS)
def test_masses_and_forces_are_those_of_the_energies(kind: str) -> None:
    """M and f of a random mechanism against differences of its Lagrangian."""
    mechanism = next(m for seed in range(1, 50) if "push" not in (m := drawn(kind, seed)).features)
    tree = mechanism.tree
    numbers = np.random.default_rng(1)
    u, v, n = mechanism.u + 0.1 * numbers.normal(size=tree.n), numbers.normal(size=tree.n), tree.n

    def lagrangian(u: Array, v: Array) -> float:
        state, total = tree.at(0.0, u, v), 0.0
        for k, link in enumerate(tree.links):
            rate, spin = state.slopes[k] @ v, state.turns[k].T @ state.spins[k]
            total += 0.5 * link.mass * float(rate @ rate) + 0.5 * float(spin @ link.inertia @ spin)
            total += link.mass * float(tree.gravity @ state.places[k])
        return total

    def momenta(u: Array, v: Array) -> Array:
        return tree.dynamics(tree.at(0.0, u, v))[0] @ v

    h, each = 1e-5, np.eye(n)
    mass, force = tree.dynamics(tree.at(0.0, u, v))
    p = [(lagrangian(u, v + h * e) - lagrangian(u, v - h * e)) / (2 * h) for e in each]
    assert mass @ v == pytest.approx(p, abs=1e-8)
    slopes = np.array([(lagrangian(u + h * e, v) - lagrangian(u - h * e, v)) / (2 * h) for e in each])
    turning = (momenta(u + h * v, v) - momenta(u - h * v, v)) / (2 * h)
    assert force == pytest.approx(slopes - turning, abs=1e-7)


@pytest.mark.parametrize("kind", KINDS)
def test_rates_of_rows_and_closures_are_those_of_their_values(kind: str) -> None:
    for seed in range(1, 8):
        mechanism = drawn(kind, seed)
        tree, u, v = mechanism.tree, mechanism.u, mechanism.v
        t, a, h = 0.3, np.ones(tree.n), 1e-4

        def at(s: float, mechanism=mechanism, u=u, v=v, t=t, a=a) -> Forms:
            return Forms(mechanism.tree, mechanism.rows, t + s, u + s * v + 0.5 * s * s * a, v + s * a)

        now, before, behind = at(0.0), at(-h), at(h)
        assert now.rates == pytest.approx((behind.values - before.values) / (2 * h), abs=1e-6)
        assert now.slopes @ a + now.bias == pytest.approx((behind.rates - before.rates) / (2 * h), abs=1e-5)
        assert now.closed[0] == pytest.approx(np.zeros(len(now.closed[0])), abs=1e-12)
        second = (behind.closed[0] - 2 * now.closed[0] + before.closed[0]) / h**2
        assert now.closed[1] @ a + now.closed[2] == pytest.approx(second, abs=1e-5)
