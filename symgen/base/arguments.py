"""Checks of the arguments of public functions; errors are one sentence."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from symgen.base.errors import InputError, quote, suggest
from symgen.base.units import si_hint

T = TypeVar("T")


def kind_of_value(value: object) -> str:
    """Return a description of an argument, in words short enough for a message."""
    if value is None or isinstance(value, bool):
        return str(value)
    if isinstance(value, str):
        return quote(value)
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and shape:
        return f"an array of shape {shape}"
    if isinstance(value, int | float | complex | bytes) or hasattr(value, "dtype"):
        return quote(value)[1:-1]
    if isinstance(value, Mapping | list | tuple | set | frozenset):
        return f"a {type(value).__name__} of {len(value)}"
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if callable(value) and hasattr(value, "__name__"):
        return f"the function {value.__name__}"
    return f"a {type(value).__name__}"


def number(where: str, value: object, *, positive: bool = False) -> float:
    """Return a finite number, of Python or NumPy; texts, truth values and arrays are none.

    Parameters
    ----------
    where : str
        The argument, for the message.
    value : object
        The value.
    positive : bool
        Whether it must be above 0.

    Raises
    ------
    InputError
        If it is anything else.
    """
    plain = not (isinstance(value, str | bytes) or is_truth_value(value) or bool(getattr(value, "shape", ())))
    try:
        result = float(value) if plain else math.nan  # type: ignore[arg-type]  # anything else raises
    except (TypeError, ValueError, OverflowError):
        result = math.nan
    if not math.isfinite(result) or (positive and not result > 0.0):
        expected = "a finite number above 0" if positive else "a finite number"
        raise InputError(where, expected, kind_of_value(value), si_hint(value))
    return result


def whole_number(where: str, value: object, least: int, most: int) -> int:
    """Return a whole number between two bounds; 3.0 is one."""
    try:
        result = number(where, value)
    except InputError:
        result = math.nan
    if not (result.is_integer() and least <= result <= most):
        raise InputError(where, f"a whole number from {least} to {most}", kind_of_value(value))
    return int(result)


def is_truth_value(value: object) -> bool:
    """Whether a value is True or False, of Python or NumPy."""
    return isinstance(value, bool) or type(value).__name__ in ("bool_", "bool")


def truth_value(where: str, value: object) -> bool:
    """Return True or False."""
    if not is_truth_value(value):
        raise InputError(where, "True or False", kind_of_value(value))
    return bool(value)


def text(where: str, value: object, expected: str = "a text") -> str:
    """Return a text."""
    if not isinstance(value, str):
        raise InputError(where, expected, kind_of_value(value))
    return value


def one_word_of(where: str, value: object, candidates: Iterable[str], meant: Mapping[str, str] | None = None) -> str:
    """Return one of some words; `meant` leads from words of others to them."""
    words = list(candidates)
    expected = f"one of {', '.join(words)}"
    if text(where, value, expected) not in words:
        word = (meant or {}).get(str(value).lower(), "")
        raise InputError(
            where, expected, kind_of_value(value), f"did you mean '{word}'?" if word else suggest(str(value), words)
        )
    return str(value)


def mapping(where: str, value: object, expected: str) -> dict[str, Any]:
    """Return a mapping whose keys are texts as a dictionary; None is an empty one."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise InputError(where, expected, kind_of_value(value))
    return {text(where, key, f"{expected}, named by texts"): item for key, item in value.items()}


def list_entries(where: str, value: object, expected: str) -> list[Any]:
    """Return the entries of a list, a tuple or an array of one dimension; None is an empty one."""
    if value is None:
        return []
    shape = getattr(value, "shape", (0,))
    if isinstance(value, str | bytes | Mapping) or not isinstance(value, Iterable) or len(shape) != 1:
        raise InputError(where, expected, kind_of_value(value))
    return [*value]


def numbers(where: str, value: object, *, positive: bool = False) -> tuple[float, ...]:
    """Return a list of finite numbers; a single one is a list of one."""
    what = "a list of finite numbers above 0" if positive else "a list of finite numbers"
    single = not isinstance(value, Iterable) and value is not None
    return tuple(
        number(where, item, positive=positive) for item in ([value] if single else list_entries(where, value, what))
    )


def words(where: str, value: object) -> tuple[str, ...]:
    """Return a list of texts; a single one is a list of one."""
    what = "a list of names"
    return tuple(
        text(where, x, what) for x in ([value] if isinstance(value, str) else list_entries(where, value, what))
    )


def path_argument(where: str, value: object) -> Path:
    """Return a path."""
    if not isinstance(value, str | os.PathLike) or not isinstance(os.fspath(value), str):
        raise InputError(where, "a path", kind_of_value(value))
    return Path(value)


def toml_file(where: str, file: Path) -> Path:
    """Return a file that ends in ``.toml``."""
    if file.suffix.lower() != ".toml":
        raise InputError(where, "a file ending in .toml", quote(str(file)))
    return file


def instance(where: str, value: object, kind: type[T], expected: str) -> T:
    """Return an object of a class."""
    if not isinstance(value, kind):
        raise InputError(where, expected, kind_of_value(value))
    return value


def callable_or_none(where: str, value: T) -> T:
    """Return a function, or None."""
    if value is not None and not callable(value):
        raise InputError(where, "a function", kind_of_value(value))
    return value
