"""Low flights between two impacts of a gap that an importer's tolerance loses, compiled: the gap comes to rest."""

from __future__ import annotations

from symgen.compile.loopcode.exact import exact
from symgen.compile.loopcode.loop_instances import exact_instance
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.accumulation import OF_EVENT
from symgen.run.effects.pushing import REACTIONS
from symgen.run.layout import abi
from symgen.run.layout.start_records import Instant
from symgen.run.modes.bounded_rows import NOT_APPLIED, OTHERS, SAME, is_held, row_scale, switch_off
from symgen.run.modes.contact_impacts import rest_contacts
from symgen.run.modes.pin_impulses import BY_REACTIONS, probe_impact
from symgen.run.modes.row_records import Choice
from symgen.run.modes.strikes import BEST, COUNT, LAST, OF_SERIES, Strikes, accelerate_in_force, come_to_rest

#: Flights up to this part of the mechanism's length are low; an importer loses those whose duration errs by this part.
_LOW, _LOST = 1e-6, 0.1
#: Changes of a gap below this part of the mechanism's length are rounding.
_RESOLVED = 2e-15
#: Whether gaps come to rest beside rows whose bounds depend on forces, along contacts or by reactions.
RUBS = False


@exact()
def end_series(t: float, c: Choice, s: Strikes, end: float, now: Instant, iw: Integers) -> int:
    """Bring the gaps that push to rest with all rows off; return `OTHERS`, or `NOT_APPLIED`."""
    code = SAME
    if RUBS:
        for i in range(c.rows.count):
            s.memory.closes[i], s.memory.leads[i] = 0, -1  # what an importer has lost of others is no series
        if REACTIONS:
            code = probe_impact(t, c, s, now.y, now.p, now.w, iw)
        code = rest_contacts(t, c, s, end, False, now, iw) if code == SAME else code
    else:
        code = come_to_rest(t, c, s, end, now)
    return OTHERS if code == SAME else NOT_APPLIED


@exact()
def end_of_flights(t: float, c: Choice, s: Strikes) -> float:
    """Return the end of the series of flights that `follow_series` has followed up to now; without any, the time."""
    for i in range(c.rows.count):
        at = OF_SERIES * i
        if s.active[i] != 0 and s.series[at + COUNT] > 0.0:
            return float(s.series[at + BEST] if s.series[at + COUNT] > 2.0 else s.series[at + LAST])
    return t


@exact(entry=True)
def end_flights(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array, iw: Integers) -> int:
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
    return int(end_series(t, c, s, end, Instant(y, p, w), iw))


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
    return int(end_series(t, c, s, end, now, iw))


#: The same where contacts or pins that rub take part.
end_flights_that_rub = exact_instance(end_flights, {"RUBS": True})
end_lost_flights_that_rub = exact_instance(end_lost_flights, {"RUBS": True})
end_flights_in_pairs = exact_instance(end_flights, {"RUBS": True, "PAIRED": True})
end_lost_flights_in_pairs = exact_instance(end_lost_flights, {"RUBS": True, "PAIRED": True})
end_flights_by_reactions = exact_instance(end_flights, BY_REACTIONS | {"RUBS": True})
end_lost_flights_by_reactions = exact_instance(end_lost_flights, BY_REACTIONS | {"RUBS": True})
