"""Tables of pages that a module measures: their rows, how cells compare, and how a page gets them."""

from __future__ import annotations

import platform
import random
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
#: Numbers below are rounding: they agree with one another.
ROUNDING = 1e-10
#: Medians of ratios of times, in turns, agree if they differ by no more than this factor: beside busy processes they
#: hold within 3 percent. A page keeps those that agree.
BAND = 1.15
#: Errors that rounding decides agree if they differ by no more than this factor.
DECADE = 10.0
#: Stands for a cell that is not measured: the page keeps its own.
KEPT = "-"

_NUMBER = re.compile(r"-?\d[\d,]*\.?\d*(?:e[-+]?\d+)?")
_DATE = "*Measured on {date}, {machine}{times}.*"
#: What that line says of run times: the digest of their code (`benchmarks.code_of_times`), or that an older code had
#: them.
CODE, OLDER = "; times by code {code}", "; times by older code"
_CLAUSE = re.compile(r"; times by (?:code [0-9a-f]{8}|older code)")

Row = tuple[tuple[str, ...], Callable[[], Sequence[str]]]


@dataclass(frozen=True)
class PageTable:
    """A table of a page.

    Parameters
    ----------
    command : str
        What follows ``python -m benchmarks.``; the page names it before the table.
    page : str
        Path of the page.
    headings : tuple of str
        Headings of all columns.
    rows : tuple of Row
        Cells of the first columns, which name a row, and a function that measures the others.
    times : tuple of int
        Columns of run times.
    loose : tuple of int
        Columns of errors that rounding decides.
    integrators : tuple of str
        Those whose times these are, and are older once their loops change.
    stored : bool
        Whether cells follow from a record: then they are equal, and nothing is measured.
    claims : callable
        Returns sentences of `study` that follow from the same numbers, word for word.
    """

    command: str
    page: str
    headings: tuple[str, ...]
    rows: tuple[Row, ...]
    times: tuple[int, ...] = ()
    loose: tuple[int, ...] = ()
    integrators: tuple[str, ...] = ()
    stored: bool = False
    claims: Callable[[], Iterable[str]] = tuple

    @property
    def study(self) -> str:
        """Return the path of the page that says what follows from the table: its own, where no study has its name."""
        study = self.page.replace("docs/tables/", "docs/findings/")
        return study if (ROOT / study).is_file() else self.page

    def band(self, column: int) -> float:
        """Return the factor by which numbers of a column may differ, 0 where their digits count."""
        return BAND if column in self.times else DECADE if column in self.loose else 0.0

    def measured(self) -> list[list[str]]:
        """Return all rows as they are measured now."""
        return [[*names, *measure()] for names, measure in self.rows]


@dataclass(frozen=True)
class Difference:
    """A cell of a page beside its measured value; `line` counts from 1."""

    page: str
    line: int
    column: str
    printed: str
    measured: str

    def __str__(self) -> str:
        return f"{self.page}:{self.line}, {self.column}: '{self.printed}', measured '{self.measured}'"


