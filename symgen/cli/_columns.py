"""Tables that fit a terminal: every name and number whole, columns left out by importance, or the table in parts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

#: Between two columns.
GAP = 2
COLOURS = {"ok": "green", "unverified": "yellow", "failed": "red"}


def console() -> Console:
    """Return a console on standard output; where that is no terminal, wide enough that no figure is cut."""
    wide = Console(highlight=False, markup=False)
    return wide if wide.is_terminal else Console(highlight=False, markup=False, width=200)


@dataclass(frozen=True)
class TableColumn:
    """A column of a table.

    Attributes
    ----------
    heading : str
        Its name.
    cells : tuple of str
        One a row.
    left : bool
        Whether it is flush left, as words are.
    weight : int
        How important it is: the columns of least weight are left out first; 0 is never left out.
    coloured : bool
        Whether its cells are statuses, which have colours.
    """

    heading: str
    cells: tuple[str, ...]
    left: bool = False
    weight: int = 0
    coloured: bool = False

    @property
    def width(self) -> int:
        """Its longest cell or heading."""
        return max(map(len, (self.heading, *self.cells)), default=0)


def room(columns: Sequence[TableColumn]) -> int:
    """Return how wide a table of columns is."""
    return sum(column.width for column in columns) + GAP * (len(columns) - 1)


def fitting(columns: Sequence[TableColumn], width: int) -> list[TableColumn]:
    """Return the columns without the least important ones, so that they fit if they can."""
    kept = list(columns)
    while room(kept) > width and any(column.weight for column in kept):
        kept.remove(min((c for c in kept if c.weight), key=lambda c: c.weight))
    return kept


def in_parts(columns: Sequence[TableColumn], width: int, first: int = 1) -> Iterator[list[TableColumn]]:
    """Yield tables of as many columns as fit, each beginning with the first ones."""
    head, part = list(columns[:first]), list[TableColumn]()
    for column in columns[first:]:
        if part and room([*head, *part, column]) > width:
            yield [*head, *part]
            part = []
        part.append(column)
    yield [*head, *part]


def columns_of(
    headings: Sequence[str],
    rows: Iterable[Sequence[str]],
    left: Sequence[str] = (),
    weights: Mapping[str, int] | None = None,
) -> list[TableColumn]:
    """Return the columns of rows of cells, with the headings of those that are flush left and the weights of some."""
    cells = list(zip(*rows, strict=True)) or [()] * len(headings)
    of = weights or {}
    return [TableColumn(h, c, h in left, of.get(h, 0), h == "status") for h, c in zip(headings, cells, strict=True)]


def show(out: Console, columns: Sequence[TableColumn], title: str = "") -> None:
    """Print a table, none of its cells cut: what is wider than the terminal goes on in the next line."""
    table = Table(title=title or None, title_justify="left", box=None, header_style="dim", pad_edge=False)
    for column in columns:
        side: Any = "left" if column.left else "right"
        table.add_column(column.heading, justify=side, no_wrap=True, min_width=column.width, overflow="fold")
    for row in zip(*(column.cells for column in columns), strict=True):
        pairs = zip(columns, row, strict=True)
        table.add_row(*(Text(cell, COLOURS.get(cell, "") if column.coloured else "") for column, cell in pairs))
    out.print(table, soft_wrap=room(columns) > out.width, crop=False)


def show_parts(out: Console, columns: Sequence[TableColumn], title: str = "") -> None:
    """Print a table, on a narrow terminal in parts."""
    for k, part in enumerate(in_parts(columns, out.width)):
        show(out, part, "" if k else title)


def show_facts(out: Console, facts: Iterable[tuple[str, str]]) -> None:
    """Print labels with what belongs to them; statuses have colours."""
    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(style="dim")
    table.add_column(overflow="fold")
    for label, text in facts:
        status = text.partition(" ")[0].rstrip(":") if label == "status" else ""
        table.add_row(label, Text(text, COLOURS.get(status, "")))
    out.print(table)
