"""What ``symgen stress`` shows on a terminal: the map, the largest steps and the findings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from symgen.cli._tables import console

if TYPE_CHECKING:
    from symgen.study.stress.rows import Stress


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
        out.print(_steps(study))
    for sentence in findings(study):
        out.print(sentence)


def _steps(study: Stress) -> Table:
    table = Table(
        title="largest constant step [s] that follows the motion, and that keeps the error below 1e-3 m",
        title_justify="left",
        box=None,
        header_style="dim",
        pad_edge=False,
    )
    for heading in ("model", "case", "method", "integrator"):
        table.add_column(heading, no_wrap=True)
    for heading in ("stable", "accurate"):
        table.add_column(heading, justify="right")
    for limit in study.limits:
        steps = ("none" if x is None else f"{x:.3g}" for x in (limit.stable_step, limit.accurate_step))
        table.add_row(limit.model, f"{limit.family} {limit.case}", limit.method, limit.integrator, *steps)
    return table
