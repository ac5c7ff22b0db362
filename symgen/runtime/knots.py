"""Points of tables that the state passes: steps of adaptive runs are made to end there.

Where a table is read over the state, nobody knows beforehand when its next point is passed, but nearly, at an accepted
state: with s, s' and s'' of the argument, at the root of s + s' h + s'' h^2 / 2 = level. It misses the point by the
third power of the step, so what is left of the kink for the next step is small. Nothing is kept: a state and the step
that the error estimate proposes say which step to try.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.runtime.instances import called

Array = NDArray[np.float64]

#: This part of the way between two points is none: a point is missed by less.
_REACHED = 1e-2


@dataclass(frozen=True)
class Knots:
    """Tables that are read over the state.

    Attributes
    ----------
    function : emitted function
        ``(t, y, p, w, ydot, out)``: arguments of all tables, their rates, and the rates of these.
    levels : tuple of tuple of float
        Points of each table, increasing.
    periods : tuple of float
        By which these repeat themselves, 0 where they do not.
    orders : tuple of int
        Which derivative of each table jumps there.
    sizes : tuple of tuple of float
        How much each point matters: by how much of its range a table differs from its neighbouring piece a point on.
    """

    function: Any
    levels: tuple[tuple[float, ...], ...]
    periods: tuple[float, ...]
    orders: tuple[int, ...]
    sizes: tuple[tuple[float, ...], ...]

    def arrays(self, rtol: float) -> tuple[Array, NDArray[np.int64], Array]:
        """Return levels, where those of each table begin, and numbers of each table, as `aimed` takes them.

        Levels stand over three periods where they repeat, the middle one the table's; points that matter less than
        `rtol` are left out: many of these together are a smooth curve, which the error estimate sees. Numbers are where
        the period begins, the period, and below which part of a step points were just met: that much of a kink is a
        tolerance, as a step of which a part x lies behind a jump of a k-th derivative feels the (k + 1)-th power of x.
        """
        every, starts, numbers = list[float](), [0], list[float]()
        for levels, period, order, sizes in zip(self.levels, self.periods, self.orders, self.sizes, strict=True):
            turns, own = ((-1, 0, 1), levels[:-1]) if period > 0.0 else ((0,), levels)
            felt = [x for x, size in zip(own, sizes, strict=False) if size > rtol]
            every += [x + k * period for k in turns for x in felt]
            starts.append(len(every))
            numbers += [levels[0], period, rtol ** (1.0 / (order + 1))]
        return np.array(every), np.array(starts, dtype=np.int64), np.array(numbers)


@called
def aimed(levels: Any, starts: Any, tables: Any, out: Any, h: float) -> float:
    """Return the step to try in place of one of `h` seconds.

    Parameters
    ----------
    levels, starts, tables : Array
        From `Knots.arrays`.
    out : Array
        What the function has written for the state at its beginning.
    h : float
        The step that the error estimate proposes [s].
    """
    n, twice, first = starts.shape[0] - 1, 2.0 * h, math.inf
    for i in range(n):
        s, rate, half = out[i], out[n + i], 0.5 * out[2 * n + i]
        begin, period, met = tables[3 * i], tables[3 * i + 1], tables[3 * i + 2]
        ahead = twice * (rate + twice * half)
        if not math.isfinite(s + ahead):
            continue
        if period > 0.0:
            s -= math.floor((s - begin) / period) * period
        low, high = starts[i], starts[i + 1]
        if rate * (rate + 2.0 * twice * half) > 0.0:
            found = first_on(levels, low, high, s, rate, half, h, met, ahead)
        else:
            found = first_around(levels, low, high, s, rate, half, h, met)
        first = min(first, found)
    if first > twice:
        return h
    return first if first <= h else 0.5 * first


def behind(levels: Any, low: int, high: int, s: float, equal: bool) -> int:
    """Return the number of the first of some levels that lies behind s, or at it, unless an equal one counts before."""
    while low < high:
        middle = (low + high) // 2
        if levels[middle] < s or (equal and levels[middle] == s):
            low = middle + 1
        else:
            high = middle
    return low


def first_on(
    levels: Any, low: int, high: int, s: float, rate: float, half: float, h: float, met: float, ahead: float
) -> float:
    """Return when s + rate t + half t^2, which goes by `ahead` in one direction in 2 h, passes the first level."""
    up = rate > 0.0
    k, way, end = behind(levels, low, high, s, up), 1, high
    if not up:
        k, way, end = k - 1, -1, low - 1
    while k != end:
        distance = levels[k] - s
        if abs(distance) > abs(ahead):
            return math.inf
        t = 2.0 * distance / (rate + math.copysign(math.sqrt(max(0.0, rate * rate + 4.0 * half * distance)), rate))
        if t > met * h or not at_point(levels, low, high, k, s):
            return float(t)
        k += way
    return math.inf


def first_around(levels: Any, low: int, high: int, s: float, rate: float, half: float, h: float, met: float) -> float:
    """Return the same of what turns round in 2 h: of the nearest levels on both sides."""
    here, found = behind(levels, low, high, s, False), math.inf
    for k in range(max(low, here - 2), min(high, here + 2)):
        distance = levels[k] - s
        inside = rate * rate + 4.0 * half * distance
        if inside < 0.0:
            continue
        q = 0.5 * (rate + math.copysign(math.sqrt(inside), rate))
        for t in (distance / q if q != 0.0 else 0.0, -q / half if half != 0.0 else 0.0):
            if 0.0 < t and t < found and (met * h < t or not at_point(levels, low, high, k, s)):
                found = t
    return found


def at_point(levels: Any, low: int, high: int, k: int, s: float) -> bool:
    """Return whether s is as good as at a level: from the one before it is nearly all the way."""
    near = math.inf
    if k > low:
        near = levels[k] - levels[k - 1]
    if k + 1 < high:
        near = min(near, levels[k + 1] - levels[k])
    return bool(abs(levels[k] - s) <= _REACHED * near)
