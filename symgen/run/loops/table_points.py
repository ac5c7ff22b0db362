"""Switches and points of tables that the state passes: the interval of an argument, and steps to the next point.

The time at which the state passes the next point of a table is not foreseen, but estimated at an accepted state: with
s, s' and s'' of the argument, it is the root of s + s' h + s'' h^2 / 2 = point. Steps are made to end there. Steps to a
switch of a formula end shortly before it, so that none of their stages passes it.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.store.emitted import plain
from symgen.run.loops.frame_parts import DOUBT, LOW, NOTHING, TRY
from symgen.run.loops.search_records import (
    ACTION,
    ANEW,
    ARGUMENT,
    ARGUMENT_START,
    CORNERS,
    CURVE,
    D_INSIDE,
    D_START,
    FIRST,
    G_HIGH,
    G_INSIDE,
    G_START,
    GRAIN,
    HIGH,
    INSIDE,
    LEVEL,
    LONGEST,
    MISSED,
    N_COLUMNS,
    N_HEAD,
    PERIOD,
    PLACE,
    POINTS,
    REACH,
    RESOLUTION,
    SIDE,
    SLOPE,
    SLOPE_START,
    TABLES,
    WAY,
)
from symgen.run.loops.switching import is_corner, is_finite, passes

A = Any
#: Distances below this fraction of that between two points are 0.
_REACHED = 1e-2
#: No step to a point is shorter than this fraction of the original step: a nearly infinite rate is no information.
_LEAST = 1e-12
#: Fraction of the distance to a jump for a step whose stages do not pass it.
SHORT_OF = 0.99
#: Rounding of a switch is passed at once within this multiple of the resolution of time, however short steps are.
_MOST = 1e6
#: Beyond the points of a table.
_FAR = 1e300
#: A switch below this fraction of the size of its terms keeps its side.
ROUNDING_OF_SWITCH = 1e-13
#: What a corner passes within this multiple of the resolution of time is rounding too.
_UNRESOLVED = 16.0


@plain
def point(hunt: A, n: int, k: int, i: int) -> float:
    """Return point number i of the table of a function, counted through its periods."""
    count, first = int(hunt[N_HEAD + POINTS * n + k]), int(hunt[TABLES] + hunt[N_HEAD + FIRST * n + k])
    period = hunt[N_HEAD + PERIOD * n + k]
    if period > 0.0:
        turns = math.floor(float(i) / float(count))
        return float(hunt[first + i - turns * count] + float(turns) * period)
    if i < 0:
        return -_FAR
    if i >= count:
        return _FAR
    return float(hunt[first + i])


@plain
def interval_at(hunt: A, n: int, k: int, s: float, rate: float) -> int:
    """Return the number of the point at which the interval of s begins; at a point, of the interval that s enters."""
    count, first = int(hunt[N_HEAD + POINTS * n + k]), int(hunt[TABLES] + hunt[N_HEAD + FIRST * n + k])
    period, turns = hunt[N_HEAD + PERIOD * n + k], 0
    if period > 0.0:
        turns = math.floor((s - hunt[first]) / period)
    local, low, high = s - float(turns) * period, 0, count
    while low < high:
        middle = (low + high) // 2
        if hunt[first + middle] < local or (hunt[first + middle] == local and rate >= 0.0):
            low = middle + 1
        else:
            high = middle
    return turns * count + low - 1


@plain
def is_near(hunt: A, n: int, k: int, i: int, s: float) -> int:
    """Return 1 where s is so near to point number i that inside a step it may be touched, else 0."""
    here = point(hunt, n, k, i)
    near = min(here - point(hunt, n, k, i - 1), point(hunt, n, k, i + 1) - here)
    return 1 if abs(here - s) <= _REACHED * near else 0


@plain
def is_met(hunt: A, n: int, k: int, i: int, s: float, rate: float, h: float) -> int:
    """Return 1 where s is practically at point number i in a step of h, else 0."""
    far = abs(point(hunt, n, k, i) - s)
    return 1 if is_near(hunt, n, k, i, s) == 1 and far <= hunt[N_HEAD + MISSED * n + k] * h * abs(rate) else 0


@plain
def enter(hunt: A, n: int, k: int, h: float) -> int:
    """Move the argument of a table to the interval that it enters where a step of h begins at a point."""
    s, rate = hunt[N_HEAD + ARGUMENT_START * n + k], hunt[N_HEAD + SLOPE_START * n + k]
    place = int(hunt[N_HEAD + PLACE * n + k])
    if rate > 0.0 and is_met(hunt, n, k, place + 1, s, rate, h) == 1:
        hunt[N_HEAD + PLACE * n + k] = float(place + 1)
    elif rate < 0.0 and is_met(hunt, n, k, place, s, rate, h) == 1:
        hunt[N_HEAD + PLACE * n + k] = float(place - 1)
    return 0


@plain
def face(hunt: A, n: int, k: int, h: float) -> int:
    """Select the point at which a step of h leaves its interval; the one ahead where it stays."""
    enter(hunt, n, k, h)
    s, rate, place = hunt[N_HEAD + ARGUMENT * n + k], hunt[N_HEAD + SLOPE_START * n + k], hunt[N_HEAD + PLACE * n + k]
    low, high = point(hunt, n, k, int(place)), point(hunt, n, k, int(place) + 1)
    for i in range(int(hunt[INSIDE])):  # it may have come back
        between = hunt[N_HEAD + (G_INSIDE + i) * n + k]
        passed = int(place) if between < low else int(place) + 1
        out = 1 if s > low and s < high and (between < low or between > high) else 0
        if out == 1 and is_near(hunt, n, k, passed, between) == 0:
            s = between
    up = 1 if s >= high or (s >= low and rate >= 0.0) else 0
    way, level = 1.0 if up == 1 else -1.0, high if up == 1 else low
    hunt[N_HEAD + WAY * n + k], hunt[N_HEAD + LEVEL * n + k] = way, level
    hunt[N_HEAD + G_START * n + k] = max(0.0, way * (level - hunt[N_HEAD + ARGUMENT_START * n + k]))
    hunt[N_HEAD + D_START * n + k] = -way * rate
    return 0


@plain
def ends_at(hunt: A, n: int, k: int, h: float) -> int:
    """Return 1 where a step of h that has passed the examined point ends practically there, else 0."""
    i = int(hunt[N_HEAD + PLACE * n + k]) + (1 if hunt[N_HEAD + WAY * n + k] > 0.0 else 0)
    return int(is_met(hunt, n, k, i, hunt[N_HEAD + ARGUMENT * n + k], hunt[N_HEAD + SLOPE * n + k], h))


@plain
def short(hunt: A, n: int, k: int) -> float:
    """Return the step below which stages on both sides of a jump do not matter."""
    least = max(hunt[N_HEAD + MISSED * n + k] * hunt[REACH], 4.0 * hunt[RESOLUTION])
    return float(max(least, 2.0 * through(hunt, n, k)))


@plain
def through(hunt: A, n: int, k: int) -> float:
    """Return the time in which a switch passes its rounding."""
    far, rate = 4.0 * hunt[N_HEAD + GRAIN * n + k], abs(hunt[N_HEAD + D_START * n + k])
    return float(far / rate) if far < rate * max(hunt[REACH], _MOST * hunt[RESOLUTION]) else 0.0


@plain
def curvature(rise: float, before: float, after: float, h: float) -> float:
    """Return the second derivative at the end of a step, of the cubic through values and rates at both ends."""
    curve = (2.0 * before + 4.0 * after - 6.0 * rise / h) / h
    return curve if is_finite(curve) == 1 else 0.0


@plain
def bend(hunt: A, n: int, k: int, g: float, d: float, h: float) -> int:
    """Store the second derivative at the end of a step of h."""
    rise, before = g - hunt[N_HEAD + G_START * n + k], hunt[N_HEAD + D_START * n + k]
    hunt[N_HEAD + CURVE * n + k] = curvature(rise, before, d, h)
    return 0


@plain
def arrive(hunt: A, n: int, k: int, h: float) -> int:
    """Make the last examined state, after a step of h (0: no step), the beginning of the next step."""
    s, rate = hunt[N_HEAD + ARGUMENT * n + k], hunt[N_HEAD + SLOPE * n + k]
    rate = rate if is_finite(rate) == 1 else 0.0
    if is_finite(s) == 1:
        if h > 0.0:
            rise, before = s - hunt[N_HEAD + ARGUMENT_START * n + k], hunt[N_HEAD + SLOPE_START * n + k]
            hunt[N_HEAD + CURVE * n + k] = curvature(rise, before, rate, h)
        hunt[N_HEAD + PLACE * n + k] = float(interval_at(hunt, n, k, s, rate))
        hunt[N_HEAD + ARGUMENT_START * n + k], hunt[N_HEAD + SLOPE_START * n + k] = s, rate
    hunt[N_HEAD + SIDE * n + k] = 1.0
    return 0


@plain
def time_to(distance: float, rate: float, curve: float, turning: int) -> float:
    """Return the time t of s' t + s'' t^2 / 2 = distance, with `turning` 1 the one after it turns; 0 where never."""
    square = rate * rate + 2.0 * curve * distance
    if not (abs(distance) < _FAR and square >= 0.0):
        return 0.0
    q = rate + math.copysign(math.sqrt(square), rate)
    if turning == 1:
        return float(-q / curve) if curve != 0.0 else 0.0
    return float(2.0 * distance / q) if q != 0.0 else 0.0


