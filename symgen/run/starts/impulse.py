"""The smallest impulse along some rows, in the metric of M: dense algebra of the loop language.

An impulse i changes velocities by ``M (v+ - v-) = C^T i``. With ``C v+ = c`` this is the v+ for which the kinetic
energy of the change, ``(v+ - v-)^T M (v+ - v-) / 2``, is smallest.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout.scales import larger_number
from symgen.run.starts.start_solvers import least_norm_above

#: Rows with an independent part below this fraction of the largest are rounding; relative residual of rows that hold.
ROUNDING, HOLDS = 1e-11, 1e-9
#: Rounding of velocities of joints, relative to the velocities of which these are differences.
_NOISE = 1e-14
_EPSILON = 2.0**-52


class Impulse(Record):
    """A problem with n velocities and k rows, its working memory and its solution.

    Attributes
    ----------
    mass, rows, values : Array, shapes (n, n), (k, n), (k,)
        M, C and c.
    unit, scale : Array, shapes (n,), (k,)
        Units of velocities with equal kinetic energy; factors of rows that have equal lengths in these units.
    after, impulses : Array, shapes (n,), (k,)
        V+ and i.
    change, basis, matrix, right, x, room, order : Array, Array of int64
        Working memory.
    """

    mass: Array
    rows: Array
    values: Array
    unit: Array
    scale: Array
    after: Array
    impulses: Array
    change: Array
    basis: Array
    matrix: Array
    right: Array
    x: Array
    room: Array
    order: Integers


def sizes_of_impulse(n: int, k: int) -> tuple[int, ...]:
    """Return the lengths of the arrays of numbers of a problem with `n` velocities and up to `k` rows."""
    most = max(n, k)
    return n * n, k * n, k, n, k, n, k, n, n * n, most * max(n, 1), most, most, most * min(most, n) + 2 * most


def new_impulse(n: int, k: int) -> Any:
    """Return memory for a problem with `n` velocities and up to `k` rows."""
    return Impulse._make((*(np.zeros(size) for size in sizes_of_impulse(n, k)), np.zeros(max(n, k), dtype=np.int64)))


@exact()
def scale_rows(n: int, k: int, work: Impulse) -> None:
    """Set units of velocities and factors of rows."""
    mass, rows, unit, scale = work.mass, work.rows, work.unit, work.scale
    usual = longest = 0.0
    for j in range(n):
        usual += mass[j * n + j] / n
    usual = usual if usual > 0.0 else 1.0
    for j in range(n):
        own = mass[j * n + j]
        unit[j] = 1.0 / math.sqrt(own if own > 0.0 else usual)
    for i in range(k):
        square = 0.0
        for j in range(n):
            square += (rows[i * n + j] * unit[j]) ** 2
        scale[i] = math.sqrt(square)
        longest = larger_number(longest, scale[i])
    for i in range(k):
        # a row that the joints of a tree satisfy by construction is rounding: scaled, it would become a constraint
        scale[i] = 1.0 / scale[i] if scale[i] > ROUNDING * longest else 0.0


@exact()
def close_in_rows(n: int, k: int, v: Array, work: Impulse) -> int:
    """Add to `change` the shortest change that satisfies the rows; return their rank."""
    rows, unit, scale, matrix, right, x = work.rows, work.unit, work.scale, work.matrix, work.right, work.x
    for i in range(k):
        rest, done = work.values[i], 0.0
        for j in range(n):
            matrix[i * n + j] = scale[i] * rows[i * n + j] * unit[j]
            rest -= rows[i * n + j] * v[j]
            done += matrix[i * n + j] * work.change[j]
        right[i] = scale[i] * rest - done
    rank = least_norm_above(matrix, k, n, right, x, work.room, work.order, ROUNDING)
    for j in range(n):
        work.change[j] += x[j]
    return int(rank)


@exact()
def lower_in_null_space(n: int, rank: int, work: Impulse) -> None:
    """Add to `change` the vector of the null space of the rows that makes the energy of the change smallest.

    The last columns of the reflections of `close_in_rows` are a basis of this space. M may be singular where the rows
    determine velocities without mass.
    """
    mass, unit, matrix, right, x, basis = work.mass, work.unit, work.matrix, work.right, work.x, work.basis
    free = n - rank
    for c in range(free):
        for j in range(n):
            basis[c * n + j] = 1.0 if j == rank + c else 0.0
        for k in range(rank - 1, -1, -1):
            row = work.order[k] * n
            total = 0.0
            for j in range(k, n):
                total += matrix[row + j] * basis[c * n + j]
            total *= work.room[k]
            for j in range(k, n):
                basis[c * n + j] -= total * matrix[row + j]
    for c in range(free):
        right[c] = 0.0
        for j in range(n):
            x[j] = 0.0
            for i in range(n):
                x[j] += basis[c * n + i] * (unit[i] * mass[i * n + j] * unit[j])
            right[c] -= x[j] * work.change[j]
        for d in range(free):
            total = 0.0
            for j in range(n):
                total += x[j] * basis[d * n + j]
            matrix[c * free + d] = total
    least_norm_above(matrix, free, free, right, x, work.room, work.order, _EPSILON * free)
    for c in range(free):
        for j in range(n):
            work.change[j] += x[c] * basis[c * n + j]


@exact()
def solve_impulses(n: int, k: int, work: Impulse) -> None:
    """Set the impulse of each row from `change`, of least norm where rows depend on each other."""
    for j in range(n):
        work.right[j] = 0.0
        for i in range(n):
            work.right[j] += work.unit[j] * work.mass[j * n + i] * work.unit[i] * work.change[i]
        for i in range(k):
            work.matrix[j * k + i] = work.scale[i] * work.rows[i * n + j] * work.unit[j]
    least_norm_above(work.matrix, n, k, work.right, work.impulses, work.room, work.order, ROUNDING)
    for i in range(k):
        work.impulses[i] *= work.scale[i]


@exact()
def set_uncoupled(n: int, k: int, v: Array, work: Impulse) -> bool:
    """Set the solution where M is diagonal and each row gives a value to a velocity of its own; return whether so."""
    mass, after, order = work.mass, work.after, work.order
    if k > n:
        return False
    for j in range(n):
        after[j], order[j] = v[j], 0
        for i in range(n):
            if i != j and mass[i * n + j] != 0.0:
                return False
    for i in range(k):
        own = -1
        for j in range(n):
            entry = work.rows[i * n + j]
            if entry != 0.0:
                if own >= 0 or entry != 1.0:
                    return False
                own = j
        if own < 0 or order[own] != 0:
            return False
        order[own], after[own] = 1, work.values[i]
        work.impulses[i] = mass[own * n + own] * (after[own] - v[own])
    return True


@exact(entry=True)
def smallest_impulse(n: int, k: int, v: Array, work: Impulse) -> int:
    """Set the velocities after the smallest impulse along the rows of `work`, and the impulses.

    Parameters
    ----------
    n, k : int
        Velocities and rows.
    v : Array, shape (n,)
        Velocities before.
    work : Impulse
        The problem; written.

    Returns
    -------
    int
        1 where ``C v+ - c`` is larger than rounding: the rows contradict each other; else 0.
    """
    rows, scale = work.rows, work.scale
    if set_uncoupled(n, k, v, work):
        return 0
    scale_rows(n, k, work)
    for j in range(n):
        work.change[j] = 0.0
    for _ in range(2):  # the second time corrects rounding
        rank = close_in_rows(n, k, v, work)
        lower_in_null_space(n, rank, work)
    for j in range(n):
        work.after[j] = v[j] + work.unit[j] * work.change[j]
    solve_impulses(n, k, work)
    wanted = moved = noise = 0.0
    for i in range(k):
        before = fast = 0.0
        for j in range(n):
            before += rows[i * n + j] * v[j]
            # the change of a slow body may be less than the rounding of fast ones
            fast += abs(rows[i * n + j]) * (abs(v[j]) + abs(work.after[j]))
        wanted = larger_number(wanted, abs(scale[i] * work.values[i]))
        moved, noise = larger_number(moved, abs(scale[i] * before)), larger_number(noise, scale[i] * fast)
    for i in range(k):
        left = -work.values[i]
        for j in range(n):
            left += rows[i * n + j] * work.after[j]
        if not abs(scale[i] * left) <= HOLDS * (wanted + moved) + _NOISE * noise:
            return 1
    return 0
