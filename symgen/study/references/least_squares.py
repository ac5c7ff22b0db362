"""Minimum-norm least squares of few equations, compiled: by Householder, or by Jacobi where rows are dependent.

Written out in scalars: Numba takes longer for NumPy's `qr` and `lstsq` than for the rest of a reference motion.
References are compiled by Numba, not by the compiler of the runs that they judge.
"""

from __future__ import annotations

import math
from typing import Any

import numba
import numpy as np

from symgen.study.references.independent import CUTOFF

#: Decorator of functions of references.
compiled = numba.njit(nogil=True, error_model="numpy", fastmath={"contract"})
#: Rows are dependent where the smallest diagonal entry of the factor is below this share of the largest.
DEPENDENT = 1e-7
#: Rows are orthogonal where their cosine is below this; after so many sweeps only rounding is left.
RIGHT, ROUNDS = 1e-15, 40


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _by_reflections(a: Any, b: Any, x: Any) -> bool:
    """Set x to the minimum-norm solution of A x = b by Householder reflections of the rows of A; overwrites A.

    Returns
    -------
    bool
        False if rows are dependent; then x is meaningless.
    """
    m, n = a.shape
    diagonal, factors = np.empty(m), np.empty(m)
    smallest, largest = math.inf, 0.0
    for k in range(m):
        square = 0.0
        for j in range(k, n):
            square += a[k, j] * a[k, j]
        length = math.sqrt(square)
        diagonal[k] = -length if a[k, k] > 0.0 else length
        smallest, largest = min(smallest, length), max(largest, length)
        if not length > 0.0:
            return False
        a[k, k] -= diagonal[k]
        factors[k] = -1.0 / (diagonal[k] * a[k, k])
        for i in range(k + 1, m):
            along = 0.0
            for j in range(k, n):
                along += a[i, j] * a[k, j]
            along *= factors[k]
            for j in range(k, n):
                a[i, j] -= along * a[k, j]
    if not smallest > DEPENDENT * largest:
        return False
    for i in range(m):
        x[i] = b[i]
        for j in range(i):
            x[i] -= a[i, j] * x[j]
        x[i] /= diagonal[i]
    for j in range(m, n):
        x[j] = 0.0
    for k in range(m - 1, -1, -1):
        along = 0.0
        for j in range(k, n):
            along += x[j] * a[k, j]
        along *= factors[k]
        for j in range(k, n):
            x[j] -= along * a[k, j]
    return True


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _by_rotations(a: Any, b: Any, x: Any) -> None:
    """Set x to the minimum-norm least-squares solution of A x = b by Hestenes' rotations of rows; overwrites A and b.

    Orthogonal rows are the right singular vectors times the singular values; b is rotated along. Singular values below
    `CUTOFF` times the largest are left out.
    """
    m, n = a.shape
    for _ in range(ROUNDS):
        turned = 0
        for i in range(m):
            for k in range(i + 1, m):
                first, second, across = 0.0, 0.0, 0.0
                for j in range(n):
                    first += a[i, j] * a[i, j]
                    second += a[k, j] * a[k, j]
                    across += a[i, j] * a[k, j]
                if abs(across) > RIGHT * math.sqrt(first) * math.sqrt(second):
                    turned += 1
                    ratio = (second - first) / (2.0 * across)
                    tangent = math.copysign(1.0, ratio) / (abs(ratio) + math.hypot(1.0, ratio))
                    cosine = 1.0 / math.sqrt(1.0 + tangent * tangent)
                    sine = cosine * tangent
                    for j in range(n):
                        a[i, j], a[k, j] = cosine * a[i, j] - sine * a[k, j], sine * a[i, j] + cosine * a[k, j]
                    b[i], b[k] = cosine * b[i] - sine * b[k], sine * b[i] + cosine * b[k]
        if turned == 0:
            break
    squares, largest = np.empty(m), 0.0
    for i in range(m):
        squares[i] = 0.0
        for j in range(n):
            squares[i] += a[i, j] * a[i, j]
        largest = max(largest, squares[i])
    for j in range(n):
        x[j] = 0.0
    for i in range(m):
        if squares[i] > CUTOFF * CUTOFF * largest:
            for j in range(n):
                x[j] += b[i] / squares[i] * a[i, j]


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def minimum_norm(a: Any, b: Any, x: Any) -> None:
    """Set x to the minimum-norm least-squares solution of A x = b.

    Parameters
    ----------
    a, b : Array, shape (m, n) and (m,)
        Finite numbers.
    x : Array, shape (n,)
        Overwritten.
    """
    m, n = a.shape
    if m > n or not _by_reflections(a.copy(), b, x):
        _by_rotations(a.copy(), b.copy(), x)