@plain
def aim(hunt: A, n: int, h: float) -> int:
    """Set the step to try in place of one of h: one that ends at the next point, or half-way to one that is near.

    It ends shortly before a jump, so that no stage passes it; a short step then crosses the jump.
    """
    first, least = 2.0 * h, _LEAST * h
    hunt[REACH] = h
    for k in range(n):
        if hunt[N_HEAD + ACTION * n + k] < float(ANEW) and not (CORNERS and is_corner(hunt, n, k) == 1):
            continue
        curve = hunt[N_HEAD + CURVE * n + k]
        if hunt[N_HEAD + POINTS * n + k] == 0.0:
            g, d = hunt[N_HEAD + G_START * n + k], hunt[N_HEAD + D_START * n + k]
            for turning in range(2):
                t = time_to(-g, d, curve, turning)
                if t > 0.0 and t < 2.0 * h:
                    if CORNERS and is_corner(hunt, n, k) == 1:  # the step that passes it is ended before it
                        t = SHORT_OF * t if t > short(hunt, n, k) else t + 0.5 * short(hunt, n, k)
                    else:
                        t = SHORT_OF * t if t > short(hunt, n, k) else t + through(hunt, n, k) + 2.0 * hunt[RESOLUTION]
                    first = min(first, t)
            continue
        enter(hunt, n, k, h)
        s, rate = hunt[N_HEAD + ARGUMENT_START * n + k], hunt[N_HEAD + SLOPE_START * n + k]
        place = int(hunt[N_HEAD + PLACE * n + k])
        for i in range(2):
            distance = point(hunt, n, k, place + i) - s
            t = time_to(distance, rate, curve, 0)
            if t > least and t < first and (i == 1) == (rate > 0.0):
                first = t
            t = time_to(distance, rate, curve, 1)
            if t > least and t < first:
                first = t
    hunt[TRY] = h
    if hunt[LONGEST] > 0.0 and h > hunt[LONGEST]:
        hunt[TRY] = hunt[LONGEST]
    if first < 2.0 * hunt[TRY]:
        hunt[TRY] = first if first <= hunt[TRY] else 0.5 * first
    return 0


