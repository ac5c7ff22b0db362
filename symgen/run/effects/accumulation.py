"""Events that accumulate: resets follow each other ever faster, so that time stops advancing."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout import abi
from symgen.run.layout.scales import larger_number
from symgen.run.layout.start_records import Instant
from symgen.run.loops.search_records import DIRECTION, N_HEAD, N_VALUES

#: Times until events accumulate below this part of the time count as zero.
NOTHING_LEFT = 1e-9
#: Number of intervals between events that must have shrunk, and largest difference of their ratios.
SHRINKING, _STEADY = 4, 0.2
#: This many resets within this part of the time are an accumulation as well.
CROWDED, _HEAP = 50, 1e-7
_EPSILON = 2.0**-52
#: A rebound of fewer roundings than this, of the switching function or of the time, is lost: its end is accurate to a
#: thousandth of it.
_FEWEST = 1e3
#: Changes of a state for finite differences: of each coordinate, and of the time as a fraction of the run.
_RELATIVE, _AHEAD = 1e-6, 1e-9
#: Times that are kept of each event, and of all.
OF_EVENT, OF_ALL = SHRINKING + 2, CROWDED + 1


class Past(Record):
    """Past resets of a run, and working memory.

    Attributes
    ----------
    until : float
        End of the run [s].
    times, counts : Array, Array of int64
        The last distinct times of the resets of each event, then of all [s]; how many there are.
    other, rate, scratch, out, values, slopes, rounding, counters : Array, Array of int64
        Working memory.
    """

    until: float
    times: Array
    other: Array
    rate: Array
    scratch: Array
    out: Array
    values: Array
    slopes: Array
    rounding: Array
    counts: Integers
    counters: Integers


#: Rates and their confirmation, and switching functions with their rates.
Rates = tuple[abi.Rhs, abi.Rhs, abi.Observe]


def new_past(events: int, functions: int, width: int, nw: int, until: float) -> Any:
    """Return an empty past of a run until a time [s], with all its switching functions."""
    sizes = (OF_EVENT * events + OF_ALL, width, width, nw, N_VALUES * functions, functions, functions, functions)
    counts = np.zeros(events + 1, dtype=np.int64), np.zeros(abi.N_COUNTERS, dtype=np.int64)
    return Past._make((float(until), *(np.zeros(size) for size in sizes), *counts))


@exact()
def add_time(past: Past, which: int, t: float) -> None:
    """Add a time to the times of an event, or of all events where `which` is their number."""
    times, counts, first = past.times, past.counts, OF_EVENT * which
    size, count = (OF_ALL if which == counts.shape[0] - 1 else OF_EVENT), counts[which]
    if count > 0 and times[first + count - 1] == t:  # several resets may share a time
        return
    if count == size:
        for i in range(size - 1):
            times[first + i] = times[first + i + 1]
        count -= 1
    times[first + count] = t
    counts[which] = count + 1


@exact(entry=True)
def add_resets(past: Past, chosen: Integers, t: float) -> int:
    """Add a time at which the chosen events have reset a run; return the number of events."""
    n = past.counts.shape[0] - 1
    for k in range(n):
        if chosen[k] != 0:
            add_time(past, k, t)
            add_time(past, n, t)
    return int(n)


@exact()
def remaining_series(before: float, last: float) -> float:
    """Return the remainder of a geometric series after two of its terms (Aitken)."""
    ratio = last / before
    return last * ratio / (1.0 - ratio)


@exact()
def end_of_series(past: Past, k: int) -> float:
    """Return the time at which the resets of an event accumulate if their intervals shrink steadily; else nan."""
    times, first, count = past.times, OF_EVENT * k, past.counts[k]
    if count < OF_EVENT:
        return math.nan
    least, most = math.inf, 0.0
    for i in range(SHRINKING):
        before = times[first + i + 1] - times[first + i]
        ratio = (times[first + i + 2] - times[first + i + 1]) / before
        least, most = ratio if ratio < least else least, larger_number(most, ratio)
    if most >= 1.0 or most - least >= _STEADY:
        return math.nan
    now = times[first + count - 1]
    last, before = now - times[first + count - 2], times[first + count - 2] - times[first + count - 3]
    rest = remaining_series(before, last)
    return now + rest if rest < NOTHING_LEFT * now else math.nan


@exact()
def switching_values(functions: Rates, t: float, y: Array, p: Array, past: Past) -> None:
    """Evaluate switching functions and their rates."""
    _, _, happens = functions
    happens(t, y, p, past.scratch, past.rate, past.out)


@exact()
def rates_at_state(functions: Rates, t: float, y: Array, p: Array, past: Past) -> None:
    """Set the rates at a state; where a pivot is suspicious, they are confirmed."""
    rates, confirm, _ = functions
    if rates(t, y, p, past.scratch, past.counters, past.rate) != 0:
        confirm(t, y, p, past.scratch, past.counters, past.rate)


@exact()
def rounding_of_values(functions: Rates, t: float, nq: int, y: Array, p: Array, past: Past) -> None:
    """Set the rounding of each switching function, from its change with the time and with each coordinate.

    Signs of changes are the digits of the coordinates' numbers: few evaluations suffice and no two coordinates cancel.
    """
    n, other = past.values.shape[0], past.other
    for i in range(y.shape[0]):
        other[i] = y[i]
    switching_values(functions, t + _RELATIVE * abs(t), y, p, past)
    for k in range(n):
        past.rounding[k] = abs(past.out[k] - past.values[k])
    power = 1
    for _ in range(64):
        for i in range(nq):
            other[i] = y[i] * (1.0 + _RELATIVE * (1.0 - 2.0 * float((i // power) % 2)))
        switching_values(functions, t, other, p, past)
        for k in range(n):
            past.rounding[k] += abs(past.out[k] - past.values[k])
        if power > nq:
            break
        power *= 2
    for k in range(n):
        past.rounding[k] *= _EPSILON / _RELATIVE


@exact()
def is_lost(
    functions: Rates, t: float, nq: int, now: Instant, iw: Integers, hunt: Array, chosen: Integers, past: Past
) -> bool:
    """Return whether a switching function returns so soon after a reset that rounding decides the time.

    Right after the reset g is 0 up to rounding and leaves with the rate g'; with g'' against it, it reaches
    g'^2 / (2 g'') and returns after 2 g' / g''.
    """
    y, p, n, other = now.y, now.p, past.values.shape[0], past.other
    for i in range(past.scratch.shape[0]):
        past.scratch[i] = now.w[i]
    for i in range(past.counters.shape[0]):
        past.counters[i] = iw[i]
    for i in range(other.shape[0]):
        other[i], past.rate[i] = y[i], 0.0
    rates_at_state(functions, t, other, p, past)
    switching_values(functions, t, y, p, past)
    for k in range(n):
        past.values[k], past.slopes[k] = past.out[k], past.out[n + k]
    rounding_of_values(functions, t, nq, y, p, past)
    ahead = _AHEAD * past.until
    for i in range(other.shape[0]):
        other[i] = y[i] + ahead * past.rate[i]
    rates_at_state(functions, t + ahead, other, p, past)
    switching_values(functions, t + ahead, other, p, past)
    for k in range(chosen.shape[0]):
        slope, curve = past.slopes[k], (past.out[n + k] - past.slopes[k]) / ahead
        back = -1.0 if slope > 0.0 else 1.0  # the direction in which it would happen again
        direction = hunt[N_HEAD + DIRECTION * n + k]
        if chosen[k] != 0 and (direction == 0.0 or direction == back) and slope * curve < 0.0:
            far, long = 0.5 * slope * slope / abs(curve), 2.0 * abs(slope / curve)
            if abs(past.values[k]) <= _FEWEST * past.rounding[k]:
                if far < _FEWEST * past.rounding[k] or long < _FEWEST * _EPSILON * abs(t):
                    return True
    return False


@exact(entry=True)
def accumulation(
    functions: Rates, t: float, nq: int, now: Instant, iw: Integers, hunt: Array, chosen: Integers, past: Past
) -> float:
    """Return the time at which resets accumulate [s]; nan where they do not.

    Parameters
    ----------
    functions : tuple
        See `RATES`.
    t, nq : float, int
        Time [s], number of coordinates.
    now, iw, hunt : Instant, Array, Array
        State of the run after the resets, counters, and data of events; not changed.
    chosen : Array of int
        1 for each event that has just reset the run, else 0.
    past : Past
        Past resets, these among them.
    """
    times, counts, n = past.times, past.counts, past.counts.shape[0] - 1
    leading = -1
    for k in range(n):
        if chosen[k] != 0:
            leading = k if leading < 0 else leading
            end = end_of_series(past, k)
            if end == end:
                return float(end)
    all_first = OF_EVENT * n
    if counts[n] == OF_ALL:
        last = times[all_first + CROWDED]
        if last - times[all_first] < _HEAP * last:
            return float(last)
    if leading < 0 or not is_lost(functions, t, nq, now, iw, hunt, chosen, past):
        return math.nan
    at, count = OF_EVENT * leading, counts[leading]
    if count >= 3:
        before = times[at + count - 2] - times[at + count - 3]
        last = times[at + count - 1] - times[at + count - 2]
        if last < before:
            return t + float(remaining_series(before, last))
    return t


@exact(entry=True)
def latest_events(past: Past) -> float:
    """Return the events with the latest resets, as a sum of powers of 2."""
    times, counts, n = past.times, past.counts, past.counts.shape[0] - 1
    first, total, power = OF_EVENT * n, 0.0, 1.0
    since = times[first + (counts[n] - SHRINKING if counts[n] > SHRINKING else 0)]
    for k in range(n):
        if counts[k] > 0 and times[OF_EVENT * k + counts[k] - 1] >= since:
            total += power
        power *= 2.0
    return total
