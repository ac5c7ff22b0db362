"""Switching functions inside a step: values and slopes at inner points, and passages that its end does not show.

A function that is on the same side at both ends of a step may have been on the other one in between. Slopes tell most
steps in which none can reach zero (`stays_away`). In the others functions are known at inner points of the motion,
and a cubic joins two neighbours; the fourth derivative that other points show gives its error. A point
at which a function may be on another side than at the ends is handed to the search, which tries a step up to there.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.store.emitted import plain
from symgen.run.loops.frame_parts import LOW, TRY
from symgen.run.loops.inner_points import slope_at, time_of, value_at
from symgen.run.loops.search_records import (
    ACCEPTED,
    ACTION,
    ANEW,
    ASLEEP,
    COARSEST,
    D_HIGH,
    D_INSIDE,
    D_LOW,
    D_START,
    DIVIDED,
    FIRED,
    G_HIGH,
    G_INSIDE,
    G_LOW,
    G_START,
    GRAZING,
    HIGH,
    INSIDE,
    LOCAL,
    LONGEST,
    LOOKED,
    MARGIN,
    MARGINS,
    MEASURE,
    N_COLUMNS,
    N_HEAD,
    NOTED,
    OF_FORCES,
    PLACES,
    PROBES,
    REACH,
    RESOLUTION,
    SIDE,
    SIZE,
    STEEPEST,
    UNCERTAIN,
    WHOLE,
)
from symgen.run.loops.switching import dip, is_finite, side_of, wake

A = Any
#: A function stays away from zero if its values at both ends are this many times its largest way in a step. Slopes of
#: earlier steps count by a fraction that falls by this factor from step to step; the least one is not 0.
_AWAY, _FADING, _LEAST = 2.0, 0.7, 1e-300
#: The error of a cubic over the one that its neighbours show, and at most over the change by the slopes at its ends.
_STRICT, _CAP = 2.0, 0.25
#: Largest number of attempts at such points up to an event.
_MOST_PROBES = 24
#: A step is too long with more than this error of cubics between its points, over the range of a function that is
#: nearer to zero than this multiple of it; number of divisions without a gain after which there are none.
_COARSE, _NEAR, _IN_VAIN = 0.01, 20.0, 3.0
#: A step may be this many times as long as one inside which margins of forces have been seen, unless it is looked into;
#: part of the range of such a margin that is seen between two points, if they show its waves; how badly they do else.
_GROWN, _WAVE, _LEAPS = 2.0, 0.5, 1.0
#: Range of a margin over its size at which it is rounding alone.
_ROUNDED = 1e-9
#: Steps below this part of the proposed one cross jumps at known times.
_AT_A_JUMP = 1e-6


@plain
def stays_away(hunt: A, n: int, h: float) -> int:
    """Return 1 where no function can be zero inside a step of h, by its slopes at both ends and in the last steps.

    Then the end of the step becomes the beginning of the next one: most steps of most runs are such, and this replaces
    the brackets and the search.
    """
    at, out, away = N_HEAD, N_HEAD + N_COLUMNS * n, 1
    for k in range(n):
        side, known = hunt[at + SIDE * n + k], hunt[at + STEEPEST * n + k]
        g0, g1 = side * hunt[at + G_START * n + k], side * (hunt[out + k] + hunt[at + ASLEEP * n + k])
        latest, most = abs(hunt[out + n + k]), known
        if hunt[at + OF_FORCES * n + k] != 0.0:
            latest = abs(g1 - g0) / h
        else:
            most = max(most, abs(hunt[at + D_START * n + k]))
        if not (known > 0.0 and g0 > 0.0 and g1 > 0.0 and g0 + g1 > _AWAY * h * max(most, latest)):
            away = 0
        if hunt[at + ACTION * n + k] >= float(ANEW) or hunt[at + GRAZING * n + k] != 0.0:
            away = 0
        hunt[at + STEEPEST * n + k] = max(max(_FADING * known, latest), _LEAST) if latest - latest == 0.0 else 0.0
        if MARGINS and is_margin_of_force(hunt, n, k) == 1:  # between its ends a step may show nothing of its slopes
            if h > _GROWN * hunt[at + LOOKED * n + k]:
                away = 0
            if hunt[at + STEEPEST * n + k] > 0.0:
                hunt[at + STEEPEST * n + k] = max(hunt[at + STEEPEST * n + k], known)
    if away == 0:
        return 0
    for k in range(n):
        value = hunt[out + k] + hunt[at + ASLEEP * n + k]
        hunt[at + FIRED * n + k] = 0.0
        hunt[at + SIZE * n + k] = max(abs(hunt[at + G_START * n + k]), abs(value))
        hunt[at + G_START * n + k], hunt[at + D_START * n + k] = value, hunt[out + n + k]
        wake(hunt, n, k)
    hunt[ACCEPTED] = hunt[NOTED]
    if hunt[LONGEST] > 0.0:
        hunt[LONGEST] = max(hunt[LONGEST], 2.0 * h)
    return 1


@plain
def is_margin_of_force(hunt: A, n: int, k: int) -> int:
    """Return 1 for a margin of a force or a part of a reaction, else 0."""
    return 1 if hunt[N_HEAD + MARGIN * n + k] != 0.0 and hunt[N_HEAD + OF_FORCES * n + k] != 0.0 else 0


@plain
def range_inside(hunt: A, n: int, k: int) -> float:
    """Return the difference of the largest and the least value of a function at the points of a step."""
    low = high = value_at(hunt, n, k, 0)
    for i in range(1, int(hunt[INSIDE]) + 2):
        g = value_at(hunt, n, k, i)
        low, high = min(low, g), max(high, g)
    return high - low


@plain
def leaps(hunt: A, n: int, k: int, h: float) -> int:
    """Return 1 where a step of h is too long to show the margin of a force that was seen in shorter steps, else 0.

    With its slopes there it may reach zero between two points, whose distance is then no small part of a wave: waves
    look as slow as one likes if they are seen seldom enough.
    """
    at, looked = N_HEAD, hunt[N_HEAD + LOOKED * n + k]
    if hunt[at + ASLEEP * n + k] > 0.0 or looked == 0.0 or h <= looked:
        return 0
    span = range_inside(hunt, n, k)
    if not span > _ROUNDED * hunt[at + MEASURE * n + k]:  # rounding has slopes, and no waves
        return 0
    known, side, most = hunt[at + STEEPEST * n + k], hunt[at + SIDE * n + k], _WAVE * span
    for i in range(int(hunt[INSIDE]) + 1):
        way = known * (time_of(hunt, i + 1) - time_of(hunt, i))
        if way > most and side * (value_at(hunt, n, k, i) + value_at(hunt, n, k, i + 1)) < way:
            return 1
    return 0


@plain
def learn_slopes(hunt: A, n: int, h: float) -> int:
    """Take the slopes of margins of forces from the points of a step of h that shows them."""
    at = N_HEAD
    for k in range(n):
        if is_margin_of_force(hunt, n, k) == 1:
            steepest = max(_FADING * hunt[at + STEEPEST * n + k], _LEAST)
            for i in range(int(hunt[INSIDE]) + 2):
                d = slope_at(hunt, n, k, i)
                steepest = max(steepest, abs(d)) if is_finite(d) == 1 else steepest
            hunt[at + STEEPEST * n + k] = steepest
            hunt[at + LOOKED * n + k] = max(hunt[at + LOOKED * n + k], h)
    return 0


@plain
def third_derivative(hunt: A, n: int, k: int, i: int) -> float:
    """Return the third derivative of the cubic between point i and the following one."""
    width = time_of(hunt, i + 1) - time_of(hunt, i)
    rise = (value_at(hunt, n, k, i + 1) - value_at(hunt, n, k, i)) / width
    return float(6.0 * (slope_at(hunt, n, k, i) + slope_at(hunt, n, k, i + 1) - 2.0 * rise) / (width * width))


@plain
def fourth_derivative(hunt: A, n: int, k: int, x: float) -> float:
    """Return the size of the fourth derivative near a time x of the step, 0 where nothing shows it."""
    count, i, most = int(hunt[INSIDE]), 0, 0.0
    if count == 0:
        return 0.0
    while i < count and time_of(hunt, i + 1) < x:
        i += 1
    here = third_derivative(hunt, n, k, i)
    if i > 0:
        apart = 0.5 * (time_of(hunt, i + 1) - time_of(hunt, i - 1))
        most = abs(here - third_derivative(hunt, n, k, i - 1)) / apart
    if i < count:
        apart = 0.5 * (time_of(hunt, i + 2) - time_of(hunt, i))
        most = max(most, abs(here - third_derivative(hunt, n, k, i + 1)) / apart)
    return most if is_finite(most) == 1 else 0.0


@plain
def coarseness(hunt: A, n: int, k: int) -> float:
    """Return the error of the cubics between points of a step over the range of a function, 0 far from its zero."""
    count, most = int(hunt[INSIDE]), 0.0
    low = high = value_at(hunt, n, k, 0)
    for i in range(1, count + 2):
        g = value_at(hunt, n, k, i)
        low, high = min(low, g), max(high, g)
    for i in range(count + 1):
        width = time_of(hunt, i + 1) - time_of(hunt, i)
        square = width * width
        error = fourth_derivative(hunt, n, k, time_of(hunt, i) + 0.5 * width) * square * square / 384.0
        near = min(abs(value_at(hunt, n, k, i)), abs(value_at(hunt, n, k, i + 1)))
        if near < _NEAR * error:
            most = max(most, error)
    if MARGINS and high - low <= UNCERTAIN * hunt[N_HEAD + MEASURE * n + k]:  # rounding is not smooth
        return 0.0
    return most / (high - low) if most > 0.0 else 0.0


@plain
def divides(hunt: A, n: int, h: float) -> int:
    """Return 1 where a step of h is too long: between its inner points a function does what they do not show.

    The next attempt is then set.
    A step that crosses a jump at a known time is short, and is not divided.
    Divisions that gain nothing end, as corners and jumps of functions do not become smooth: until inner points show the
    functions again no step is divided. Rates jump at switches, which the error of a step shows.
    """
    at, worst = N_HEAD, 0.0
    if h < _AT_A_JUMP * hunt[REACH]:
        return 0
    for k in range(n):
        awake = hunt[at + ASLEEP * n + k] == 0.0 and hunt[at + GRAZING * n + k] == 0.0
        if awake and hunt[at + ACTION * n + k] < float(ANEW) and hunt[at + SIDE * n + k] != 0.0:
            worst = max(worst, coarseness(hunt, n, k))
        if MARGINS and is_margin_of_force(hunt, n, k) == 1 and leaps(hunt, n, k, h) == 1:
            worst = max(worst, _LEAPS)
    change = 2.0 if worst * 64.0 < _COARSE else 0.8 * math.sqrt(math.sqrt(_COARSE / worst))
    before = hunt[COARSEST]
    hunt[COARSEST] = worst
    if worst <= _COARSE:
        hunt[COARSEST], hunt[DIVIDED] = 0.0, 0.0
        if hunt[LONGEST] > 0.0:
            hunt[LONGEST] = max(hunt[LONGEST], min(2.0, change) * h)
        return 0
    if hunt[DIVIDED] >= 0.0:
        hunt[DIVIDED] = hunt[DIVIDED] + 1.0 if before > 0.0 and worst > 0.5 * before else 0.0
    if hunt[DIVIDED] < 0.0 or hunt[DIVIDED] >= _IN_VAIN:
        hunt[DIVIDED], hunt[LONGEST] = -1.0, 0.0
        return 0
    hunt[LONGEST] = hunt[TRY] = max(0.3, change) * h
    return 1


@plain
def dip_between(hunt: A, n: int, k: int, x0: float, g0: float, d0: float, x1: float, g1: float, d1: float) -> float:
    """Return a time at which g may be on the other side although both ends of a part are on one; inf where it is not.

    Both ends are at the times x0 and x1 of the step, with the values and slopes g0, d0, g1 and d1.
    """
    width, side = x1 - x0, side_of(g0 + g1, 1.0)
    # a switch that is touched, as a point of a table at the turn of a sine, is not passed
    exact = 1 if hunt[INSIDE] == 0.0 or hunt[N_HEAD + ACTION * n + k] >= float(ANEW) else 0
    if exact == 1 and not (side * d0 < 0.0 and side * d1 > 0.0):
        return float(2.0 * hunt[WHOLE])
    square = width * width
    fourth = 0.0
    if exact == 0:
        fourth = _STRICT * fourth_derivative(hunt, n, k, 0.5 * (x0 + x1)) * square * square / 24.0
    most = _CAP * width * max(abs(d0), abs(d1))
    x = dip(g0, width * d0, g1, width * d1, side, fourth, most)
    return float(x0 + x * width if x < 1.0 else 2.0 * hunt[WHOLE])


@plain
def hidden(hunt: A, n: int, k: int) -> float:
    """Return a time of the bracket at which function k is on the other side before it comes back; beyond where never.

    Of the first stay on that side it is the point that is farthest from zero.
    """
    at, beyond, high = N_HEAD, 2.0 * hunt[WHOLE], hunt[HIGH]
    side, count, near = hunt[at + LOCAL * n + k], int(hunt[INSIDE]), 2.0 * hunt[RESOLUTION]
    x0, g0, d0 = hunt[LOW], hunt[at + G_LOW * n + k], hunt[at + D_LOW * n + k]
    now, there, deepest = side, beyond, -1.0
    if side == 0.0:
        return float(beyond)
    for i in range(count + 1):
        x1, g1, d1 = high, hunt[at + G_HIGH * n + k], hunt[at + D_HIGH * n + k]
        if i < count:
            x1 = hunt[PLACES + i]
            g1, d1 = hunt[at + (G_INSIDE + i) * n + k], hunt[at + (D_INSIDE + i) * n + k]
            if not (x1 > hunt[LOW] + near and x1 < high - near and is_finite(g1 + d1) == 1):
                continue
        after = side_of(g1, now)
        if after == now and is_finite(d0 + d1) == 1 and now * g0 >= 0.0:
            x = dip_between(hunt, n, k, x0, g0, d0, x1, g1, d1)
            if x > hunt[LOW] + near and x < high - near:  # for a time on the other side
                return float(there if now != side else x)
        if after != now and after == side:
            return float(there)
        if after != side and abs(g1) > deepest:
            there, deepest = x1, abs(g1)
        x0, g0, d0, now = x1, g1, d1, after
    return float(beyond)


@plain
def concealed(hunt: A, n: int) -> float:
    """Return the point of a bracket to try for events that its end does not show; its end without such events."""
    high = hunt[HIGH]
    x = 2.0 * hunt[WHOLE]
    if hunt[PROBES] < _MOST_PROBES and high - hunt[LOW] > 8.0 * hunt[RESOLUTION]:
        for k in range(n):
            x = min(x, hidden(hunt, n, k))
    return float(min(x, high))
