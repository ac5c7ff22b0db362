"""The interval that the argument of a table is in, and the step that ends at its next point."""

import math

import numpy as np
import pytest

from symgen.compile.loopcode.exact import plain_form
from symgen.run.loops import search_records as records
from symgen.run.loops import table_points
from symgen.run.loops.frame_parts import TRY

LEVELS = (0.0, 0.17, 0.31, 0.52, 0.8, 1.0)
REPEATED = 1.0


def kept(period: float) -> np.ndarray:
    """What a run keeps of one table and nothing else."""
    own = LEVELS[:-1] if period else LEVELS
    hunt = np.zeros(records.N_HEAD + records.N_COLUMNS + len(own))
    columns = hunt[records.N_HEAD :]
    columns[[records.ACTION, records.POINTS, records.PERIOD]] = records.ANEW, len(own), period
    columns[records.MISSED] = 1e-4
    hunt[records.TABLES] = records.N_HEAD + records.N_COLUMNS
    hunt[-len(own) :] = own
    return hunt


def aimed(hunt: np.ndarray, s: float, rate: float, second: float, h: float) -> float:
    """The step in place of one of `h` where the argument is s, with its derivatives."""
    columns = hunt[records.N_HEAD :]
    place = plain_form(table_points.interval_at)(hunt, 1, 0, s, rate)
    columns[[records.PLACE, records.ARGUMENT_START, records.SLOPE_START, records.CURVE]] = place, s, rate, second
    plain_form(table_points.aim)(hunt, 1, h)
    return float(hunt[TRY])


@pytest.mark.parametrize("period", [0.0, REPEATED])
def test_intervals_are_those_of_numpy(period):
    hunt, random = kept(period), np.random.default_rng(4)
    every = [x + k for k in range(-3, 4) for x in LEVELS[:-1]] if period else LEVELS
    for s in (*random.uniform(-1.5, 2.5, 100), *LEVELS):
        for rate in (1.0, -1.0):
            place = plain_form(table_points.interval_at)(hunt, 1, 0, float(s), rate)
            inside = np.searchsorted(every, s, side="right" if rate > 0.0 else "left") - 1
            assert plain_form(table_points.point)(hunt, 1, 0, place) == pytest.approx(
                every[inside] if inside >= 0 else -1e300
            )


@pytest.mark.slow_cases("1.0")
@pytest.mark.parametrize("period", [0.0, REPEATED])
def test_the_next_point_is_the_first_root_of_a_parabola(period):
    """Beside NumPy's roots of all parabolas, for motions that go on and that turn round."""
    random, hunt, seen = np.random.default_rng(5), kept(period), set()
    every = [x + k for k in range(-4, 12) for x in LEVELS[:-1]] if period else LEVELS
    for _ in range(400):
        s, rate, second = random.uniform(-0.3, 1.3), random.normal(), random.normal() * 3.0
        h = random.uniform(0.02, 0.3)
        roots = [np.roots([0.5 * second, rate, s - level]) for level in every]
        times = [float(t.real) for pair in roots for t in pair if abs(t.imag) < 1e-12 and t.real > 1e-4 * h]
        first = min(times, default=math.inf)
        expected = h if first >= 2.0 * h else first if first <= h else 0.5 * first
        assert aimed(hunt, s, rate, second, h) == pytest.approx(expected, rel=1e-9)
        seen.add((first <= h, first <= 2.0 * h, rate * (rate + 2.0 * h * second) > 0.0))
    assert len(seen) == 6, "near, far and further, of motions that go on and that turn round"


def test_a_point_that_a_step_begins_at_is_not_aimed_at_again():
    hunt = kept(0.0)
    assert aimed(hunt, 0.5, 0.0, 0.0, 0.1) == 0.1, "it stands still"
    assert aimed(hunt, 0.96, 1.0, 0.0, 0.1) == pytest.approx(0.04)
    assert aimed(hunt, 0.999999, 1.0, 0.0, 0.1) == 0.1, "as good as at the last point"
    assert aimed(hunt, 0.85, 1.0, 0.0, 0.1) == pytest.approx(0.075), "two equal steps"


def test_a_step_to_a_jump_ends_before_it_and_a_short_one_crosses():
    hunt = kept(0.0)
    columns = hunt[records.N_HEAD :]
    columns[records.POINTS] = 0.0
    columns[[records.G_START, records.D_START, records.CURVE, records.GRAIN]] = 0.05, -1.0, 0.0, 1e-13
    plain_form(table_points.aim)(hunt, 1, 0.1)
    assert 0.045 < hunt[TRY] < 0.05
    columns[records.G_START] = 1e-9
    plain_form(table_points.aim)(hunt, 1, 0.1)
    assert 1e-9 < hunt[TRY] < 1e-8
