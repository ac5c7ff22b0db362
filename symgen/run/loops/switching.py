"""Switching functions in a bracket: the cubic through values and slopes at its ends, and the next point to try."""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.store.emitted import plain
from symgen.run.loops.frame_parts import LOW
from symgen.run.loops.search_records import (
    ACTION,
    ANEW,
    ASLEEP,
    BLUR,
    CORNER,
    CORNERS,
    D_HIGH,
    D_LOW,
    D_START,
    DIRECTION,
    G_HIGH,
    G_LOW,
    G_START,
    GRAIN,
    GRAZING,
    HIGH,
    LOCAL,
    MARGIN,
    N_COLUMNS,
    N_HEAD,
    ROUNDS,
    SIDE,
    WHOLE,
    WIDTH,
)

A = Any
#: Iterations for the root of a cubic, at worst mostly bisections.
_ITERATIONS = 60
#: Values below this fraction of g at both ends are rounding.
_ROUNDING = 1e-14
#: Factor by which the final bracket grows each time that the root seems to be at an end of it.
_WIDER = 8.0


@plain
def cubic(g0: float, d0: float, g1: float, d1: float, x: float) -> float:
    """Return the value at x of the cubic with values g0, g1 and slopes d0, d1 at 0 and 1."""
    rise = g1 - g0
    return g0 + x * (d0 + x * (3.0 * rise - 2.0 * d0 - d1 + x * (d0 + d1 - 2.0 * rise)))


@plain
def extremum(g0: float, d0: float, g1: float, d1: float, which: int) -> float:
    """Return the position of the first or second extremum of the cubic inside (0, 1), 2 for no extremum."""
    rise = g1 - g0
    c, b, a = d0, 3.0 * rise - 2.0 * d0 - d1, 3.0 * (d0 + d1 - 2.0 * rise)  # a x^2 + 2 b x + c
    square = b * b - a * c
    if not square > 0.0:
        return 2.0
    q = -(b + math.copysign(math.sqrt(square), b))
    first = c / q if q != 0.0 else 2.0
    second = q / a if a != 0.0 else 2.0
    first = first if first > 0.0 and first < 1.0 else 2.0
    second = second if second > 0.0 and second < 1.0 else 2.0
    return min(first, second) if which == 0 else max(first, second)


@plain
def side_of(g: float, before: float) -> float:
    """Return the side of g, 1 or -1; where g is 0 or nan the former side, which is 0 until g first leaves zero."""
    return 1.0 if g > 0.0 else -1.0 if g < 0.0 else before


@plain
def is_sought(direction: float, before: float, after: float) -> int:
    """Return 1 where a change of sides is in the sought direction, else 0; the first side after none is no change."""
    return 1 if before != after and before != 0.0 and (direction == 0.0 or direction == after) else 0


@plain
def is_finite(x: float) -> int:
    """Return 1 for a number that is neither infinite nor nan, else 0."""
    return 1 if x - x == 0.0 else 0


@plain
def root_between(g0: float, d0: float, g1: float, d1: float, side: float, low: float, high: float) -> float:
    """Return the root of the cubic between two extrema, by Newton's iteration, or bisection where that leaves them."""
    rise, x = g1 - g0, 0.5 * (low + high)
    if low == 0.0 and high == 1.0:  # where nothing bends back, the chord is near
        x = g0 / (g0 - g1)
    for _ in range(_ITERATIONS):
        g = cubic(g0, d0, g1, d1, x)
        if side * g >= 0.0:
            low = x
        else:
            high = x
        slope = d0 + x * (2.0 * (3.0 * rise - 2.0 * d0 - d1) + x * 3.0 * (d0 + d1 - 2.0 * rise))
        following = x - g / slope if slope != 0.0 else low
        if abs(following - x) <= _ROUNDING:
            return following
        x = following if following > low and following < high else 0.5 * (low + high)
    return x


