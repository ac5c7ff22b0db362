"""Flights between two impacts of a gap, compiled: which gaps fly, though they may seem closed."""

from __future__ import annotations

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array
from symgen.run.effects.accumulation import OF_EVENT
from symgen.run.modes.bounded_rows import is_held
from symgen.run.modes.row_records import Choice
from symgen.run.modes.strikes import Strikes

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
