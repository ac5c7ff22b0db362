"""Words of the command line turned into values, each refused with a sentence before anything is done."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from symgen.errors import InputError


def _pair(option: str, text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals or not name.strip() or not value.strip():
        raise InputError(option, "NAME=VALUE", f"'{text[:60]}'")
    return name.strip(), value.strip()


def assignments(option: str, texts: Sequence[str]) -> dict[str, float]:
    """Return the numbers of ``NAME=VALUE`` words by name.

    Raises
    ------
    InputError
        If a word has another form or a value is not a finite number.
    """
    values = {}
    for text in texts:
        name, value = _pair(option, text)
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise InputError(f"{option} {name}", "a finite number", f"'{value[:60]}'")
        values[name] = number
    return values


def option_pairs(texts: Sequence[str]) -> dict[str, str | float]:
    """Return the values of ``KEY=VALUE`` words by key, not yet interpreted."""
    return dict(_pair("--option", text) for text in texts)


def numbers(**values: float | None) -> None:
    """Refuse numbers that are not finite and above 0; None is none given."""
    for name, value in values.items():
        if value is not None and not (math.isfinite(value) and value > 0.0):
            raise InputError(f"--{name.replace('_', '-')}", "a finite number above 0", f"{value:g}")


def words(option: str, text: str | None) -> tuple[str, ...]:
    """Return the words of a comma-separated list, empty where none is given."""
    if text is None:
        return ()
    found = tuple(part.strip() for part in text.split(","))
    if not all(found):
        raise InputError(option, "words separated by commas", f"'{text[:60]}'")
    return found


def number_list(option: str, text: str | None) -> tuple[float, ...]:
    """Return the numbers of a comma-separated list, each finite and above 0."""
    values = []
    for word in words(option, text):
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and value > 0.0):
            raise InputError(option, "finite numbers above 0, separated by commas", f"'{word[:60]}'")
        values.append(value)
    return tuple(values)


def output_file(option: str, text: str | None, kind: str = "") -> Path | None:
    """Return where a file will be written, after making sure that it can be.

    Parameters
    ----------
    option, text : str
        The option and its value; None gives None.
    kind : str
        ``"data"``, ``"plot"``, or nothing for any ending.

    Raises
    ------
    InputError
        If the ending is not known, the library for it is missing, or the folder cannot be written.
    """
    if text is None:
        return None
    from symgen.result.export import PLOTTED, SAVED, check_path, check_writable

    path = Path(text)
    if kind:
        check_path(option, path, SAVED if kind == "data" else PLOTTED, kind)
    else:
        check_writable(option, path)
    return path
