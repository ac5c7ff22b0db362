"""Formulas of time: their values, and the times at which they pass a level."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ONE, ZERO, Call, Expr, Name, call, names_in_expression
from symgen.describe.formulas.evaluate import evaluate
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.driven_mechanism import Jump
from symgen.run.breaks.array_formulas import Columns

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
#: Values of a function at many times.
Over = Callable[[Array], Array]

#: Most pieces of a run.
MOST_PIECES = 100_000
#: Number of samples of a formula, first and at most, until two samplings count the same passages.
_FIRST, _MOST = 2048, 2**19
#: Fewest samples for each passage, or near one: with fewer it cannot be separated from the next.
_LOOKS = 4
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


class InTime:
    """Values of formulas of parameters and t at given times.

    Parameters
    ----------
    mechanism : Mechanism
        Source of the tables that they may read, and of the largest step, which bounds the distance of samples.
    values : mapping of str to float
        Values of the parameters.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, float]) -> None:
        self._tables = {table.name: table for table in mechanism.tables}
        self._values, self._shortest = dict(values), mechanism.defaults.max_step or math.inf

    def at(self, e: Expr, t: float) -> float:
        """Return the value of a formula at a time [s], or nan if it is undefined."""
        self._values["t"] = t
        try:
            return evaluate(e, self._values, tables=self._tables)
        except InputError:  # no comparison with it holds
            return math.nan

    def over(self, e: Expr, times: Array) -> Array:
        """Return the values of a formula at many times, equal to the values that `at` gives."""
        return np.broadcast_to(Columns({**self._values, "t": times}, self._tables).value(e), len(times))

    def crossings(self, jump: Jump, until: float, first: float = 0.0) -> list[float]:
        """Return the times from `first` to `until` at which a jump's argument passes its levels; see `crossings`."""
        over, line = partial(self.over, jump.argument), line_of(jump, self._values)
        return crossings(over, line, jump.levels, until, first, self._shortest)

    def range(self, jump: Jump, until: float, first: float = 0.0) -> tuple[float, float]:
        """Return the least and the largest sampled value of the argument of `jump`; nan if undefined."""
        line = line_of(jump, self._values)
        times = np.linspace(first, until, 2 if line is not None else _FIRST)
        values = self.over(jump.argument, times)
        finite = values[np.isfinite(values)]
        return (float(finite.min()), float(finite.max())) if len(finite) else (math.nan, math.nan)


def crossings(
    over: Over,
    line: tuple[float, float] | None,
    levels: Sequence[float],
    until: float,
    first: float = 0.0,
    shortest: float = math.inf,
) -> list[float]:
    """Return the times from `first` to `until` at which a function passes one of some levels.

    Parameters
    ----------
    over : callable
        Values of the function at many times [s].
    line : tuple of float or None
        Value at 0 and slope if the function is a straight line.
    levels : sequence of float
        Levels to pass.
    until, first : float
        End and begin [s].
    shortest : float
        Largest distance of samples [s], as far as their number allows.

    Raises
    ------
    InputError
        If it passes them too often, or too often to separate the times.
    """
    if line is not None or not levels:
        value, slope = line or (0.0, 0.0)
        return [t for level in levels if slope and first <= (t := (level - value) / slope) <= until]
    before, span, sorted_levels = -1, until - first, np.sort(np.asarray(levels, dtype=np.float64))
    count = max(_FIRST, math.ceil(min(span / shortest, 0.5 * _MOST)))
    often = "a formula that changes sides more often"
    while count <= _MOST:
        # at random in equal parts, to detect changes faster than the sampling at any frequency
        anywhere = np.random.default_rng(count).random(count)
        times = np.concatenate([[first], first + span * (np.arange(count) + anywhere) / count, [until]])
        samples = over(times)
        below = _below(sorted_levels, samples)
        passes, of_passes = _counted(below[:-1], below[1:])
        if len(passes) > MOST_PIECES:
            raise InputError("inputs", f"at most {MOST_PIECES} jumps", often)
        turns, sign = _turns(samples, below, len(levels))
        beyond, finite, passed = sorted_levels[below[turns] - (sign > 0.0)], samples[np.isfinite(samples)], -1
        near = np.abs(beyond - samples[turns]) < (float(np.ptp(finite)) if len(finite) else 0.0)
        if _LOOKS * (len(passes) + np.count_nonzero(near)) <= count:
            # turning points may pass a level twice
            begin, end = times[np.maximum(turns - 1, 0)], times[np.minimum(turns + 1, len(times) - 1)]
            middle = _lowest(over, sign, begin, end)
            twice, of_twice = _counted(below[turns], _below(sorted_levels, over(middle)))
            low = np.concatenate([times[passes], begin[twice], middle[twice]])
            high = np.concatenate([times[passes + 1], middle[twice], end[twice]])
            passed = len(low)
            if passed == before:
                at = sorted_levels[np.concatenate([of_passes, of_twice, of_twice])]
                return [float(x) for x in _bisected(over, low, high, at)]
        count, before = 2 * count, passed
    raise InputError("inputs", f"at most {MOST_PIECES} jumps", f"{often} than can be distinguished")


