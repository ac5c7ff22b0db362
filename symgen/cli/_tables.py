"""What commands show on a terminal."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from symgen.cli._columns import Column, fitting, in_parts, show

if TYPE_CHECKING:
    from symgen.analyses.kinds import Table as Shown
    from symgen.result.result import Result
    from symgen.study.comparison.compare import Study
    from symgen.study.comparison.rows import Row

COLOURS = {"ok": "green", "unverified": "yellow", "failed": "red"}


def console() -> Console:
    """Return a console on standard output; where that is no terminal, wide enough that no figure is cut."""
    wide = Console(highlight=False, markup=False)
    return wide if wide.is_terminal else Console(highlight=False, markup=False, width=200)


def show_result(result: Result) -> None:
    """Print what a run gave."""
    from symgen.result.summary import lines

    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(style="dim")
    table.add_column(overflow="fold")
    for label, text in lines(result):
        table.add_row(label, Text(text, style=COLOURS[result.status] if label == "status" else ""))
    out = console()
    out.print(table)
    if len(result.t):
        for k, part in enumerate(in_parts(_final(result), out.width)):
            show(out, part, "" if k else "final state")


def show_quantities(found: Mapping[str, Mapping[str, Any]]) -> None:
    """Print last, smallest and largest values of quantities."""
    columns = [Column("quantity", tuple(found), left=True)]
    for heading, key in (("final", "final"), ("smallest", "min"), ("largest", "max")):
        numbers = ("" if entry[key] is None else f"{entry[key]:.6g}" for entry in found.values())
        columns.append(Column(heading, tuple(numbers)))
    columns.append(Column("unit", tuple(str(entry["unit"]) for entry in found.values()), left=True))
    out = console()
    for part in in_parts(columns, out.width):
        show(out, part)


def show_table(found: Shown) -> None:
    """Print a table of an analysis."""
    out = console()
    if found.parts:
        cells = zip(*found.rows, strict=True) if found.rows else ((),) * len(found.headings)
        columns = [Column(h, tuple(c), left=h in found.left) for h, c in zip(found.headings, cells, strict=True)]
        for part in in_parts(columns, out.width):
            show(out, part)
        return
    table = Table(box=None, header_style="dim", pad_edge=False)
    for heading in found.headings:
        table.add_column(heading, justify="left" if heading in found.left else "right")
    for row in found.rows:
        table.add_row(*row)
    out.print(table)


def _final(result: Result, most: int = 12) -> list[Column]:
    """Return the last positions and velocities, of the first bodies where there are many."""
    rows: dict[str, dict[str, str]] = {}
    labels: dict[str, None] = {}
    for values in (result.q.row(), result.v.row()):
        for name, value in values.items():
            body, _, label = name.rpartition(".")
            rows.setdefault(body, {})[label] = f"{value:.6g}"
            labels[label] = None
    order = sorted(labels, key=_LABELS.index)
    shown = list(rows.items())[:most]
    bodies = [body for body, _ in shown] + ([f"... {len(rows) - most} more"] if len(rows) > most else [])
    columns = [Column("body", tuple(bodies), left=True)]
    for label in order:
        cells = [row.get(label, "") for _, row in shown] + [""] * (len(bodies) - len(shown))
        columns.append(Column(label, tuple(cells)))
    return columns


#: Coordinates and velocities of bodies in the order in which they are shown.
_LABELS = ("x", "y", "z", "theta", "e0", "e1", "e2", "e3", "vx", "vy", "vz", "omega", "wx", "wy", "wz")


def show_study(study: Study) -> None:
    """Print the rows of a study, every number whole: on a narrow terminal columns are left out by importance."""
    out = console()
    off = "" if study.how == "none" else f" (off by about {study.estimated_error:.1g} m)"
    out.print(f"{study.mechanism}, {study.until:g} s; reference: {study.how}{off}")
    if study.note:
        out.print(study.note)
    columns = _of_study(study)
    kept = fitting(columns, out.width)
    show(out, kept, colours=COLOURS)
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


def _of_study(study: Study) -> list[Column]:
    def column(heading: str, cell: Callable[[Row], str], weight: int = 0, **more: Any) -> Column:
        return Column(heading, tuple(map(cell, study.rows)), weight=weight, **more)

    return [
        column("method", lambda r: r.label, left=True),
        column("integrator", lambda r: r.integrator, left=True),
        column("step, rtol", lambda r: f"rtol {r.rtol:g}" if r.rtol is not None else f"{r.step:g} s", left=True),
        column("status", lambda r: r.status, 8, left=True, style="status"),
        column(
            "error [m]", lambda r: "" if r.error is None else f"{r.error:.2e}" + (" *" if r.below_reference else "")
        ),
        column("run [ms]", lambda r: f"{1e3 * r.run_seconds:.3f}", 9),
        column("spread", lambda r: f"{1e3 * r.run_seconds_spread:.3f}", 1),
        column("x lagrange", lambda r: "" if r.cost_ratio is None else f"{r.cost_ratio:.2f}", 7),
        column("evaluations", lambda r: str(r.evaluations), 3),
        column("|Phi|", lambda r: f"{r.position_violation_max:.1e}", 6),
        column("|D v - nu|", lambda r: f"{r.velocity_violation_max:.1e}", 2),
        column("energy [J]", lambda r: f"{r.energy_drift_max:.1e}", 5),
    ]
