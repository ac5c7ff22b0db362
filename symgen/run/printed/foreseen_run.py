"""Times at which formulas jump or have kinks, found by a run for its own parameters, for programs without Python.

Runs of Python have these times before they begin (`symgen.run.breaks.seams`). A program whose parameters change finds
them anew at each start, window after window: a window is as long as the run, and shorter where it has more jumps than
there is room for. Where all formulas are straight lines over time, and pass few levels, the first window has no end.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.loop_instances import called, compiled_loop
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Integers, Record, record_type
from symgen.run.layout import abi
from symgen.run.layout.records import STATE, State
from symgen.run.loops.event_loop import EVENT_STATE
from symgen.run.loops.seams import SEAMS, Seams

_F, _N = types.float64, types.int64

#: What a passage is, summed: a kink, at which a step ends; a side, beside which two steps end; one over which a run
#: goes on without a step; one at which rates of gaps jump, too.
KINK, BESIDE, SKIP, STRIKE = 1, 2, 4, 8
#: Samples of a formula in a window, first and at most, until two samplings count the same passages; most passages of
#: one formula in a window; most periods from 0, and steps, that are told apart.
_FIRST, _MOST, _PASSAGES, _PERIODS, _STEPS = 2048, 2**17, 100_000, 1e6, 1e9
#: Rounding of a time.
_ROUNDING = 2.0**-52
#: Parts of a sample's interval and of a golden section.
_SPREAD, _GOLDEN = 0.6180339887498949, 0.3819660112501051


class Foresight(Record):
    """Passages of formulas in time.

    Attributes
    ----------
    lines : function
        Values of formulas: of a straight line that at 0 and the slope.
    until, shortest : float
        End of a run, where it is not in `ends`, and the largest distance of samples [s].
    step : float
        Distance of the grid of constant steps [s], 0 where steps vary.
    same, beside, apart : float
        Distances as parts of a run: passages that are one, steps beside a side, and on both sides of what is
        skipped.
    end : int
        Place of the end of a run in `ends`, -1 where it is not there.
    slots, straight, kinds : Array of int64, shapes (k,)
        For each formula its place in `out`, 1 for a straight line, what it does.
    first : Array of int64, shape (k + 1,)
        First level of each formula.
    levels, periods : Array
        Levels in ascending order; period of the levels of each formula, 0 without one.
    out, ends : Array
        Values of all formulas; what a run shows.
    known : Array, shape (2,)
        End and begin of the present window [s].
    moments, flags : Array, Array of int64, shapes (room,), found (shape (2,))
        Passages in the window, their number, and 1 where some of them have no room.
    """

    lines: abi.Observe
    until: float
    shortest: float
    step: float
    same: float
    beside: float
    apart: float
    end: int
    slots: Integers
    straight: Integers
    kinds: Integers
    first: Integers
    levels: Array
    periods: Array
    out: Array
    ends: Array
    known: Array
    moments: Array
    flags: Integers
    found: Integers


FORESIGHT = record_type(Foresight)

COUNT, DROPPED = range(2)
TO, FROM = range(2)


def length_of(f: Foresight) -> float:
    """Return the length of a run [s]."""
    return float(f.ends[f.end] if f.end >= 0 else f.until)


# -- levels ------------------------------------------------------------------------------------------------------------


@called
def levels_below(f: Foresight, j: int, x: float) -> int:
    """Return the number of levels of formula j below a value; 0 where the value is undefined."""
    begin, count, period, number = f.first[j], f.first[j + 1] - f.first[j], f.periods[j], 0
    if not math.isfinite(x):
        return 0
    if period > 0.0:
        periods = (x - f.levels[begin]) / period
        if not abs(periods) < _PERIODS:
            return 0
        turns = math.floor(periods)
        x -= turns * period
        count -= 1  # the last level is the first one of the next period
        number = turns * count
    low, high = 0, count
    while low < high:
        middle = (low + high) // 2
        if f.levels[begin + middle] < x:
            low = middle + 1
        else:
            high = middle
    return int(number + low)


@called
def level_at(f: Foresight, j: int, number: int) -> float:
    """Return the level of formula j with a number."""
    begin, count, period = f.first[j], f.first[j + 1] - f.first[j], f.periods[j]
    if period > 0.0:
        count -= 1
        turns = number // count
        return float(f.levels[begin + number - turns * count] + turns * period)
    return float(f.levels[begin + number])


# -- passages ----------------------------------------------------------------------------------------------------------


@called
def note_instant(f: Foresight, t: float, kind: int) -> None:
    """Note a passage; those at the same time are one. Where there is no room, the last one is dropped.

    At the start of a run of constant steps sides and gaps count; no step could end there for others.
    """
    n, room, same = f.found[COUNT], f.moments.shape[0], f.same * max(length_of(f), t)
    if t - f.known[FROM] <= same:
        if f.known[FROM] > 0.0 or f.end >= 0 or kind % 2 == 1:
            return
        t = 0.0
    i = n
    while i > 0 and f.moments[i - 1] > t:
        i -= 1
    if i > 0 and t - f.moments[i - 1] <= same:
        f.flags[i - 1] = joined(f.flags[i - 1], kind)
    elif i < n and f.moments[i] - t <= same:
        f.flags[i] = joined(f.flags[i], kind)
    else:
        f.found[DROPPED] = f.found[DROPPED] if n < room else 1
        for k in range(min(n, room - 1), i, -1):
            f.moments[k], f.flags[k] = f.moments[k - 1], f.flags[k - 1]
        if i < room:
            f.moments[i], f.flags[i] = t, kind
        f.found[COUNT] = min(n + 1, room)


def joined(flags: int, kind: int) -> int:
    """Return the kinds of two passages at the same time, each of them once."""
    result = 0
    for flag in (KINK, BESIDE, SKIP, STRIKE):
        if (flags // flag) % 2 == 1 or (kind // flag) % 2 == 1:
            result += flag
    return result


@called
def note_line(f: Foresight, j: int, start: float, end: float) -> None:
    """Note the passages of a straight line behind `start` up to `end`."""
    value, slope, begin, kind = f.out[f.slots[j]], f.out[f.slots[j] + 1], f.first[j], f.kinds[j]
    if slope == 0.0 or not math.isfinite(slope) or not math.isfinite(value):
        return
    low, high = 0, f.first[j + 1] - begin
    if f.periods[j] > 0.0:
        at_start, at_end = levels_below(f, j, value + slope * start), levels_below(f, j, value + slope * end)
        low, high = min(at_start, at_end) - 1, max(at_start, at_end) + 1
    if high - low > _PASSAGES:
        return
    for number in range(low, high):
        t = (level_at(f, j, number) - value) / slope
        if start <= t <= end:
            note_instant(f, t, kind)


@called
def formula_at(f: Foresight, state: State, j: int, t: float) -> float:
    """Return the value of formula j at a time."""
    f.lines(t, state.y, state.p, state.w, state.y, f.out)
    return float(f.out[f.slots[j]])


@called
def passed_at(f: Foresight, state: State, j: int, number: int, low: float, high: float) -> float:
    """Return the first time, to rounding, at which formula j is on the side of a level on which it is at `high`."""
    at = level_at(f, j, number)
    above = 1 if formula_at(f, state, j, high) > at else 0
    rounding, middle = _ROUNDING * abs(high), 0.5 * (low + high)
    while high - low > rounding and low < middle < high:
        if (1 if formula_at(f, state, j, middle) > at else 0) == above:
            high = middle
        else:
            low = middle
        middle = 0.5 * (low + high)
    return float(high)


@called
def pass_levels(f: Foresight, state: State, j: int, notes: int, a: float, b: float, below: int, above: int) -> int:
    """Note, where `notes` is 1, when formula j passes the levels with numbers between two; return their number."""
    low, high = min(below, above), max(below, above)
    if notes != 0:
        for number in range(low, high):
            note_instant(f, passed_at(f, state, j, number, a, b), f.kinds[j])
    return int(high - low)


@called
def turned_at(f: Foresight, state: State, j: int, sign: float, low: float, high: float) -> float:
    """Return the time at which formula j times a sign is least, by golden sections."""
    for _ in range(60):
        a, b = low + _GOLDEN * (high - low), high - _GOLDEN * (high - low)
        if sign * formula_at(f, state, j, a) < sign * formula_at(f, state, j, b):
            high = b
        else:
            low = a
    return 0.5 * (low + high)


@called
def sample(f: Foresight, state: State, j: int, start: float, end: float, count: int, notes: int) -> int:
    """Return the number of passages of formula j between samples, `count` of them; note them where `notes` is 1."""
    passages = 0
    ta = tb = start
    xa = xb = formula_at(f, state, j, start)
    below = levels_below(f, j, xb)
    for k in range(1, count + 1):
        # not in equal parts, to detect changes faster than the sampling at any frequency
        part = k * _SPREAD - math.floor(k * _SPREAD)
        tc = end if k == count else start + (end - start) * ((k - 0.5 + 0.9 * (part - 0.5)) / count)
        xc = formula_at(f, state, j, tc)
        above = levels_below(f, j, xc)
        passages += pass_levels(f, state, j, notes, tb, tc, below, above)
        top = xb >= xa and xb >= xc and (xb > xa or xb > xc)
        if top or (xb <= xa and xb <= xc and (xb < xa or xb < xc)):
            tm = turned_at(f, state, j, -1.0 if top else 1.0, ta, tc)
            beyond = levels_below(f, j, formula_at(f, state, j, tm))
            if (beyond - below) * (1 if top else -1) > 0:
                passages += pass_levels(f, state, j, notes, ta, tm, below, beyond)
                passages += pass_levels(f, state, j, notes, tm, tc, beyond, below)
        ta, tb, xa, xb, below = tb, tc, xb, xc, above
    return int(passages)


@called
def search_curve(f: Foresight, state: State, j: int, start: float, end: float) -> None:
    """Note the passages of a formula that is no straight line; where they are too many, none is noted."""
    before, count, most = -1, _FIRST, min((end - start) / f.shortest, 0.5 * _MOST)
    while count < most:
        count *= 2
    while count <= _MOST:
        passages = sample(f, state, j, start, end, count, 0)
        if passages == before or passages > _PASSAGES:
            if passages == before and passages > 0:
                sample(f, state, j, start, end, count, 1)
            return
        before, count = passages, 2 * count


# -- seams -------------------------------------------------------------------------------------------------------------


def add_seam(seams: Seams, t: float, skips: int) -> None:
    """Add a seam behind the last one; at the time of the last one there is none to add unless a run skips."""
    n = seams.rows[1]
    before = seams.times[n - 1] if n > 0 else -1.0
    if t <= before and skips == 0 and seams.skips[n - 1] == 0:
        return
    seams.times[n], seams.skips[n] = max(t, before), skips
    seams.rows[1] = n + 1


@called
def lay_seams(f: Foresight, seams: Seams, end: float) -> None:
    """Lay out the seams at the passages of a window, and one at its end."""
    n, whole = f.found[COUNT], length_of(f)
    for i in range(n):
        t, flags, following = f.moments[i], f.flags[i], f.moments[i + 1] if i + 1 < n else end
        apart, beside = f.apart * max(whole, t), f.beside * max(whole, t)
        if flags >= SKIP:
            add_seam(seams, max(t - apart, 0.0), 2 if flags >= STRIKE else 1)
            add_seam(seams, t + apart, 0)
            steps = t / f.step if f.step > 0.0 and t < _STEPS * f.step else 0.0
            point = math.ceil(steps) * f.step
            if abs(steps - math.floor(steps + 0.5)) > abi.SAME_TIME and point < following - abi.SAME_TIME * f.step:
                add_seam(seams, point, 0)
        else:
            if flags >= BESIDE and t - beside > 0.0:
                add_seam(seams, t - beside, 0)
            if flags % 2 == 1:
                add_seam(seams, t, 0)
            if flags >= BESIDE:
                add_seam(seams, t + beside, 0)
    if end < math.inf:
        add_seam(seams, end, 0)


def foresee_run(is_start: int, t: float, foresight: Foresight, seams: Seams, state: State) -> int:
    """Lay out the seams of a run at its start, or of the next window where the present one ends.

    Parameters
    ----------
    is_start : int
        1 where a run begins, at 0 s.
    t : float
        The time up to which the run has come [s].
    foresight : Foresight
        Passages of formulas.
    seams : Seams
        Written; none has been passed.
    state : State
        State of the run, with its parameters.

    Returns
    -------
    int
        1 where seams have been laid out.
    """
    f = foresight
    if is_start == 0 and (f.known[TO] == math.inf or t < f.known[TO] * (1.0 - f.same)):
        return 0
    start, end, whole, count = 0.0 if is_start != 0 else f.known[TO], math.inf, length_of(f), f.kinds.shape[0]
    for j in range(count):
        if f.straight[j] == 0 or f.periods[j] > 0.0:
            end = start + whole
    f.found[COUNT] = f.found[DROPPED] = 0
    f.known[FROM] = start
    for j in range(count):
        if f.straight[j] != 0:
            f.lines(0.0, state.y, state.p, state.w, state.y, f.out)
            note_line(f, j, start, end)
        else:
            search_curve(f, state, j, start, end)
    if f.found[DROPPED] != 0:
        n = f.found[COUNT] - 1
        f.found[COUNT], end = n, 0.5 * (f.moments[n - 1] + f.moments[n])
    f.known[TO], seams.rows[1], state.control[abi.PASSED] = end, 0, 0
    if is_start != 0 and not (f.found[COUNT] > 0 and f.moments[0] == 0.0):
        add_seam(seams, 0.0, 0)
    lay_seams(f, seams, end)
    return 1


_loops: dict[bool, Any] = {}


def foreseen_run(events: bool) -> Any:
    """Return `foresee_run` for runs with or without switching functions, made at the first use."""
    if events not in _loops:
        signature = types.int64(_N, _F, FORESIGHT, SEAMS, EVENT_STATE if events else STATE)
        name = "foresee_events" if events else "foresee"
        _loops[events] = compiled_loop(__name__, name, foresee_run, signature)
    return _loops[events]
