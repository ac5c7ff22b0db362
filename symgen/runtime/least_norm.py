"""Least-squares solutions of least norm, of any rank, in a loop that compiles in a fraction of LAPACK's time."""

from __future__ import annotations

import math
from typing import Any

from symgen.store.jit import jit

#: Rows whose remaining part is below this, times the largest row, depend on others; as in `symgen.runtime.assembly`.
_CUTOFF = 1e-6


@jit()
def least_norm(a: Any, m: int, n: int, right: Any, x: Any, room: Any, order: Any) -> int:
    """Set `x` to the shortest vector that minimises ``|a x - right|``; return the rank of `a`.

    Parameters
    ----------
    a : Array
        Matrix, m x n, row by row; overwritten.
    right : Array, shape (m,)
        Right-hand side; overwritten.
    x : Array, shape (n,)
        Result.
    room : Array
        Working memory for ``m * min(m, n) + m + n`` numbers.
    order : Array of int, shape (m,)
        Order of the rows on return: those that count come first.

    Notes
    -----
    Householder's reflections from the right with pivoting of rows give ``a = P L Q^T``; where rows depend on others,
    the trapezoid L is reduced from the left as well (a complete orthogonal decomposition; Golub, Van Loan, Matrix
    Computations, section 5.5).
    """
    beta = 0  # offsets in the working memory: factors of the reflections, then the trapezoid
    trapezoid = n + m
    for i in range(m):
        order[i] = i
    rank, first = 0, 0.0
    for k in range(min(m, n)):
        best, at = -1.0, k
        for i in range(k, m):
            row = order[i] * n
            square = 0.0
            for j in range(k, n):
                square += a[row + j] * a[row + j]
            if square > best:
                best, at = square, i
        size = math.sqrt(best)
        if k == 0:
            first = size
        if not size > _CUTOFF * first:
            break
        order[k], order[at] = order[at], order[k]
        row = order[k] * n
        # the reflection maps the rest of the row to its first component, away from cancellation
        head = a[row + k]
        diagonal = -size if head > 0.0 else size
        a[row + k] = head - diagonal
        room[beta + k] = -1.0 / (diagonal * (head - diagonal))
        for i in range(k + 1, m):
            other = order[i] * n
            total = 0.0
            for j in range(k, n):
                total += a[row + j] * a[other + j]
            total *= room[beta + k]
            for j in range(k, n):
                a[other + j] -= total * a[row + j]
        x[k] = diagonal  # kept here until the trapezoid is written out
        rank += 1
    for i in range(m):
        for k in range(min(i, rank)):
            room[trapezoid + i * rank + k] = a[order[i] * n + k]
        for k in range(i, rank):
            room[trapezoid + i * rank + k] = x[k] if k == i else 0.0
        room[n + i] = right[order[i]]
    for i in range(m):
        right[i] = room[n + i]
    if rank < m:
        _reduce(room, trapezoid, m, rank, right)
        for k in range(rank - 1, -1, -1):
            total = right[k]
            for j in range(k + 1, rank):
                total -= room[trapezoid + k * rank + j] * x[j]
            x[k] = total / room[trapezoid + k * rank + k]
    else:
        for k in range(rank):
            total = right[k]
            for j in range(k):
                total -= room[trapezoid + k * rank + j] * x[j]
            x[k] = total / room[trapezoid + k * rank + k]
    for j in range(rank, n):
        x[j] = 0.0
    for k in range(rank - 1, -1, -1):
        row = order[k] * n
        total = 0.0
        for j in range(k, n):
            total += a[row + j] * x[j]
        total *= room[beta + k]
        for j in range(k, n):
            x[j] -= total * a[row + j]
    return rank


@jit()
def _reduce(matrix: Any, at: int, m: int, n: int, right: Any) -> None:
    """Reflect the columns of a matrix of full rank, m x n from index `at` on: leave R and Q^T right."""
    for k in range(n):
        square = 0.0
        for i in range(k, m):
            square += matrix[at + i * n + k] ** 2
        head = matrix[at + k * n + k]
        size = math.sqrt(square)
        diagonal = -size if head > 0.0 else size
        factor = -1.0 / (diagonal * (head - diagonal))
        matrix[at + k * n + k] = head - diagonal
        for j in range(k + 1, n):
            total = 0.0
            for i in range(k, m):
                total += matrix[at + i * n + k] * matrix[at + i * n + j]
            total *= factor
            for i in range(k, m):
                matrix[at + i * n + j] -= total * matrix[at + i * n + k]
        total = 0.0
        for i in range(k, m):
            total += matrix[at + i * n + k] * right[i]
        total *= factor
        for i in range(k, m):
            right[i] -= total * matrix[at + i * n + k]
        matrix[at + k * n + k] = diagonal
