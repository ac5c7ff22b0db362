"""What ``symgen sweep`` shows on a terminal."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from symgen.cli._columns import columns_of, console, show_facts, show_parts

if TYPE_CHECKING:
    from symgen.ensemble.sweep_study import Sweep


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
