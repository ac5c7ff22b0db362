"""Tables as a terminal shows them: every name and number whole, wide tables in parts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from symgen.base.digits import digits, scale_of
from symgen.base.errors import fit_lines
from symgen.base.locales import local_text

if TYPE_CHECKING:
    from symgen.result.result import Result


#: Between two columns.
GAP = 2
COLOURS = {"ok": "green", "unverified": "yellow", "failed": "red"}


def make_console() -> Console:
    """Return a console on standard output; where that is no terminal, wide enough that no figure is cut."""
    wide = Console(highlight=False, markup=False)
    return wide if wide.is_terminal else Console(highlight=False, markup=False, width=240)


def show_rows(
    out: Console,
    headings: Sequence[str],
    rows: Iterable[Sequence[str]],
    left: Sequence[str] = (),
    title: str = "",
    first: int = 1,
    in_parts: bool = True,
) -> None:
    """Print a table, none of its cells cut.

    Parameters
    ----------
    out : Console
        Output of the table.
    headings, rows : sequence of str, iterable of sequences of str
        Columns and cells.
    left : sequence of str
        Headings of columns that are flush left, as words are.
    title : str
        Above the table.
    first : int
        Number of columns repeated in each part of a table wider than the terminal.
    in_parts : bool
        Whether further parts are printed; otherwise a line names their columns.
    """
    kept = {k for k, heading in enumerate(headings) if heading in left}
    listed = [[x if k in kept else local_text(x) for k, x in enumerate(row)] for row in rows]
    widths = [max(map(len, column)) for column in zip(headings, *listed, strict=True)]
    parts = [[*range(first)]]
    for k in range(first, len(headings)):
        if len(parts[-1]) > first and sum(widths[i] + GAP for i in (*parts[-1], k)) - GAP > out.width:
            parts.append([*range(first)])
        parts[-1].append(k)
    for n, part in enumerate(parts if in_parts else parts[:1]):
        above = title if title and not n else None
        table = Table(title=above, title_justify="left", box=None, header_style="dim", pad_edge=False)
        for k in part:
            side: Any = "left" if headings[k] in left else "right"
            table.add_column(headings[k], justify=side, no_wrap=True, min_width=widths[k], overflow="fold")
        for row in listed:
            table.add_row(*(Text(row[k], COLOURS.get(row[k], "") if headings[k] == "status" else "") for k in part))
        out.print(table, soft_wrap=sum(widths[k] + GAP for k in part) - GAP > out.width, crop=False)
    if not in_parts and parts[1:]:
        missing = ", ".join(headings[k] for part in parts[1:] for k in part[first:])
        out.print(f"left out for want of room: {missing} (--csv has them)", style="dim")


def show_facts(out: Console, facts: Iterable[tuple[str, str]]) -> None:
    """Print labels and values; statuses have colours."""
    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(style="dim")
    table.add_column(overflow="fold")
    for label, text in facts:
        status = text.partition(" ")[0].rstrip(":") if label == "status" else ""
        table.add_row(label, Text(local_text(text), COLOURS.get(status, "")))
    out.print(table)


def show_result(result: Result, quantities: Sequence[str] = ()) -> None:
    """Print the result of a run, with the largest values of some quantities, or of those that are asked for first."""
    from symgen.cli import in_terms_of_options
    from symgen.result.summary import summary_lines

    out = make_console()
    show_facts(out, [(label, in_terms_of_options(text)) for label, text in summary_lines(result)])
    if len(result.t):
        _show_extremes(out, result, quantities)


def show_quantities(quantities: Mapping[str, Mapping[str, Any]]) -> None:
    """Print last, smallest and largest values of quantities; rounding is shown as 0 beside the ``scale`` of one."""
    rows = list[tuple[str, ...]]()
    for name, entry in quantities.items():
        values = [entry[key] for key in ("final", "min", "max")]
        scale = max(scale_of((x for x in values if x is not None), entry["unit"]), entry.get("scale", 0.0))
        rows.append((name, *("" if x is None else digits(x, scale) for x in values), entry["unit"]))
    headings = ("quantity", "final", "smallest", "largest", "unit")
    show_rows(make_console(), headings, rows, left=("quantity", "unit"))


def show_sensitivities(result: Result, quantities: Sequence[str], most: int = 40) -> None:
    """Print the derivatives of quantities at the end, by default of coordinates, velocities and outputs."""
    sensitivities = result.sensitivities
    assert sensitivities is not None, "the run had sensitivities"
    names = quantities or [name for table in sensitivities.saved(result) for name in getattr(result, table).names]
    tables = [(name, result.gradient(name)) for name in names]
    rows = [
        (name, by, digits(value, max(map(abs, table.row().values()))), unit)
        for name, table in tables
        for (by, value), unit in zip(table.row().items(), table.units, strict=True)
    ]
    first = fit_lines(len(rows), most)
    show_rows(
        make_console(),
        ("final derivative of", "by", "value", "unit"),
        rows[:first],
        left=("final derivative of", "by", "unit"),
    )
    if len(rows) > first:
        click.echo(f"... {len(rows) - first} more; --quantity chooses, --json has all")


def _show_extremes(out: Console, result: Result, quantities: Sequence[str], most: int = 12) -> None:
    """Print smallest and largest values with their times; of all `quantities`, else of the first of many others."""
    from symgen.result.extremes import extremes_of_run
    from symgen.result.labelled import common_scales

    found, scales = extremes_of_run(result, quantities), common_scales((result.q, result.v, result.a, result.lam))
    first, rows = len(found) if quantities else fit_lines(len(found), most), list[tuple[str, ...]]()
    for each in found[:first]:
        scale = max(scale_of((each.low, each.high), each.unit), scales.get(each.unit, 0.0))
        cells = digits(each.low, scale), f"{each.low_at:.4g}", digits(each.high, scale), f"{each.high_at:.4g}"
        rows.append((each.name, *cells, digits(each.last, scale), each.unit))
    headings = ("quantity", "smallest", "at t [s]", "largest", "at t [s]", "at the end", "unit")
    show_rows(out, headings, rows, left=("quantity", "unit"))
    if len(found) > first:
        click.echo(f"... {len(found) - first} more; --quantity chooses, --json has the final state")
