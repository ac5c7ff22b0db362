"""Formulas of the time: their values, and when they pass a level."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from symgen.describe.evaluate import evaluate
from symgen.describe.inputs import Jump
from symgen.describe.mechanism import Mechanism
from symgen.errors import InputError
from symgen.runtime.columns import Columns
from symgen.vocabulary.expressions import Call, Expr, Name, Number, names

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
#: Values of a function at many times.
Over = Callable[[Array], Array]

#: Pieces of a run at most.
MOST_PIECES = 100_000
#: Instants at which a formula is looked at first, and at most, until it changes sides as often as the time before.
_FIRST, _MOST = 2048, 2**19
#: Looks at each passage, or near one, at least: with fewer it cannot be told from the next.
_LOOKS = 4
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


class InTime:
    """What formulas of parameters and t are at times.

    Parameters
    ----------
    mechanism : Mechanism
        Whose tables they may read.
    values : mapping of str to float
        Of the parameters.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, float]) -> None:
        self._tables = {table.name: table for table in mechanism.tables}
        self._values = dict(values)

    def at(self, e: Expr, t: float) -> float:
        """Return a formula's value at a time [s]; not a number where it is undefined."""
        self._values["t"] = t
        try:
            return evaluate(e, self._values, tables=self._tables)
        except InputError:  # no comparison with it holds
            return math.nan

    def over(self, e: Expr, times: Array) -> Array:
        """Return a formula's values at many times, each that of `at`."""
        return np.broadcast_to(Columns({**self._values, "t": times}, self._tables).value(e), len(times))

    def crossings(self, jump: Jump, until: float, first: float = 0.0) -> list[float]:
        """Return the times from `first` to `until` at which what `jump` reads passes its levels; see `crossings`."""
        over = partial(self.over, jump.argument)
        return crossings(over, line_of(jump, self._values), jump.levels, until, first)

    def range(self, jump: Jump, until: float, first: float = 0.0) -> tuple[float, float]:
        """Return the least and the largest value of what `jump` reads, as far as looks tell; nan where undefined."""
        line = line_of(jump, self._values)
        times = np.linspace(first, until, 2 if line is not None else _FIRST)
        values = self.over(jump.argument, times)
        known = values[np.isfinite(values)]
        return (float(known.min()), float(known.max())) if len(known) else (math.nan, math.nan)


def crossings(
    over: Over,
    line: tuple[float, float] | None,
    levels: Sequence[float],
    until: float,
    first: float = 0.0,
) -> list[float]:
    """Return the times from `first` to `until` at which a function passes one of some levels.

    Parameters
    ----------
    over : callable
        Its values at many times [s].
    line : tuple of float or None
        Its value at 0 and its slope where it is a straight line.
    levels : sequence of float
        What it passes.
    until, first : float
        End and begin [s].

    Raises
    ------
    InputError
        If it passes them more often, or too often to tell one time from the next.
    """
    if line is not None or not levels:
        value, slope = line or (0.0, 0.0)
        return [t for level in levels if slope and first <= (t := (level - value) / slope) <= until]
    count, before, span, often = _FIRST, -1, until - first, "a formula that changes sides more often"
    while count <= _MOST:
        # anywhere in equal parts, so that what is faster than the looks is seen to be, whatever its frequency
        anywhere = np.random.default_rng(count).random(count)
        times = np.concatenate([[first], first + span * (np.arange(count) + anywhere) / count, [until]])
        samples, passed = over(times), -1
        passes, close = zip(*(_seen(samples, level) for level in levels), strict=True)
        if sum(len(x) for x in passes) > MOST_PIECES:
            raise InputError("inputs", f"at most {MOST_PIECES} jumps", often)
        known = samples[np.isfinite(samples)]
        moving = float(np.ptp(known)) if len(known) else 0.0
        active = sum(len(x) + int((n < moving).sum()) for x, (_, n) in zip(passes, close, strict=True))
        if _LOOKS * active <= count:
            found = [_around(over, times, samples, *seen) for seen in zip(passes, close, levels, strict=True)]
            passed = sum(len(low) for low, _ in found)
            if passed == before:
                return [
                    t for at, level in zip(found, levels, strict=True) for t in _bisected(over, *at, level).tolist()
                ]
        count, before = 2 * count, passed
    raise InputError("inputs", f"at most {MOST_PIECES} jumps", f"{often} than can be told apart")


