"""Impulses with friction: rows that impulses hold at values, and columns along which they push, which are others.

A sliding contact holds the rate of its gap, ``W_N v+ = c``, by an impulse along ``W_N - s mu W_T``. The impulses along
W_T are multiples of those along W_N, and velocities are linear in both: the smallest impulse is found without those
along W_T and for one unit of each of them, and a small system has the multiples. Friction by reactions has impulses
that are known before: these act on the velocities from which the impact begins.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.effects.applying import (
    APPLIED,
    NO_VELOCITIES,
    EffectModel,
    EffectWork,
    energy_of_effects,
    fill_masses,
    probe_velocities,
)
from symgen.run.layout import abi
from symgen.run.layout.redundancy import is_off
from symgen.run.layout.scales import fill_jacobian
from symgen.run.layout.start_records import Instant
from symgen.run.starts.impulse import smallest_impulse
from symgen.run.starts.start_solvers import least_norm_above

_EPSILON = 2.0**-52
#: Whether bounds depend on reactions of joints beside one-sided rows.
REACTIONS = False
#: Whether restitutions are ratios of impulses, of expansion to compression.
POISSON = False
#: Whether friction of contacts has two rows, as in space.
PAIRED = False


class Ties(Record):
    """What impulses of contacts are tied to, by the velocities that events set, and working memory.

    Attributes
    ----------
    held, ratio, values : Array of int64, Array, Array, shapes (count,)
        1 where an impulse gives a velocity its value, 0 where it is without impulse, -1 where its impulse is `ratio`
        times that of the velocity before it; these values.
    row_of : Array of int64, shape (count,)
        Row of each velocity in the problem of impulses.
    push : Array, shape (count nv,)
        Rows of velocities that impulses push along and do not hold.
    after, taken : Array, shapes ((count + 1) nv,), ((count + 1) rows,)
        Velocities and impulses without those along `push`, then for one unit of each.
    mass, right, x, room, order, matrix : Array, Array of int64
        Working memory.
    impulses : Array, shape (count,)
        Impulse of each velocity.
    ways : Array, shape (count,)
        Sign of each multiple.
    kept, kept_ways : Array of int64, Array, shapes (count,)
        What was held, and those signs, at the latest impact, while it is followed by another one that brings to rest.
    leads, parts : Array of int64, Array, shapes (count,)
        Velocities that are left at `parts` times the velocity `leads`, those along contacts beside what they are; -1
        for others.
    kicks : Array, shape (rows,)
        Known impulses along rows that are off.
    """

    held: Integers
    ratio: Array
    values: Array
    row_of: Integers
    push: Array
    after: Array
    taken: Array
    mass: Array
    right: Array
    x: Array
    room: Array
    order: Integers
    matrix: Array
    impulses: Array
    ways: Array
    kept: Integers
    kept_ways: Array
    leads: Integers
    parts: Array
    kicks: Array


class KeptSeries(NamedTuple):
    """What a series of impacts that comes to rest follows from, see `symgen.run.modes.impact_memory.ImpactMemory`.

    Attributes
    ----------
    impacts, rates, rests : Array
        Copies of these arrays.
    """

    impacts: Array
    rates: Array
    rests: Array


class KeptTies(NamedTuple):
    """What an impact was tied to, for derivatives.

    Attributes
    ----------
    held, ways, leads, parts : Array of int64, Array, Array of int64, Array
        Copies of arrays of `Ties`.
    series : KeptSeries or None
        What ``parts`` follow from; None where no velocity is left at a part of another one.
    pins, kicks : Array of int64, Array, or None
        Of friction by reactions, the modes of rows with bounds, and the impulses along rows; None without any.
    """

    held: Integers
    ways: Array
    leads: Integers
    parts: Array
    series: KeptSeries | None = None
    pins: Integers | None = None
    kicks: Array | None = None


def new_ties(count: int, n: int, m: int) -> Any:
    """Return memory for `count` velocities that events set, in a model of n velocities and m rows."""
    numbers, most = np.zeros, max(n, count, 1)
    return Ties(
        held=np.zeros(count, dtype=np.int64),
        ratio=numbers(count),
        values=numbers(count),
        row_of=np.zeros(count, dtype=np.int64),
        push=numbers(count * n),
        after=numbers((count + 1) * n),
        taken=numbers((count + 1) * (m + count)),
        mass=numbers(most * most),
        right=numbers(most),
        x=numbers(most),
        room=numbers(most * most + 2 * most),
        order=np.zeros(most, dtype=np.int64),
        matrix=numbers(max(count * count, 1)),
        impulses=numbers(count),
        ways=numbers(count),
        kept=np.zeros(count, dtype=np.int64),
        kept_ways=numbers(count),
        leads=np.full(count, -1),
        parts=numbers(count),
        kicks=numbers(m),
    )


@exact()
def split_rows(model: EffectModel, t: float, now: Instant, chosen: Integers, work: EffectWork, ties: Ties) -> int:
    """Write the rows that impulses hold to the problem, and all along which they push; return the number of the former.

    Velocities of events that are not chosen have no impulse.
    """
    layout, geometry, _, _, changes = model
    n, m, impulse, count = layout.nv, layout.m, work.impulse, changes.owners.shape[0]
    rows = impulse.rows
    geometry(t, now.y, now.p, work.scratch)
    fill_jacobian(layout, work.scratch, rows)
    for j in range(n):
        ties.right[j] = 0.0
    for i in range(m):
        impulse.values[i] = work.scratch[layout.nu + i]
        if is_off(layout, i, work.scratch):
            impulse.values[i] = 0.0
            for j in range(n):
                ties.right[j] += ties.kicks[i] * rows[i * n + j] if REACTIONS else 0.0
                rows[i * n + j] = 0.0
    k = m
    for i in range(count):
        if chosen[changes.owners[i]] != 0:
            impulse.values[k] = ties.values[i]
            k += 1
    probe_velocities(model, t, now, chosen, work)
    fill_masses(model, work.scratch, work)
    kept, k = m, m
    for i in range(count):
        ties.row_of[i], ties.impulses[i] = -1, 0.0
        if chosen[changes.owners[i]] != 0:
            for j in range(n):
                ties.push[i * n + j] = rows[k * n + j]
            if ties.held[i] > 0:
                for j in range(n):
                    rows[kept * n + j] = rows[k * n + j]
                impulse.values[kept] = impulse.values[k]
                ties.row_of[i] = kept
                kept += 1
            k += 1
        else:
            ties.held[i] = 0
    return kept


@exact()
def solve_with(n: int, rows: int, v: Array, work: EffectWork, ties: Ties, place: int) -> bool:
    """Solve the problem for velocities before it, and keep the solution at a place of `ties`; return whether it is."""
    impulse = work.impulse
    if smallest_impulse(n, rows, v, impulse) != 0:
        return False
    most = ties.taken.shape[0] // (ties.held.shape[0] + 1)
    for j in range(n):
        ties.after[place * n + j] = impulse.after[j]
    for i in range(rows):
        ties.taken[place * most + i] = impulse.impulses[i]
    return True


@exact()
def move_freely(n: int, work: EffectWork, ties: Ties) -> None:
    """Write the velocities that an impulse gives to bodies that nothing holds to ``x``."""
    for j in range(n * n):
        ties.mass[j] = work.impulse.mass[j]
    least_norm_above(ties.mass, n, n, ties.right, ties.x, ties.room, ties.order, _EPSILON * n)


@exact()
def move_by_unit(n: int, i: int, work: EffectWork, ties: Ties) -> None:
    """Write the velocities after one unit of an impulse along a row of `push`, of bodies that nothing holds."""
    for j in range(n):
        ties.right[j] = ties.push[i * n + j]
    move_freely(n, work, ties)
    for j in range(n):
        work.still[j] = ties.x[j]


@exact()
def tie_impulses(count: int, ties: Ties) -> int:
    """Set the impulses of velocities that slide, from the impulses before them in their order; return their number."""
    most, slides = ties.taken.shape[0] // (count + 1), 0
    for a in range(count):
        if ties.held[a] < 0:
            gap = 2 if PAIRED and ties.held[a - 1] < 0 else 1
            ties.right[slides] = ties.ratio[a] * ties.taken[ties.row_of[a - gap]]
            column = 0
            for b in range(count):
                if ties.held[b] < 0:
                    own = 1.0 if a == b else 0.0
                    ties.matrix[slides * count + column] = (
                        own - ties.ratio[a] * ties.taken[(b + 1) * most + ties.row_of[a - gap]]
                    )
                    column += 1
            slides += 1
    for a in range(slides):
        for b in range(slides):
            ties.mass[a * slides + b] = ties.matrix[a * count + b]
    if slides > 0:
        least_norm_above(ties.mass, slides, slides, ties.right, ties.x, ties.room, ties.order, _EPSILON * slides)
    place = 0
    for a in range(count):
        if ties.held[a] < 0:
            ties.impulses[a] = ties.x[place]
            place += 1
    return slides


@exact(entry=True)
def push_contacts(model: EffectModel, t: float, now: Instant, chosen: Integers, work: EffectWork, ties: Ties) -> int:
    """Apply an impact with friction to the state of a run; parameters and result as of `apply_effects`.

    `ties` says which impulses hold velocities at values, and which are multiples of others; it keeps all impulses.
    """
    layout, _, formulas, _, changes = model
    n, nq, m, impulse, count = layout.nv, layout.nq, layout.m, work.impulse, changes.owners.shape[0]
    for i in range(work.scratch.shape[0]):
        work.scratch[i] = now.w[i]
    work.energy[0] = 0.0
    formulas(t, now.y, now.p, work.scratch, work.rate, work.out)
    rows = split_rows(model, t, now, chosen, work, ties)
    for j in range(n):
        work.still[j] = now.y[nq + j]
    if REACTIONS:
        move_freely(n, work, ties)
        for j in range(n):
            work.still[j] += ties.x[j]
    if not solve_with(n, rows, work.still, work, ties, 0):
        return int(NO_VELOCITIES)
    for i in range(rows):  # one unit of an impulse has nothing to reach
        impulse.values[i] = 0.0
    for i in range(count):
        if ties.held[i] < 0:
            move_by_unit(n, i, work, ties)
            if not solve_with(n, rows, work.still, work, ties, i + 1):
                return int(NO_VELOCITIES)
    tie_impulses(count, ties)
    most = ties.taken.shape[0] // (count + 1)
    for j in range(n):
        impulse.after[j] = ties.after[j]
    for i in range(rows):
        impulse.impulses[i] = ties.taken[i]
    for a in range(count):
        if ties.held[a] < 0:
            for j in range(n):
                impulse.after[j] += ties.impulses[a] * ties.after[(a + 1) * n + j]
            for i in range(rows):
                impulse.impulses[i] += ties.impulses[a] * ties.taken[(a + 1) * most + i]
    for a in range(count):
        if ties.held[a] > 0:
            ties.impulses[a] = impulse.impulses[ties.row_of[a]]
    for j in range(n):
        if not math.isfinite(impulse.after[j]):
            return int(NO_VELOCITIES)
    work.energy[0] = energy_of_effects(model, now.y, nq, work)
    for j in range(n):  # work.still has the velocities before it, for whoever asks what they change
        work.still[j] = now.y[nq + j]
        now.y[nq + j] = impulse.after[j]
    for i in range(m):
        if REACTIONS and ties.kicks[i] != 0.0:
            impulse.impulses[i] = ties.kicks[i]
    k = m
    for a in range(count):  # in the order of velocities of chosen events, as those of other effects are
        if chosen[changes.owners[a]] != 0:
            impulse.impulses[k] = ties.impulses[a]
            k += 1
    now.y[nq + n] += work.energy[0]  # work of the impulses: the energy balance continues
    now.w[abi.KINETIC] += work.energy[0]
    return int(APPLIED)
