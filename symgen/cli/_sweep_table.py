"""What ``symgen sweep`` shows on a terminal."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from symgen.cli._columns import Column, in_parts, show
from symgen.cli._tables import COLOURS, console

if TYPE_CHECKING:
    from symgen.ensemble.study import Sweep


def show_sweep(found: Sweep, written: Path | None) -> None:
    """Print what an ensemble gave: axes, statuses, reasons, and the ends of what was kept."""
    import numpy as np

    facts, ensemble = found.to_json(), found.ensemble
    steps = f"step {facts['step']:g} s" if facts["rtol"] is None else f"rtol {facts['rtol']:g}"
    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(style="dim")
    table.add_column(overflow="fold")
    table.add_row("mechanism", facts["mechanism"])
    table.add_row("method", f"{facts['method']}, {facts['integrator']}, {steps}, until {facts['until']:g} s")
    for axis in ensemble.grid.axes:
        for name, values in axis.values.items():
            table.add_row("varies", f"{name}: {len(values)} values from {values.min():.6g} to {values.max():.6g}")
    rate = f", {len(found) / found.seconds:.3g} runs a second" if found.seconds > 0.0 and not found.interrupted else ""
    table.add_row("runs", f"{len(found)} in {found.seconds:.3g} s{rate}")
    for status, count in found.counts.items():
        if count:
            table.add_row("status", Text(f"{status}: {count}", style=COLOURS.get(status, "")))
    for reason, count in found.reasons():
        table.add_row("reason", f"{count} x {reason}")
    table.add_row("error", "not estimated: symgen run --verify does so for a single run")
    if written is not None and not found.interrupted:
        table.add_row("written", Text(str(written)))
    out = console()
    out.print(table)
    cells: list[tuple[str, ...]] = []
    for i, q in enumerate(ensemble.recipe.quantities[:24]):
        last = found.values[:, i, -1]
        last = last[np.isfinite(last)]
        if len(last):
            cells.append((q.name, q.unit, *(f"{x:.6g}" for x in (last.min(), last.mean(), last.max()))))
    if cells:
        headings = ("quantity", "unit", "least", "mean", "largest")
        columns = [
            Column(h, c, left=k < 2) for k, (h, c) in enumerate(zip(headings, zip(*cells, strict=True), strict=True))
        ]
        for part in in_parts(columns, out.width):
            show(out, part, "at the last output")
