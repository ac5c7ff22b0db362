"""What impacts that accumulate change at contacts beside them, compiled: the sum of a geometric series.

Flights between the impacts of a contact last ever shorter, and what one changes falls with the rate u that remains. A
contact beside it may slip after each impact and stick before the next one, so that no modes have the sum of what is
left out. But two impacts have it: between them the rates z of all rows that depend on the contact have changed by
``dz``, and u by ``du``; those that are left out change them by ``-u dz / du``, in a time of ``-u dt / du``. The run
goes on at the time of the latest impact in the modes at rest. Their accelerations a in that time are taken off before:

    z+ = z - u (dz - a dt) / du
"""

from __future__ import annotations

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.accumulation import OF_EVENT
from symgen.run.effects.pushing import REACTIONS
from symgen.run.layout import abi
from symgen.run.layout.scales import larger_number
from symgen.run.layout.start_records import Instant
from symgen.run.modes.bounded_rows import SAME, STILL, row_scale, switch_off
from symgen.run.modes.choice import follow_modes
from symgen.run.modes.choosing import choose_modes
from symgen.run.modes.found_rows import forget_found
from symgen.run.modes.impact_memory import AT, HEAD, RATE, REMEMBERED
from symgen.run.modes.pin_impulses import probe_impact, push
from symgen.run.modes.probing import by_reaction
from symgen.run.modes.reading import find_starting, read_rows, recall_rates
from symgen.run.modes.row_records import TOUCHING, Choice
from symgen.run.modes.strikes import Strikes, accelerate_in_force

#: Rates below this part of what is left out of them end with the series.
_ENDS = 0.02
#: Sums by one flight and by two that differ by less than this part are of the same modes.
SAME_MODES = 0.02
#: Rates that differ by less than this part of those that remain are the same sum.
_SAME_SUM = 5e-3


@exact()
def remember_impact(t: float, c: Choice, s: Strikes) -> None:
    """Remember the rates after the latest impact for the contacts that it has struck."""
    impacts, size = s.memory.impacts, HEAD + c.rows.count
    for i in range(c.rows.dry, c.rows.count):
        if s.active[i] != 0 and s.before[i] < 0.0:
            at = REMEMBERED * size * i
            for place in range(size):
                impacts[at + size + place] = impacts[at + place]
            impacts[at + AT], impacts[at + RATE] = t, s.asked[i]
            for row in range(c.rows.count):
                impacts[at + HEAD + row] = c.read.speed[row]


@exact()
def remembers(c: Choice, s: Strikes, i: int, past: int) -> bool:
    """Return whether an impact before the latest one of a gap is remembered: its rates are larger."""
    at, event = (HEAD + c.rows.count) * (REMEMBERED * i + past - 1), s.events[i]
    count = s.effects.past.counts[event]
    if count <= past:
        return False
    same = s.memory.impacts[at + AT] == s.effects.past.times[OF_EVENT * event + count - 1 - past]
    return bool(same and s.memory.impacts[at + RATE] > s.asked[i])


@exact()
def is_geometric(t: float, c: Choice, s: Strikes, i: int) -> bool:
    """Return whether the last two flights of a gap are of one geometric series, and not of several."""
    if not (remembers(c, s, i, 1) and remembers(c, s, i, 2)):
        return False
    impacts, at, u = s.memory.impacts, REMEMBERED * (HEAD + c.rows.count) * i, s.asked[i]
    before = at + HEAD + c.rows.count
    one = (t - impacts[at + AT]) / (impacts[at + RATE] - u)
    two = (t - impacts[before + AT]) / (impacts[before + RATE] - u)
    return bool(abs(two - one) <= SAME_MODES * one)


@exact()
def find_leading(t: float, c: Choice, s: Strikes) -> int:
    """Set ``leads`` where contacts touch beside one whose impacts accumulate; return the number of rows in series."""
    leads, groups, count = s.memory.leads, s.memory.groups, 0
    for i in range(c.rows.count):
        leads[i] = -1
    for i in range(c.rows.dry, c.rows.count):
        if s.active[i] != 0 and s.before[i] < 0.0 and groups[i] >= 0 and leads[i] < 0 and is_geometric(t, c, s, i):
            beside = 0
            for j in range(c.rows.count):
                own = j == i or c.rows.partner[i] == j or by_reaction(c, j)
                beside += 1 if groups[j] == groups[i] and not own else 0
            for j in range(c.rows.count):
                if beside > 0 and groups[j] == groups[i]:
                    leads[j] = i
                    count += 1
    return count


