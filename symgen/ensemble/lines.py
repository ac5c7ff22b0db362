"""The runs of an ensemble as lines of a table: one for every run and output time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from symgen.ensemble.labels import of_quantities, of_varied
from symgen.ensemble.verdicts import column
from symgen.files import headed

if TYPE_CHECKING:
    from symgen.ensemble.study import Sweep

#: Endings of files -> the libraries needed.
SAVED: Mapping[str, tuple[str, ...]] = {".nc": ("xarray", "h5netcdf", "h5py"), ".csv": ()}


def csv_of(found: Sweep) -> tuple[list[str], Iterator[list[object]]]:
    """Return the heading of a table, with units, and its lines; numbers that are not there are empty.

    Parameters
    ----------
    found : Sweep
        What an ensemble gave.
    """
    ensemble, units = found.ensemble, found.units()
    times, quantities = ensemble.recipe.spec.times, ensemble.recipe.quantities
    varied = ensemble.grid.values(0, len(found))
    labels = of_quantities([q.name for q in quantities], ensemble.grid.axes)
    names = {name: of_varied(name, axis) for axis in ensemble.grid.axes for name in axis.values}
    events = {name: found.summary[:, at] for name, (at, _) in found.events.items()}
    heading = [
        "run",
        *(headed(names[name], units[name]) for name in varied),
        headed("t", "s"),
        *(headed(label, q.unit) for label, q in zip(labels, quantities, strict=True)),
        headed("end", "s"),
        *(headed(name, unit) for name, (_, unit) in found.events.items()),
        "status",
        "reason",
        "warnings",
    ]
    end = column(found.summary, "end")

    def lines() -> Iterator[list[object]]:
        for i in range(len(found)):
            before = [i, *(float(x[i]) for x in varied.values())]
            behind = [float(end[i]), *(_shown(x[i]) for x in events.values()), found.status[i], found.reason[i]]
            behind.append("; ".join(found.warnings[i]))
            for k, t in enumerate(times):
                yield [*before, float(t), *(_shown(x) for x in found.values[i, :, k]), *behind]

    return heading, lines()


def _shown(x: float) -> float | None:
    return float(x) if np.isfinite(x) else None
