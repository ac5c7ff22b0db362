"""Numbers that a search varies: their bounds, where it begins, and values as parts of their ranges."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Real

import numpy as np
from numpy.typing import NDArray

from symgen.base import arguments
from symgen.base.errors import InputError

Array = NDArray[np.float64]
#: Bounds of a number; None where it has none.
Bounds = tuple[float | None, float | None]


@dataclass(frozen=True)
class Ranges:
    """Ranges of the numbers that vary.

    Attributes
    ----------
    names : tuple of str
        As typed.
    low, high : Array, shape (n,)
        Bounds; infinite where there are none.
    start : Array, shape (n,)
        Where a search begins.
    """

    names: tuple[str, ...]
    low: Array
    high: Array
    start: Array

    def values(self, u: Array) -> Array:
        """Return values from parts of the ranges."""
        return np.asarray(np.clip(self.low + u * (self.high - self.low), self.low, self.high))

    def parts(self, x: Array) -> Array:
        """Return values as parts of the ranges, from 0 to 1."""
        return np.asarray(np.clip((x - self.low) / (self.high - self.low), 0.0, 1.0))


def read_bounds(where: str, free: object, closed: bool = False) -> dict[str, Bounds]:
    """Return names of numbers that vary, with their bounds, which a sequence of names leaves open.

    Parameters
    ----------
    where : str
        Argument that has them, for messages.
    free : object
        A mapping of names to pairs, or names.
    closed : bool
        Whether each number needs two finite bounds.

    Raises
    ------
    InputError
        If there are no names, or a bound is no number.
    """
    if closed:
        free = arguments.mapping(where, free, "bounds by the names of numbers, such as {'a': (0.2, 0.4)}")
    elif isinstance(free, str) or not isinstance(free, Mapping):
        free = dict.fromkeys(arguments.words(where, free), (None, None))
    if not free and not closed:
        raise InputError(where, "numbers to be found", "none")
    return {name: _read_pair(f"{where} '{name}'", pair, closed) for name, pair in free.items()}


def _read_pair(where: str, bounds: object, closed: bool) -> Bounds:
    expected = f"a lower and an upper bound, {'such as (0.2, 0.4)' if closed else 'each a number or None'}"
    pair = arguments.list_entries(where, bounds, expected) or ([] if closed else [None, None])
    if len(pair) != 2 or not all(isinstance(x, Real) or (x is None and not closed) for x in pair):
        raise InputError(where, expected, arguments.kind_of_value(bounds))
    low, high = (arguments.number(where, x) if closed else x for x in pair)
    return low, high


def make_ranges(where: str, bounds: Mapping[str, Bounds], start: Sequence[float] | Array, what: str) -> Ranges:
    """Return ranges of numbers from their bounds and their values at the start.

    Parameters
    ----------
    where : str
        Argument that has them, for messages.
    bounds : mapping of str to (float or None, float or None)
        Bounds by name.
    start : sequence of float
        Values in the same order.
    what : str
        What these values are, such as ``"the value of the file"``.

    Raises
    ------
    InputError
        If a lower bound is not below the upper one, or a value lies outside.
    """
    pairs = [(-math.inf if a is None else float(a), math.inf if b is None else float(b)) for a, b in bounds.values()]
    for name, (low, high), x in zip(bounds, pairs, start, strict=True):
        if not low < high:
            raise InputError(f"{where} '{name}'", "a lower bound below the upper one", f"{low:g} and {high:g}")
        if not low <= x <= high:
            expected = f"bounds that hold {what}, {x:g}"
            raise InputError(f"{where} '{name}'", expected, f"{low:g} and {high:g}")
    ends = np.array(pairs).reshape(-1, 2)
    return Ranges(tuple(bounds), ends[:, 0], ends[:, 1], np.asarray(start, dtype=np.float64))
