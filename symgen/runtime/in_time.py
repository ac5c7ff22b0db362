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

#: Pieces of a run at most.
MOST_PIECES = 100_000
#: Instants at which a formula is looked at first, and at most, until it changes sides as often as the time before.
_FIRST, _MOST = 2048, 65536
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

    def crossings(self, jump: Jump, until: float, first: float = 0.0, most: int = MOST_PIECES) -> list[float]:
        """Return the times from `first` to `until` at which what `jump` reads passes its levels; see `crossings`."""
        function, over = partial(self.at, jump.argument), partial(self.over, jump.argument)
        return crossings(function, line_of(jump, self._values), jump.levels, until, first, most, over)


def crossings(
    function: Callable[[float], float],
    line: tuple[float, float] | None,
    levels: Sequence[float],
    until: float,
    first: float = 0.0,
    most: int = MOST_PIECES,
    over: Callable[[Array], Array] | None = None,
) -> list[float]:
    """Return the times from `first` to `until` at which a function passes one of some levels.

    Parameters
    ----------
    function : callable
        Of the time [s].
    line : tuple of float or None
        Its value at 0 and its slope where it is a straight line.
    levels : sequence of float
        What it passes.
    until, first : float
        End and begin [s].
    most : int
        Times at most, where they are looked for.
    over : callable, optional
        Its values at many times, where that is quicker than one by one.

    Raises
    ------
    InputError
        If it passes them more often, or too often to tell one time from the next.
    """
    if line is not None:
        value, slope = line
        return [t for level in levels if slope and first <= (t := (level - value) / slope) <= until]
    found, count, span = list[float](), _FIRST, until - first
    while True:
        # not equidistant, so that what is faster than the looks is seen to be: doubling finds more then
        i = np.arange(count)
        times = np.append(first + span * (i + 0.6 * (_GOLDEN * i % 1.0)) / count, until)
        samples = np.array([function(t) for t in times.tolist()]) if over is None else over(times)
        if sum(int(np.count_nonzero(np.diff(samples > level))) for level in levels) > most:
            raise InputError("inputs", f"at most {most} jumps", "a formula that changes sides more often")
        before, found = len(found), [t for level in levels for t in _passed(function, times, samples, level)]
        if count > _FIRST and len(found) == before:
            return found
        if count >= _MOST:
            got = "a formula that changes sides more often than can be told apart"
            raise InputError("inputs", f"at most {MOST_PIECES} jumps", got)
        count *= 2


def _passed(function: Callable[[float], float], times: Array, samples: Array, level: float) -> list[float]:
    """Return where a function passes a level between instants at which it is known."""
    above, near, at = samples > level, np.abs(samples - level), times.tolist()
    passes = above[1:] != above[:-1]
    before, here, after = near[:-2], near[1:-1], near[2:]
    # nearest to the level among its neighbours, but not all along a plateau: it may pass it twice there
    close = ~(passes[1:] | passes[:-1]) & (here <= np.minimum(before, after)) & (here < np.maximum(before, after))
    found = [_bisected(function, at[i], at[i + 1], level) for i in np.flatnonzero(passes).tolist()]
    for i in np.flatnonzero(close).tolist():
        low, high, side = at[i], at[i + 2], bool(above[i])
        t = _lowest(function, 1.0 if side else -1.0, low, high)
        if (function(t) > level) != side:
            found += [_bisected(function, low, t, level), _bisected(function, t, high, level)]
    return found


def _bisected(function: Callable[[float], float], low: float, high: float, level: float) -> float:
    """Return the first number at which a function is on the side that it is on at `high`."""
    side = function(high) - level > 0.0
    while low < (middle := 0.5 * (low + high)) < high:
        if (function(middle) - level > 0.0) == side:
            high = middle
        else:
            low = middle
    return high


def _lowest(function: Callable[[float], float], sign: float, low: float, high: float) -> float:
    """Return where a function, times a sign, is smallest, by golden sections."""
    for _ in range(60):
        a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        if sign * function(a) < sign * function(b):
            high = b
        else:
            low = a
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
