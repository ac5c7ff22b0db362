"""Tables of comparisons as a terminal shows them: rows, times at equal error, and several mechanisms together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from symgen.cli._tables import make_console, show_rows

if TYPE_CHECKING:
    from symgen.study.comparison.across import Across
    from symgen.study.comparison.compare_models import Study
    from symgen.study.comparison.comparison_rows import Row
    from symgen.study.comparison.published import Benchmark, PublishedRow


def show_study(study: Study) -> None:
    """Print the rows of a study."""
    from symgen.study.comparison.comparison_study import BEYOND, FRONT, LOADED, ONE_RUN

    out = make_console()
    off = "" if study.how == "none" else f" (off by about {study.estimated_error:.1g} m)"
    out.print(f"{study.mechanism}, {study.until:g} s; reference: {study.how}{off}")
    if study.note:
        out.print(study.note)
    cells = [_cells_of_row(row, i in study.front) for i, row in enumerate(study.rows)]
    show_rows(out, _HEADINGS, cells, (*_HEADINGS[:3], "status"), first=3, in_parts=False)
    if any(row.law for row in study.rows):
        contacts = [(*cell[:3], *_contact_cells(row)) for cell, row in zip(cells, study.rows, strict=True)]
        show_rows(out, (*_HEADINGS[:3], *_CONTACT), contacts, _HEADINGS[:3], first=3)
    if any(row.differences_seconds is not None for row in study.rows):
        slopes = [(*cell[:3], *_gradient_cells(row)) for cell, row in zip(cells, study.rows, strict=True)]
        show_rows(out, (*_HEADINGS[:3], *_GRADIENT), slopes, _HEADINGS[:3], first=3)
    if len(study.rows) > 1:
        out.print(FRONT)
    if any(row.below_reference for row in study.rows):
        out.print("* below what the reference itself may be off")
    if any(row.beyond_limits for row in study.rows):
        out.print(BEYOND)
    if any(row.disturbed for row in study.rows):
        out.print(LOADED)
    spreads = study.ratio_spreads
    if not study.is_repeated:
        out.print(ONE_RUN)
    elif spreads is not None:
        out.print(
            "run: processor time of the loop, median of rounds; ratios within rounds, ± holds their median with 95 %: "
            f"{100 * spreads[0]:.1f} % in the median row, {100 * spreads[1]:.0f} % in the worst"
        )
    if study.at:
        show_rows(out, *_cells_at_errors(study), ("error [m]", "method", "integrator"), first=3)
        for x in study.at:
            if x.reason:
                out.print(f"{x.error:g} m, {x.method}, {x.integrator}: {x.reason}", style="dim")
    common = study.common_warnings
    for sentence in common:
        out.print(f"every run: {sentence}", style="dim")
    for row in study.rows:
        steps = f"rtol {row.rtol:g}" if row.rtol is not None else f"step {row.step:g} s"
        own = [sentence for sentence in row.warnings if sentence not in common]
        for sentence in (*([f"{row.status}: {row.reason}"] if row.reason else []), *own):
            out.print(f"{row.label}, {row.integrator}, {steps}: {sentence}", style="dim")


def _cells_at_errors(study: Study) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Return headings and cells of the run times at errors."""

    def value_with_quartiles(
        middle: float | None, low: float | None, high: float | None, scale: float = 1.0
    ) -> tuple[str, str]:
        if middle is None or low is None or high is None:
            return "", ""
        return f"{scale * middle:.3g}", _quartiles_cell(low, high, scale)

    ratio = f"time / {study.rows[0].label}"
    headings = "error [m]", "method", "integrator", "CPU [ms]", "quartiles", ratio, "of the ratio"
    cells = list[tuple[str, ...]]()
    for x in study.at:
        times = value_with_quartiles(x.seconds, x.seconds_low, x.seconds_high, 1e3)
        cells.append(
            (f"{x.error:g}", x.method, x.integrator, *times, *value_with_quartiles(x.ratio, x.ratio_low, x.ratio_high))
        )
    return headings, cells


#: Columns of a study; a narrow terminal shows the first ones.
_HEADINGS = (
    *(
        "method",
        "integrator",
        "step, rtol",
        "error [m]",
        "run [ms]",
        "status",
        "time / lagrange",
        "|Phi|",
        "energy [J]",
    ),
    *("evaluations", "|D v - nu|", "quartiles", "error / length", "error [m/s]", "error [N]"),
    "|Phi| / length",
)


