"""Dense elimination for Newton matrices, in loops that compile in a fraction of LAPACK's time."""

from __future__ import annotations

from typing import Any

from symgen.store.jit import jit


@jit()
def eliminate(a: Any, n: int, rows: Any) -> int:
    """Factorise `a` (n x n, row by row, in place) with equilibration and partial pivoting; return the skipped pivots.

    Parameters
    ----------
    a : Array, length n^2 + 2 n
        Matrix; L and U on return, and behind them the scales of rows and columns.
    n : int
        Size.
    rows : Array of int64
        Order of the rows on return.

    Notes
    -----
    Rows, then columns are scaled so that the largest entry of each is 1. A pivot below 1e-13 then belongs to a
    dependent equation: its unknown is set to 0 by `substitute`. Without scales of columns, unknowns that stiff springs
    dwarf, multipliers first of all, would be taken for undetermined ones.
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
        a[n * n + i] = 1.0 / largest if largest > 0.0 else 0.0
    for j in range(n):
        a[n * n + n + j] = 0.0
    for i in range(n):
        for j in range(n):
            a[n * n + n + j] = max(a[n * n + n + j], abs(a[i * n + j]))
    for j in range(n):
        a[n * n + n + j] = 1.0 / a[n * n + n + j] if a[n * n + n + j] > 0.0 else 0.0
    for i in range(n):
        for j in range(n):
            a[i * n + j] *= a[n * n + n + j]
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
    for i in range(n):
        x[i] *= a[n * n + n + i]


@jit()
def leave_out(a: Any, size: int, first: int, n: int, width: int, m: int, w: Any, mask: int) -> None:
    """Replace the equations of redundant rows in a Newton matrix by ``multiplier = 0``.

    Parameters
    ----------
    a : Array
        Newton matrix of `size` unknowns.
    size, first : int
        Its size, and where the `n` unknowns of the stage begin.
    n, width, m : int
        Unknowns of the stage: `width` rates, then one or two multipliers for each of `m` rows.
    w, mask : Array, int
        Scratch, and where the mask begins in it: 0, or infinite for a row that depends on others.

    Notes
    -----
    The rows are those that every other method leaves out, decided on D D^T at the start. Near the constraints, not on
    them, such a row is independent by as much as they are violated, so a threshold on pivots of this matrix would
    take it for a regular one, with multipliers of any size.
    """
    for i in range(width, n):
        if w[mask + (i - width) % m] > 0.0:
            row = (first + i) * size
            for j in range(size):
                a[row + j] = 0.0
            a[row + first + i] = 1.0


@jit()
def leave_out_rest(right: Any, first: int, n: int, width: int, m: int, w: Any, mask: int, k: Any, origin: int) -> None:
    """Set the residuals that go with `leave_out`: the multipliers themselves, of the stage at `origin` in `k`."""
    for i in range(width, n):
        if w[mask + (i - width) % m] > 0.0:
            right[first + i] = k[origin + i]
