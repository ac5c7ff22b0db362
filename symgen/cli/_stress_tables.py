"""What ``symgen stress`` shows on a terminal: the map, the largest steps and the findings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from symgen.cli._columns import columns_of, console, fitting, show

if TYPE_CHECKING:
    from symgen.study.stress.stress_rows import Limit, Stress


def show_stress(study: Stress) -> None:
    """Print a stress study."""
    from symgen.study.stress.findings import findings
    from symgen.study.stress.stress_rows import LEGEND, Map

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
