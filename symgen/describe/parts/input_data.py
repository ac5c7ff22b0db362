"""Data of inputs: samples from a CSV file or from Python, checked, in SI units."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from symgen.base import arguments
from symgen.base.csv_tables import numbers_in_unit, read_csv_table
from symgen.base.errors import InputError, quote, suggest
from symgen.base.units import SI, Unit
from symgen.describe.table_functions import Table

INTERPOLATIONS = ("hold", "linear", "cubic", "pchip")
_FILE = re.compile(r"(?P<file>.+\.csv):(?P<column>[^:]+)(?::(?P<how>[^:]*))?", re.IGNORECASE)
_WORDS = re.compile(rf".* \(({'|'.join(INTERPOLATIONS)})\)", re.DOTALL)


@dataclass(frozen=True)
class Data:
    """Samples of an input.

    Attributes
    ----------
    t, u : tuple of float
        Times, increasing [s], and values.
    interpolation : str
        ``hold``: each value until the next one; else see `symgen.describe.table_functions.Table`.
    words : str
        Description for people.
    """

    t: tuple[float, ...]
    u: tuple[float, ...]
    interpolation: str
    words: str

    def as_table(self, where: str, name: str) -> Table:
        """Return the data as a table of t."""
        if self.interpolation == "cubic" and len(self.t) < 4:
            raise InputError(where, "four samples or more for interpolation 'cubic'", f"{len(self.t)}")
        return Table(name, self.t, self.u, self.interpolation)

    def at(self, time: float) -> float:
        """Return the sample that is held at a time."""
        from bisect import bisect_right

        return self.u[max(0, bisect_right(self.t, time) - 1)]


def read_data(where: str, value: object, unit: Unit = SI) -> Data | None:
    """Return the data of an input in SI units, None where it is a number or a formula.

    Parameters
    ----------
    where : str
        The input, for the message.
    unit : Unit
        Unit of a column of a file whose heading has none; times and values of Python are in SI units.
    value : object
        ``"FILE.csv:COLUMN"`` or ``"FILE.csv:COLUMN:INTERPOLATION"``; a pair of times and values; or a mapping with the
        keys ``t`` and ``u``, or ``file`` and ``column``, and with ``interpolation``, which is linear by default.

    Raises
    ------
    InputError
        If the data are missing or invalid.
    """
    if isinstance(value, str):
        match = _FILE.fullmatch(value.strip())
        return (
            None
            if match is None
            else _read_file_column(where, match["file"], match["column"].strip(), match["how"], unit)
        )
    if isinstance(value, Mapping):
        return _data_of_mapping(where, value, unit)
    if isinstance(value, list | tuple) or len(getattr(value, "shape", "")) > 0:
        pair = [*value]  # type: ignore[misc]  # an array of dimensions can be walked through
        if len(pair) != 2:
            raise InputError(where, "a pair of times and values", arguments.kind_of_value(value))
        return _checked_data(where, pair[0], pair[1], "linear", "")
    return None


def _data_of_mapping(where: str, value: Mapping[Any, Any], unit: Unit) -> Data:
    keys = ("t", "u", "file", "column", "interpolation")
    entries = arguments.mapping(where, value, "t and u, or file and column, and interpolation")
    for key in entries:
        if key not in keys:
            raise InputError(where, f"the keys {', '.join(keys)}", f"the unknown key {quote(key)}", suggest(key, keys))
    how = arguments.one_word_of(f"{where} interpolation", entries.get("interpolation", "linear"), INTERPOLATIONS)
    pairs = [pair for pair in (("t", "u"), ("file", "column")) if any(key in entries for key in pair)]
    if len(pairs) != 1 or not all(key in entries for key in pairs[0]):
        raise InputError(where, "either t and u or file and column", ", ".join(entries) or "no keys")
    if "t" in entries:
        return _checked_data(where, entries["t"], entries["u"], how, "")
    file = arguments.path_argument(f"{where} file", entries["file"])
    return _read_file_column(where, str(file), arguments.text(f"{where} column", entries["column"]), how, unit)


def _read_file_column(where: str, file: str, column: str, how: str | None, unit: Unit) -> Data:
    """Return a column of a file, over its column ``t`` or ``time``, or its first one, in SI units."""
    how = arguments.one_word_of(f"{where} interpolation", how or "linear", INTERPOLATIONS)
    path = Path(file)
    table = read_csv_table(f"{where}: {path.name}", path)
    place, times = table.place(column), table.place_of_times() or 0
    if place == times:
        raise InputError(table.where, "a column beside that of the times", quote(column))
    t, u = table.numbers_in_unit(times, "s"), table.numbers(place)
    if table.units[place]:
        u = numbers_in_unit(f"{table.where}: {column}", u, table.units[place], unit.si)
    else:
        u = [*map(unit.to_si, u)]
    return _checked_data(where, t, u, how, f"{file}:{column}")


def _checked_data(where: str, t: object, u: object, how: str, source: str) -> Data:
    times, values = arguments.numbers(f"{where} times", t), arguments.numbers(f"{where} values", u)
    if len(times) != len(values):
        raise InputError(where, "as many values as times", f"{len(values)} for {len(times)}")
    if len(times) < 2:
        raise InputError(where, "two samples or more", f"{len(times)}")
    for before, after in pairwise(times):
        if not before < after:
            raise InputError(f"{where} times", "increasing times", f"{after!r} after {before!r}")
    return Data(times, values, how, f"{source or f'{len(times)} samples'} ({how})")


def are_words_of_data(text: str | float) -> bool:
    """Return whether the description of an input names data rather than a formula."""
    return isinstance(text, str) and _WORDS.fullmatch(text) is not None
