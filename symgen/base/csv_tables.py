"""CSV tables of numbers: every file that a user measured or saved is read here, with the units of its headings."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from symgen.base.errors import InputError, quote, suggest
from symgen.base.files import system_message
from symgen.base.units import known_unit, unit_of

#: Maximum bytes of a table.
LARGEST_FILE = 50_000_000
#: Signs between cells; the first one that the heading has counts.
_SEPARATORS = (";", "\t", ",")
_HEADING = re.compile(r"\s*(?P<name>.*?)\s*(?:\[(?P<unit>[^\]]*)\]\s*)?", re.DOTALL)
_MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
#: Names of the column of times.
_TIMES = ("t", "time")


def split_heading(heading: str) -> tuple[str, str]:
    """Return name and unit of a column, ``crank.theta`` and ``deg`` of ``crank.theta [deg]``; empty without a unit."""
    match = _HEADING.fullmatch(heading)
    return (heading, "") if match is None else (match["name"], (match["unit"] or "").strip())


def numbers_in_unit(where: str, values: Sequence[float], written: str, unit: str) -> list[float]:
    """Return numbers of a column in the unit of the quantity that they are of.

    Parameters
    ----------
    where : str
        File and column, for the message.
    values : sequence of float
        As the file has them.
    written : str
        Unit of the heading; numbers without one are in `unit` already.
    unit : str
        Unit of the quantity; SI where it is empty.

    Raises
    ------
    InputError
        If the heading has a unit of another quantity, or none at all.
    """
    if not written or written == unit:
        return list(values)
    own, wanted = unit_of(written, where, quantity=unit), known_unit(unit)
    if own.factor == wanted.factor:
        return list(values)
    return [x if math.isnan(x) else wanted.from_si(own.to_si(x)) for x in values]


@dataclass(frozen=True)
class CsvTable:
    """A table as its file has it.

    Attributes
    ----------
    where : str
        The file, for messages.
    names, units : tuple of str
        Columns, and the units of their headings, empty without one.
    rows : tuple of (int, list of str)
        Line of the file and cells, as many as columns.
    separator : str
        The sign between cells.
    """

    where: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    rows: tuple[tuple[int, list[str]], ...]
    separator: str

    def place(self, name: str) -> int:
        """Return the place of a column.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        if name not in self.names:
            raise InputError(self.where, "a column of the file", quote(name), suggest(name, filter(None, self.names)))
        return self.names.index(name)

    def place_of_times(self) -> int | None:
        """Return the place of the column ``t`` or ``time``; without one the first, if its unit is one of time."""
        for i, name in enumerate(self.names):
            if name == "t" or name.casefold() in _TIMES[1:]:
                return i
        try:
            return 0 if self.units and unit_of(self.units[0], self.where, quantity="s").text else None
        except InputError:
            return None

    def numbers(self, place: int, gaps: bool = False) -> list[float]:
        """Return the numbers of a column as written; cells without one are nan if there may be gaps.

        Raises
        ------
        InputError
            If a cell holds no number: says which.
        """
        return list(self._numbers(place, gaps))

    def numbers_in_unit(self, place: int, unit: str, gaps: bool = False) -> list[float]:
        """Return the numbers of a column in a unit; see `numbers_in_unit` and `numbers`."""
        where = f"{self.where}: {self.names[place]}"
        return numbers_in_unit(where, self.numbers(place, gaps), self.units[place], unit)

    def is_of_numbers(self, place: int) -> bool:
        """Return whether a column has a number, or nothing but gaps."""
        cells = [row[place].strip() for _, row in self.rows]
        return not any(cells) or any(_number_of(cell.replace(",", ".")) is not None for cell in cells)

    def _numbers(self, place: int, gaps: bool) -> Iterator[float]:
        cells = [row[place].strip() for _, row in self.rows]
        comma = any("," in cell for cell in cells)
        if comma and any("." in cell for cell in cells):
            example = next(cell for cell in cells if "," in cell)
            raise InputError(
                f"{self.where}: {self.names[place]}", "a point or a comma in all numbers of a column", quote(example)
            )
        for (line, _), cell in zip(self.rows, cells, strict=True):
            number = _number_of(cell.replace(",", ".") if comma else cell)
            if number is None and not (gaps and not cell):
                hint = "units stand in the heading, in square brackets" if line == self.rows[0][0] and cell else ""
                got = f"{quote(cell)} in row {line} of {quote(self.names[place])}"
                raise InputError(self.where, "a number in every row", got, hint)
            yield math.nan if number is None else number


def read_csv_table(where: str, path: Path) -> CsvTable:
    """Return the table of a CSV file.

    Cells are separated by commas, semicolons or tabulators; with the last two, numbers may have decimal commas. Empty
    lines and a byte order mark do not count.

    Parameters
    ----------
    where : str
        The file, for messages.
    path : Path
        The file.

    Raises
    ------
    InputError
        If the file cannot be read, is too large, or holds no table.
    """
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:
        raise InputError(where, "a file that can be read", system_message(error)) from None
    if len(content) > LARGEST_FILE:
        raise InputError(where, f"a file of at most {LARGEST_FILE} bytes", "a larger one")
    try:
        text = content.decode(next((code for mark, code in _MARKS if content.startswith(mark)), "utf-8"))
        lines = [(k, line) for k, line in enumerate(text.splitlines(), 1) if line.strip(" \t,;")]
        if lines and (named := re.fullmatch(r"sep=([;,\t])", lines[0][1].strip())):  # what spreadsheets write first
            separator, lines = named[1], lines[1:]
        else:
            separator = _separator_of(lines[0][1] if lines else "")
        cells = list(csv.reader((line for _, line in lines), delimiter=separator, strict=False))
    except UnicodeDecodeError:
        raise InputError(where, "a CSV file in UTF-8", "something else") from None
    except csv.Error:
        raise InputError(where, f"cells of at most {csv.field_size_limit()} characters", "a longer one") from None
    if len(cells) != len(lines):
        raise InputError(where, "a CSV file with a row on each line", "a cell with several lines")
    headings = [split_heading(cell) for cell in cells[0]] if cells else []
    rows = tuple((k, row) for (k, _), row in zip(lines[1:], cells[1:], strict=True))
    names = tuple(name for name, _ in headings)
    if names and all(_number_of(name.replace(",", ".")) is not None for name in names):
        raise InputError(where, "the names of the columns in the first row", "numbers")
    _check_rows(where, names, rows, separator)
    return CsvTable(where, names, tuple(unit for _, unit in headings), rows, separator)


def _separator_of(heading: str) -> str:
    """Return the sign that separates the cells of a heading, in which quoted text and units do not count."""
    bare = re.sub(r'"[^"]*"|\[[^\]]*\]', "", heading)
    return next((sign for sign in _SEPARATORS if sign in bare), ",")


def _check_rows(where: str, names: Sequence[str], rows: Iterable[tuple[int, Sequence[str]]], separator: str) -> None:
    """Refuse a table whose columns share a name, or whose rows are longer or shorter than its heading."""
    for name in names:
        if name and names.count(name) > 1:
            raise InputError(where, "a name of its own for each column", f"{names.count(name)} columns {quote(name)}")
    for line, row in rows:
        if len(row) != len(names):
            hint = "decimal commas need semicolons between cells" if separator == "," and len(row) > len(names) else ""
            raise InputError(where, f"as many cells as in the heading, {len(names)}", f"{len(row)} in row {line}", hint)


def _number_of(cell: str) -> float | None:
    try:
        return None if "_" in cell else float(cell)
    except ValueError:
        return None
