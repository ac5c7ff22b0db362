"""What reference motions solve their equations with, beside LAPACK's singular values."""

import numpy as np
import pytest

from symgen.study.references.least_squares import minimum_norm

#: Rows, columns and rank.
SIZES = [(1, 1, 1), (3, 5, 3), (9, 9, 9), (9, 9, 7), (12, 9, 9), (12, 9, 5), (4, 9, 2), (6, 6, 0), (20, 15, 13)]


@pytest.mark.by_turns(6)
@pytest.mark.slow_cases("1.0-1-1-1", "1.0-3-5-3", "1.0-9-9-9", "1.0-9-9-7")
@pytest.mark.parametrize(("m", "n", "rank"), SIZES)
@pytest.mark.parametrize("size", [1.0, 1e-120, 1e120])
def test_the_shortest_of_the_best(m, n, rank, size):
    rng = np.random.default_rng(100 * m + n)
    for _ in range(5):
        a = size * rng.standard_normal((m, rank)) @ rng.standard_normal((rank, n))
        b, x = rng.standard_normal(m), np.full(n, np.nan)
        kept = a.copy(), b.copy()
        minimum_norm(a, b, x)
        np.testing.assert_array_equal((a, b)[0], kept[0])
        np.testing.assert_array_equal((a, b)[1], kept[1])
        expected = np.linalg.pinv(a, 1e-9) @ b
        singular = np.linalg.svd(a, compute_uv=False)[:rank]
        bound = 1e-13 * singular[0] / singular[-1] ** 2 * np.linalg.norm(b) if rank else 0.0
        assert np.abs(x - expected).max() <= 10.0 * bound


def test_a_row_of_zeros_and_a_row_twice():
    """Contradictory rows share their error; a row of zeros asks for nothing."""
    x = np.empty(3)
    minimum_norm(np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), np.array([5.0, 1.0, 3.0]), x)
    np.testing.assert_allclose(x, [1.0, 0.0, 0.0], rtol=1e-15)


def test_rows_that_nearly_depend_are_solved_by_what_is_left():
    """Beyond 1e-9 of the largest, a singular value is rounding's; above, it counts."""
    for small, expected in ((1e-11, 0.0), (1e-5, 1e5)):
        x = np.empty(2)
        minimum_norm(np.array([[1.0, 0.0], [0.0, small]]), np.array([0.0, 1.0]), x)
        np.testing.assert_allclose(x, [0.0, expected], rtol=1e-12)