def _seen(samples: Array, level: float) -> tuple[Integers, tuple[Integers, Array]]:
    """Return the looks before which a level is passed; those behind which it may be twice, and how near they are."""
    above, near = samples > level, np.abs(samples - level)
    passes = above[1:] != above[:-1]
    beside = np.concatenate([[math.inf], near, [math.inf]])
    before, after = beside[:-2], beside[2:]
    passing = np.concatenate([[False], passes]) | np.concatenate([passes, [False]])
    # nearest to the level among its neighbours, but not all along a plateau: it may pass it twice there
    close = ~passing & (near <= np.minimum(before, after)) & (near < np.maximum(before, after))
    return np.flatnonzero(passes), (np.flatnonzero(close), near[close])


def _around(
    over: Over, times: Array, samples: Array, passes: Integers, close: tuple[Integers, Array], level: float
) -> tuple[Array, Array]:
    """Return times before and behind each passage of a level."""
    above = samples[close[0]] > level
    before, after = times[np.maximum(close[0] - 1, 0)], times[np.minimum(close[0] + 1, len(times) - 1)]
    t = _lowest(over, np.where(above, 1.0, -1.0), before, after)
    twice = (over(t) > level) != above
    before, t, after = before[twice], t[twice], after[twice]
    return np.concatenate([times[passes], before, t]), np.concatenate([times[passes + 1], t, after])


def _bisected(over: Over, low: Array, high: Array, level: float) -> Array:
    """Return the first numbers at which a function is on the side that it is on at `high`."""
    side = over(high) > level
    while True:
        middle = 0.5 * (low + high)
        inside = (low < middle) & (middle < high)
        if not inside.any():
            return high
        same = (over(middle) > level) == side
        low, high = np.where(inside & ~same, middle, low), np.where(inside & same, middle, high)


def _lowest(over: Over, sign: Array, low: Array, high: Array) -> Array:
    """Return where a function, times a sign, is smallest, by golden sections."""
    for _ in range(60 if len(low) else 0):
        a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        left = sign * over(a) < sign * over(b)
        low, high = np.where(left, low, a), np.where(left, b, high)
    return 0.5 * (low + high)


def line_of(jump: Jump, values: Mapping[str, float]) -> tuple[float, float] | None:
    """Return value at 0 and slope of a jump's argument where that is a straight line in t."""

    def line(e: Expr) -> tuple[float, float] | None:
        if isinstance(e, Name) and e.name == "t":
            return 0.0, 1.0
        if isinstance(e, Number | Name) or "t" not in set(names(e)):
            try:
                return evaluate(e, values), 0.0
            except InputError:
                return None
        assert isinstance(e, Call), "a tree has three kinds of nodes"
        parts = [line(a) for a in e.arguments]
        if any(part is None for part in parts):
            return None
        (a, m), (b, n) = (parts[0] or (0.0, 0.0)), ((parts[1] if len(parts) > 1 else None) or (0.0, 0.0))
        if e.function in ("add", "sub", "neg"):
            sign = {"add": 1.0, "sub": -1.0, "neg": -1.0}[e.function]
            return (sign * a, sign * m) if e.function == "neg" else (a + sign * b, m + sign * n)
        if e.function == "mul" and 0.0 in (m, n):
            return a * b, a * n + b * m
        return (a / b, m / b) if e.function == "div" and n == 0.0 and b != 0.0 else None

    return line(jump.argument)
