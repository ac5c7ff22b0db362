"""Forces of rows with bounds against all motions of drawn problems, found by other means."""

from collections.abc import Callable

import numpy as np
import pytest
from support.rotation import of_turn

from benchmarks.bounded.laws import compare as against
from benchmarks.bounded.laws.compare import SOLVE, solve_laws
from benchmarks.bounded.laws.problems import Problem, Row, draw, filled, motions
from symgen.compile.loopcode.exact import compiled_form, plain_form
from symgen.run.laws.motions import (
    NO_MOTION,
    NOT_SOUGHT,
    ONE_MOTION,
    SEVERAL_MOTIONS,
    find_forces,
    seek_another,
)
from symgen.run.laws.problem import BALL, PUSH, SECOND, Laws, new_laws

#: Mixes of rows that push, dry friction, contacts, and friction by reactions of one and two components.
MANY = ("ccccc", "jjjjjj", "c" * 10, "cejdp" * 4, "cejdp" * 10)


def compare(count: int, mixes: tuple[str, ...], seed: int) -> tuple[int, int]:
    """Compare drawn problems with all of their motions; return how many have none, and several."""
    numbers, none, several = np.random.default_rng(seed), 0, 0
    for number in range(count):
        problem = draw(numbers, mixes[number % len(mixes)], redundant=number % 3 == 0)
        laws, k, there = filled(problem), len(problem.rows), motions(problem)
        code = SOLVE(k, 0, laws)
        none, several = none + (not there), several + (len(there) > 1)
        if code != NO_MOTION:
            assert problem.miss(laws.forces[:k]) < 1e-8
        assert (code == NO_MOTION) <= (not there)
        assert (len(there) > 1) <= (code == SEVERAL_MOTIONS)
        assert (code == SEVERAL_MOTIONS) <= (len(there) != 1)
    return none, several


def test_no_motion_of_few_rows_is_missed() -> None:
    none, several = compare(60, ("c", "cj", "cd", "jd"), 91)
    assert none + several > 0


@pytest.mark.slow
def test_no_motion_of_ten_thousand_problems_is_missed() -> None:
    """A fiftieth of them in a turn; `python -m benchmarks.bounded.laws` has all."""
    verdicts = against.compare(of_turn(range(10_000), 50, "laws"))
    assert verdicts.counts["all motions known"] > 50
    assert verdicts.faults == []


def test_a_contact_in_space_beside_friction_by_a_reaction_has_the_motion_that_exists() -> None:
    """Of ten thousand drawn problems this one was missed: no beginning had swept the rows of a plane."""
    assert against.compare([261]).faults == []


@pytest.mark.slow
@pytest.mark.parametrize("mix", MANY)
def test_what_is_found_among_many_rows_obeys_all_laws(mix: str) -> None:
    numbers, found = np.random.default_rng(5), 0
    for number in range(100):
        problem = draw(numbers, mix, redundant=number % 2 == 0)
        laws, k = filled(problem), len(problem.rows)
        if SOLVE(k, 0, laws) in (ONE_MOTION, NOT_SOUGHT):
            found += 1
            assert problem.miss(laws.forces[:k]) < 1e-8
    assert found >= 97


@pytest.mark.parametrize("solve", [SOLVE, plain_form(solve_laws)])
def test_a_rod_that_slides_on_its_tip_jams_where_painleve_says(solve: Callable[..., int]) -> None:
    """Its tip is accelerated by its force by ``G_NN - s mu G_NT``: below 0 no force serves where it falls."""
    for friction in (0.2, 1.9, 2.1, 3.0):
        for way in (-1.0, 1.0):
            problem = Problem(np.array([[2.0, 1.0], [1.0, 1.0]]), np.array([-1.0, 0.3]), [Row(pushes=True)])
            problem.rows.append(Row(kappa=friction, presser=0, way=way))
            laws, mobility = filled(problem), 2.0 - way * friction
            assert (solve(2, 0, laws) != NO_MOTION) == (mobility > 0.0)
            if mobility > 0.0:
                np.testing.assert_allclose(laws.forces, [-1.0 / mobility, way * friction / mobility], rtol=1e-12)


def test_the_same_rod_at_rest_has_several_motions() -> None:
    """At rest, lifted by what pulls it, and pressed by a friction that turns the pull round."""
    problem = Problem(
        np.array([[2.0, 1.9], [1.9, 2.0]]), np.array([0.1, 1.0]), [Row(pushes=True), Row(kappa=2.0, presser=0)]
    )
    there = motions(problem)
    laws = filled(problem)
    assert len(there) > 1
    assert SOLVE(2, 0, laws) == SEVERAL_MOTIONS
    assert list(laws.other[:2]) != list(laws.state[:2])


@pytest.mark.parametrize("count", [3, 5, 10])
def test_boxes_on_each_other_rest_by_equal_parts(count: int) -> None:
    """Two corners a box with friction: forces are many, and the least sum leaves friction without a drive at 0."""
    problem = stack(count, push=0.0)
    laws, k = filled(problem), len(problem.rows)
    assert SOLVE(k, 0, laws) != NO_MOTION
    above = np.repeat(np.arange(count, 0, -1), 2) * 9.81 / 2.0
    np.testing.assert_allclose(-laws.forces[:k:2], above, rtol=1e-11)
    np.testing.assert_allclose(laws.forces[1:k:2], 0.0, atol=1e-9)


