"""Data of inputs: samples from a CSV file or from Python, checked, in SI units."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from symgen.base import arguments
from symgen.base.errors import InputError, quote, suggest
from symgen.base.files import check_csv_rows, system_message
from symgen.base.units import SI, Unit, unit_of
from symgen.describe.table_functions import Table

INTERPOLATIONS = ("hold", "linear", "cubic", "pchip")
#: Maximum bytes of a data file.
LARGEST_FILE = 50_000_000
_FILE = re.compile(r"(?P<file>.+\.csv):(?P<column>[^:]+)(?::(?P<how>[^:]*))?", re.IGNORECASE)
_WORDS = re.compile(rf".* \(({'|'.join(INTERPOLATIONS)})\)", re.DOTALL)
_HEADING = re.compile(r"\s*(?P<name>.*?)\s*(?:\[(?P<unit>[^\]]*)\]\s*)?")


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
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:
        raise InputError(f"{where}: {file}", "a file that can be read", system_message(error)) from None
    if len(content) > LARGEST_FILE:
        raise InputError(f"{where}: {path.name}", f"a file of at most {LARGEST_FILE} bytes", "a larger one")
    try:
        rows = [row for row in csv.reader(content.decode("utf-8-sig").splitlines()) if any(map(str.strip, row))]
    except (UnicodeDecodeError, csv.Error):
        raise InputError(f"{where}: {path.name}", "a CSV file in UTF-8", "something else") from None
    matches = [_HEADING.fullmatch(cell) for cell in rows[0]] if rows else []
    headings = [match["name"] if match else cell for match, cell in zip(matches, rows[0] if rows else (), strict=True)]
    if column not in headings:
        raise InputError(f"{where}: {path.name}", "a column of the file", quote(column), suggest(column, headings))
    check_csv_rows(f"{where}: {path.name}", headings, rows[1:])
    times = next((headings.index(name) for name in ("t", "time") if name in headings), 0)
    place = headings.index(column)
    if place == times:
        raise InputError(f"{where}: {path.name}", "a column beside that of the times", quote(column))
    t, u = (
        [_number_of_cell(f"{where}: {path.name}", row, i, k) for k, row in enumerate(rows[1:], 2)]
        for i in (times, place)
    )
    units = [(m["unit"] or "").strip() if (m := matches[i]) else "" for i in (times, place)]
    of_time = unit_of(units[0], f"{where}: {path.name}", quantity="s") if units[0] else SI
    own = unit_of(units[1], f"{where}: {path.name}", quantity=unit.si) if units[1] and unit.si else unit
    return _checked_data(where, [*map(of_time.to_si, t)], [*map(own.to_si, u)], how, f"{file}:{column}")


def _number_of_cell(where: str, row: list[str], index: int, line: int) -> float:
    text = row[index] if index < len(row) else ""
    try:
        return float(text)
    except ValueError:
        raise InputError(where, "a number in every row", f"{quote(text)} in row {line}") from None


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