@plain
def first_root(g0: float, d0: float, g1: float, d1: float, side: float) -> float:
    """Return the position where the cubic first leaves a side, g1 being on the other; 0 where it has left already."""
    low, below = 0.0, 1 if side * g0 >= 0.0 else 0
    first = extremum(g0, d0, g1, d1, 0)
    for k in range(0 if first < 1.0 else 2, 3):  # the second one is after the first
        high = 1.0 if k == 2 else first if k == 0 else extremum(g0, d0, g1, d1, 1)
        if high > 1.0:
            continue
        above = 0 if k < 2 and side * cubic(g0, d0, g1, d1, high) >= 0.0 else 1
        if below == 1 and above == 1:
            return root_between(g0, d0, g1, d1, side, low, high)
        low, below = high, 1 - above
    return 0.0


@plain
def dip(g0: float, d0: float, g1: float, d1: float, side: float, fourth: float, most: float) -> float:
    """Return a position where g may be on the other side although both ends are on this one; 2 where it is not.

    It is the extremum of the cubic, or, as conditions of several parts have corners, the intersection of the tangents:
    the first of the two, as the rest is examined again. At x the cubic errs by fourth x^2 (1 - x)^2, at most by `most`.
    Where slopes at both ends do not show a dip, it has one only if this error is known.
    """
    least, first, between = -_ROUNDING * (abs(g0) + abs(g1)), 2.0, 1 if side * d0 < 0.0 and side * d1 > 0.0 else 0
    if between == 0 and not fourth > 0.0:
        return 2.0
    for which in range(2):
        x = extremum(g0, d0, g1, d1, which)
        if x < first:
            both = x * (1.0 - x)
            if side * cubic(g0, d0, g1, d1, x) < least + min(fourth * both * both, most):
                first = x
    if between == 0:
        return first
    x = (g1 - d1 - g0) / (d0 - d1)
    return min(first, x) if x > 0.0 and side * (g0 + d0 * x) < least else first


@plain
def passes(hunt: A, n: int, k: int, column: int) -> int:
    """Return 1 where a function changes sides as sought between the bracket's beginning and a column, else 0."""
    side = hunt[N_HEAD + LOCAL * n + k]
    return int(is_sought(hunt[N_HEAD + DIRECTION * n + k], side, side_of(hunt[N_HEAD + column * n + k], side)))


@plain
def is_corner(hunt: A, n: int, k: int) -> int:
    """Return 1 for what is 0 at a corner of the gap of a closed row."""
    return 1 if hunt[N_HEAD + MARGIN * n + k] == float(CORNER) else 0


@plain
def passes_corner(hunt: A, n: int) -> int:
    """Return 1 where the bracket passes a corner: a step ends before it, where the row holds that is in force."""
    for k in range(n):
        if is_corner(hunt, n, k) == 1 and passes(hunt, n, k, G_HIGH) == 1:
            return 1
    return 0


@plain
def beyond_low(hunt: A, n: int, k: int, otherwise: float) -> float:
    """Return the fraction of the bracket at which g leaves its side, by values and rates up to its beginning.

    After a jump, rates at the end of the bracket are different.
    """
    at, low, width = N_HEAD, hunt[LOW], hunt[HIGH] - hunt[LOW]
    g, d, bent = hunt[at + G_LOW * n + k], hunt[at + D_LOW * n + k], 0.0
    if low > 0.0:
        rise = (g - hunt[at + G_START * n + k]) / low
        bent = (2.0 * hunt[at + D_START * n + k] + 4.0 * d - 6.0 * rise) / low
    square = d * d - 2.0 * bent * g
    if not (g * d < 0.0 and square >= 0.0):
        return otherwise
    x = -2.0 * g / (d + math.copysign(math.sqrt(square), d)) / width
    return float(x) if x > 0.0 and x < 1.0 else otherwise


