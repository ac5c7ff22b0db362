"""Sweeps as lines of a table, one for each run and output time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.files import heading_with_unit
from symgen.study.ensemble.row_quantities import dataset_names, label_of_varied
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
    labels = dataset_names([q.name for q in quantities], ensemble.grid.axes)
    names = {name: label_of_varied(name, axis) for axis in ensemble.grid.axes for name in axis.values}
    events = {name: sweep.summary[:, at] for name, (at, _) in sweep.events.items()}
    heading = [
        "run",
        *(heading_with_unit(names[name], units[name]) for name in varied),
        heading_with_unit("t", "s"),
        *(heading_with_unit(label, q.unit) for label, q in zip(labels, quantities, strict=True)),
        heading_with_unit("end", "s"),
        *(heading_with_unit(name, unit) for name, (_, unit) in sweep.events.items()),
        "status",
        "reason",
        "warnings",
    ]
    end = summary_column(sweep.summary, "end")

    def lines_of_runs() -> Iterator[list[object]]:
        for i in range(len(sweep)):
            before = [i, *(float(x[i]) for x in varied.values())]
            behind = [
                float(end[i]),
                *(_finite_or_none(x[i]) for x in events.values()),
                sweep.status[i],
                sweep.reason[i],
            ]
            behind.append("; ".join(sweep.warnings[i]))
            for k, t in enumerate(times):
                yield [*before, float(t), *(_finite_or_none(x) for x in sweep.values[i, :, k]), *behind]

    return heading, lines_of_runs()


def _finite_or_none(x: float) -> float | None:
    return float(x) if np.isfinite(x) else None
