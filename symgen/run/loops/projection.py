"""Small dense systems of one state: accelerations along rows of any rank, and efforts that make them.

Both are functions of the state alone: which rows depend on others is decided anew at every call, by orthonormal rows
with the longest remainder first.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.native.annotations import Array, Integers
from symgen.compile.store.jit import jit

#: What the functions return.
DONE, LIGHT, SINGULAR, MISSING, UNDEFINED = range(5)
#: A row with less than this part of its length beside others depends on them.
DEPENDENT = 1e-10
#: A pivot of M with less than this part of its diagonal is rounding.
NO_MASS = 1e-14
#: Part of what accelerations take that efforts may leave.
LEFT = 1e-9


def projection_room(n: int, m: int, k: int = 0) -> int:
    """Return the length of the working memory for `n` velocities, `m` rows and `k` actuators."""
    return max(n * n + n + m * n + m, n + m * n + m + 2 * k * n + k * k + 3 * k)


@jit()
def orthonormalise(rows: Array, right: Array, count: int, n: int) -> int:
    """Replace rows, and right-hand sides of their equations, by orthonormal ones; return their number.

    They come first, in the order in which they were taken; rows that depend on them are left behind as rounding.
    """
    for i in range(count):
        square = 0.0
        for j in range(n):
            square += rows[i * n + j] * rows[i * n + j]
        scale = 1.0 / math.sqrt(square) if square > 0.0 else 0.0
        right[i] *= scale
        for j in range(n):
            rows[i * n + j] *= scale
    for k in range(count):
        best, largest = k, -1.0
        for i in range(k, count):
            square = 0.0
            for j in range(n):
                square += rows[i * n + j] * rows[i * n + j]
            if square > largest:
                best, largest = i, square
        if not largest > DEPENDENT * DEPENDENT:
            return k
        scale = 1.0 / math.sqrt(largest)
        for j in range(n):
            value = rows[best * n + j] * scale
            rows[best * n + j] = rows[k * n + j]
            rows[k * n + j] = value
        value = right[best] * scale
        right[best] = right[k]
        right[k] = value
        for i in range(k + 1, count):
            along = 0.0
            for j in range(n):
                along += rows[k * n + j] * rows[i * n + j]
            right[i] -= along * right[k]
            for j in range(n):
                rows[i * n + j] -= along * rows[k * n + j]
    return count


@jit()
def place_on_constraints(rows: Array, right: Array, count: int, x: Array, n: int) -> None:
    """Move a vector the shortest way to where orthonormal rows have their right-hand sides."""
    for i in range(count):
        along = -right[i]
        for j in range(n):
            along += rows[i * n + j] * x[j]
        for j in range(n):
            x[j] -= along * rows[i * n + j]


@jit(entry=True)
def project_accelerations(sizes: Integers, w: Array, out: Array) -> int:
    """Set `out` to v' of M v' + D^T lambda = f, D v' = gamma.

    Parameters
    ----------
    sizes : Array
        Numbers of velocities and rows, and the least rank of D.
    w : Array
        M, f, D and gamma, row by row; overwritten.
    out : Array
        The result.
    """
    n, m = sizes[0], sizes[1]
    x, rows, right = part(w, n * n, n), part(w, n * n + n, m * n), part(w, n * n + n + m * n, m)
    for k in range(n):
        diagonal = w[k * n + k]
        pivot = diagonal
        for j in range(k):
            pivot -= w[k * n + j] * w[k * n + j]
        if pivot != pivot:
            return UNDEFINED
        if not pivot > NO_MASS * diagonal:
            return LIGHT
        root = math.sqrt(pivot)
        w[k * n + k] = root
        for i in range(k + 1, n):
            value = w[i * n + k]
            for j in range(k):
                value -= w[i * n + j] * w[k * n + j]
            w[i * n + k] = value / root
    for r in range(m + 1):
        begin = n * n + r * n  # f, then the rows
        for i in range(n):
            value = w[begin + i]
            for j in range(i):
                value -= w[i * n + j] * w[begin + j]
            w[begin + i] = value / w[i * n + i]
    rank = orthonormalise(rows, right, m, n)
    if rank < sizes[2]:
        return SINGULAR
    place_on_constraints(rows, right, rank, x, n)
    for i in range(n - 1, -1, -1):
        value = x[i]
        for j in range(i + 1, n):
            value -= w[j * n + i] * out[j]
        out[i] = value / w[i * n + i]
    return DONE


@jit(entry=True)
def project_efforts(sizes: Integers, w: Array, out: Array) -> int:
    """Set `out` to the shortest efforts that balance M a - f with the help of rows.

    Parameters
    ----------
    sizes : Array
        Numbers of velocities and rows, the least rank of D, the number of named actuators, and 1 if they are named;
        else there is one along each velocity.
    w : Array
        M a - f, D, and, for named actuators, their present values and the effort of 1 of each on the velocities.
    out : Array
        The result.
    """
    n, m, count = sizes[0], sizes[1], sizes[3]
    x, rows = part(w, 0, n), part(w, n, m * n)
    free = n + m * n + count + count * n
    right = part(w, free, m)
    for i in range(m):
        right[i] = 0.0
    rank = orthonormalise(rows, right, m, n)
    if rank < sizes[2]:
        return SINGULAR
    size = 0.0
    for j in range(n):
        size += x[j] * x[j]
    place_on_constraints(rows, right, rank, x, n)
    if sizes[4] == 0:
        for j in range(n):
            out[j] = x[j]
        return DONE
    values, ways = part(w, n + m * n, count), part(w, n + m * n + count, count * n)
    begin = free + m
    none, products = part(w, begin, count), part(w, begin + count, count * count)
    for i in range(count):
        place_on_constraints(rows, right, rank, part(w, n + m * n + count + i * n, n), n)
        none[i] = 0.0
        for j in range(n):
            size += (values[i] * ways[i * n + j]) * (values[i] * ways[i * n + j])
    # orthonormal ways q, and the products q . way, before the ways are overwritten
    copied = part(w, begin + count + count * count, count * n)
    for i in range(count * n):
        copied[i] = ways[i]
    found = orthonormalise(copied, none, count, n)
    needed = part(w, begin + count + count * count + count * n, count)
    for k in range(found):
        needed[k] = 0.0
        for j in range(n):
            needed[k] += copied[k * n + j] * x[j]
        for i in range(count):
            products[k * count + i] = 0.0
            for j in range(n):
                products[k * count + i] += copied[k * n + j] * ways[i * n + j]
    for k in range(found):
        for j in range(n):
            x[j] -= needed[k] * copied[k * n + j]
    left = 0.0
    for j in range(n):
        left += x[j] * x[j]
    if left > LEFT * LEFT * size:
        return MISSING
    for i in range(count):
        out[i] = 0.0
    rank = orthonormalise(products, needed, found, count)
    place_on_constraints(products, needed, rank, out, count)
    for i in range(count):
        out[i] += values[i]
    return DONE
