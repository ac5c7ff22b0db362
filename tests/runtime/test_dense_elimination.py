"""The elimination of Newton matrices against NumPy, with unknowns of very different sizes."""

import numpy as np
import pytest

from symgen.runtime.dense import eliminate, leave_out, leave_out_rest, substitute


def solve(matrix, right):
    """Return the solution and the number of skipped pivots."""
    n = len(right)
    a, rows, x = np.concatenate([matrix.ravel(), np.zeros(2 * n)]), np.zeros(n, dtype=np.int64), np.zeros(n)
    skipped = eliminate(a, n, rows)
    substitute(a, n, rows, right.copy(), x)
    return x, skipped


def saddle(stiffness, rng):
    """A stiff block above rows of constraints, and which unknowns are multipliers."""
    k = rng.uniform(-1.0, 1.0, (6, 6))
    d = rng.uniform(-1.0, 1.0, (4, 6))
    matrix = np.block([[stiffness * (k @ k.T + np.eye(6)), d.T], [d, np.zeros((4, 4))]])
    return matrix, d


@pytest.mark.parametrize("stiffness", [1.0, 1e8, 1e16, 1e24])
def test_stiff_unknowns_do_not_hide_multipliers(stiffness):
    rng = np.random.default_rng(7)
    matrix, _ = saddle(stiffness, rng)
    # the multipliers are as large as the stiff forces: in their unit the matrix is as regular as with stiffness 1
    exact = np.concatenate([rng.uniform(1.0, 2.0, 6), stiffness * rng.uniform(1.0, 2.0, 4)])
    scale = np.concatenate([np.ones(6), np.full(4, stiffness)])
    unit = matrix * scale / np.concatenate([np.full(6, stiffness), np.ones(4)])[:, None]
    right = np.concatenate([np.full(6, stiffness), np.ones(4)]) * (unit @ (exact / scale))
    x, skipped = solve(matrix, right)
    assert skipped == 0
    np.testing.assert_allclose(x / scale, exact / scale, rtol=1e-11)


def test_a_dependent_equation_is_skipped():
    rng = np.random.default_rng(8)
    matrix, d = saddle(1e6, rng)
    matrix[9, :6] = matrix[:6, 9] = d[0] + d[1]
    exact = np.concatenate([rng.uniform(1.0, 2.0, 6), rng.uniform(1e6, 2e6, 3), [0.0]])
    x, skipped = solve(matrix, matrix @ exact)
    assert skipped == 1
    np.testing.assert_allclose(x[:6], exact[:6], rtol=1e-8)
    np.testing.assert_allclose(matrix @ x, matrix @ exact, rtol=1e-8)


def test_rows_that_are_left_out_have_no_multiplier():
    """With a row that is dependent up to a violation, and masked, the solution is that without the row."""
    rng = np.random.default_rng(9)
    matrix, d = saddle(1.0, rng)
    matrix[9, :6] = matrix[:6, 9] = d[0] + d[1] + 1e-9 * rng.uniform(-1.0, 1.0, 6)
    right = rng.uniform(-1.0, 1.0, 10)
    expected = np.linalg.solve(matrix[:9, :9], right[:9])
    w = np.array([0.0, 0.0, 0.0, 0.0, np.inf])
    a = matrix.ravel().copy()
    leave_out(a, 10, 0, 10, 6, 4, w, 1)
    k = np.zeros(10)
    k[9] = 0.25  # a multiplier that an earlier iterate left: the iteration takes it away
    leave_out_rest(right, 0, 10, 6, 4, w, 1, k, 0)
    x, skipped = solve(a.reshape(10, 10), right)
    assert skipped == 0 and x[9] == 0.25
    coupled = expected - 0.25 * np.linalg.solve(matrix[:9, :9], matrix[:9, 9])
    np.testing.assert_allclose(x[:9], coupled, rtol=1e-9)
