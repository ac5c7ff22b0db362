"""Where smooth formulas of the time pass pulses and steps that are short beside the times at which they rest.

What is far shorter than a step lies between two of its evaluations, however smooth it is, and samples at any finite
number of times may miss it as well. Bounds of a formula over an interval of time do not: intervals over which it may
change are halved until it changes by no more than a part of its range over any of them. Such intervals are as long as
it rests, and as short as its pulses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.describe.tables import Table
from symgen.runtime.columns import Columns
from symgen.vocabulary.expressions import Expr, Name, Number, Reading, table_of

Array = NDArray[np.float64]
#: Least and largest values over intervals of the time; a number and itself where nothing changes.
Bounds = tuple[Any, Any]

#: Over an interval a formula changes by this part of its range at most.
_PART = 0.25
#: Intervals are short below this part of the longest one: those of a sine differ by a factor of 4, and by up to 16 as
#: they are halved.
_SHORT = 1.0 / 32.0
#: Intervals that may change at once, and the least length of one, as a part of the run.
_MOST, _LEAST = 2**15, 1e-11
#: What is too fast is looked at in so many windows, each of this part of the run.
_ASKED, _WINDOW = 8, 2.0**-13
#: Changes below this part of the values are rounding.
_ROUNDING = 1e-12
#: Looks into a table between two values of its argument.
_LOOKS = 9


class TooFast(Exception):
    """A formula changes too often, or too fast, to be followed."""


class Bounded:
    """Bounds of formulas of parameters and t over intervals of the time.

    Parameters
    ----------
    tables : mapping of str to Table
        That they may read.
    values : mapping of str to float
        Of the parameters.
    """

    def __init__(self, tables: Mapping[str, Table], values: Mapping[str, float]) -> None:
        self._values, self._columns = values, Columns({}, tables)

    def pulses(self, e: Expr, until: float, first: float = 0.0) -> list[list[float]]:
        """Return the times at which each pulse or step of a formula begins, changes and ends.

        Parameters
        ----------
        e : expression
            The formula.
        until, first : float
            End and begin of the run [s].

        Raises
        ------
        TooFast
            If they cannot be told apart.
        """
        try:
            return self._told_apart(e, first, until)
        except TooFast:  # what is as fast everywhere hides nothing
            for begin in np.linspace(first, until, _ASKED, endpoint=False).tolist():
                if self._told_apart(e, begin, begin + _WINDOW * (until - first)):
                    raise
            return []

    def _told_apart(self, e: Expr, first: float, until: float) -> list[list[float]]:
        span = until - first
        bounds, begin, end = self._divided(e, np.array([first]), np.array([until]), _LEAST * span)
        joined = _joined(begin, end, bounds)
        short = _SHORT * max((b - a for a, b in joined), default=0.0)
        found, last = list[list[float]](), -math.inf
        for a, b in joined:
            if _LEAST * span < b - a < short:
                found += [[a, b]] if a > last or not found else []
                if found[-1][-1] != b:
                    found[-1].append(b)
                last = b
        return found

    def _divided(self, e: Expr, begin: Array, end: Array, least: float) -> tuple[Bounds, Array, Array]:
        """Return intervals, and bounds of a formula over each that differ by no more than a part of its range."""
        low, high = self.over(e, begin, end)
        while True:
            finite = np.isfinite(low) & np.isfinite(high)
            extent = np.ptp([low[finite].min(), high[finite].max()]) if finite.any() else 0.0
            with np.errstate(invalid="ignore"):
                much = np.maximum(_PART * extent, _ROUNDING * np.maximum(np.abs(low), np.abs(high)))
                wide = (high - low > much) | np.isinf(low)
            wide &= end - begin > least
            count = int(np.count_nonzero(wide))
            if count == 0:
                order = np.argsort(begin)
                return (low[order], high[order]), begin[order], end[order]
            if count > _MOST:
                raise TooFast
            middle = 0.5 * (begin[wide] + end[wide])
            fresh = np.concatenate([begin[wide], middle]), np.concatenate([middle, end[wide]])
            parts = zip((begin, end, low, high), (*fresh, *self.over(e, *fresh)), strict=True)
            begin, end, low, high = (np.concatenate([old[~wide], new]) for old, new in parts)

    def over(self, e: Expr, begin: Array, end: Array) -> tuple[Array, Array]:
        """Return bounds of a formula over intervals; nan where it is undefined all along, infinite where in part."""
        low, high = self._bounds(e, begin, end)
        return np.broadcast_to(low, begin.shape), np.broadcast_to(high, begin.shape)

    def _bounds(self, e: Expr, begin: Array, end: Array) -> Bounds:
        """Return bounds of a formula over intervals; nan where it is undefined all along, infinite where in part."""
        if isinstance(e, Number):
            return e.value, e.value
        if isinstance(e, Name | Reading):
            return (begin, end) if e.name == "t" else (self._values[e.name],) * 2
        arguments = [self._bounds(a, begin, end) for a in e.arguments]
        if all(low is high or not isinstance(low, np.ndarray) for low, high in arguments):
            value = self._columns.apply(e.function, *(low for low, _ in arguments))
            return value, value
        if e.function in ("sin", "cos"):
            return _waved(e.function, *arguments[0])
        # functions of one argument rise, fall, or turn round at 0; those of two do so in each
        looked: Any = product(*(_looks(*bounds, e.function) for bounds in arguments))
        if e.function in ("add", "sub"):
            first, second = arguments
            looked = zip(first, second if e.function == "add" else second[::-1], strict=True)
        values = np.array([np.broadcast_to(self._columns.apply(e.function, *x), begin.shape) for x in looked])
        undefined = np.isnan(values)
        if e.function == "tan":
            poles = [np.floor(x / math.pi + 0.5) for x in arguments[0]]
            undefined[0] |= poles[0] != poles[1]
        some, every = undefined.any(axis=0), undefined.all(axis=0)
        for x in (x for bounds in arguments for x in bounds):
            every &= ~np.isinf(x)
        low, high = np.fmin.reduce(values), np.fmax.reduce(values)
        low, high = np.where(some, -np.inf, low), np.where(some, np.inf, high)
        return np.where(every, np.nan, low), np.where(every, np.nan, high)


def _looks(low: Any, high: Any, function: str) -> list[Any]:
    """Return values of an argument between bounds at which a function has its least and its largest value."""
    if not isinstance(low, np.ndarray):
        return [low]
    if table_of(function):
        with np.errstate(invalid="ignore"):
            return [low + (high - low) * k / (_LOOKS - 1) for k in range(_LOOKS)]
    return [low, high, np.clip(0.0, low, high)]


def _waved(function: str, low: Array, high: Array) -> Bounds:
    """Return bounds of a sine or cosine."""
    unknown, top = ~np.isfinite(low) | ~np.isfinite(high), 0.25 if function == "sin" else 0.0
    with np.errstate(invalid="ignore"):
        ends, turns = getattr(np, function)([low, high]), (low / math.tau, high / math.tau)
        up, down = (np.floor(turns[1] - at) > np.floor(turns[0] - at) for at in (top, top + 0.5))
    return np.where(unknown | down, -1.0, np.fmin(*ends)), np.where(unknown | up, 1.0, np.fmax(*ends))


def _joined(begin: Array, end: Array, bounds: Bounds) -> list[tuple[float, float]]:
    """Return as few intervals as possible, from the first one on, over which a formula changes no more than that."""
    known = [bound[np.isfinite(bound)] for bound in bounds]
    part = _PART * float(known[1].max() - known[0].min()) if len(known[0]) and len(known[1]) else 0.0
    found, least, largest = list[tuple[float, float]](), math.nan, math.nan
    for a, b, low, high in zip(begin.tolist(), end.tolist(), *(bound.tolist() for bound in bounds), strict=True):
        lower, upper = min(least, low), max(largest, high)
        if found and (upper - lower <= part or (low != low and least != least)):
            found[-1] = found[-1][0], b
            least, largest = lower, upper
        else:
            found.append((a, b))
            least, largest = low, high
    return found
