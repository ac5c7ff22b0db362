"""Impacts of contacts, compiled: Newton's law for gaps, Coulomb's for impulses along them, and rest.

The rates after an impact have ``u_N+ + e min(u_N-, 0) >= 0`` beside an impulse that pushes, and friction whose impulse
is at most mu times that. The laws are those at rest, on rates
(`symgen.run.modes.contact_laws`); the velocities follow from a linear problem in the modes that are right.

Where impacts of one contact accumulate, or of several in turn, impulses in the modes of the last impact take what
is left of their rates: friction counts for the impacts that are left out, less what it does at rest in their place.
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.accumulation import accumulation, add_resets
from symgen.run.effects.pushing import PAIRED, POISSON, REACTIONS
from symgen.run.laws.problem import LOWER, OFF, ON, UPPER
from symgen.run.layout import abi
from symgen.run.layout.scales import larger_number
from symgen.run.layout.start_records import Instant
from symgen.run.modes.bounded_rows import (
    GAINED,
    NOT_APPLIED,
    NOT_FINITE,
    OTHERS,
    OUT_OF_RANGE,
    SAME,
    SIGN,
    STILL,
    is_held,
    row_scale,
    sign_of_number,
    switch_off,
)
from symgen.run.modes.contact_laws import solve_by_laws
from symgen.run.modes.contact_parts import choose_part, find_parts
from symgen.run.modes.contact_series import (
    end_in_turn,
    ends_closed,
    find_leading,
    remember_impact,
    sum_series,
    turns_back,
)
from symgen.run.modes.paired_rows import component_at, find_direction, first_of, is_first, length_at
from symgen.run.modes.pin_impulses import find_shortfall, probe_impact, push
from symgen.run.modes.probing import by_reaction, forget_kicks, pose_impact, probe
from symgen.run.modes.reading import read_rows
from symgen.run.modes.row_records import Choice
from symgen.run.modes.strikes import (
    OF_SERIES,
    Strikes,
    accelerate_in_force,
    ask_rates,
    choose_events,
    find_immovable,
    find_touching,
    follow_series,
    is_closing,
    is_struck,
)

#: Impulses below this part of the largest are rounding.
_NOTHING = 1e-12
#: Gaps are along each other where the squared cosine of their directions is nearer to 1.
_ALONG = 1e-9
#: An impact adds energy where its work is above this part of the work of its impulses, one by one.
_GAIN = 1e-9


@exact(entry=True)
def find_struck_contacts(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set the gaps that touch with the friction along them, all friction by reactions, and G; else as `find_struck`."""
    gaps = n = find_touching(c, w)
    if gaps == 0:
        return SAME
    for i in range(c.rows.count):
        own = c.rows.pushes[i] == 0 and c.rows.partner[i] < 0 and not by_reaction(c, i)
        c.signs[i] = w[c.rows.first + MODE_NUMBERS * i + SIGN] if own else 0.0
    for i in range(c.rows.dry):
        j = c.rows.partner[i]
        if (j >= 0 and c.taken[j] != 0 and c.rows.turning[i] == 0) or by_reaction(c, i):
            c.rest[n], c.taken[i] = i, 1
            n += 1
    c.at_rest[0] = n
    if probe(t, c, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    return int(find_immovable(c, w, leave_to_others(c, w)))


@exact()
def leave_to_others(c: Choice, w: Array) -> int:
    """Leave out closed gaps along which one strikes that was open, with their friction; return the number of gaps left.

    A contact goes on as another row there. Impulses of both are differences of rounding.
    """
    n, left, gaps, matrix, k = c.at_rest[0], 0, 0, c.problem.matrix, c.rows.count
    for r in range(n):
        i = c.rest[r]
        gap, kept = i if c.rows.pushes[i] != 0 else c.rows.partner[i], True
        for other in range(n if gap >= 0 and is_held(c, w, gap) else 0):
            j = c.rest[other]
            if c.rows.pushes[j] != 0 and not is_held(c, w, j) and is_closing(c, w, j):
                both = matrix[gap * k + gap] * matrix[j * k + j]
                kept = kept and matrix[gap * k + j] * matrix[gap * k + j] < (1.0 - _ALONG) * both
        if kept:
            c.rest[left] = i
            left += 1
            gaps += 1 if c.rows.pushes[i] != 0 else 0
        else:
            c.taken[i] = 0
    c.at_rest[0] = left
    return gaps


@exact()
def find_impulses(c: Choice, s: Strikes, w: Array) -> int:
    """Find the modes of an impact; return `SAME`, or why there are none."""
    rows = c.at_rest[0]
    pose_impact(c, s.asked, s.memory.kicked)
    for r in range(rows):
        i = c.rest[r]
        c.loose[i] = 0 if c.rows.pushes[i] != 0 else 1  # impulses of friction have the bound of motion
        c.best[i], c.forces[i], c.signs[i] = OFF, 0.0, 0.0
    find_parts(c)
    for i in range(c.rows.count):
        s.memory.groups[i] = -1
    for r in range(rows):
        s.memory.groups[c.rest[r]] = c.part[c.rest[r]]
    for first in range(c.rows.count):
        count = choose_part(c, first, rows)
        if count > 0:
            code = solve_by_laws(c, count, 1.0) if is_struck(c, s, w, count) else SAME
            if code != SAME:
                return int(code)
            for a in range(count):
                c.part[c.order[a]] = c.rows.count
    if PAIRED:
        for i in range(c.rows.dry):
            slides = c.best[i] == UPPER and c.rows.turning[i] == 0 and is_first(c, first_of(c, i))
            c.signs[i] = find_direction(c, i) if slides else 0.0
    return SAME


@exact()
def row_along(c: Choice, s: Strikes, i: int, j: int) -> int:
    """Return the row of friction of a gap that velocity j of its event is along."""
    owners = s.effects.model[4].owners
    return int(c.rows.partner[i] + (1 if j > 1 and owners[j - 2] == owners[j] else 0))


@exact()
def find_pushing(c: Choice, s: Strikes) -> int:
    """Find the gaps that push at the impact; return their number."""
    most, count = 0.0, 0
    for i in range(c.rows.count):
        s.active[i] = 0
    for r in range(c.at_rest[0]):
        most = larger_number(most, abs(c.forces[c.rest[r]]) if c.rows.pushes[c.rest[r]] != 0 else 0.0)
        if POISSON:
            most = larger_number(most, s.memory.kicked[c.rest[r]])
    for r in range(c.at_rest[0]):
        i = c.rest[r]
        impulse = -c.forces[i] + (s.memory.kicked[i] if POISSON else 0.0)
        if c.rows.pushes[i] != 0 and impulse > _NOTHING * most:
            s.active[i] = 1
            count += 1
    return count


@exact()
def tie_velocities(c: Choice, s: Strikes, rests: bool, keeps: bool) -> None:
    """Say which velocities of the events that push impulses hold, and at which values; `keeps`: for what follows."""
    _, _, _, _, changes = s.effects.model
    owners, ties = changes.owners, s.ties
    for j in range(owners.shape[0]):
        ties.held[j], ties.ratio[j], ties.values[j], ties.ways[j] = 0, 0.0, 0.0, 0.0
        ties.leads[j], ties.parts[j] = -1, 0.0
        for i in range(c.rows.dry, c.rows.count):
            if owners[j] == s.events[i] and s.active[i] != 0:
                friction = row_along(c, s, i, j) if PAIRED else c.rows.partner[i]
                if j == 0 or owners[j - 1] != owners[j]:
                    ties.held[j], ties.values[j] = 1, 0.0 if rests else s.asked[i]
                    if POISSON and not rests and c.mode[i] != ON:  # its impulse is that of compression alone
                        ties.held[j] = 0
                elif c.mode[friction] >= UPPER and (not POISSON or ties.held[j - 1] > 0):
                    sign = c.signs[friction] if PAIRED else 1.0 if c.mode[friction] == UPPER else -1.0
                    ties.held[j], ties.ways[j], ties.ratio[j] = -1, -sign, -sign * c.read.sliding[friction]
                elif c.mode[friction] == ON:
                    ties.held[j] = 1
        if keeps:
            ties.kept[j], ties.kept_ways[j] = ties.held[j], ties.ways[j]


@exact()
def lose_at_contacts(c: Choice, s: Strikes, y: Array) -> None:
    """Add what impulses take to the losses of their contacts, and their work to ``spent``.

    Each impulse does work by the sum of the rates before and after it.
    """
    _, _, _, _, changes = s.effects.model
    owners, ties, n, spent = changes.owners, s.ties, c.rows.layout.nv, s.memory.spent
    for j in range(owners.shape[0]):
        for i in range(c.rows.dry, c.rows.count):
            if owners[j] == s.events[i] and s.active[i] != 0:
                gap = j == 0 or owners[j - 1] != owners[j]
                place = i if gap else row_along(c, s, i, j) if PAIRED else c.rows.partner[i]
                rate, impulse = c.read.speed[place], ties.impulses[j]
                if POISSON:
                    impulse += s.memory.kicked[place]
                after = rate
                for q in range(n):
                    after += ties.push[j * n + q] * (y[c.rows.layout.nq + q] - s.effects.work.still[q])
                done = 0.5 * impulse * (rate + after)
                spent[0] += done
                spent[1] += 0.5 * abs(impulse) * (abs(rate) + abs(after))
                if s.losses[i] >= 0:
                    y[s.losses[i]] -= done


@exact()
def apply_impulses(t: float, c: Choice, s: Strikes, now: Instant, keeps: bool) -> int:
    """Find the impulses of an impact, or of a part of it, and apply them; return `SAME`, or why there are none."""
    code = find_impulses(c, s, now.w)
    if code != SAME:
        return int(code)
    s.pushing[0] = find_pushing(c, s)
    for i in range(c.rows.count):
        c.mode[i] = c.best[i]
        if REACTIONS:
            s.memory.pins[i] = c.best[i]
    choose_events(c, s, False)
    tie_velocities(c, s, False, keeps)
    if not push(t, c, s, now, False):
        return NOT_APPLIED
    lose_at_contacts(c, s, now.y)
    return SAME


@exact()
def expand(t: float, c: Choice, s: Strikes, now: Instant) -> int:
    """Apply the impulses of expansion after compression: each gap has at least its restitution times its first impulse.

    What the impact keeps is the sum of both. Returns as `apply_impulses` does.
    """
    _, _, _, _, changes = s.effects.model
    owners, memory, impulse, m = changes.owners, s.memory, s.effects.work.impulse, c.rows.layout.m
    energy, count = s.effects.work.energy[0], owners.shape[0]
    for row in range(m):
        memory.compressed[row] = impulse.impulses[row]
    for j in range(count):
        memory.compressed[m + j] = s.ties.impulses[j]
        for i in range(c.rows.dry, c.rows.count):
            if owners[j] == s.events[i] and (j == 0 or owners[j - 1] != owners[j]):
                memory.kicked[i] = c.read.restitution[i] * s.ties.impulses[j] if s.active[i] != 0 else 0.0
                memory.closes[i] = s.active[i]
    if read_rows(t, c, now.y, now.p, now.w) != SAME:
        return OUT_OF_RANGE
    code = apply_impulses(t, c, s, now, False)
    forget_kicks(c)
    if code != SAME:
        return int(code)
    for i in range(c.rows.dry, c.rows.count):
        s.active[i] = 1 if memory.closes[i] != 0 else s.active[i]
    choose_events(c, s, False)
    s.effects.work.energy[0] += energy
    for row in range(m):
        own = c.rows.place_of[row] < 0 or c.rows.pressed[c.rows.place_of[row]] != 0
        impulse.impulses[row] = memory.compressed[row] + impulse.impulses[row] if own else 0.0
    place = m
    for j in range(count):
        if s.chosen[owners[j]] != 0:
            total = memory.compressed[m + j] + s.ties.impulses[j]
            for i in range(c.rows.dry, c.rows.count):
                if owners[j] == s.events[i]:
                    gap = j == 0 or owners[j - 1] != owners[j]
                    total += memory.kicked[i if gap else c.rows.partner[i]]
            impulse.impulses[place] = total
            place += 1
    for i in range(c.rows.count):
        memory.kicked[i] = 0.0
    if read_rows(t, c, now.y, now.p, now.w) != SAME:
        return OUT_OF_RANGE
    for i in range(c.rows.dry, c.rows.count):
        s.asked[i] = c.read.speed[i] if s.active[i] != 0 else s.asked[i]
    return SAME


@exact(entry=True)
def strike_contacts(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array) -> int:
    """Change the velocities by the impact of `find_struck_contacts`; all rows with bounds are off after it.

    Returns `SAME`, or why there is none: no modes or several, `NOT_APPLIED`, or `GAINED` where it adds energy.
    """
    now = Instant(y, p, w)
    for r in range(c.at_rest[0]):
        c.shut[c.rest[r]] = 1 if c.rows.pushes[c.rest[r]] != 0 else 0
    switch_off(c, w)
    for i in range(c.rows.count):
        s.left[i], s.before[i] = math.nan, c.read.speed[i]
    s.memory.spent[0] = s.memory.spent[1] = 0.0
    for i in range(c.rows.count):
        s.memory.kicked[i] = 0.0
    if POISSON:  # compression takes all rates of gaps that close
        for i in range(c.rows.count):
            s.asked[i] = 0.0
    else:
        ask_rates(t, c, s, now)
    code = apply_impulses(t, c, s, now, True)
    if POISSON and code == SAME:
        code = expand(t, c, s, now)
    if code != SAME:
        return int(code)
    if s.memory.spent[0] > _GAIN * s.memory.spent[1]:
        for i in range(c.rows.count):
            c.named[0] = i if s.active[i] != 0 else c.named[0]
        c.jam[0] = s.memory.spent[0]
        return GAINED
    choose_events(c, s, True)
    add_resets(s.effects.past, s.chosen, t)
    return SAME


@exact()
def follow_past(t: float, c: Choice, s: Strikes, now: Instant, iw: Integers, hunt: Array) -> float:
    """Return the time at which the resets of the chosen events accumulate; nan where they do not."""
    functions = c.rows.rates, c.rows.confirm, s.effects.happens
    return float(accumulation(functions, t, c.rows.layout.nq, now, iw, hunt, s.chosen, s.effects.past))


@exact()
def find_lost_beside(t: float, c: Choice, s: Strikes, now: Instant, iw: Integers, hunt: Array) -> bool:
    """Find the gaps that open after the impact of another one, and whose own impacts accumulate, or are lost."""
    lost = False
    for i in range(c.rows.dry, c.rows.count):
        s.memory.closes[i] = 0
        opens = c.read.speed[i] > STILL * row_scale(c, now.w, i, abi.SPEED)
        if turns_back(c, s, now.w, i) or (opens and ends_closed(c, s, now.w, i)):
            for event in range(s.chosen.shape[0]):
                s.chosen[event] = 0
            s.chosen[s.events[i]] = 1
            own = follow_past(t, c, s, now, iw, hunt)
            if own == own:
                s.memory.closes[i], lost = 1, True
    return lost


@exact()
def find_closing(t: float, c: Choice, s: Strikes, w: Array, left: float) -> bool:
    """Find the gaps that turn back within what is left of a series of impacts: they take part in it.

    Gaps whose own flight takes longer fly on, though it be low. Returns whether any gap closes in turn.
    """
    in_turn = False
    for i in range(c.rows.dry, c.rows.count):
        fall = c.read.value[i] + (c.read.speed[i] + 0.5 * c.out[i] * left) * left
        if turns_back(c, s, w, i) and fall <= 0.0:
            s.memory.closes[i] = 1
        in_turn = in_turn or s.memory.closes[i] != 0
    return in_turn


@exact()
def recall_modes(c: Choice, s: Strikes) -> None:
    """Set the modes of friction anew that it had at the latest impact: since then modes without impulses are chosen."""
    _, _, _, _, changes = s.effects.model
    owners, ties = changes.owners, s.ties
    for j in range(1, owners.shape[0]):
        for i in range(c.rows.dry, c.rows.count):
            slides = owners[j] == owners[j - 1] and owners[j] == s.events[i]
            gap = j - 2 if PAIRED and j > 1 and owners[j - 2] == owners[j] else j - 1
            if slides and ties.kept[gap] > 0 and c.rows.partner[i] >= 0:
                way = UPPER if ties.kept_ways[j] < 0.0 else LOWER
                if PAIRED:
                    way, c.signs[row_along(c, s, i, j)] = UPPER, -ties.kept_ways[j]
                c.mode[row_along(c, s, i, j) if PAIRED else c.rows.partner[i]] = (
                    way if ties.kept[j] < 0 else (ON if ties.kept[j] > 0 else OFF)
                )


@exact()
def rest_contacts(t: float, c: Choice, s: Strikes, end: float, in_series: bool, now: Instant, iw: Integers) -> int:
    """Bring the gaps that push, or turn back, to rest, in the modes of the latest impact; friction has its part.

    What contacts beside them have of the impacts that are left out is the sum of a series.
    """
    recall_modes(c, s)
    for i in range(c.rows.dry, c.rows.count):
        turns = s.memory.closes[i] != 0
        if turns or ends_closed(c, s, now.w, i):
            s.active[i] = 1
            j = c.rows.partner[i]
            if j >= 0 and (turns or c.read.speed[i] > STILL * row_scale(c, now.w, i, abi.SPEED)):
                still = abs(c.read.speed[j]) <= STILL * row_scale(c, now.w, j, abi.SPEED)
                if PAIRED and is_first(c, j):
                    still = length_at(c, c.read.speed, j) <= STILL * row_scale(c, now.w, j, abi.SPEED)
                    c.mode[j] = c.mode[j + 1] = ON if still else UPPER
                    c.signs[j], c.signs[j + 1] = component_at(c, c.read.speed, j), component_at(c, c.read.speed, j + 1)
                else:
                    c.mode[j] = ON if still else (UPPER if sign_of_number(c.read.speed[j]) > 0.0 else LOWER)
    choose_events(c, s, False)
    tie_velocities(c, s, True, False)
    if REACTIONS:
        find_shortfall(c, s, end - t)
    if in_series and not sum_series(t, c, s, now, iw):
        tie_velocities(c, s, True, False)
    if not push(t, c, s, now, True):
        return NOT_APPLIED
    lose_at_contacts(c, s, now.y)
    for i in range(c.rows.dry, c.rows.count):
        if s.active[i] != 0:
            s.left[i] = larger_number(end - t, 0.0)
            s.effects.past.counts[s.events[i]] = 0
    for number in range(OF_SERIES * c.rows.count):
        s.series[number] = 0.0
    return SAME


@exact(entry=True)
def gather_contacts(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array, iw: Integers, hunt: Array) -> int:
    """Bring the gaps of the latest impact to rest where impacts accumulate, of one contact or of several in turn.

    Returns as `symgen.run.modes.strikes.gather` does.
    """
    now, count = Instant(y, p, w), int(s.pushing[0])
    s.pushing[0] = 0
    if count == 0:
        return SAME
    choose_events(c, s, True)
    end = follow_past(t, c, s, now, iw, hunt)
    in_series = find_leading(t, c, s) > 0
    lost = find_lost_beside(t, c, s, now, iw, hunt)
    accelerate_in_force(t, c, now, iw)
    series = follow_series(c, s, t, count)
    if not (end == end or lost):
        remember_impact(t, c, s)
        return SAME
    switch_off(c, w)
    # an impact in turn stays closed: whether it would fly again, and when, would be rounding
    turn = end_in_turn(t, c, s)
    in_turn = find_closing(t, c, s, w, larger_number(turn, series if series == series else t) - t)
    end = turn if in_turn or not series == series else series
    if REACTIONS and probe_impact(t, c, s, y, p, w, iw) != SAME:
        return NOT_FINITE
    return OTHERS if rest_contacts(t, c, s, end, in_series, now, iw) == SAME else NOT_APPLIED