def stack(count: int, push: float) -> Problem:
    """Return boxes of 1 kg, 1 m wide and 1 m high, on each other, the top one pushed at its middle [N]."""
    entries, rows = np.zeros((4 * count, 3 * count)), list[Row]()
    masses = np.tile([1.0, 1.0, 1.0 / 6.0], count)
    for box in range(count):
        for corner, side in enumerate((-0.5, 0.5)):
            line = 4 * box + 2 * corner
            entries[line, 3 * box : 3 * box + 3] = 0.0, 1.0, side
            entries[line + 1, 3 * box : 3 * box + 3] = 1.0, 0.0, 0.5
            if box > 0:
                entries[line, 3 * box - 3 : 3 * box] = 0.0, -1.0, -side
                entries[line + 1, 3 * box - 3 : 3 * box] = -1.0, 0.0, 0.5
            rows += [Row(pushes=True), Row(kappa=0.5, presser=line)]
    force = np.tile([0.0, -9.81, 0.0], count)
    force[3 * count - 3] = push
    return Problem(entries / masses @ entries.T, entries @ (force / masses), rows)


def test_a_ball_of_two_rows_slides_along_its_acceleration_or_rests() -> None:
    """A block on a floor, pulled obliquely: within the cone of friction it rests, else it goes as it is pulled."""
    for pull in ((3.0, 4.0), (12.0, 5.0)):
        laws = new_laws(3)
        problem = Problem(np.eye(3) / 2.0, np.array([-9.81, *pull]) / np.array([1.0, 2.0, 2.0]), [Row(pushes=True)])
        problem.rows += [Row(kappa=0.4, presser=0), Row(kappa=0.4, presser=0)]
        laws = filled(problem)
        laws.law[1:3] = BALL, SECOND
        assert SOLVE(3, 0, laws) == ONE_MOTION
        size, most = float(np.hypot(*pull)), 0.4 * 2.0 * 9.81
        force = np.array(pull) * min(1.0, most / size)
        np.testing.assert_allclose(laws.forces[1:3], force, rtol=1e-12)
        np.testing.assert_allclose(laws.left[1:3], (np.array(pull) - force) / 2.0, atol=1e-12)


def full_bearing(balls: int, phase: float, friction: float, radii: tuple[float, float] = (1.0, 0.2)) -> Laws:
    """Return the laws of a ring on balls in a fixed outer ring, all at rest: each ball touches both."""
    (ring, ball), weight = radii, np.array([0.0, -9.81, 0.0])
    masses = np.array([1.0, 1.0, 0.5] + [0.1, 0.1, 0.05 * ball**2] * balls)
    rows = np.zeros((4 * balls, len(masses)))
    for q in range(balls):
        angle, own = 2.0 * np.pi * (q + phase) / balls, slice(3 * q + 3, 3 * q + 6)
        out, along = np.array([np.cos(angle), np.sin(angle)]), np.array([np.sin(angle), -np.cos(angle)])
        rows[4 * q, own], rows[4 * q, :3] = [*out, 0.0], [*-out, 0.0]
        rows[4 * q + 1, own], rows[4 * q + 1, :3] = [*along, ball], [*-along, ring]
        rows[4 * q + 2, own], rows[4 * q + 3, own] = [*-out, 0.0], [*-along, ball]
    laws = new_laws(4 * balls)
    laws.matrix[:], laws.offset[:] = (rows / masses @ rows.T).ravel(), rows @ np.tile(weight, balls + 1)
    laws.law[::2], laws.law[1::2], laws.kappa[1::2] = PUSH, BALL, friction
    laws.presser[::2], laws.presser[1::2] = -1, np.arange(0, 4 * balls, 2)
    return laws


@pytest.mark.parametrize("friction", [0.1, 0.3])
def test_a_full_bearing_rests_or_has_several_motions(friction: float) -> None:
    """Rest is a motion of 24 contacts; other beginnings find motions of the ring, and none is the only one."""
    for phase in np.linspace(0.0, 1.0, 12, endpoint=False):
        laws = full_bearing(12, float(phase), friction)
        assert compiled_form(find_forces)(48, laws, 1)
        rests = np.max(np.abs(laws.left)) < 1e-8
        assert rests or compiled_form(seek_another)(48, laws), phase


@pytest.mark.parametrize("rounding", [0.0, -1e-18, 1e-18])
def test_rates_of_closed_gaps_that_are_rounding_have_impulses_of_rounding(rounding: float) -> None:
    """Discs slide on each other and no gap closes: nothing pushes, so that no friction changes their rates."""
    for number in range(30):
        problem = draw(np.random.default_rng(number), "cccc")
        for row in problem.rows:
            row.way = 0.0
        problem.offset[::2] = rounding * np.array([1.0, 0.1, 3.0, 0.0])
        problem.offset[1::2] *= 0.1
        laws = filled(problem)
        assert SOLVE(8, 0, laws) != NO_MOTION, number
        np.testing.assert_allclose(laws.forces[:8], 0.0, atol=1e-14)
