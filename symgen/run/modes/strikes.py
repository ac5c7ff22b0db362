"""Impacts at gaps: Newton's law through all rows of joints, in the metric of M, in one source for all targets.

At an impact the rate u of each gap that is 0 satisfies ``u+ >= r(u-)``, where r is the rate that the formula of its
event asks for, such as ``-e min(u-, 0)`` with a restitution e; its impulse only pushes, and one of both is zero: the
laws (`symgen.run.laws`) on rates instead of accelerations. A row with two bounds has no impulse. Where impacts follow
each other ever faster, so that the time until they accumulate counts as zero, the gap is at rest.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.effects.accumulation import accumulation, add_resets
from symgen.run.effects.applying import APPLIED, apply_effects
from symgen.run.effects.pushing import Ties, new_ties
from symgen.run.effects.resets import KeptEffect, OfEffects, new_kept_effect
from symgen.run.laws.motions import find_forces
from symgen.run.laws.problem import begin_row
from symgen.run.layout import abi
from symgen.run.layout.scales import larger_number
from symgen.run.layout.start_records import Instant
from symgen.run.modes.bounded_rows import (
    CONTRARY,
    IMMOVABLE,
    NOT_APPLIED,
    NOT_FINITE,
    OTHERS,
    SAME,
    SIGN,
    STILL,
    is_held,
    is_shut,
    row_scale,
    switch_off,
)
from symgen.run.modes.contact_laws import name_gaps
from symgen.run.modes.impact_memory import ImpactMemory, new_impact_memory
from symgen.run.modes.probing import copy_state, probe, write_rates
from symgen.run.modes.row_records import Choice

#: Impulses below this part of the largest are rounding.
_NOTHING = 1e-12
#: Numbers of the series of flights to and fro of a row: their number, the end that followed at the last impact, that of
#: the last two, the least change of the latter, and the end after it.
COUNT, LAST, _BETTER, _LEAST, BEST = range(5)
OF_SERIES = 5


class Strikes(Record):
    """Impacts of a run, and working memory.

    Attributes
    ----------
    effects : OfEffects
        Effects of all events.
    chosen : Array of int64, shape (events,)
        1 for events that happen.
    events, losses, active : Array of int64, shapes (rows,)
        Event of each one-sided row, -1 for others; place in the state of the energy that a row has taken, or -1; 1
        for gaps that strike.
    pushing : Array of int64, shape (1,)
        Number of rows that push at an impact whose accumulation has not been asked for.
    before, asked : Array, shapes (rows,)
        Rates of gaps before the latest impact; those that their events ask for after it.
    series : Array, shape (OF_SERIES rows,)
        For each row the numbers of its series of flights, at the places of `COUNT` and following.
    left : Array, shape (rows,)
        Time until the impacts of a gap that comes to rest would have accumulated [s], else nan.
    struck, rested : KeptEffect
        The latest impact; impulses that have brought gaps to rest where impacts accumulate.
    ties : Ties
        Of the latest impact of contacts, which impulses are multiples of others.
    memory : ImpactMemory
        Of impacts of contacts.
    """

    effects: OfEffects
    chosen: Integers
    events: Integers
    losses: Integers
    active: Integers
    pushing: Integers
    before: Array
    asked: Array
    series: Array
    left: Array
    struck: KeptEffect
    rested: KeptEffect
    ties: Ties
    memory: ImpactMemory


def new_strikes(effects: OfEffects, hits: Sequence[int], losses: Sequence[int], keeps: bool, contacts: bool) -> Strikes:
    """Return the impacts of a run.

    Parameters
    ----------
    effects : OfEffects
        Of all events.
    hits, losses : sequence of int
        Event of the impact of each row with bounds, and place in the state of the energy that it takes; -1 for none.
    keeps : bool
        Whether somebody reads the impacts.
    contacts : bool
        Whether there are contacts.
    """
    k = len(hits)
    work = effects.work
    sizes = k, len(work.state), len(work.scratch), len(work.impulse.impulses)
    remembered = sizes if contacts else (0, 0, 0, 0)
    return Strikes(
        effects=effects,
        chosen=np.zeros(len(effects.chosen), dtype=np.int64),
        events=np.array(hits, dtype=np.int64),
        losses=np.array(losses, dtype=np.int64),
        active=np.zeros(k, dtype=np.int64),
        pushing=np.zeros(1, dtype=np.int64),
        before=np.zeros(k),
        asked=np.zeros(k),
        series=np.zeros(OF_SERIES * k),
        left=np.zeros(k),
        struck=new_kept_effect(effects.model[0], effects.work, keeps),
        rested=new_kept_effect(effects.model[0], effects.work, keeps),
        ties=new_ties(len(effects.model[4].owners), effects.model[0].nv, effects.model[0].m),
        memory=new_impact_memory(*remembered),
    )


@exact()
def approaches(c: Choice, w: Array, i: int) -> bool:
    """Return whether the rate of a gap is below 0, by more than rounding."""
    return bool(c.read.speed[i] < -STILL * row_scale(c, w, i, abi.SPEED))


@exact()
def is_closing(c: Choice, w: Array, i: int) -> bool:
    """Return whether a gap that touches strikes: its rate is below 0, and no mode holds it.

    The rate of a gap that its mode has closed is what a method leaves of it.
    """
    return bool(not is_held(c, w, i) and approaches(c, w, i))


@exact()
def is_struck(c: Choice, s: Strikes, w: Array, count: int) -> bool:
    """Return whether a gap among the rows of a part strikes, or expands after compression.

    Other parts have no impulses: beside rates along their gaps, rounding of rates of 0 would count as impacts.
    """
    for a in range(count):
        i = c.order[a]
        # closed ones too, after a joint has caught
        if c.rows.pushes[i] != 0 and (approaches(c, w, i) or s.memory.kicked[i] != 0.0):
            return True
    return False


@exact()
def find_touching(c: Choice, w: Array) -> int:
    """Set the gaps that touch; return their number, 0 where none strikes."""
    n, strikes = 0, False
    for i in range(c.rows.count):
        c.taken[i] = 0
    for i in range(c.rows.dry, c.rows.count):
        if is_shut(c, w, i) and c.flying[i] == 0:
            c.rest[n], c.taken[i] = i, 1
            n += 1
            strikes = strikes or is_closing(c, w, i)
    return n if strikes else 0


@exact()
def find_immovable(c: Choice, w: Array, n: int) -> int:
    """Return `IMMOVABLE` and name a gap that strikes where nothing changes the rate of one, else `OTHERS`."""
    for r in range(n):
        i = c.rest[r]
        if is_closing(c, w, i) and c.problem.matrix[i * c.rows.count + i] == 0.0:
            c.named[0] = i
            return IMMOVABLE
    return OTHERS


@exact(entry=True)
def find_struck(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set the gaps that touch, and G among them, where one strikes: `OTHERS`; else `SAME`, or why there is no impact.

    That is `NOT_FINITE`, or `IMMOVABLE` with the gap named: its rate is what joints and drivers make of it.
    """
    n = find_touching(c, w)
    if n == 0:
        return SAME
    c.at_rest[0] = n
    for i in range(c.rows.count):
        c.signs[i] = w[c.rows.first + MODE_NUMBERS * i + SIGN] if c.rows.pushes[i] == 0 else 0.0
    if probe(t, c, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    return int(find_immovable(c, w, n))


@exact()
def find_active(c: Choice, s: Strikes) -> int:
    """Find the rows that push at the impact; return their number, -1 where no impulses keep all gaps from closing."""
    k, n, laws, most, count = c.rows.count, c.at_rest[0], c.laws, 0.0, 0
    for r in range(n):
        i = c.rest[r]
        c.order[r] = i
        begin_row(n, r, laws)
        laws.offset[r] = c.read.speed[i] - s.asked[i]
        for q in range(n):
            laws.matrix[r * n + q] = c.problem.matrix[i * k + c.rest[q]]
    if not find_forces(n, laws, 1):
        name_gaps(c, n)
        return -1
    for r in range(n):
        most = larger_number(most, abs(laws.forces[r]))
    for i in range(k):
        s.active[i] = 0
    for r in range(n):
        if -laws.forces[r] > _NOTHING * most:
            s.active[c.rest[r]] = 1
            count += 1
    return count


@exact()
def choose_events(c: Choice, s: Strikes, only_struck: bool) -> None:
    """Choose the events of rows that push; `only_struck`: of those whose gap becomes smaller before."""
    for event in range(s.chosen.shape[0]):
        s.chosen[event] = 0
    for i in range(c.rows.dry, c.rows.count):
        if s.active[i] != 0 and not (only_struck and s.before[i] >= 0.0):
            s.chosen[s.events[i]] = 1


@exact()
def ask_rates(t: float, c: Choice, s: Strikes, now: Instant) -> None:
    """Set the rates of gaps after an impact at the present state: the law of impacts is the formula of the event.

    An event that sets several velocities has that of the gap first.
    """
    _, _, formulas, _, changes = s.effects.model
    work, count = s.effects.work, changes.owners.shape[0]
    for i in range(work.scratch.shape[0]):
        work.scratch[i] = now.w[i]
    formulas(t, now.y, now.p, work.scratch, work.rate, work.out)
    for k in range(count):
        j = count - 1 - k
        for i in range(c.rows.dry, c.rows.count):
            if changes.owners[j] == s.events[i]:
                s.asked[i] = work.out[count + j]


@exact()
def lose(c: Choice, s: Strikes, first: bool, y: Array) -> None:
    """Add what an impact takes to the losses of its rows, by the sums of their rates before and after it."""
    place = c.rows.layout.m
    for i in range(c.rows.dry, c.rows.count):
        if s.active[i] != 0:
            rates = s.before[i] + s.asked[i] if first else s.asked[i]
            if s.losses[i] >= 0:
                y[s.losses[i]] -= 0.5 * (s.effects.work.impulse.impulses[place] * rates)
            place += 1


@exact()
def follow_series(c: Choice, s: Strikes, t: float, count: int) -> float:
    """Return the end of the series of flights of the only row that pushes, by all of its impacts; else nan.

    It follows at each impact from the rate and its change. Its errors fall with the square of the duration of a flight,
    of which the next one takes a part, the rate after the impact over that before; errors by rounding grow as flights
    become shorter. The time that changes least is taken.
    """
    end = math.nan
    for i in range(c.rows.count):
        at, e = OF_SERIES * i, -s.asked[i] / s.before[i] if s.before[i] < 0.0 else 0.0
        if s.active[i] == 0 or count != 1:
            s.series[at + COUNT] = 0.0
        elif c.out[i] < 0.0 and e < 1.0:
            now, part = t + 2.0 * e * (s.before[i] / c.out[i]) / (1.0 - e), e * e
            before = s.series[at + COUNT]
            if before > 0.0:
                better = (now - part * s.series[at + LAST]) / (1.0 - part)
                change = abs(better - s.series[at + _BETTER])
                if before > 1.0 and (before == 2.0 or change < s.series[at + _LEAST]):
                    s.series[at + _LEAST], s.series[at + BEST] = change, better
                s.series[at + _BETTER] = better
            s.series[at + LAST] = now
            s.series[at + COUNT] = before + 1.0
            end = s.series[at + BEST] if before > 1.0 else now
    return end


@exact()
def come_to_rest(t: float, c: Choice, s: Strikes, end: float, now: Instant) -> int:
    """Bring the gaps that push to rest: another impact takes the rest of their rates."""
    choose_events(c, s, False)
    for i in range(c.rows.dry, c.rows.count):
        if s.active[i] != 0:
            now.w[c.rows.first + MODE_NUMBERS * i + SIGN] = 1.0
    if apply_effects(s.effects.model, t, now, s.chosen, s.effects.work) != APPLIED:
        return NOT_APPLIED
    lose(c, s, False, now.y)
    for i in range(c.rows.dry, c.rows.count):
        if s.active[i] != 0:
            now.w[c.rows.first + MODE_NUMBERS * i + SIGN] = 0.0
            s.left[i] = larger_number(end - t, 0.0)
            if s.before[i] < 0.0:
                s.effects.past.counts[s.events[i]] = 0
    for number in range(OF_SERIES * c.rows.count):
        s.series[number] = 0.0
    return SAME


@exact(entry=True)
def strike(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array) -> int:
    """Change the velocities by the impact of `find_struck`; all rows with bounds are off after it.

    Returns `SAME`, `CONTRARY` where no impulses serve, or `NOT_APPLIED` where joints do not allow the impact.
    """
    now = Instant(y, p, w)
    for r in range(c.at_rest[0]):
        c.shut[c.rest[r]] = 1
    switch_off(c, w)
    for i in range(c.rows.count):
        s.left[i], s.before[i] = math.nan, c.read.speed[i]
    ask_rates(t, c, s, now)
    count = find_active(c, s)
    if count < 0:
        return CONTRARY
    choose_events(c, s, False)
    if apply_effects(s.effects.model, t, now, s.chosen, s.effects.work) != APPLIED:
        return NOT_APPLIED
    lose(c, s, True, y)
    choose_events(c, s, True)
    add_resets(s.effects.past, s.chosen, t)
    s.pushing[0] = count
    return SAME


@exact(entry=True)
def gather(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array, iw: Integers, hunt: Array) -> int:
    """Bring the gaps of the latest impact to rest where impacts accumulate in the modes chosen after it.

    Returns `OTHERS` where velocities have changed, with all rows with bounds off; else `SAME`, or `NOT_APPLIED`.
    """
    now, count = Instant(y, p, w), int(s.pushing[0])
    s.pushing[0] = 0
    if count == 0:
        return SAME
    choose_events(c, s, True)
    functions = c.rows.rates, c.rows.confirm, s.effects.happens
    end = accumulation(functions, t, c.rows.layout.nq, now, iw, hunt, s.chosen, s.effects.past)
    accelerate_in_force(t, c, now, iw)
    series = follow_series(c, s, t, count)
    if not end == end:
        return SAME
    switch_off(c, w)
    return OTHERS if come_to_rest(t, c, s, series if series == series else end, now) == SAME else NOT_APPLIED


@exact()
def accelerate_in_force(t: float, c: Choice, now: Instant, iw: Integers) -> None:
    """Write the accelerations of coordinates and gaps in the present modes to ``out``."""
    copy_state(c, now.y, now.w, iw)
    write_rates(t, c, now.p)
    c.rows.accelerations(t, c.y, now.p, c.w, c.rate, c.out)