@plain
def candidate(hunt: A, n: int) -> float:
    """Return the next point to try for the first change of sides in a bracket."""
    at = N_HEAD
    low, high, rounds = hunt[LOW], hunt[HIGH], int(hunt[ROUNDS])
    width = high - low
    if rounds % 3 == 0:
        before = hunt[WIDTH]
        hunt[WIDTH] = width
        if rounds > 0 and width > 0.25 * before:
            return float(0.5 * (low + high))
    x = 1.0
    for k in range(n):
        if passes(hunt, n, k, G_HIGH) == 1:
            side, g1 = hunt[at + LOCAL * n + k], hunt[at + G_HIGH * n + k]
            d0, d1 = width * hunt[at + D_LOW * n + k], width * hunt[at + D_HIGH * n + k]
            root = first_root(hunt[at + G_LOW * n + k], d0, g1, d1, side) if is_finite(d0 + d1) == 1 else 0.5
            if rounds % 2 == 1 and hunt[at + ACTION * n + k] >= float(ANEW):
                root = beyond_low(hunt, n, k, root)
            x = min(x, root)
    x = low + x * width
    # a little beyond the root, from the nearer end, so that the root lies between two near ends
    ahead = 1 if x - low < high - x else 0
    distance, least = x - low if ahead == 1 else high - x, 0.5 * hunt[BLUR]
    share, beyond = width / hunt[WHOLE], -least if ahead == 0 else least
    if rounds > 0:
        beyond = distance * min(0.1, 4.0 * (distance / hunt[WHOLE]) * share * share)
    x += beyond if ahead == 1 else -beyond
    if distance < least:  # at the end of the bracket: rounding of g hides it for longer than the resolution of time
        hunt[BLUR] *= _WIDER
    return float(min(max(x, low + least), high - least))


@plain
def is_at_end(hunt: A, n: int) -> int:
    """Return 1 where all changes of sides in a bracket are at its end, up to the resolution of time, else 0.

    Each g there is smaller than the change of g in that time, by its slopes at both ends and by its mean slope.
    """
    at, width, blur = N_HEAD, hunt[HIGH] - hunt[LOW], hunt[BLUR]
    for k in range(n):
        if passes(hunt, n, k, G_HIGH) == 1:
            g, d0, d1 = hunt[at + G_HIGH * n + k], abs(hunt[at + D_LOW * n + k]), abs(hunt[at + D_HIGH * n + k])
            least = min(min(d0, d1) * width, abs(g - hunt[at + G_LOW * n + k]))
            if not abs(g) * width <= blur * least:
                return 0
    return 1


@plain
def wake(hunt: A, n: int, k: int) -> int:
    """Wake a sleeping margin that has left rounding by the end of a step."""
    asleep = hunt[N_HEAD + ASLEEP * n + k]
    if asleep > 0.0 and hunt[N_HEAD + G_START * n + k] > 2.0 * asleep:
        hunt[N_HEAD + G_START * n + k] -= asleep
        hunt[N_HEAD + ASLEEP * n + k] = 0.0
    return 0


@plain
def taken_for(hunt: A, n: int, k: int, h: float) -> float:
    """Return g at the trial state, counted as on the side of the run until g has reached that side.

    A margin that sleeps counts with what lifts it above its rounding.
    """
    at, g = N_HEAD, hunt[N_HEAD + N_COLUMNS * n + k]
    if hunt[at + ASLEEP * n + k] > 0.0:
        return float(g + hunt[at + ASLEEP * n + k])
    if CORNERS and is_corner(hunt, n, k) == 1:
        # within its rounding formulas may be those behind the corner
        grain, touches = hunt[at + GRAIN * n + k], abs(g) <= hunt[at + GRAIN * n + k]
        return float(-hunt[at + SIDE * n + k] * grain if touches and abs(hunt[at + G_START * n + k]) > grain else g)
    before = abs(hunt[at + G_START * n + k])
    near = h * abs(hunt[at + D_START * n + k]) < 4.0 * before and abs(g) < 8.0 * before
    return float(hunt[at + SIDE * n + k] * before) if near and hunt[at + GRAZING * n + k] != 0.0 else float(g)
