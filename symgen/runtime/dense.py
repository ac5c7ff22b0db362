"""Dense elimination for Newton matrices, in loops that compile in a fraction of LAPACK's time."""

from __future__ import annotations

from typing import Any

from symgen.store.jit import jit


@jit()
def eliminate(a: Any, n: int, rows: Any) -> int:
    """Factorise `a` (n x n, row by row, in place) with scaled partial pivoting; return the number of skipped pivots.

    Parameters
    ----------
    a : Array
        Matrix; L and U on return.
    n : int
        Size.
    rows : Array of int64
        Order of the rows on return.

    Notes
    -----
    A pivot below 1e-13 of its scaled column belongs to a dependent equation: its unknown is set to 0 by `substitute`.
    """
    skipped = 0
    for i in range(n):
        rows[i] = i
        largest = 0.0
        for j in range(n):
            largest = max(largest, abs(a[i * n + j]))
        if largest > 0.0:
            for j in range(n):
                a[i * n + j] /= largest
        # the scale is kept behind the matrix for the right-hand sides
        a[n * n + i] = 1.0 / largest if largest > 0.0 else 0.0
    for k in range(n):
        best, at = 0.0, k
        for i in range(k, n):
            size = abs(a[rows[i] * n + k])
            if size > best:
                best, at = size, i
        rows[k], rows[at] = rows[at], rows[k]
        top = rows[k] * n
        if best < 1e-13:
            a[top + k] = 0.0
            skipped += 1
            continue
        for i in range(k + 1, n):
            row = rows[i] * n
            if a[row + k] != 0.0:
                factor = a[row + k] / a[top + k]
                a[row + k] = factor
                for j in range(k + 1, n):
                    a[row + j] -= factor * a[top + j]
    return skipped


@jit()
def substitute(a: Any, n: int, rows: Any, right: Any, x: Any) -> None:
    """Solve with the factors that `eliminate` left; `right` and `x` are different arrays of length n."""
    for i in range(n):
        row = rows[i]
        total = right[row] * a[n * n + row]
        for j in range(i):
            if a[rows[j] * n + j] != 0.0:
                total -= a[row * n + j] * x[j]
        x[i] = total
    for i in range(n - 1, -1, -1):
        row = rows[i] * n
        if a[row + i] == 0.0:
            x[i] = 0.0
            continue
        total = x[i]
        for j in range(i + 1, n):
            total -= a[row + j] * x[j]
        x[i] = total / a[row + i]
