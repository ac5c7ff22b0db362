"""Switching functions between two states: the cubic through their values and slopes, and where it changes sides."""

from __future__ import annotations

import math

from symgen.store.emitted import plain

#: Iterations for the root of a cubic, most of which halve a part at worst.
_ITERATIONS = 60
#: What is below this part of g at both ends is rounding.
_ROUNDING = 1e-14


@plain
def cubic(g0: float, d0: float, g1: float, d1: float, x: float) -> float:
    """Return the value at x of the cubic with values g0, g1 and slopes d0, d1 at 0 and 1."""
    rise = g1 - g0
    return g0 + x * (d0 + x * (3.0 * rise - 2.0 * d0 - d1 + x * (d0 + d1 - 2.0 * rise)))


@plain
def extremum(g0: float, d0: float, g1: float, d1: float, which: int) -> float:
    """Return where the cubic has its first or second extremum inside (0, 1), 2 where it has none."""
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
    """Return the side that g is on, 1 or -1; that of before where g is 0 or no number."""
    return 1.0 if g > 0.0 else -1.0 if g < 0.0 else before


@plain
def asked(direction: float, before: float, after: float) -> int:
    """Return 1 where a change of sides is one that is asked for, else 0."""
    return 1 if before != after and (direction == 0.0 or direction == after) else 0


@plain
def is_finite(x: float) -> int:
    """Return 1 for a number that is neither infinite nor nan, else 0."""
    return 1 if x - x == 0.0 else 0


@plain
def root_between(g0: float, d0: float, g1: float, d1: float, side: float, low: float, high: float) -> float:
    """Return where the cubic leaves a side between two of its extrema: Newton's iteration, halves where it strays."""
    rise, x = g1 - g0, 0.5 * (low + high)
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
    """Return where the cubic first leaves a side, g1 being on the other one; 0 where it has left it already."""
    low, below = 0.0, 1 if side * g0 >= 0.0 else 0
    for k in range(3):
        high = 1.0 if k == 2 else extremum(g0, d0, g1, d1, k)
        if high > 1.0:
            continue
        above = 0 if k < 2 and side * cubic(g0, d0, g1, d1, high) >= 0.0 else 1
        if below == 1 and above == 1:
            return root_between(g0, d0, g1, d1, side, low, high)
        low, below = high, 1 - above
    return 0.0


@plain
def dip(g0: float, d0: float, g1: float, d1: float, side: float) -> float:
    """Return where g may be on the other side for a while although both ends are on this one; 2 where it is not.

    That is at the extremum of the cubic, or, as conditions of several parts have corners, where tangents meet: at the
    first of the two, as what is behind it is looked at again.
    """
    if not (side * d0 < 0.0 and side * d1 > 0.0):
        return 2.0
    least, x, first = -_ROUNDING * (abs(g0) + abs(g1)), extremum(g0, d0, g1, d1, 0), 2.0
    if x < 1.0 and side * cubic(g0, d0, g1, d1, x) < least:
        first = x
    x = (g1 - d1 - g0) / (d0 - d1)
    return min(first, x) if x > 0.0 and side * (g0 + d0 * x) < least else first