@exact()
def left_over(c: Choice, s: Strikes, i: int, place: int, now: float) -> float:
    """Return how a number changes until the end of the series of a contact, over the rate that remains.

    It is the number of rows at `place` of an impact. The longer of two spans has less rounding.
    """
    size = HEAD + c.rows.count
    at, u = REMEMBERED * size * i, s.asked[i]
    one = (now - s.memory.impacts[at + place]) / (s.memory.impacts[at + RATE] - u)
    two = (now - s.memory.impacts[at + size + place]) / (s.memory.impacts[at + size + RATE] - u)
    return float(two if abs(two - one) <= SAME_MODES * abs(one) else one)


@exact()
def ends_closed(c: Choice, s: Strikes, w: Array, i: int) -> bool:
    """Return whether a gap of a series that the latest impact has not pushed is closed at the end of the series.

    It is at rest, or is thrown open by each impact, ever more slowly.
    """
    lead = s.memory.leads[i]
    if lead < 0 or s.active[i] != 0:
        return False
    if abs(c.read.speed[i]) <= STILL * row_scale(c, w, i, abi.SPEED):
        return True
    part = left_over(c, s, lead, HEAD + i, c.read.speed[i]) * s.asked[lead]
    closed = c.read.value[i] <= TOUCHING * row_scale(c, w, i, abi.LENGTH) and c.read.speed[i] > 0.0
    return bool(closed and abs(c.read.speed[i] + part) <= _ENDS * abs(part))


@exact()
def set_target(t: float, c: Choice, s: Strikes, lead: int, row: int, j: int, slides: bool) -> None:
    """Say at which rate a row of a series is left, the velocity j that its events set; as it stands, at 0.

    A gap that opens at rest does so at the end of the series; what ends with it sticks, or `slides` up to its end.
    """
    ties, rate, part, u = s.ties, s.memory.rates[row], 0.0, s.asked[lead]
    if c.rows.pushes[row] != 0:
        rate = 0.0
    else:
        part = left_over(c, s, lead, HEAD + row, rate)
        if abs(rate + part * u) <= _ENDS * abs(part * u):
            if not slides:
                return
            part = -rate / u
    ties.parts[j] = part - s.memory.rests[row] * left_over(c, s, lead, AT, t)
    ties.values[j] = rate + ties.parts[j] * u
    ties.leads[j] = first_velocity(s.effects.model[4].owners, s.events[lead])


@exact()
def set_targets(t: float, c: Choice, s: Strikes, slides: bool) -> None:
    """Say at which rates the rows of series are left: gaps are at rest, and friction has its sum, see `set_target`."""
    _, _, _, _, changes = s.effects.model
    owners, ties, gap_of = changes.owners, s.ties, -1
    for j in range(owners.shape[0]):
        gap_of = j if j == 0 or owners[j - 1] != owners[j] else gap_of
        for gap in range(c.rows.dry, c.rows.count):
            lead = s.memory.leads[gap]
            if owners[j] == s.events[gap] and lead >= 0 and s.active[gap] != 0:
                ties.held[j], ties.ratio[j], ties.values[j], ties.ways[j] = 1, 0.0, 0.0, 0.0
                row = gap if j == gap_of else c.rows.partner[gap]
                set_target(t, c, s, lead, row, j, slides)


@exact()
def first_velocity(owners: Integers, event: int) -> int:
    """Return the number of the first velocity that an event sets."""
    for j in range(owners.shape[0]):
        if owners[j] == event:
            return int(j)
    return -1


