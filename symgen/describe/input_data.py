"""Data in place of an input: samples of a file or of arrays, and how values between them are found."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from symgen import arguments
from symgen.describe.tables import Table
from symgen.errors import InputError, nearest, quoted

INTERPOLATIONS = ("hold", "linear", "cubic", "pchip")
#: Bytes of a file of data.
LARGEST_FILE = 50_000_000
_FILE = re.compile(r"(?P<file>.+\.csv):(?P<column>[^:]+)(?::(?P<how>[^:]*))?", re.IGNORECASE)
_WORDS = re.compile(rf".* \(({'|'.join(INTERPOLATIONS)})\)", re.DOTALL)
_HEADING = re.compile(r"\s*(?P<name>.*?)\s*(?:\[[^\]]*\]\s*)?")


@dataclass(frozen=True)
class Data:
    """Samples of an input.

    Attributes
    ----------
    t, u : tuple of float
        Times, increasing [s], and values.
    interpolation : str
        ``hold``: each value until the next one; else see `symgen.describe.tables.Table`.
    words : str
        What it is, for people.
    """

    t: tuple[float, ...]
    u: tuple[float, ...]
    interpolation: str
    words: str

    def table(self, where: str, name: str) -> Table:
        """Return the data as a table of t."""
        if self.interpolation == "cubic" and len(self.t) < 4:
            raise InputError(where, "four samples or more for interpolation 'cubic'", f"{len(self.t)}")
        return Table(name, self.t, self.u, self.interpolation)

    def at(self, time: float) -> float:
        """Return the sample that is held at a time."""
        from bisect import bisect_right

        return self.u[max(0, bisect_right(self.t, time) - 1)]


def data_of(where: str, value: object) -> Data | None:
    """Return the data that are given for an input, None where it is a number or a formula.

    Parameters
    ----------
    where : str
        The input, for the message.
    value : object
        ``"FILE.csv:COLUMN"`` or ``"FILE.csv:COLUMN:INTERPOLATION"``; a pair of times and values; or a mapping with the
        keys ``t`` and ``u``, or ``file`` and ``column``, and with ``interpolation``, which is linear by default.

    Raises
    ------
    InputError
        If it means data that are not there or make no sense.
    """
    if isinstance(value, str):
        found = _FILE.fullmatch(value.strip())
        return None if found is None else _read(where, found["file"], found["column"].strip(), found["how"])
    if isinstance(value, Mapping):
        return _of_mapping(where, value)
    if isinstance(value, list | tuple) or len(getattr(value, "shape", "")) > 0:
        pair = [*value]  # type: ignore[misc]  # an array of dimensions can be walked through
        if len(pair) != 2:
            raise InputError(where, "a pair of times and values", arguments.shown(value))
        return _checked(where, pair[0], pair[1], "linear", "")
    return None


def _of_mapping(where: str, value: Mapping[Any, Any]) -> Data:
    keys = ("t", "u", "file", "column", "interpolation")
    given = arguments.mapping(where, value, "t and u, or file and column, and interpolation")
    for key in given:
        if key not in keys:
            raise InputError(where, f"the keys {', '.join(keys)}", f"the unknown key {quoted(key)}", nearest(key, keys))
    how = arguments.one_of(f"{where} interpolation", given.get("interpolation", "linear"), INTERPOLATIONS)
    pairs = [pair for pair in (("t", "u"), ("file", "column")) if any(key in given for key in pair)]
    if len(pairs) != 1 or not all(key in given for key in pairs[0]):
        raise InputError(where, "either t and u or file and column", ", ".join(given) or "no keys")
    if "t" in given:
        return _checked(where, given["t"], given["u"], how, "")
    file = arguments.path(f"{where} file", given["file"])
    return _read(where, str(file), arguments.text(f"{where} column", given["column"]), how)


def _read(where: str, file: str, column: str, how: str | None) -> Data:
    """Return a column of a file, over its column ``t`` or ``time``, or its first one."""
    how = arguments.one_of(f"{where} interpolation", how or "linear", INTERPOLATIONS)
    path = Path(file)
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "an error"
        raise InputError(f"{where}: {file}", "a file that can be read", reason) from None
    if len(content) > LARGEST_FILE:
        raise InputError(f"{where}: {path.name}", f"a file of at most {LARGEST_FILE} bytes", "a larger one")
    try:
        rows = [row for row in csv.reader(content.decode("utf-8-sig").splitlines()) if any(map(str.strip, row))]
    except (UnicodeDecodeError, csv.Error):
        raise InputError(f"{where}: {path.name}", "a CSV file in UTF-8", "something else") from None
    headings = [found["name"] if (found := _HEADING.fullmatch(cell)) else cell for cell in rows[0]] if rows else []
    if column not in headings:
        raise InputError(f"{where}: {path.name}", "a column of the file", quoted(column), nearest(column, headings))
    times = next((headings.index(name) for name in ("t", "time") if name in headings), 0)
    place = headings.index(column)
    if place == times:
        raise InputError(f"{where}: {path.name}", "a column beside that of the times", quoted(column))
    t, u = ([_cell(f"{where}: {path.name}", row, i, k) for k, row in enumerate(rows[1:], 2)] for i in (times, place))
    return _checked(where, t, u, how, f"{file}:{column}")


def _cell(where: str, row: list[str], index: int, line: int) -> float:
    text = row[index] if index < len(row) else ""
    try:
        return float(text)
    except ValueError:
        raise InputError(where, "a number in every row", f"{quoted(text)} in row {line}") from None


def _checked(where: str, t: object, u: object, how: str, source: str) -> Data:
    times, values = arguments.numbers(f"{where} times", t), arguments.numbers(f"{where} values", u)
    if len(times) != len(values):
        raise InputError(where, "as many values as times", f"{len(values)} for {len(times)}")
    if len(times) < 2:
        raise InputError(where, "two samples or more", f"{len(times)}")
    for before, after in pairwise(times):
        if not before < after:
            raise InputError(f"{where} times", "increasing times", f"{after!r} after {before!r}")
    return Data(times, values, how, f"{source or f'{len(times)} samples'} ({how})")


def are_words_of_data(told: str | float) -> bool:
    """Return whether what is told of an input are the words of data, which are no formula."""
    return isinstance(told, str) and _WORDS.fullmatch(told) is not None