#: Columns of bounded rows.
_CONTACT = "creep [m/s]", "transitions", "impacts", "energy lost [J]"


#: Columns of derivatives.
_GRADIENT = (
    *("run [ms]", "forward, error of derivatives", "forward [ms]", "adjoint, error", "adjoint [ms]"),
    *("differences, least error", "differences [ms]"),
)


def _gradient_cells(row: Row) -> tuple[str, ...]:
    ways = (
        (row.gradient_error, row.gradient_seconds),
        (row.adjoint_error, row.adjoint_seconds),
        (row.differences_error, row.differences_seconds),
    )
    shown = ("" if x is None else f"{1e3 * x:.3f}" if k else f"{x:.2e}" for way in ways for k, x in enumerate(way))
    return f"{1e3 * row.run_seconds:.3f}", *shown


def _contact_cells(row: Row) -> tuple[str, ...]:
    counts = ("" if x is None else str(x) for x in (row.transitions, row.impacts))
    lost = "" if row.dissipated is None else f"{row.dissipated:.9g}"
    return "" if row.creep is None else f"{row.creep:.1e}", *counts, lost


def _ratio_cell(row: Row) -> str:
    """Return the ratio with its interval as ±."""
    if row.cost_ratio is None:
        return ""
    return f"{row.cost_ratio:.2f}" + (f" ± {row.cost_ratio_spread:.2f}" if row.cost_ratio_spread is not None else "")


def _quartiles_cell(low: float | None, high: float | None, scale: float) -> str:
    return "-" if low is None or high is None else f"{scale * low:.3g} - {scale * high:.3g}"


def _cells_of_row(row: Row, on_front: bool) -> tuple[str, ...]:
    return (
        *(row.label, row.integrator, f"rtol {row.rtol:g}" if row.rtol is not None else f"{row.step:g} s"),
        "" if row.error is None else f"{row.error:.2e}" + " *" * row.below_reference + " ^" * on_front,
        *(f"{1e3 * row.run_seconds:.3f}{row.time_mark}", row.status_text, _ratio_cell(row)),
        *(f"{row.position_violation_max:.1e}", f"{row.energy_drift_max:.1e}", str(row.evaluations)),
        *(
            f"{row.velocity_violation_max:.1e}",
            _quartiles_cell(row.run_seconds_low, row.run_seconds_high, 1e3),
        ),
        *("" if x is None else f"{x:.1e}" for x in (row.relative_error, row.velocity_error, row.reaction_error)),
        "" if row.relative_violation is None else f"{row.relative_violation:.1e}",
    )


def show_across(lines: Sequence[Across]) -> None:
    """Print the statistic of methods over several mechanisms."""
    if not lines:
        return
    headings = "method", "integrator", "mechanisms", "error of lagrange / error", "95 %", "time / lagrange", "of time"
    cells = [
        (
            *(x.method, x.integrator, str(x.mechanisms), "" if x.error is None else f"{x.error:.3g}"),
            *(_quartiles_cell(x.error_low, x.error_high, 1.0), "" if x.time is None else f"{x.time:.3g}"),
            _quartiles_cell(x.time_low, x.time_high, 1.0),
        )
        for x in lines
    ]
    show_rows(make_console(), headings, cells, headings[:2], "medians over the mechanisms, with intervals", first=2)


def show_published(benchmark: Benchmark, rows: Sequence[PublishedRow]) -> None:
    """Print the problems of a library beside what was published of them."""
    out = make_console()
    out.print(benchmark.source)
    cells = [
        (
            *(row.problem, row.model, row.method, row.integrator, f"{row.rtol:g}", row.status),
            *(f"{row.error:.1e}", "-" if row.published_error is None else f"{row.published_error:.1e}"),
            *(f"{row.seconds:.2g} s", "-" if row.published_seconds is None else f"{row.published_seconds:.3g} s"),
        )
        for row in rows
    ]
    words = ("problem", "model", "method", "integrator", "rtol", "status")
    show_rows(out, (*words, "energy error [J]", "published", "run", "published"), cells, words, first=2)
    out.print(f"published: {benchmark.published}")
    out.print(
        "run: processor time of the loop on this machine; the published ones are of theirs, so their ratio is no speed"
    )
    for row in rows:
        for sentence in row.warnings:
            out.print(f"{row.problem}: {sentence}", style="dim")
