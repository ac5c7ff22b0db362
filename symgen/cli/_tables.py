"""What commands show on a terminal of runs, analyses and comparisons."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from symgen.cli._columns import TableColumn, columns_of, console, fitting, show, show_facts, show_parts

if TYPE_CHECKING:
    from symgen.analyses.kinds import AnalysisTable as Shown
    from symgen.result.result import Result
    from symgen.study.comparison.compare import Study
    from symgen.study.comparison.comparison_rows import Row


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
