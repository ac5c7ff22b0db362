"""Sweeps as lines of a table, one for each run and output time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.files import headed
from symgen.study.ensemble.row_quantities import of_quantities, of_varied
from symgen.study.ensemble.verdicts import summary_column

if TYPE_CHECKING:
    from symgen.study.ensemble.sweep_study import Sweep


def table_lines(sweep: Sweep, as_written: bool = False) -> tuple[list[str], Iterator[list[object]]]:
    """Return the heading of a table with units, and a line for each run and output time; missing numbers are empty.

    Parameters
    ----------
    sweep : Sweep
        The sweep.
    as_written : bool
        Whether parameters that vary are in the unit of the file; in SI units otherwise.
    """
    ensemble = sweep.ensemble
    grid, units = sweep.as_written() if as_written else (ensemble.grid, sweep.units())
    varied, times, quantities = grid.values(0, len(sweep)), ensemble.recipe.kept_times, ensemble.recipe.kept
    labels = of_quantities([q.name for q in quantities], ensemble.grid.axes)
    names = {name: of_varied(name, axis) for axis in ensemble.grid.axes for name in axis.values}
    events = {name: sweep.summary[:, at] for name, (at, _) in sweep.events.items()}
    heading = [
        "run",
        *(headed(names[name], units[name]) for name in varied),
        headed("t", "s"),
        *(headed(label, q.unit) for label, q in zip(labels, quantities, strict=True)),
        headed("end", "s"),
        *(headed(name, unit) for name, (_, unit) in sweep.events.items()),
        "status",
        "reason",
        "warnings",
    ]
    end = summary_column(sweep.summary, "end")

    def lines() -> Iterator[list[object]]:
        for i in range(len(sweep)):
            before = [i, *(float(x[i]) for x in varied.values())]
            behind = [float(end[i]), *(_shown(x[i]) for x in events.values()), sweep.status[i], sweep.reason[i]]
            behind.append("; ".join(sweep.warnings[i]))
            for k, t in enumerate(times):
                yield [*before, float(t), *(_shown(x) for x in sweep.values[i, :, k]), *behind]

    return heading, lines()


def _shown(x: float) -> float | None:
    return float(x) if np.isfinite(x) else None
