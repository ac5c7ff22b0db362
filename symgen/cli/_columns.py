"""Tables that fit a terminal: every name and number whole, columns left out by importance, or the table in parts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rich.console import Console
from rich.table import Table
from rich.text import Text

#: Between two columns.
GAP = 2


@dataclass(frozen=True)
class Column:
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
    style : str
        Of its cells; "status" colours them by what they say.
    """

    heading: str
    cells: tuple[str, ...]
    left: bool = False
    weight: int = 0
    style: str = ""

    @property
    def width(self) -> int:
        """Its longest cell or heading."""
        return max(map(len, (self.heading, *self.cells)), default=0)


def room(columns: Sequence[Column]) -> int:
    """Return how wide a table of columns is."""
    return sum(column.width for column in columns) + GAP * (len(columns) - 1)


def fitting(columns: Sequence[Column], width: int) -> list[Column]:
    """Return the columns without the least important ones, so that they fit if they can."""
    kept = list(columns)
    while room(kept) > width and any(column.weight for column in kept):
        kept.remove(min((c for c in kept if c.weight), key=lambda c: c.weight))
    return kept


def in_parts(columns: Sequence[Column], width: int, first: int = 1) -> Iterator[list[Column]]:
    """Yield tables of as many columns as fit, each beginning with the first ones."""
    head, part = list(columns[:first]), list[Column]()
    for column in columns[first:]:
        if part and room([*head, *part, column]) > width:
            yield [*head, *part]
            part = []
        part.append(column)
    yield [*head, *part]


def show(out: Console, columns: Sequence[Column], title: str = "", colours: dict[str, str] | None = None) -> None:
    """Print a table, none of its cells cut: what is wider than the terminal goes on in the next line."""
    table = Table(title=title or None, title_justify="left", box=None, header_style="dim", pad_edge=False)
    for column in columns:
        table.add_column(
            column.heading,
            justify="left" if column.left else "right",
            no_wrap=True,
            min_width=column.width,
            overflow="fold",
        )
    for row in zip(*(column.cells for column in columns), strict=True):
        texts = [
            Text(cell, style=(colours or {}).get(cell, "") if column.style == "status" else column.style)
            for column, cell in zip(columns, row, strict=True)
        ]
        table.add_row(*texts)
    out.print(table, soft_wrap=room(columns) > out.width, crop=False)
