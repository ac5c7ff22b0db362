"""Minimum-norm least squares of few equations, compiled, by Householder reflections, also of dependent rows.

Written out in scalars: Numba takes longer for NumPy's `qr` and `lstsq` than for the rest of a reference motion.
References are compiled by Numba, not by the compiler of the runs that they judge.
"""

from __future__ import annotations

import math

import numba
import numpy as np

from symgen.compile.native.annotations import Array
from symgen.study.references.independent import CUTOFF

#: Decorator of functions of references.
compiled = numba.njit(nogil=True, error_model="numpy", fastmath={"contract"})
#: Rows are dependent where the smallest diagonal entry of the factor is below this share of the largest.
DEPENDENT = 1e-7


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _reflect_rows(a: Array, k: int, length: float, diagonal: Array, factors: Array) -> None:
    """Reflect the rows of A from the k-th on, of which columns from k on are left, so that the k-th has one entry."""
    m, n = a.shape
    diagonal[k] = -length if a[k, k] > 0.0 else length
    a[k, k] -= diagonal[k]
    factors[k] = -1.0 / (diagonal[k] * a[k, k])
    for i in range(k + 1, m):
        along = 0.0
        for j in range(k, n):
            along += a[i, j] * a[k, j]
        along *= factors[k]
        for j in range(k, n):
            a[i, j] -= along * a[k, j]


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _apply_reflections(a: Array, factors: Array, rank: int, x: Array) -> None:
    """Take x back through the reflections in the rows of A; entries from the rank on are set to 0 before."""
    n = a.shape[1]
    for j in range(rank, n):
        x[j] = 0.0
    for k in range(rank - 1, -1, -1):
        along = 0.0
        for j in range(k, n):
            along += x[j] * a[k, j]
        along *= factors[k]
        for j in range(k, n):
            x[j] -= along * a[k, j]


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _sum_of_squares(a: Array, i: int, k: int) -> float:
    """Return the sum of squares of a row from column k on."""
    square = 0.0
    for j in range(k, a.shape[1]):
        square += a[i, j] * a[i, j]
    return square


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _solve_independent_rows(a: Array, b: Array, x: Array) -> bool:
    """Set x to the minimum-norm solution of A x = b by Householder reflections of the rows of A; overwrites A.

    Returns
    -------
    bool
        False if rows are dependent; then x is meaningless.
    """
    m = a.shape[0]
    diagonal, factors = np.empty(m), np.empty(m)
    smallest, largest = math.inf, 0.0
    for k in range(m):
        length = math.sqrt(_sum_of_squares(a, k, k))
        smallest, largest = min(smallest, length), max(largest, length)
        if not length > 0.0:
            return False
        _reflect_rows(a, k, length, diagonal, factors)
    if not smallest > DEPENDENT * largest:
        return False
    for i in range(m):
        x[i] = b[i]
        for j in range(i):
            x[i] -= a[i, j] * x[j]
        x[i] /= diagonal[i]
    _apply_reflections(a, factors, m, x)
    return True


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _solve_dependent_rows(a: Array, b: Array, x: Array) -> None:
    """Set x to the minimum-norm least-squares solution of A x = b, rows of any rank; overwrites A and b.

    The longest row that is left is reflected next, until `CUTOFF` times the first one is longer than all: A = L Q with
    as many columns in L as the rank. L y = b is solved by reflections of the columns of L, and x = Q^T y (G. H. Golub,
    C. F. Van Loan, Matrix Computations, section on complete orthogonal decompositions).
    """
    m, n = a.shape
    most = min(m, n)
    diagonal, factors = np.empty(most), np.empty(most)
    rank, least = 0, 0.0
    for k in range(most):
        chosen, square = k, _sum_of_squares(a, k, k)
        for i in range(k + 1, m):
            other = _sum_of_squares(a, i, k)
            if other > square:
                chosen, square = i, other
        if k == 0:
            least = CUTOFF * CUTOFF * square
        if not square > least:
            break
        if chosen != k:
            for j in range(n):
                a[k, j], a[chosen, j] = a[chosen, j], a[k, j]
            b[k], b[chosen] = b[chosen], b[k]
        _reflect_rows(a, k, math.sqrt(square), diagonal, factors)
        rank = k + 1
    # columns of L as rows, b the last of them: their reflections bring it to the triangle of R^T and to Q^T b
    lower = np.zeros((rank + 1, m))
    for k in range(rank):
        lower[k, k] = diagonal[k]
        for i in range(k + 1, m):
            lower[k, i] = a[i, k]
    for i in range(m):
        lower[rank, i] = b[i]
    turned, unused = np.empty(rank), np.empty(rank)
    for k in range(rank):
        _reflect_rows(lower, k, math.sqrt(_sum_of_squares(lower, k, k)), turned, unused)
    for k in range(rank - 1, -1, -1):
        x[k] = lower[rank, k]
        for j in range(k + 1, rank):
            x[k] -= lower[j, k] * x[j]
        x[k] /= turned[k]
    _apply_reflections(a, factors, rank, x)


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def minimum_norm(a: Array, b: Array, x: Array) -> None:
    """Set x to the minimum-norm least-squares solution of A x = b.

    Parameters
    ----------
    a, b : Array, shape (m, n) and (m,)
        Finite numbers.
    x : Array, shape (n,)
        Overwritten.
    """
    m, n = a.shape
    if m > n or not _solve_independent_rows(a.copy(), b, x):
        _solve_dependent_rows(a.copy(), b.copy(), x)
