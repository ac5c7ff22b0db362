"""Low flights between two impacts of a gap, compiled: what ends them, and which of them an importer loses."""

from __future__ import annotations

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.accumulation import OF_EVENT
from symgen.run.layout import abi
from symgen.run.layout.start_records import Instant
from symgen.run.modes.bounded_rows import NOT_APPLIED, OTHERS, SAME, is_held, row_scale, switch_off
from symgen.run.modes.row_records import Choice
from symgen.run.modes.strikes import BEST, COUNT, LAST, OF_SERIES, Strikes, accelerate_in_force, come_to_rest

#: Flights up to this part of the mechanism's length are low; an importer loses those whose duration errs by this part.
_LOW, _LOST = 1e-6, 0.1
#: Changes of a gap below this part of the mechanism's length are rounding.
_RESOLVED = 2e-15
#: A flight ends where this part of its duration is left.
_ENDING = 1e-3


@exact(entry=True)
def mark_flights(t: float, c: Choice, s: Strikes, w: Array) -> int:
    """Mark the open gaps that have been struck before and are between two impacts, though they may seem closed.

    The lowest flights stay within the resolution of positions. What ends them is their own event, and not one of
    another contact meanwhile. Returns the number of gaps.
    """
    past = s.effects.past
    for i in range(c.rows.dry, c.rows.count):
        count = past.counts[s.events[i]]
        c.flying[i] = 0
        if count > 0 and not is_held(c, w, i):
            since = t - past.times[OF_EVENT * s.events[i] + count - 1]
            c.flying[i] = 1 if c.read.value[i] > _ENDING * abs(c.read.speed[i]) * since else 0
    return int(c.rows.count - c.rows.dry)


@exact()
def end_of_flights(t: float, c: Choice, s: Strikes) -> float:
    """Return the end of the series of flights that `follow_series` has followed up to now; without any, the time."""
    for i in range(c.rows.count):
        at = OF_SERIES * i
        if s.active[i] != 0 and s.series[at + COUNT] > 0.0:
            return float(s.series[at + BEST] if s.series[at + COUNT] > 2.0 else s.series[at + LAST])
    return t


@exact(entry=True)
def end_flights(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array) -> int:
    """Bring the gaps of the latest impact to rest where an importer's tolerance loses their flights.

    A low flight takes twice the rate at its end over the acceleration. Where an importer finds another duration, its
    errors are as large as the flight, and the next ones, which are lower, would be errors alone: how long they would
    have lasted follows from those before. `gather` has written the accelerations. Returns as `gather` does.
    """
    lost = False
    for i in range(c.rows.dry, c.rows.count):
        pull, rate, flight = -c.out[i], -s.before[i], 0.0
        if s.active[i] != 0 and pull > 0.0 and rate > 0.0:
            last = OF_EVENT * s.events[i] + s.effects.past.counts[s.events[i]] - 1
            if s.effects.past.counts[s.events[i]] > 1:
                flight = s.effects.past.times[last] - s.effects.past.times[last - 1]
            low = 0.5 * rate * rate <= _LOW * row_scale(c, w, i, abi.LENGTH) * pull
            lost = lost or (low and flight > 0.0 and abs(flight * pull - 2.0 * rate) > _LOST * 2.0 * rate)
    if not lost:
        return SAME
    switch_off(c, w)
    end = end_of_flights(t, c, s)
    return OTHERS if come_to_rest(t, c, s, end, Instant(y, p, w)) == SAME else NOT_APPLIED


@exact()
def find_lost(t: float, c: Choice, s: Strikes, w: Array) -> bool:
    """Find the open gaps that are 0 again on the way up, while their flight is low: an importer has lost it.

    Since the impact a gap has grown by more than its rate times the time, as rates fall in a flight; where less than
    half of that is left, the height of the flight is below the importer's tolerance.
    """
    lost = False
    for i in range(c.rows.dry, c.rows.count):
        pull, rate, k = -c.out[i], c.read.speed[i], s.events[i]
        s.active[i] = 0
        if s.effects.past.counts[k] > 0 and not is_held(c, w, i) and pull > 0.0 and rate > 0.0:
            length = row_scale(c, w, i, abi.LENGTH)
            risen = rate * (t - s.effects.past.times[OF_EVENT * k + s.effects.past.counts[k] - 1])
            low = 0.5 * rate * rate <= _LOW * length * pull
            if low and risen > _RESOLVED * length and c.read.value[i] < 0.5 * risen:
                s.active[i], s.before[i], s.asked[i], lost = 1, -rate, rate, True
    return lost


@exact(entry=True)
def end_lost_flights(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array, iw: Integers) -> int:
    """Bring gaps to rest whose flight an importer has lost, see `find_lost`; rows have been read.

    Returns as `gather` does.
    """
    now = Instant(y, p, w)
    accelerate_in_force(t, c, now, iw)
    if not find_lost(t, c, s, w):
        return SAME
    end = end_of_flights(t, c, s)
    switch_off(c, w)
    return OTHERS if come_to_rest(t, c, s, end, now) == SAME else NOT_APPLIED
