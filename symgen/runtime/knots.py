"""Points of tables that the state passes: steps of adaptive runs are made to end there.

Where a table is read over the state, nobody knows beforehand when its next point is passed, but nearly, at an accepted
state: with s, s' and s'' of the argument, at the root of s + s' h + s'' h^2 / 2 = level. It misses the point by the
third power of the step, so what is left of the kink for the next step is small. Nothing is kept: a state and the step
that the error estimate proposes say which step to try.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

#: A table with more points inside a step than this is not followed: its kinks are smaller than the tolerance, or the
#: error estimate will say so.
_CROWD = 8


@dataclass(frozen=True)
class Knots:
    """Tables that are read over the state.

    Attributes
    ----------
    function : callable
        ``(t, y, p, w, ydot, out)``, plain Python: arguments of all tables, their rates, and the rates of these.
    levels : tuple of tuple of float
        Points of each table, increasing.
    periods : tuple of float
        By which these repeat themselves, 0 where they do not.
    orders : tuple of int
        Which derivative of each table jumps there.
    """

    function: Callable[..., None]
    levels: tuple[tuple[float, ...], ...]
    periods: tuple[float, ...]
    orders: tuple[int, ...]

    @cached_property
    def _unrolled(self) -> list[tuple[Sequence[float], float, float]]:
        """Levels, over three periods where they repeat, the middle one the table's; where that begins; the period."""
        found = list[tuple[Sequence[float], float, float]]()
        for levels, period in zip(self.levels, self.periods, strict=True):
            turns = (-1, 0, 1) if period > 0.0 else ()
            rolled = [x + k * period for k in turns for x in levels[:-1]]
            found.append((rolled or levels, levels[0], period))
        return found

    def met(self, rtol: float) -> list[float]:
        """Return below which part of a step points of each table were just met: that much of a kink is a tolerance.

        A step of which a part x lies behind a jump of a k-th derivative feels the (k + 1)-th power of x.
        """
        return [rtol ** (1.0 / (order + 1)) for order in self.orders]

    def step(self, out: Sequence[float], h: float, met: Sequence[float]) -> float:
        """Return the step to try in place of one of `h` seconds.

        Parameters
        ----------
        out : sequence of float
            What the function has written for the state at its beginning.
        h : float
            The step that the error estimate proposes [s].
        met : sequence of float
            From `met`.
        """
        n, twice, first = len(self.periods), 2.0 * h, math.inf
        for i, (levels, begin, period) in enumerate(self._unrolled):
            s, rate, half = out[i], out[n + i], 0.5 * out[2 * n + i]
            ahead = twice * (rate + twice * half)
            if not math.isfinite(s + ahead):
                continue
            if period > 0.0:
                s -= math.floor((s - begin) / period) * period
            if rate * (rate + 2.0 * twice * half) > 0.0:
                found = _first_on(levels, s, rate, half, h, met[i], ahead)
            else:
                found = _first_around(levels, s, rate, half, h, met[i])
            if found < first:
                first = found
        if first > twice:
            return h
        return first if first <= h else 0.5 * first


def _first_on(levels: Sequence[float], s: float, rate: float, half: float, h: float, met: float, ahead: float) -> float:
    """Return when s + rate t + half t^2, which goes by `ahead` in one direction in 2 h, passes the first level."""
    up = rate > 0.0
    k, way, count = (bisect_right(levels, s), 1, len(levels)) if up else (bisect_left(levels, s) - 1, -1, -1)
    while k != count:
        distance = levels[k] - s
        if abs(distance) > abs(ahead):
            return math.inf
        t = 2.0 * distance / (rate + math.copysign(math.sqrt(max(0.0, rate * rate + 4.0 * half * distance)), rate))
        if t > met * h:
            last = k + way * _CROWD
            crowd = 0 <= last < len(levels) and abs(levels[last] - s) <= abs(h * (rate + h * half))
            return math.inf if crowd else t
        k += way
    return math.inf


def _first_around(levels: Sequence[float], s: float, rate: float, half: float, h: float, met: float) -> float:
    """Return the same of what turns round in 2 h: of the nearest levels on both sides."""
    here, found = bisect_left(levels, s), math.inf
    for level in levels[max(0, here - 2) : here + 2]:
        distance = level - s
        inside = rate * rate + 4.0 * half * distance
        if inside < 0.0:
            continue
        q = 0.5 * (rate + math.copysign(math.sqrt(inside), rate))
        for t in (distance / q if q != 0.0 else 0.0, -q / half if half != 0.0 else 0.0):
            if met * h < t < found:
                found = t
    return found
