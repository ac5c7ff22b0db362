"""Tables as a terminal shows them: every name and number whole, wide tables in parts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from symgen.analyses.kinds import AnalysisTable as Shown
    from symgen.ensemble.sweep_study import Sweep
    from symgen.result.result import Result
    from symgen.study.comparison.compare import Study
    from symgen.study.comparison.comparison_rows import Row
    from symgen.study.stress.stress_rows import Limit, Stress


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


def show_result(result: Result) -> None:
    """Print what a run gave."""
    from symgen.result.summary import lines

    out = console()
    show_facts(out, lines(result))
    if len(result.t):
        show_parts(out, _final(result), "final state")


def show_quantities(found: Mapping[str, Mapping[str, Any]]) -> None:
    """Print last, smallest and largest values of quantities."""
    rows = [
        (name, *("" if entry[key] is None else f"{entry[key]:.6g}" for key in ("final", "min", "max")), entry["unit"])
        for name, entry in found.items()
    ]
    headings = ("quantity", "final", "smallest", "largest", "unit")
    show_parts(console(), columns_of(headings, rows, left=("quantity", "unit")))


def show_table(found: Shown) -> None:
    """Print a table of an analysis."""
    show_parts(console(), columns_of(found.headings, found.rows, found.left))


def _final(result: Result, most: int = 12) -> list[TableColumn]:
    """Return the last positions and velocities, of the first bodies where there are many."""
    bodies = dict[str, dict[str, str]]()
    for name, value in (result.q.row() | result.v.row()).items():
        body, _, label = name.rpartition(".")
        bodies.setdefault(body, {})[label] = f"{value:.6g}"
    labels = sorted({label for row in bodies.values() for label in row}, key=_LABELS.index)
    rows = [(body, *(row.get(label, "") for label in labels)) for body, row in list(bodies.items())[:most]]
    if len(bodies) > most:
        rows.append((f"... {len(bodies) - most} more", *("" for _ in labels)))
    return columns_of(("body", *labels), rows, left=("body",))


#: Coordinates and velocities of bodies in the order in which they are shown.
_LABELS = ("x", "y", "z", "theta", "e0", "e1", "e2", "e3", "vx", "vy", "vz", "omega", "wx", "wy", "wz")


def show_study(study: Study) -> None:
    """Print the rows of a study, every number whole: on a narrow terminal columns are left out by importance."""
    out = console()
    off = "" if study.how == "none" else f" (off by about {study.estimated_error:.1g} m)"
    out.print(f"{study.mechanism}, {study.until:g} s; reference: {study.how}{off}")
    if study.note:
        out.print(study.note)
    columns = columns_of(_HEADINGS, map(_cells, study.rows), _HEADINGS[:4], _WEIGHTS)
    kept = fitting(columns, out.width)
    show(out, kept)
    if len(kept) < len(columns):
        missing = ", ".join(column.heading for column in columns if column not in kept)
        out.print(f"left out for want of room: {missing} (--csv has them)", style="dim")
    if any(row.below_reference for row in study.rows):
        out.print("* below what the reference itself may be off")
    spreads = study.ratio_spreads
    if spreads is not None:
        out.print(
            f"ratios of run time may vary by {100 * spreads[0]:.1f} % (median row; worst {100 * spreads[1]:.0f} %)"
        )
    common = study.common_warnings
    for sentence in common:
        out.print(f"every run: {sentence}", style="dim")
    for row in study.rows:
        steps = f"rtol {row.rtol:g}" if row.rtol is not None else f"step {row.step:g} s"
        own = [sentence for sentence in row.warnings if sentence not in common]
        for sentence in (*([f"{row.status}: {row.reason}"] if row.reason else []), *own):
            out.print(f"{row.label}, {row.integrator}, {steps}: {sentence}", style="dim")


#: Columns of a study; the first four are words. Those of least weight are left out first on a narrow terminal.
_HEADINGS = (
    *("method", "integrator", "step, rtol", "status", "error [m]", "run [ms]", "spread", "x lagrange", "evaluations"),
    *("|Phi|", "|D v - nu|", "energy [J]"),
)
_WEIGHTS = {
    **{"spread": 1, "|D v - nu|": 2, "evaluations": 3, "energy [J]": 5, "|Phi|": 6, "x lagrange": 7},
    **{"status": 8, "run [ms]": 9},
}


def _cells(row: Row) -> tuple[str, ...]:
    """Return the cells of a row of a study."""
    return (
        *(row.label, row.integrator, f"rtol {row.rtol:g}" if row.rtol is not None else f"{row.step:g} s", row.status),
        "" if row.error is None else f"{row.error:.2e}" + (" *" if row.below_reference else ""),
        *(f"{1e3 * row.run_seconds:.3f}", f"{1e3 * row.run_seconds_spread:.3f}"),
        *("" if row.cost_ratio is None else f"{row.cost_ratio:.2f}", str(row.evaluations)),
        *(f"{row.position_violation_max:.1e}", f"{row.velocity_violation_max:.1e}", f"{row.energy_drift_max:.1e}"),
    )


def show_stress(study: Stress) -> None:
    """Print a stress study."""
    from symgen.study.stress.findings import findings
    from symgen.study.stress.map import LEGEND, Map

    out = console()
    out.print(f"{', '.join(study.models)}: {len(study.rows)} cells")
    shown = Map.of(study)
    if shown.rows:
        table = Table(box=None, header_style="dim", pad_edge=False)
        table.add_column("method", no_wrap=True)
        table.add_column("integrator", no_wrap=True)
        for family in shown.families:
            table.add_column(family.replace("-", " "), overflow="fold")
        for line in shown.lines:
            cells = []
            for family in shown.families:
                entry = shown.entry(line, family)
                style = "" if not entry.judged else "green" if entry.good == entry.judged else "yellow"
                cells.append(Text(entry.text, style=style))
            table.add_row(*line, *cells)
        out.print(table)
        out.print(f"accurate cells of those judged; {LEGEND}", style="dim")
    if study.limits:
        out.print("largest constant step [s] that follows the motion, and that keeps the error below 1e-3 m")
        rows = [(x.model, f"{x.family} {x.case}", x.method, x.integrator, *_steps(x)) for x in study.limits]
        headings = ("model", "case", "method", "integrator", "stable", "accurate")
        show(out, fitting(columns_of(headings, rows, headings[:4], {"model": 1, "integrator": 2}), out.width))
    for sentence in findings(study):
        out.print(sentence)


def _steps(limit: Limit) -> list[str]:
    return ["none" if x is None else f"{x:.3g}" for x in (limit.stable_step, limit.accurate_step)]


def show_sweep(found: Sweep, written: Path | None) -> None:
    """Print what an ensemble gave: axes, statuses, reasons, and the ends of what was kept."""
    import numpy as np

    facts, ensemble = found.to_json(), found.ensemble
    steps = f"step {facts['step']:g} s" if facts["rtol"] is None else f"rtol {facts['rtol']:g}"
    rate = f", {len(found) / found.seconds:.3g} runs a second" if found.seconds > 0.0 and not found.interrupted else ""
    axes = [item for axis in ensemble.grid.axes for item in axis.values.items()]
    lines = [
        ("mechanism", facts["mechanism"]),
        ("method", f"{facts['method']}, {facts['integrator']}, {steps}, until {facts['until']:g} s"),
        *(("varies", f"{name}: {len(x)} values from {x.min():.6g} to {x.max():.6g}") for name, x in axes),
        ("runs", f"{len(found)} in {found.seconds:.3g} s{rate}"),
        *(("status", f"{status}: {count}") for status, count in found.counts.items() if count),
        *(("reason", f"{count} x {reason}") for reason, count in found.reasons()),
        ("error", "not estimated: symgen run --verify does so for a single run"),
        *([("written", str(written))] if written is not None and not found.interrupted else []),
    ]
    out = console()
    show_facts(out, lines)
    rows = list[tuple[str, ...]]()
    for i, q in enumerate(ensemble.recipe.quantities[:24]):
        last = found.values[:, i, -1]
        last = last[np.isfinite(last)]
        if len(last):
            rows.append((q.name, q.unit, *(f"{x:.6g}" for x in (last.min(), last.mean(), last.max()))))
    if rows:
        headings = ("quantity", "unit", "least", "mean", "largest")
        show_parts(out, columns_of(headings, rows, left=headings[:2]), "at the last output")
