"""What commands show on a terminal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from symgen.result.result import Result
    from symgen.study.comparison.compare import Study

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
        out.print(_final(result))


def show_quantities(found: Mapping[str, Mapping[str, Any]]) -> None:
    """Print last, smallest and largest values of quantities."""
    table = Table(box=None, header_style="dim", pad_edge=False)
    table.add_column("quantity")
    for heading in ("final", "smallest", "largest", "unit"):
        table.add_column(heading, justify="left" if heading == "unit" else "right")
    for name, entry in found.items():
        numbers = ("" if entry[key] is None else f"{entry[key]:.6g}" for key in ("final", "min", "max"))
        table.add_row(name, *numbers, entry["unit"])
    console().print(table)


def show_summary(found: Mapping[str, Mapping[str, Any]]) -> None:
    """Print what sizes each actuator: its largest effort and when, root mean square, peak power and energy."""
    table = Table(box=None, header_style="dim", pad_edge=False)
    table.add_column("effort")
    for heading in ("largest", "rms", "unit", "at [s]", "peak power [W]", "energy [J]"):
        table.add_column(heading, justify="left" if heading == "unit" else "right")
    for name, entry in found.items():
        power = (f"{entry[key]:.6g}" if key in entry else "" for key in ("peak_power", "energy"))
        table.add_row(name, f"{entry['max']:.6g}", f"{entry['rms']:.6g}", entry["unit"], f"{entry['at']:.6g}", *power)
    console().print(table)


def _final(result: Result, most: int = 12) -> Table:
    """Return the last positions and velocities, of the first bodies where there are many."""
    table = Table(title="final state", title_justify="left", box=None, header_style="dim", pad_edge=False)
    table.add_column("body")
    rows: dict[str, list[str]] = {}
    labels: list[str] = []
    for values in (result.q.row(), result.v.row()):
        for name, value in values.items():
            body, _, label = name.rpartition(".")
            rows.setdefault(body, []).append(f"{value:.6g}")
            if label not in labels:
                labels.append(label)
    for label in labels:
        table.add_column(label, justify="right")
    point = ["x", "y", "vx", "vy"]
    for body, numbers in list(rows.items())[:most]:
        shown = dict(zip(labels if len(numbers) == len(labels) else point, numbers, strict=True))
        table.add_row(body, *(shown.get(label, "") for label in labels))
    if len(rows) > most:
        table.add_row(f"... {len(rows) - most} more", *([""] * len(labels)))
    return table


def show_study(study: Study) -> None:
    """Print the rows of a study."""
    out = console()
    off = "" if study.how == "none" else f" (off by about {study.estimated_error:.1g} m)"
    out.print(f"{study.mechanism}, {study.until:g} s; reference: {study.how}{off}")
    if study.note:
        out.print(study.note)
    table = Table(box=None, header_style="dim", pad_edge=False)
    for heading in ("method", "integrator", "step or rtol", "status"):
        table.add_column(heading, no_wrap=True)
    for heading in (
        "error [m]",
        "run [ms]",
        "spread",
        "x lagrange",
        "evaluations",
        "|Phi|",
        "|D v - nu|",
        "energy [J]",
    ):
        table.add_column(heading, justify="right", no_wrap=True)
    for row in study.rows:
        error = "" if row.error is None else f"{row.error:.2e}" + (" *" if row.below_reference else "")
        table.add_row(
            row.label,
            row.integrator,
            f"rtol {row.rtol:g}" if row.rtol is not None else f"{row.step:g} s",
            Text(row.status, style=COLOURS[row.status]),
            error,
            f"{1e3 * row.run_seconds:.3f}",
            f"{1e3 * row.run_seconds_spread:.3f}",
            "" if row.cost_ratio is None else f"{row.cost_ratio:.2f}",
            str(row.evaluations),
            *(f"{x:.1e}" for x in (row.position_violation_max, row.velocity_violation_max, row.energy_drift_max)),
        )
    out.print(table)
    if any(row.below_reference for row in study.rows):
        out.print("* below what the reference itself may be off")
    spreads = study.ratio_spreads
    if spreads is not None:
        out.print(
            f"ratios of run time may vary by {100 * spreads[0]:.1f} % (median row; worst {100 * spreads[1]:.0f} %)"
        )
    for row in study.rows:
        steps = f"rtol {row.rtol:g}" if row.rtol is not None else f"step {row.step:g} s"
        for sentence in (*([f"{row.status}: {row.reason}"] if row.reason else []), *row.warnings):
            out.print(f"{row.label}, {row.integrator}, {steps}: {sentence}", style="dim")
