"""Axes of varied values, for parameters and starts, and the grid that they span.

Text such as ``lin(1, 3, 21)`` is read by a parser of its own that knows four words and numbers; nothing is evaluated.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symgen.base.arguments import kind_of_value
from symgen.base.errors import InputError, quote, suggest
from symgen.base.memory import require_memory
from symgen.base.units import read_amount

Array = NDArray[np.float64]

#: An ensemble has at most so many runs.
MOST_RUNS = 1_000_000_000
#: What a run takes at least [bytes]: its summary, status and reason.
RUN_SIZE = 400.0
_SHAPE = re.compile(r"\s*([A-Za-z]+)\s*\(([^()]*)\)\s*")
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")


@dataclass(frozen=True)
class Axis:
    """One dimension of the grid: names that vary together, each with a value for every index.

    Attributes
    ----------
    dimension : str
        Name of the dimension.
    values : mapping of str to Array, shape (n,)
        Values of each name.
    together : bool
        Whether it is the dimension ``run`` of names that vary together.
    """

    dimension: str
    values: Mapping[str, Array]
    together: bool = False

    def __len__(self) -> int:
        return len(next(iter(self.values.values())))


@dataclass(frozen=True)
class Grid:
    """All combinations of the axes' indices; the last axis changes fastest."""

    axes: tuple[Axis, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values along each axis."""
        return tuple(len(axis) for axis in self.axes)

    @property
    def names(self) -> tuple[str, ...]:
        """All names that vary."""
        return tuple(name for axis in self.axes for name in axis.values)

    def __len__(self) -> int:
        return math.prod(self.shape)

    def values(self, first: int, last: int) -> dict[str, Array]:
        """Return the value of every name in the runs from `first` to `last`, shape (last - first,) each."""
        indices = np.unravel_index(np.arange(first, last), self.shape)
        columns: dict[str, Array] = {}
        for axis, index in zip(self.axes, indices, strict=True):
            for name, values in axis.values.items():
                columns[name] = values[index]
        return columns


# -- from what people write --------------------------------------------------------------------------------------------


def equidistant_values(first: float, last: float, count: int) -> Array:
    """Return `count` equidistant values from `first` to `last`, both included."""
    return np.linspace(first, last, _check_count("lin", count))


def logarithmic_values(first: float, last: float, count: int) -> Array:
    """Return `count` values from `first` to `last`, both above 0, each the same factor above the one before."""
    if not (first > 0.0 and last > 0.0):
        raise InputError("log", "two ends above 0", f"{first:g} and {last:g}")
    values = np.exp(np.linspace(math.log(first), math.log(last), _check_count("log", count)))
    values[0], values[-1] = first, last if len(values) > 1 else first
    return np.asarray(values)


def listed_values(*numbers: float) -> Array:
    """Return the numbers as listed."""
    return np.array(numbers, dtype=np.float64)


def uniform_values(lowest: float, highest: float, count: int, seed: int) -> Array:
    """Return `count` values drawn independently and evenly between two ends by NumPy's PCG64 with this `seed`."""
    if not lowest < highest:
        raise InputError("uniform", "a first end below the second", f"{lowest:g} and {highest:g}")
    if not (float(seed).is_integer() and 0 <= seed < 2**63):
        raise InputError("uniform", "a whole number from 0 on as its seed", f"{seed:g}")
    return np.random.default_rng(int(seed)).uniform(lowest, highest, _check_count("uniform", count))


def _check_count(where: str, count: float) -> int:
    if not (float(count).is_integer() and 1 <= count <= MOST_RUNS):
        raise InputError(where, f"a whole number of values from 1 to {MOST_RUNS:g}", f"{count:g}")
    require_memory(where, f"{count:g} values", 24.0 * count)  # as they are made
    return int(count)


#: Words of NumPy, MATLAB and statistics -> the axis.
_MEANT = {
    **dict.fromkeys(("linspace", "range", "arange", "linear"), "lin"),
    **dict.fromkeys(("logspace", "geomspace", "geom"), "log"),
    **dict.fromkeys(("list", "choice", "value", "set"), "values"),
    **dict.fromkeys(("random", "rand", "unif"), "uniform"),
}
#: Word -> (what builds the values, number of arguments or None for any, how it is written).
_WORDS: Mapping[str, tuple[Callable[..., Array], int | None, str]] = {
    "lin": (equidistant_values, 3, "lin(first, last, count)"),
    "log": (logarithmic_values, 3, "log(first, last, count)"),
    "values": (listed_values, None, "values(a, b, ...)"),
    "uniform": (uniform_values, 4, "uniform(lowest, highest, count, seed)"),
}


#: Words whose last arguments are a number of values, and a seed.
_COUNTS = {"lin": 1, "log": 1, "uniform": 2}


def axis_values(text: str, where: str, units: tuple[str, str] = ("", "")) -> Array:
    """Return the values that a text such as ``lin(1, 3, 21)`` stands for, in SI units.

    Parameters
    ----------
    text : str
        ``lin(a, b, n)``, ``log(a, b, n)``, ``values(a, b, ...)`` or ``uniform(a, b, n, seed)``; values may have units.
    where : str
        For the message.
    units : (str, str), optional
        SI unit of the quantity, empty if it is not known, and the unit of numbers without one.

    Raises
    ------
    InputError
        If it is anything else.
    """
    word, numbers = _read_axis_text(text, where, units)
    build, _, form = _WORDS[word]
    try:
        return build(*numbers)
    except InputError as error:
        raise InputError(where, f"{form} with {error.expected}", error.got) from None


def check_axis(text: str, where: str) -> None:
    """Refuse a text that no quantity can have as its values; arguments as of `axis_values`.

    Ends with units are compared later, when the unit of the others is known.
    """
    amounts = map(read_amount, re.split("[(,)]", text))
    if any(amount is not None and amount.unit for amount in amounts):
        _read_axis_text(text, where, ("", ""))
    else:
        axis_values(text, where)


def meant_axis(text: str) -> str:
    """Return the hint on numbers without a word before them or with other signs between them, else nothing."""
    word, opened, inside = text.partition("(")
    if opened and word.strip() in _WORDS:
        parts = [part.strip() for part in inside.rstrip(") ").split(";")]
        return f"did you mean {word.strip()}({', '.join(parts)})?" if len(parts) > 1 else ""
    parts = [part.strip() for part in re.split(r"\.\.+|[,:;]", text.strip("[]()"))]
    if not all(re.fullmatch(r"[-+.\d][-+.\deE]*", part) for part in parts):
        return ""
    if ":" not in text and ".." not in text:
        return f"did you mean values({', '.join(parts)})?"
    try:
        first, last = float(parts[0]), float(parts[-1])
        steps = 10.0 if len(parts) == 2 else (last - first) / float(parts[1])  # as in MATLAB
    except (ValueError, ZeroDivisionError):
        return ""
    if len(parts) > 3 or not 0.5 < steps < 1e6:
        return ""
    whole = abs(steps - round(steps)) < 1e-9 * steps
    return f"did you mean lin({f'{parts[0]}, {parts[-1]}, {round(steps) + 1}' if whole else ', '.join(parts)})?"


def _read_axis_text(text: str, where: str, units: tuple[str, str]) -> tuple[str, list[float]]:
    """Return the word of a text, and its numbers in SI units."""
    expected = "lin(a, b, n), log(a, b, n), values(a, b, ...) or uniform(a, b, n, seed)"
    match = _SHAPE.fullmatch(text) if len(text) <= 1_000_000 else None
    if match is None:
        raise InputError(where, expected, quote(text.strip()), meant_axis(text.strip()))
    word = match[1]
    if word not in _WORDS:
        meant = _MEANT.get(word.lower(), "")
        raise InputError(where, expected, quote(word), f"did you mean '{meant}'?" if meant else suggest(word, _WORDS))
    _, arity, form = _WORDS[word]
    if ";" in match[2]:
        raise InputError(where, form, quote(text.strip()), meant_axis(text.strip()))
    parts = match[2].split(",")
    last = len(parts) - _COUNTS.get(word, 0)
    numbers = [
        _value_in_si(part, where, units) if i < last else _finite_number(part, where) for i, part in enumerate(parts)
    ]
    if arity is not None and len(numbers) != arity:
        raise InputError(where, form, f"{len(numbers)} numbers")
    return word, numbers


def _value_in_si(text: str, where: str, units: tuple[str, str]) -> float:
    """Return a number that may have a unit in SI units."""
    amount = read_amount(text)
    if amount is None or not math.isfinite(amount.number):
        return _finite_number(text, where)
    return amount.in_si(where, *units)


def _finite_number(text: str, where: str) -> float:
    if _NUMBER.fullmatch(text.strip()) is None or not math.isfinite(number := float(text)):
        raise InputError(where, "finite numbers between the brackets", quote(text.strip()))
    return number


def make_grid(
    vary: Mapping[str, ArrayLike | str],
    runs: Mapping[str, ArrayLike | str],
    starts: Sequence[str] = (),
    units: Callable[[str], tuple[str, str]] = lambda name: ("", ""),
) -> Grid:
    """Return the grid of every combination of `vary`, times the runs whose values are listed together.

    Parameters
    ----------
    vary : mapping
        Name -> values, or the text of them; each name is a dimension.
    runs : mapping
        Name -> values of one length: the dimension ``run``.
    starts : sequence of str
        Names of coordinates and velocities; their dimensions are called ``crank.theta(0)``.
    units : callable
        Of a name, the SI unit of the quantity and the unit of numbers in texts; numbers in arrays are in SI units.

    Raises
    ------
    InputError
        If values are not finite numbers, lengths differ, or nothing varies.
    """
    axes = []
    if runs:
        together = {name: _values_of_axis(name, written, units(name)) for name, written in runs.items()}
        lengths = {name: len(written) for name, written in together.items()}
        if len(set(lengths.values())) > 1:
            sizes = ", ".join(f"{length} for {name}" for name, length in lengths.items())
            raise InputError("runs", "as many values for every name", sizes)
        axes.append(Axis("run", together, together=True))
    for name, written in vary.items():
        if name in runs:
            raise InputError(name, "one way of varying it", "two")
        axes.append(Axis(f"{name}(0)" if name in starts else name, {name: _values_of_axis(name, written, units(name))}))
    if not axes:
        raise InputError("sweep", "something that varies", "nothing")
    grid = Grid(tuple(axes))
    if len(grid) > MOST_RUNS:
        raise InputError("sweep", f"at most {MOST_RUNS:g} runs", f"{len(grid):g}")
    require_memory("sweep", f"{len(grid):g} runs", RUN_SIZE * len(grid))
    return grid


def _values_of_axis(name: str, written: ArrayLike | str, units: tuple[str, str]) -> Array:
    if isinstance(written, str):
        return axis_values(written, name, units)
    try:
        plain = np.asarray(written)
        if plain.dtype.kind in "bc":
            raise TypeError("truth values and complex numbers are no values")
        numbers = np.array(plain, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(name, "numbers", kind_of_value(written)) from None
    if numbers.ndim != 1 or len(numbers) == 0:
        raise InputError(name, "a list of at least one number", f"an array of shape {numbers.shape}")
    if not np.all(np.isfinite(numbers)):
        raise InputError(name, "finite numbers", "others")
    return numbers