@exact()
def try_rest(t: float, c: Choice, s: Strikes, now: Instant, iw: Integers) -> bool:
    """Find rates and accelerations in the modes at rest after the impulses of ``ties``; return whether there are any.

    The state stays as it is.
    """
    memory, found = s.memory, False
    for i in range(now.y.shape[0]):
        memory.y[i] = now.y[i]
    for i in range(now.w.shape[0]):
        memory.w[i] = now.w[i]
    for i in range(c.rows.count):
        memory.rests[i] = 0.0
    forget_found(c, False)
    if push(t, c, s, now, True):
        if read_rows(t, c, now.y, now.p, now.w) == SAME:
            find_starting(t, c, now.w)
            if choose_modes(t, c, now.y, now.p, now.w, iw, memory.control) <= 1:
                follow_modes(t, c, now.y, now.p, now.w)
                accelerate_in_force(t, c, now, iw)
                for i in range(c.rows.count):
                    memory.rests[i], memory.rested[i] = c.out[i], c.read.speed[i]
                found = True
    switch_off(c, now.w)
    for i in range(now.y.shape[0]):
        now.y[i] = memory.y[i]
    for i in range(now.w.shape[0]):
        now.w[i] = memory.w[i]
    if REACTIONS:
        found = probe_impact(t, c, s, now.y, now.p, now.w, iw) == SAME and found
    recall_rates(c, memory.rates)
    return found


@exact()
def is_sum(t: float, c: Choice, s: Strikes) -> bool:
    """Return whether contacts beside have the sum of their series already: in modes that stay, without its rounding."""
    for gap in range(c.rows.dry, c.rows.count):
        lead, row = s.memory.leads[gap], c.rows.partner[gap]
        if lead >= 0 and s.active[gap] != 0:
            lasts = left_over(c, s, lead, AT, t) * s.asked[lead]
            if abs(s.memory.rested[gap] + s.memory.rests[gap] * lasts) > _SAME_SUM * s.asked[lead]:
                return False
            if row >= 0:
                part = left_over(c, s, lead, HEAD + row, s.memory.rates[row]) * s.asked[lead]
                other = s.memory.rested[row] + s.memory.rests[row] * lasts - s.memory.rates[row]
                if abs(other - part) > _SAME_SUM * (s.asked[lead] + abs(part)):
                    return False
    return True


@exact()
def sum_series(t: float, c: Choice, s: Strikes, now: Instant, iw: Integers) -> bool:
    """Say at which rates contacts are left beside those whose impacts accumulate, see `set_targets`.

    Returns whether there are such rates: those of more rows than velocities may contradict each other.
    """
    for i in range(c.rows.count):
        s.memory.rates[i], s.memory.modes[i] = c.read.speed[i], c.mode[i]
    found = try_rest(t, c, s, now, iw)
    if not (found and is_sum(t, c, s)):
        for i in range(c.rows.count):
            s.memory.first[i], s.memory.rests[i] = s.memory.rests[i], 0.0
        set_targets(t, c, s, False)
        found = try_rest(t, c, s, now, iw)
        set_targets(t, c, s, False)
        found = found and try_rest(t, c, s, now, iw)
        if not found:
            for i in range(c.rows.count):
                s.memory.rests[i] = s.memory.first[i]
            set_targets(t, c, s, True)
            found = try_rest(t, c, s, now, iw) and is_sum(t, c, s)
    for i in range(c.rows.count):
        c.mode[i] = s.memory.modes[i]
    return found


@exact()
def turns_back(c: Choice, s: Strikes, w: Array, i: int) -> bool:
    """Return whether a gap opens after the impact of another one, and has been struck before."""
    touches = c.read.value[i] <= TOUCHING * row_scale(c, w, i, abi.LENGTH) and c.read.speed[i] > 0.0
    return bool(touches and s.active[i] == 0 and s.effects.past.counts[s.events[i]] > 0)


@exact()
def end_in_turn(t: float, c: Choice, s: Strikes) -> float:
    """Return the end of impacts in turn, by the times between impacts of the gap that has just been struck."""
    past, end = s.effects.past, t
    for i in range(c.rows.dry, c.rows.count):
        k = s.events[i]
        if s.active[i] != 0 and past.counts[k] > 2:
            at = OF_EVENT * k + past.counts[k] - 1
            last, before = past.times[at] - past.times[at - 1], past.times[at - 1] - past.times[at - 2]
            if past.times[at] == t and last < before:
                end = larger_number(end, t + last * last / (before - last))
    return end
