"""Times at which formulas of t pass levels, and the seams of a run there: one search for all runs.

Runs of Python have the times before they begin (`symgen.run.breaks.foreseen_seams`), from formulas as codes. Programs
without Python find them at each start (`symgen.run.printed.foreseen_run`), from formulas of their text. Straight lines
are solved. Others are sampled until two samplings count the same passages, which are then bisected.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout import abi
from symgen.run.loops.seams import Seams
from symgen.run.loops.unbound import formula_at

#: What a passage is, summed: a kink, at which a step ends; a side, beside which two steps end; one over which a run
#: goes on without a step; one at which rates of gaps jump, too.
KINK, BESIDE, SKIP, STRIKE = 1, 2, 4, 8
#: Passages closer than this part of a run are one.
SAME = 1e-14
#: Distance from a jump at which a step ends and another begins, as a part of the run; and where constant steps do,
#: between which no step is: more than the rounding of stages, and of the time of the jump.
BESIDE_A_SIDE, NEXT_TO = 1e-12, 4.0 * 2.0**-52
#: Seams of a passage at most; and those at the begin and at the end of a window.
SEAMS_OF_PASSAGE, SEAMS_OF_WINDOW = 3, 2
#: Most passages of a formula, or of a run.
MOST_PASSAGES = 100_000
#: Samples of a formula, first and at most, until two samplings count the same passages; and fewest samples for each
#: passage, or near one: with fewer it cannot be separated from the next.
_FIRST, MOST_SAMPLES, _LOOKS = 2048, 2**19, 4
#: Most periods from 0, and steps, that are told apart.
_PERIODS, _STEPS = 1e6, 1e9
#: Random places of samples: multiplier and modulus of Park and Miller, whose products are exact in any number.
_MULTIPLIER, _MODULUS = 48271, 2147483647
#: Part of a golden section, and number of sections.
_GOLDEN, _SECTIONS = 0.6180339887498949, 60
#: Least distance of two times, as a part of a search: near 0 neighbouring numbers are much closer.
_FINEST = 2.0**-70
#: What a sampling does: count passages between samples and places near a level, count the passages of turning points
#: as well, and note all.
_LOOK, _ASK, _NOTE = range(3)


class JumpSearch(Record):
    """A search for the times at which formulas pass levels.

    Attributes
    ----------
    until, shortest : float
        End of a run, where it is not in `ends`, and the largest distance of samples [s].
    origin, step : float
        First point and distance of the grid of constant steps [s], the latter 0 where steps vary.
    same, beside, apart : float
        Distances as parts of a run: passages that are one, steps beside a side, and on both sides of what is skipped.
    end : int
        Place of the end of a run in `ends`, -1 where it is not there, as where steps are constant.
    kinds : Array of int64, shape (k,)
        What passages of each formula are.
    first : Array of int64, shape (k + 1,)
        First level of each formula.
    levels, periods : Array
        Levels in ascending order; period of the levels of each formula, 0 without one.
    ends : Array
        What a run shows.
    known : Array, shape (2,)
        End and begin of the present window [s].
    moments, flags : Array, Array of int64, shape (room,)
        Passages in the window.
    samples : Array
        Room for the first samples of a formula; others are evaluated whenever they are read.
    found : Array of int64, shape (4,)
        Number of passages; 1 where some of them have no room; number of samples that are near a level; why passages
        of a formula were left out, else 0.
    """

    until: float
    shortest: float
    origin: float
    step: float
    same: float
    beside: float
    apart: float
    end: int
    kinds: Integers
    first: Integers
    levels: Array
    periods: Array
    ends: Array
    known: Array
    moments: Array
    samples: Array
    flags: Integers
    found: Integers


COUNT, DROPPED, NEAR, LEFT_OUT = range(4)
#: Why passages are left out: more than `MOST_PASSAGES`, or closer together than samples can be.
TOO_MANY, TOO_CLOSE = 1, 2
TO, FROM = range(2)


def length_of(f: JumpSearch) -> float:
    """Return the length of a run [s]."""
    return float(f.ends[f.end] if f.end >= 0 else f.until)


# -- levels ------------------------------------------------------------------------------------------------------------


def levels_below(f: JumpSearch, j: int, x: float) -> int:
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
def level_at(f: JumpSearch, j: int, number: int) -> float:
    """Return the level of formula j with a number."""
    begin, count, period = f.first[j], f.first[j + 1] - f.first[j], f.periods[j]
    if period > 0.0:
        count -= 1
        turns = number // count
        return float(f.levels[begin + number - turns * count] + turns * period)
    return float(f.levels[begin + number])


# -- passages ----------------------------------------------------------------------------------------------------------


@called
def note_passage(f: JumpSearch, t: float, kind: int) -> None:
    """Note a passage; of those at the same time the first stays. Where there is no room, the last one is dropped.

    At the start of a run of constant steps sides and gaps count; no step could end there for others.
    """
    n, room, same = f.found[COUNT], f.moments.shape[0], f.same * max(length_of(f), t)
    if t - f.known[FROM] <= same:
        if f.known[FROM] > 0.0 or f.end >= 0 or kind % 2 == 1:
            return
        t = f.known[FROM]
    i = n
    while i > 0 and f.moments[i - 1] > t:
        i -= 1
    if i > 0 and t - f.moments[i - 1] <= same:
        f.flags[i - 1] = join_kinds(f.flags[i - 1], kind)
    elif i < n and f.moments[i] - t <= same:
        f.moments[i], f.flags[i] = t, join_kinds(f.flags[i], kind)
    else:
        f.found[DROPPED] = f.found[DROPPED] if n < room else 1
        for k in range(min(n, room - 1), i, -1):
            f.moments[k], f.flags[k] = f.moments[k - 1], f.flags[k - 1]
        if i < room:
            f.moments[i], f.flags[i] = t, kind
        f.found[COUNT] = min(n + 1, room)


def join_kinds(flags: int, kind: int) -> int:
    """Return the kinds of two passages at the same time, each of them once."""
    result = 0
    for flag in (KINK, BESIDE, SKIP, STRIKE):
        if (flags // flag) % 2 == 1 or (kind // flag) % 2 == 1:
            result += flag
    return result


@called
def note_line(f: JumpSearch, j: int, value: float, slope: float, start: float, end: float) -> None:
    """Note the passages of a straight line from `start` to `end`, by its value at 0 and its slope."""
    begin, kind, period = f.first[j], f.kinds[j], f.periods[j]
    if slope == 0.0 or not math.isfinite(slope) or not math.isfinite(value):
        return
    low, high = 0, f.first[j + 1] - begin
    if period > 0.0:
        at_start, at_end = value + slope * start, value + slope * end
        if not max(abs(at_start - f.levels[begin]), abs(at_end - f.levels[begin])) < _PERIODS * period:
            f.found[LEFT_OUT] = TOO_MANY
            return
        before, after = levels_below(f, j, at_start), levels_below(f, j, at_end)
        low, high = min(before, after) - 1, max(before, after) + 1
    if high - low > MOST_PASSAGES:
        f.found[LEFT_OUT] = TOO_MANY
        return
    for number in range(low, high):
        t = (level_at(f, j, number) - value) / slope
        if start <= t <= end:
            note_passage(f, t, kind)


@called
def passed_at(f: JumpSearch, state: Record, j: int, number: int, low: float, high: float, finest: float) -> float:
    """Return the first time at which formula j is on the side of a level on which it is at `high`.

    No number is between it and the time before, so that it does not depend on the bracket.
    """
    at = level_at(f, j, number)
    above = 1 if formula_at(f, state, j, high) > at else 0
    middle = 0.5 * (low + high)
    while high - low > finest and low < middle < high:
        if (1 if formula_at(f, state, j, middle) > at else 0) == above:
            high = middle
        else:
            low = middle
        middle = 0.5 * (low + high)
    return float(high)


@called
def turned_at(f: JumpSearch, state: Record, j: int, sign: float, low: float, high: float) -> float:
    """Return the time at which formula j times a sign is least, by golden sections."""
    for _ in range(_SECTIONS):
        a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        if sign * formula_at(f, state, j, a) < sign * formula_at(f, state, j, b):
            high = b
        else:
            low = a
    return 0.5 * (low + high)


def extremum_of(before: float, x: float, after: float, over: int, under: int) -> int:
    """Return 1 where a sample is a greatest value, -1 where it is a least one, else 0; of a plateau, only at its ends.

    Undefined neighbours are ends of the formula. Where no level is `over` a sample (0), it is no greatest value to look
    at; where none is `under` it, no least one.
    """
    is_end = math.isnan(before) or math.isnan(after)
    a, b = after if math.isnan(before) else before, before if math.isnan(after) else after
    if over == 1 and x >= a and x >= b and (is_end or x > a or x > b):
        return 1
    return -1 if under == 1 and x <= a and x <= b and (is_end or x < a or x < b) else 0


def next_random(noise: int) -> int:
    """Return the next of a sequence of random numbers."""
    return (_MULTIPLIER * noise) % _MODULUS


def sampled_at(start: float, end: float, k: int, count: int, noise: int) -> float:
    """Return the time of a sample: `start`, then one at random in each of equal parts, then `end`.

    In this way changes faster than the sampling are detected at any frequency.
    """
    if k == 0 or k > count:
        return start if k == 0 else end
    return start + (end - start) * ((k - 1) + noise / _MODULUS) / count


@called
def range_of_samples(f: JumpSearch, state: Record, j: int, start: float, end: float, count: int) -> float:
    """Sample formula j; return the difference of its largest and its least value."""
    low, high, noise = math.inf, -math.inf, count
    for k in range(count + 2):
        x = formula_at(f, state, j, sampled_at(start, end, k, count, noise))
        if k < f.samples.shape[0]:
            f.samples[k] = x
        low, high, noise = x if x < low else low, x if x > high else high, next_random(noise)
    return float(high - low) if high > low else 0.0


@called
def pass_levels(f: JumpSearch, state: Record, j: int, a: float, b: float, below: int, above: int, finest: float) -> int:
    """Return the number of levels that formula j passes between two times; note when, where `finest` is above 0."""
    low, high = min(below, above), max(below, above)
    for number in range(low, high if finest > 0.0 else low):
        note_passage(f, passed_at(f, state, j, number, a, b, finest), f.kinds[j])
    return int(high - low)


@called
def count_passages(
    f: JumpSearch, state: Record, j: int, start: float, end: float, count: int, doing: int, spread: float
) -> int:
    """Return the number of passages of formula j between samples, `count` of them besides both ends.

    Parameters
    ----------
    f, state : JumpSearch, State
        The search, and what `formula_at` reads.
    j : int
        Number of the formula.
    start, end : float
        The window [s].
    count, doing : int
        Number of samples, and `_LOOK`, `_ASK` or `_NOTE`.
    spread : float
        Distance from a level up to which a turning point is near it.
    """
    passages, near, noise, levels = 0, 0, count, f.first[j + 1] - f.first[j]
    endless, finest = f.periods[j] > 0.0, _FINEST * (end - start) if doing == _NOTE else 0.0
    ta, tb, xa, xb = start, start, math.nan, formula_at(f, state, j, start)
    below = levels_below(f, j, xb)
    for k in range(1, count + 3):
        noise = next_random(noise)
        tc, xc, above = end, math.nan, below
        if k < count + 2:
            tc = sampled_at(start, end, k, count, noise)
            xc = f.samples[k] if k < f.samples.shape[0] else formula_at(f, state, j, tc)
            above = levels_below(f, j, xc)
            if above != below:
                passages += pass_levels(f, state, j, tb, tc, below, above, finest)
        over, under = 1 if endless or below < levels else 0, 1 if endless or below > 0 else 0
        way = extremum_of(xa, xb, xc, over, under)
        if way != 0:
            if doing == _LOOK:
                near += 1 if abs(level_at(f, j, below if way > 0 else below - 1) - xb) < spread else 0
            else:
                tm = turned_at(f, state, j, -1.0 * way, ta, tc)
                beyond = levels_below(f, j, formula_at(f, state, j, tm))
                if (beyond - below) * way > 0:
                    passages += pass_levels(f, state, j, ta, tm, below, beyond, finest)
                    passages += pass_levels(f, state, j, tm, tc, beyond, below, finest)
        ta, tb, xa, xb, below = tb, tc, xb, xc, above
    f.found[NEAR] = near
    return int(passages)


@called
def search_curve(f: JumpSearch, state: Record, j: int, start: float, end: float) -> None:
    """Note the passages of a formula that is no straight line; none where they are too many, or too close together."""
    before, count, most = -1, _FIRST, min((end - start) / f.shortest, 0.5 * MOST_SAMPLES)
    while count < most:
        count *= 2
    while count <= MOST_SAMPLES:
        passages, spread = -1, range_of_samples(f, state, j, start, end, count)
        seen = count_passages(f, state, j, start, end, count, _LOOK, spread)
        if _LOOKS * (seen + f.found[NEAR]) <= count:
            passages = count_passages(f, state, j, start, end, count, _ASK, spread)
        if max(seen, passages) > MOST_PASSAGES:
            f.found[LEFT_OUT] = TOO_MANY
            return
        if passages >= 0 and passages == before:
            if passages > 0:
                count_passages(f, state, j, start, end, count, _NOTE, spread)
            return
        before, count = passages, 2 * count
    f.found[LEFT_OUT] = TOO_CLOSE


# -- seams -------------------------------------------------------------------------------------------------------------


def add_seam(seams: Seams, t: float, skips: int) -> None:
    """Add a seam after the last one; at the time of the last one only where a run skips."""
    n = seams.rows[1]
    before = seams.times[n - 1] if n > 0 else -1.0
    if t <= before and skips == 0 and seams.skips[n - 1] == 0:
        return
    seams.times[n], seams.skips[n] = max(t, before), skips
    seams.rows[1] = n + 1


@called
def lay_seams(f: JumpSearch, seams: Seams, end: float) -> None:
    """Lay out the seams of a window: at its passages, at the start of the run, and at its end."""
    n, whole = f.found[COUNT], length_of(f)
    if f.known[FROM] == 0.0 and not (n > 0 and f.moments[0] == 0.0):
        add_seam(seams, 0.0, 0)
    for i in range(n):
        t, flags, following = f.moments[i], f.flags[i], f.moments[i + 1] if i + 1 < n else end
        apart, beside = f.apart * max(whole, t), f.beside * max(whole, t)
        if flags >= SKIP:
            add_seam(seams, max(t - apart, 0.0), 2 if flags >= STRIKE else 1)
            add_seam(seams, t + apart, 0)
            steps = (t - f.origin) / f.step if f.step > 0.0 and t - f.origin < _STEPS * f.step else 0.0
            point = f.origin + math.ceil(steps) * f.step
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
