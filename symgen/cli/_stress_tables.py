"""What ``symgen stress`` shows on a terminal: the map, the largest steps and the findings."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rich.table import Table
from rich.text import Text

from symgen.cli._columns import Column, fitting, show
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
        out.print("largest constant step [s] that follows the motion, and that keeps the error below 1e-3 m")
        show(out, fitting(_steps(study), out.width))
    for sentence in findings(study):
        out.print(sentence)


def _steps(study: Stress) -> list[Column]:
    def column(heading: str, cell: Callable[[Any], str], left: bool = True, weight: int = 0) -> Column:
        return Column(heading, tuple(map(cell, study.limits)), left, weight)

    def step(x: float | None) -> str:
        return "none" if x is None else f"{x:.3g}"

    return [
        column("model", lambda limit: limit.model, weight=1),
        column("case", lambda limit: f"{limit.family} {limit.case}"),
        column("method", lambda limit: limit.method),
        column("integrator", lambda limit: limit.integrator, weight=2),
        column("stable", lambda limit: step(limit.stable_step), left=False),
        column("accurate", lambda limit: step(limit.accurate_step), left=False),
    ]
