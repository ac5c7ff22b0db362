"""The compiled least-norm solver against singular values."""

import numpy as np
import pytest

from symgen.compile.loopcode.exact import compiled_form, plain_form
from symgen.run.starts.start_solvers import least_norm

compiled = compiled_form(least_norm)


def solve(a, b):
    m, n = a.shape
    x, order = np.full(n, np.nan), np.zeros(m, dtype=np.int64)
    room = np.full(m * min(m, n) + m + n, np.nan)
    rank = compiled(a.ravel().copy(), m, n, b.copy(), x, room, order)
    other, room[:] = np.full(n, np.nan), np.nan
    with np.errstate(all="ignore"):
        assert plain_form(least_norm)(a.ravel().copy(), m, n, b.copy(), other, room, order.copy()) == rank
    np.testing.assert_array_equal(other, x)  # every bit, compiled or not
    return x, rank, order


def matrix(seed, m, n, rank):
    random = np.random.default_rng(seed)
    return random.normal(size=(m, rank)) @ random.normal(size=(rank, n))


SHAPES = [(8, 9, 8), (8, 9, 5), (5, 5, 5), (9, 4, 4), (9, 4, 2), (1, 6, 1), (6, 1, 1), (30, 30, 29), (7, 12, 7)]


@pytest.mark.parametrize(("m", "n", "rank"), SHAPES)
def test_the_shortest_of_the_best_solutions(m, n, rank):
    for seed in range(5):
        a = matrix(seed, m, n, rank)
        b = np.random.default_rng(100 + seed).normal(size=m)  # no solution where rows depend on others
        x, found, order = solve(a, b)
        assert found == rank and sorted(order) == list(range(m))
        np.testing.assert_allclose(x, np.linalg.pinv(a, rcond=1e-9) @ b, rtol=1e-8, atol=1e-9)
        np.testing.assert_allclose(a.T @ (a @ x - b), 0.0, atol=1e-8)


def test_columns_of_zeros_stay_out():
    a = matrix(3, 4, 6, 4)
    a[:, [1, 4]] = 0.0
    x, rank, _ = solve(a, np.ones(4))
    assert rank == 4
    np.testing.assert_allclose(x, np.linalg.pinv(a) @ np.ones(4), atol=1e-11)


def test_nothing_and_nan():
    x, rank, _ = solve(np.zeros((3, 4)), np.ones(3))
    assert rank == 0 and np.all(x == 0.0)
    a = matrix(1, 3, 4, 3)
    a[1, 1] = np.nan
    solve(a, np.ones(3))  # ends