def markdown(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the lines of a table."""
    lines = [headings, ["---"] * len(headings), *rows]
    return [re.sub(r"\|  (?=\|)", "| ", "| " + " | ".join(line) + " |") for line in lines]


def two_digits(value: float) -> str:
    """Return a number to two digits, without an exponent."""
    return f"{float(f'{value:.1e}'):.15g}"


def number(x: float) -> str:
    """Return a number with two digits, one where it is rounding."""
    text = f"{x:.0e}" if abs(x) < ROUNDING else f"{x:.1e}"
    return text.replace("e-0", "e-").replace("e+0", "e+")


def step_size(x: float) -> str:
    """Return a step as pages print it, such as 2e-3."""
    mantissa, power = f"{x:.3e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(power)}"


def list_of(cells: Callable[..., Iterator[str]], *case: Any) -> list[str]:
    """Return the measured cells of a row."""
    return list(cells(*case))


def cells_of(line: str) -> list[str]:
    """Return the cells of a line of a table; a bar behind a backslash is part of a cell."""
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def place(table: PageTable, text: str) -> tuple[int, int]:
    """Return the first line of a table in the text of its page, and the line behind its last one.

    Raises
    ------
    ValueError
        If the page does not name its command before a table.
    """
    lines, command = text.splitlines(), f"`python -m benchmarks.{table.command}`"
    named = next((i for i, line in enumerate(lines) if command in line and line[:1] != "|"), len(lines))
    first = next((i for i in range(named, len(lines)) if lines[i].startswith("|")), None)
    if first is None:
        raise ValueError(f"{table.page}: expected {command} and a table behind it")
    return first, next((i for i in range(first, len(lines)) if not lines[i].startswith("|")), len(lines))


def unit(number: str) -> float:
    """Return one unit of the last digit of a printed number."""
    mantissa, _, power = number.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return float(10.0 ** (int(power or 0) - decimals))


def agrees(printed: str, measured: str, band: float = 0.0) -> bool:
    """Whether cells agree: counts and words exactly, other numbers to one unit of the last digit, or within a band."""
    if measured == KEPT:
        return True
    if band and ", " in printed:  # one processor may resolve a number that another does not
        parts = printed.split(", "), measured.split(", ")
        alike = len(parts[0]) == len(parts[1])
        return alike and all(KEPT in pair or agrees(*pair, band) for pair in zip(*parts, strict=True))
    if _NUMBER.sub("#", printed) != _NUMBER.sub("#", measured):
        return False
    for one, other in zip(_NUMBER.findall(printed), _NUMBER.findall(measured), strict=True):
        a, b = (float(x.replace(",", "")) for x in (one, other))
        exact = not any(c in one + other for c in ".e")
        rounding = not exact and max(abs(a), abs(b)) < ROUNDING
        if band and not rounding and not max(abs(a), abs(b)) <= band * min(abs(a), abs(b)):
            return False
        least = 0.0 if exact else 1.01 * max(unit(one), unit(other))
        if "e" in one + other and not rounding and not band and max(abs(a), abs(b)) > 2.1 * min(abs(a), abs(b)):
            return False
        if not band and not rounding and not abs(a - b) <= least:
            return False
    return True


def differences(table: PageTable, text: str, measured: Mapping[int, Sequence[str]]) -> Iterator[Difference]:
    """Yield the cells of a page that are not those of the measured rows, which are given by their number."""
    first, end = place(table, text)
    lines = text.splitlines()[first:end]
    if cells_of(lines[0]) != list(table.headings) or len(lines) != len(table.rows) + 2:
        yield Difference(table.page, first + 1, "the whole table", lines[0], " ".join(table.headings))
        return
    for number, row in measured.items():
        printed = cells_of(lines[number + 2])
        for column, cell in enumerate(row):
            if not agrees(printed[column], cell, table.band(column)):
                where = first + number + 3
                yield Difference(table.page, where, table.headings[column], printed[column], cell)


def stays(table: PageTable, column: int, printed: str, measured: str) -> bool:
    """Whether a page keeps a cell: it was not measured, or agrees and is no cell of a record."""
    return measured == KEPT or (not table.stored and agrees(printed, measured, table.band(column)))


def clause_of(table: PageTable, text: str) -> str:
    """Return what a page says of the code of a table's times; empty where it says nothing."""
    found = _CLAUSE.search(next(iter(text.splitlines()[place(table, text)[1] + 1 :]), ""))
    return found[0] if found else ""


def is_stale(table: PageTable, text: str, code: str) -> bool:
    """Whether a page shows run times that neither the present code had nor the page calls older."""
    return bool(table.times) and clause_of(table, text) not in (CODE.format(code=code), OLDER)


def is_older(table: PageTable, text: str, code: str) -> bool:
    """Whether run times of a page have to be measured anew."""
    return bool(table.times) and clause_of(table, text) != CODE.format(code=code)


def written(table: PageTable, text: str, measured: Sequence[Sequence[str]], date: str, code: str = "") -> str:
    """Return the text of a page with a measured table; cells that agree stay, and with all of them the date does.

    Where times were measured their code is written down, and all of them are those of this measurement.
    """
    clause = CODE.format(code=code) if table.times and code else clause_of(table, text)
    anew = clause != clause_of(table, text)
    first, end = place(table, text)
    lines = text.splitlines()
    printed = [cells_of(line) for line in lines[first + 2 : end]]
    same = cells_of(lines[first]) == list(table.headings)
    named = {tuple(row[: len(names)]): row for row in printed for names, _ in table.rows[:1]}
    rows = []
    for (names, _), row in zip(table.rows, measured, strict=True):
        old = named.get(names) if same else None
        pairs = enumerate(zip(old or [KEPT] * len(row), row, strict=True))
        kept = [a if old and stays(table, i, a, b) else b for i, (a, b) in pairs]
        rows.append(
            [
                b if anew and i in table.times and b != KEPT else a
                for i, (a, b) in enumerate(zip(kept, row, strict=True))
            ]
        )
    behind = end + 1
    stamped = behind < len(lines) and lines[behind].startswith(_DATE.partition("{")[0])
    whole = not any(KEPT in row[1:] for row in measured)
    if same and not anew and rows == printed and (stamped or not whole):
        return text
    stamp = ["", _DATE.format(date=date, machine=platform.machine(), times=clause)] if whole or not table.stored else []
    return (
        "\n".join([*lines[:first], *markdown(table.headings, rows), *stamp, *lines[behind + 1 if stamped else end :]])
        + "\n"
    )


def missing(table: PageTable, text: str) -> list[str]:
    """Return the claims of a table that the text of its study does not have."""
    page = " ".join(text.split())
    return [claim for claim in table.claims() if claim not in page]


def drawn(tables: Sequence[PageTable], share: float, seed: int) -> list[tuple[PageTable, int]]:
    """Return rows that hold this share of all cells at least, drawn by a seed."""
    rows = [(table, number) for table in tables for number in range(len(table.rows))]
    wanted = share * sum(len(table.headings) for table, _ in rows)
    random.Random(seed).shuffle(rows)
    chosen, count = list[tuple[PageTable, int]](), 0
    for table, number in rows:
        if count >= wanted:
            break
        chosen.append((table, number))
        count += len(table.headings)
    return chosen


def print_tables(tables: Mapping[str, PageTable], names: Sequence[str]) -> int:
    """Measure and print the tables that are named, or all."""
    for name in names or tables:
        lines = markdown(tables[name].headings, tables[name].measured())
        sys.stdout.write("\n".join([*lines, "", *(f"- {claim}" for claim in tables[name].claims()), ""]))
    return 0