def _below(levels: Array, samples: Array) -> Integers:
    """Return the number of levels below each value, 0 for undefined values."""
    return np.searchsorted(levels, np.where(np.isnan(samples), -math.inf, samples))


def _turns(samples: Array, below: Integers, levels: int) -> tuple[Integers, Array]:
    """Return samples beyond which a level may be passed for a moment, and the sign that makes them smallest.

    They are local extrema; of a plateau, only its ends.
    """
    padded = np.concatenate([[np.nan], samples, [np.nan]])
    before, after = padded[:-2], padded[2:]
    lower, higher = np.fmin(before, after), np.fmax(before, after)
    ends = np.isnan(before) | np.isnan(after)
    top = (samples >= higher) & (ends | (samples > lower)) & (below < levels)
    bottom = (samples <= lower) & (ends | (samples < higher)) & (below > 0)
    return np.flatnonzero(top | bottom), np.where(top, -1.0, 1.0)[top | bottom]


def _counted(a: Integers, b: Integers) -> tuple[Integers, Integers]:
    """Return all numbers from the smaller to the larger of two (exclusive), with the index of the pair of each."""
    least, count = np.minimum(a, b), np.abs(a - b)
    pairs = np.repeat(np.arange(len(a)), count)
    return pairs, np.arange(len(pairs)) - np.repeat(np.cumsum(count) - count - least, count)


def _bisected(over: Over, low: Array, high: Array, levels: Array) -> Array:
    """Return the first times, to rounding, at which a function is on the same side of a level as at `high`."""
    side, rounding = over(high) > levels, np.finfo(np.float64).eps * np.max(np.abs(high), initial=0.0)
    while True:
        middle = 0.5 * (low + high)
        inside = (low < middle) & (middle < high) & (high - low > rounding)
        if not inside.any():
            return high
        same = (over(middle) > levels) == side
        low, high = np.where(inside & ~same, middle, low), np.where(inside & same, middle, high)


def _lowest(over: Over, sign: Array, low: Array, high: Array) -> Array:
    """Return the minimiser of a function times a sign, by golden sections."""
    for _ in range(60 if len(low) else 0):
        a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        left = sign * over(a) < sign * over(b)
        low, high = np.where(left, low, a), np.where(left, b, high)
    return 0.5 * (low + high)


def line_of(jump: Jump, values: Mapping[str, float]) -> tuple[float, float] | None:
    """Return value at 0 and slope of a jump's argument if it is a straight line over time, else None."""
    parts = line_parts(jump.argument)
    try:
        return None if parts is None else (evaluate(parts[0], values), evaluate(parts[1], values))
    except InputError:
        return None


def line_parts(e: Expr) -> tuple[Expr, Expr] | None:
    """Return the formulas of the value at 0 and of the slope of a straight line over time; None for another formula."""
    if isinstance(e, Name) and e.name == "t":
        return ZERO, ONE
    if "t" not in set(names_in_expression(e)):
        return e, ZERO
    assert isinstance(e, Call), "a name or a number has no other names in it"
    parts = [line_parts(a) for a in e.arguments]
    if any(part is None for part in parts) or e.function not in ("add", "sub", "neg", "mul", "div"):
        return None
    (a, m), *others = [part for part in parts if part is not None]
    if e.function == "neg":
        return call("neg", a), call("neg", m)
    ((b, n),) = others
    if e.function in ("add", "sub"):
        return _sum(e.function, a, b), _sum(e.function, m, n)
    if e.function == "div":
        return (call("div", a, b), call("div", m, b)) if n == ZERO else None
    if ZERO not in (m, n):
        return None
    return call("mul", a, b), call("mul", a, n) if m == ZERO else call("mul", m, b)


def _sum(function: str, a: Expr, b: Expr) -> Expr:
    if b == ZERO:
        return a
    return call(function, a, b) if a != ZERO else b if function == "add" else call("neg", b)
