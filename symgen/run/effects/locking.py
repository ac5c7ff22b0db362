"""Where drivers lock: rows that vanish together, for programs without loops of their own."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout import abi
from symgen.run.layout.redundancy import farthest_row, is_off
from symgen.run.layout.scales import square_rows
from symgen.run.layout.start_records import Instant, Layout

#: Sine of the angle between rows below which they vanish together, the share of the largest factor below which a row
#: takes no part, and the number of inverse iterations.
SINE, HOLDS, ROUNDS = 1e-2, 3e-5, 8
#: Added to the square of a row's remainder: a row that vanishes to the last bit has a factor that is finite.
NOTHING = 1e-60
#: Most coordinates that are named, their least share of the largest one, and the relative difference below which jumps
#: are equal, of which the first are named: the state is a bit before the dead centre.
MOST_NAMED, COUNTS, EQUAL = 3, 0.3, 3e-2
#: Layout, ``geometry``, 1 for each row of a driver, else 0, and the number of rows that depend on others everywhere.
LockModel = tuple[Layout, abi.Measure, Integers, int]


class LockWork(Record):
    """Working memory and results.

    Attributes
    ----------
    numbers, scale, factors, sums : Array
        Memory of the choice of rows; reciprocal lengths of rows; factors of rows in the combination that vanishes,
        before and after an iteration.
    jumps : Array, shape (nv,)
        How far coordinates would jump, relative to each other.
    drivers : Array of int64, shape (m,)
        1 for each row of a driver that can go no further, else 0.
    named : Array of int64, shape (MOST_NAMED,)
        Velocities of the coordinates that would jump farthest, by falling jumps, then -1.
    """

    numbers: Array
    scale: Array
    factors: Array
    sums: Array
    jumps: Array
    drivers: Integers
    named: Integers


def new_lock_work(layout: Layout) -> Any:
    """Return working memory."""
    m, n = layout.m, layout.nv
    integers = (np.zeros(size, dtype=np.int64) for size in (m, MOST_NAMED))
    return LockWork._make((*map(np.zeros, (m * (n + m) + m, m, m, m, n)), *integers))


@exact()
def name_jumps(jumps: Array, count: int, named: Integers) -> None:
    """Write the places of the largest jumps."""
    for k in range(MOST_NAMED):
        best = -1
        for j in range(count):
            is_new = True
            for i in range(k):
                is_new = is_new and named[i] != j
            if is_new and (best < 0 or jumps[j] > jumps[best] * (1.0 + EQUAL)):
                best = j
        counts = (
            best >= 0 and (k == 0 or named[k - 1] >= 0) and jumps[best] > COUNTS * jumps[best if k == 0 else named[0]]
        )
        named[k] = best if counts else -1


@exact(entry=True)
def find_lock(model: LockModel, t: float, now: Instant, work: LockWork) -> bool:
    """Return whether drivers lock at a state: with other rows, their rows nearly vanish.

    Inverse iteration finds the combination of rows that vanishes first, and the velocity that hardly changes any row.
    Rows that depend on others at the start do so everywhere and are left out by their number: however near a step comes
    to the dead centre, the row that vanishes only there is farther from the others than they are.

    Parameters
    ----------
    model : tuple
        See `LockModel`.
    t : float
        Time [s].
    now : Instant
        State, parameters and scratch.
    work : LockWork
        Working memory.
    """
    layout, geometry, driven, redundant = model
    m, n, numbers, factors, jumps = layout.m, layout.nv, work.numbers, work.factors, work.jumps
    width, largest, usual, size, locked = n + m, 0.0, 0.0, 0.0, False
    geometry(t, now.y, now.p, now.w)
    square_rows(layout, now.w, work.scale)
    for i in range(m):  # rows as lengths
        square = work.scale[i] * (1.0 if layout.rows[2 * i + 1] != 0 else now.w[abi.LENGTH] ** 2)
        work.scale[i] = 1.0 / math.sqrt(square) if square > 0.0 else 0.0
        usual = work.scale[i] if work.scale[i] > usual else usual
        factors[i] = 1.0 + i / m
    count = m - redundant
    for i in range(m):
        count -= 1 if is_off(layout, i, now.w) else 0
    farthest_row(layout, width, count, 0.0, 0, now.w, numbers)
    for _ in range(ROUNDS):
        for j in range(n):
            jumps[j] = 0.0
        for i in range(m):
            work.sums[i] = 0.0
        for k in range(m):
            if numbers[m * width + k] < 0.0:  # an independent row
                square, product = NOTHING, 0.0
                for j in range(n):
                    square += numbers[k * width + j] * numbers[k * width + j]
                for i in range(m):
                    product += numbers[k * width + n + i] * work.scale[i] * factors[i]
                for j in range(n):
                    jumps[j] += product / square * numbers[k * width + j]
                for i in range(m):
                    work.sums[i] += product / square * numbers[k * width + n + i]
        size = largest = 0.0
        for i in range(m):
            work.sums[i] *= work.scale[i]
            size += work.sums[i] * work.sums[i]
        size = math.sqrt(size)
        for i in range(m):
            factors[i] = work.sums[i] / size if size > 0.0 else 0.0
            largest = abs(factors[i]) if abs(factors[i]) > largest else largest
    for i in range(m):
        holds = driven[i] != 0 and abs(factors[i]) > HOLDS * largest
        work.drivers[i] = 1 if holds else 0
        locked = locked or holds
    for j in range(n):
        jumps[j] = abs(jumps[j])
    name_jumps(jumps, n, work.named)
    return locked and size * SINE * SINE > usual * usual
