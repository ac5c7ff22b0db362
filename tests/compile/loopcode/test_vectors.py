"""Arithmetic on whole states, by long double sums in NumPy; between guards of nan: nothing beyond is touched."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from support.checks import assert_same_motion

from symgen.compile.loopcode import vectors
from symgen.compile.loopcode.padding import BLOCK, padded
from symgen.compile.store.jit import jit

Array = NDArray[np.float64]
#: States of up to four blocks are treated in pairs of numbers where emitted functions have just written them.
WIDTHS = (BLOCK, 3 * BLOCK, 4 * BLOCK, 5 * BLOCK, 9 * BLOCK)
#: Roundings of a sum of so few terms, each at most half a unit of the last place of the sum of magnitudes.
ROUNDINGS = 16 * np.finfo(np.float64).eps


@jit()
def combined(
    how: int, h: float, first: int, last: int, column: Any, value: Any, rows: Any, base: Any, out: Any
) -> None:
    width = out.shape[0]
    if how == 0:
        vectors.combine(width, h, first, last, column, value, rows, base, out)
    elif how == 1:
        vectors.follow(width, h, first, last, column, value, rows, base, out)
    else:
        vectors.total(width, h, first, last, column, value, rows, out)


@jit()
def taken(how: int, array: Any, out: Any) -> None:
    if how == 0:
        vectors.copied(out.shape[0], array, out)
    else:
        vectors.received(out.shape[0], array, out)


@contextmanager
def guarded(values: Array) -> Iterator[Array]:
    """Give a copy between guards of nan, which have to be there afterwards, at an odd place of memory."""
    room = np.full(values.size + 2 * BLOCK + 1, np.nan)
    inside = room[BLOCK + 1 : BLOCK + 1 + values.size]
    inside[:] = values
    yield inside
    assert np.isnan(room[: BLOCK + 1]).all() and np.isnan(room[BLOCK + 1 + values.size :]).all()


def table(rng: np.random.Generator, count: int) -> tuple[NDArray[np.int64], Array]:
    """Return columns and coefficients of a packed row behind entries of other rows, which are nan."""
    column = np.array([-(10**9), *np.sort(rng.permutation(12)[:count]), -(10**9)], dtype=np.int64)
    return column, np.array([np.nan, *rng.standard_normal(count), np.nan])


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("count", [0, 1, 2, 7, 12])
def test_combinations_are_sums_of_rows(width: int, count: int) -> None:
    rng = np.random.default_rng(width + count)
    column, value = table(rng, count)
    rows, base, h = rng.standard_normal(12 * width), rng.standard_normal(width), 0.37
    terms = rows.reshape(12, width)[column[1:-1]].astype(np.longdouble) * value[1:-1, None] * np.longdouble(h)
    size = np.abs(terms).sum(axis=0) + np.abs(base)
    found = []
    for how in range(3):
        with guarded(rows) as r, guarded(base) as b, guarded(np.full(width, 7.0)) as out:
            combined(how, h, 1, 1 + count, column, value, r, b, out)
            exact = terms.sum(axis=0) + (base if how < 2 else 0.0)
            assert np.all(np.abs(out - exact) <= ROUNDINGS * size)
            found.append(out.copy())
    # lanes read whole vectors where single runs read numbers
    assert_same_motion(found[0], found[1])


def test_a_row_of_numbers_that_are_not_finite_reaches_the_state_it_belongs_to() -> None:
    rows, base = np.ones(2 * BLOCK), np.zeros(BLOCK)
    rows[BLOCK + 3] = np.inf
    column, value = np.array([0, 1]), np.ones(2)
    for how in range(2):
        out = np.zeros(BLOCK)
        combined(how, 1.0, 0, 2, column, value, rows, base, out)
        assert np.isinf(out[3]) and np.array_equal(np.delete(out, 3), np.full(BLOCK - 1, 2.0))


@pytest.mark.parametrize("width", WIDTHS)
def test_a_combination_may_stand_where_its_base_does(width: int) -> None:
    rng = np.random.default_rng(width)
    column, value = table(rng, 5)
    rows, base = rng.standard_normal(12 * width), rng.standard_normal(width)
    for how in range(2):
        apart = np.empty(width)
        combined(how, 0.5, 1, 6, column, value, rows, base, apart)
        with guarded(base) as same:
            combined(how, 0.5, 1, 6, column, value, rows, same, same)
            assert np.array_equal(same, apart)


@pytest.mark.parametrize("width", WIDTHS)
def test_copies_are_bit_for_bit_and_end_where_the_state_does(width: int) -> None:
    values = np.random.default_rng(width).standard_normal(width)
    values[:3] = np.nan, -0.0, np.inf
    for how in range(2):
        with guarded(values) as array, guarded(np.zeros(width)) as out:
            taken(how, array, out)
            assert out.tobytes() == array.tobytes() == values.tobytes()


def test_widths_are_whole_blocks() -> None:
    assert [padded(n) for n in (1, 7, 8, 9, 19)] == [8, 8, 8, 16, 24]
