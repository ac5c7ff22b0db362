"""Tables as a terminal shows them: every name and number whole, wide tables in parts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from symgen.base.digits import digits, format_column, scale_of
from symgen.base.errors import InputError, fit_lines, plural

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from symgen.result.labelled import Labelled
    from symgen.result.result import Result
    from symgen.study.comparison.across import Across
    from symgen.study.comparison.compare_models import Study
    from symgen.study.comparison.comparison_rows import Row
    from symgen.study.ensemble.sweep_study import Sweep
    from symgen.study.stress.stress_rows import Stress


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
    listed = list(rows)
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
        table.add_row(label, Text(text, COLOURS.get(status, "")))
    out.print(table)


def show_result(result: Result) -> None:
    """Print the result of a run."""
    from symgen.cli import in_terms_of_options
    from symgen.result.summary import summary_lines

    out = make_console()
    show_facts(out, [(label, in_terms_of_options(text)) for label, text in summary_lines(result)])
    if len(result.t):
        _show_extremes(out, result)


def show_quantities(quantities: Mapping[str, Mapping[str, Any]], tables: Iterable[Labelled] = ()) -> None:
    """Print last, smallest and largest values of quantities.

    Rounding is shown as 0 beside what `tables` of the same motion have of that unit; for a moment, force times length.
    """
    from symgen.result.labelled import common_scales

    rows, scales = list[tuple[str, ...]](), common_scales(tables)
    for name, entry in quantities.items():
        values = [entry[key] for key in ("final", "min", "max")]
        scale = scale_of((x for x in values if x is not None), entry["unit"])
        scale = max(scale, scales.get(entry["unit"], 0.0), entry.get("scale", 0.0))
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


def _show_extremes(out: Console, result: Result, most: int = 12) -> None:
    """Print smallest and largest values with their times, of the first quantities where there are many."""
    from symgen.result.extremes import extremes_of_run
    from symgen.result.labelled import common_scales

    found, scales = extremes_of_run(result), common_scales((result.q, result.v, result.lam))
    first, rows = fit_lines(len(found), most), list[tuple[str, ...]]()
    for each in found[:first]:
        scale = max(scale_of((each.low, each.high), each.unit), scales.get(each.unit, 0.0))
        cells = digits(each.low, scale), f"{each.low_at:.4g}", digits(each.high, scale), f"{each.high_at:.4g}"
        rows.append((each.name, *cells, each.unit))
    headings = ("quantity", "smallest", "at t [s]", "largest", "at t [s]", "unit")
    show_rows(out, headings, rows, left=("quantity", "unit"))
    if len(found) > first:
        click.echo(f"... {len(found) - first} more; --quantity chooses, --json has the final state")


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


def show_stress(study: Stress) -> None:
    """Print a stress study."""
    from symgen.study.stress.beside import beside_yardstick, cells_beside, extremes_beside, families_beside
    from symgen.study.stress.findings import findings_of_study
    from symgen.study.stress.stress_rows import LEGEND, Map

    out = make_console()
    out.print(f"{', '.join(study.models)}: {plural(len(study.rows), 'cell')}")
    shown = Map.of_study(study)
    if shown.rows:
        headings = ("method", "integrator", *(family.replace("-", " ") for family in shown.families))
        rows = [(*line, *(shown.entry(line, family).text for family in shown.families)) for line in shown.lines]
        show_rows(out, headings, rows, headings, first=2)
        out.print(f"accurate cells of those judged; {LEGEND}", style="dim")
    lines = beside_yardstick(study)
    if len(lines) > 1:
        (families, searched), extremes = families_beside(lines), extremes_beside(lines)
        headings = (
            *("methods", "integrator", *(family.replace("-", " ") for family in families)),
            *(f"step, {family}" for family in searched),
            *(f"up to, {family}" for family in extremes),
        )
        cells = [(", ".join(x.methods), x.integrator, *cells_beside(x, families, searched, extremes)) for x in lines]
        title = (
            "error of lagrange with the same integrator over the error: medians; largest steps that follow [s]; "
            "extreme values up to which runs are accurate"
        )
        show_rows(out, headings, cells, headings[:2], title, first=2)
    if study.limits:
        out.print("largest constant step [s] that follows the motion, and with an error below 1e-3 of the length")
        steps = [["none" if h is None else f"{h:.3g}" for h in (x.stable_step, x.accurate_step)] for x in study.limits]
        words = [(x.model, f"{x.family} {x.case}", x.method, x.integrator) for x in study.limits]
        headings = ("model", "case", "method", "integrator", "stable", "accurate")
        show_rows(out, headings, [(*a, *b) for a, b in zip(words, steps, strict=True)], headings[:4], first=4)
    for sentence in findings_of_study(study):
        out.print(sentence)


def show_contributions(study: Sweep) -> None:
    """Print what each varied number contributes to the variance of the kept quantities, where enough runs have them."""
    names = list(study.ensemble.grid.names)[:8]
    rows = list[tuple[str, ...]]()
    for q in study.ensemble.recipe.kept[:24]:
        try:
            shares = study.contributions(q.name)
        except InputError:  # too few runs
            continue
        if any(shares.values()):
            rows.append(
                (q.name, *(f"{100.0 * shares[name]:.1f}" for name in names), f"{100 * sum(shares.values()):.1f}")
            )
    if rows:
        headings = ("quantity", *names, "together")
        show_rows(make_console(), headings, rows, headings[:1], "share of the variance [%], by straight lines")


def show_sweep(study: Sweep, written: Path | None) -> None:
    """Print the results of an ensemble: axes, statuses, reasons, and final values of the kept quantities."""
    import numpy as np

    from symgen.study.ensemble.samples import PERCENTILES, has_samples

    facts, ensemble = study.to_json(), study.ensemble
    steps = f"step {facts['step']:g} s" if facts["rtol"] is None else f"rtol {facts['rtol']:g}"
    rate = f", {len(study) / study.seconds:.3g} runs a second" if study.seconds > 0.0 and not study.interrupted else ""
    grid, units = study.as_written()
    axes = [item for axis in grid.axes for item in axis.values.items()]

    def range_of_values(name: str, x: NDArray[np.float64]) -> str:
        return f"{x.min():.6g} to {x.max():.6g} {units[name]}".strip()

    lines = [
        ("mechanism", facts["mechanism"]),
        ("method", f"{facts['method']}, {facts['integrator']}, {steps}, until {facts['until']:g} s"),
        *(("varies", f"{name}: {plural(len(x), 'value')} from {range_of_values(name, x)}") for name, x in axes),
        ("runs", f"{len(study)} in {study.seconds:.3g} s{rate}"),
        *(("status", f"{status}: {count}") for status, count in study.counts.items() if count),
        *(("reason", f"{count} x {reason}") for reason, count in study.reasons()),
        ("error", "not estimated: symgen run --verify does so for a single run"),
        *([("written", str(written))] if written is not None and not study.interrupted else []),
    ]
    out = make_console()
    show_facts(out, lines)
    rows, sampled = list[tuple[str, ...]](), has_samples(ensemble.grid)
    for i, q in enumerate(ensemble.recipe.kept[:24]):
        last = study.values[:, i, -1]
        last = last[np.isfinite(last)]
        if len(last):
            middle = np.percentile(last, PERCENTILES) if sampled else [last.mean()]
            rows.append((q.name, q.unit, *format_column([last.min(), *middle, last.max()], q.unit)))
    if rows:
        between = [f"{share:g} %" for share in PERCENTILES] if sampled else ["mean"]
        headings = ("quantity", "unit", "least", *between, "largest")
        show_rows(out, headings, rows, headings[:2], "at the last output")
    if sampled:
        show_contributions(study)