@plain
def switch_values(hunt: A, n: int, h: float, search: int) -> int:
    """Set the effective values of switches: those within rounding of zero, or undefined, stay on the same side."""
    at, out = N_HEAD, N_HEAD + N_COLUMNS * n
    for k in range(n):
        if CORNERS and is_corner(hunt, n, k) == 1:
            # no step that begins farther from a corner passes it within the resolution of time
            least = _UNRESOLVED * hunt[RESOLUTION] * abs(hunt[out + n + k])
            hunt[at + GRAIN * n + k] = ROUNDING_OF_SWITCH * hunt[out + 2 * n + k] + (
                least if is_finite(least) == 1 else 0.0
            )
        if hunt[at + ACTION * n + k] < float(ANEW):
            continue
        if hunt[at + POINTS * n + k] > 0.0:
            s, rate = hunt[out + k], hunt[out + n + k]
            hunt[at + ARGUMENT * n + k], hunt[at + SLOPE * n + k] = s, rate
            if search == NOTHING or search == DOUBT:
                face(hunt, n, k, h)
            way = hunt[at + WAY * n + k]
            for i in range(int(hunt[INSIDE]) if search == NOTHING else 0):
                g, d = at + (G_INSIDE + i) * n + k, at + (D_INSIDE + i) * n + k
                faced = int(hunt[at + PLACE * n + k]) + (1 if way > 0.0 else 0)
                near = is_near(hunt, n, k, faced, hunt[g])
                hunt[g] = 0.0 if near == 1 else way * (hunt[at + LEVEL * n + k] - hunt[g])
                hunt[d] *= -way
            hunt[out + k], hunt[out + n + k] = way * (hunt[at + LEVEL * n + k] - s), -way * rate
        hunt[at + GRAIN * n + k] = ROUNDING_OF_SWITCH * hunt[out + 2 * n + k]
        if is_finite(hunt[out + k] + hunt[out + n + k]) == 0:
            hunt[out + k], hunt[out + n + k] = 0.0, 0.0
        elif abs(hunt[out + k]) <= hunt[at + GRAIN * n + k]:
            hunt[out + k] = 0.0
    return 0


@plain
def ends_near(hunt: A, n: int) -> int:
    """Return 1 where the bracket passes only switches, and ends near enough after all of them, else 0."""
    for k in range(n):
        if passes(hunt, n, k, G_HIGH) == 1:
            if hunt[N_HEAD + POINTS * n + k] > 0.0:
                if ends_at(hunt, n, k, hunt[HIGH]) == 0:
                    return 0
            elif hunt[N_HEAD + ACTION * n + k] < float(ANEW) or hunt[HIGH] > 2.0 * short(hunt, n, k):
                return 0
    return 1


@plain
def is_before(hunt: A, n: int) -> int:
    """Return 1 where the bracket begins near a jump and passes it, but no event, else 0."""
    jumps = 0
    for k in range(n):
        if passes(hunt, n, k, G_HIGH) == 1:
            if hunt[N_HEAD + ACTION * n + k] < float(ANEW):
                return 0
            if hunt[N_HEAD + POINTS * n + k] == 0.0 and hunt[LOW] > short(hunt, n, k):
                jumps = 1
    return 1 if jumps == 1 and hunt[HIGH] - hunt[LOW] <= (1.0 - SHORT_OF) * hunt[LOW] else 0
