"""Smallest and largest values of a run with their times: what a reader asks first, loads before motions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.result.labelled import Labelled

if TYPE_CHECKING:
    from symgen.result.result import Result

#: Units of loads, which are shown by size.
_LOADS = ("N", "N m", "W")
#: Columns of force elements for which code is made at most: beams have thousands.
MOST_ELEMENTS = 60
#: Ending of a driver's load, beside which the size of its reaction says nothing new.
_EFFORT = ".effort"


class Extreme(NamedTuple):
    """The extremes of a quantity.

    Attributes
    ----------
    name, unit : str
        The quantity.
    low, high : float
        Its smallest and its largest value.
    low_at, high_at : float
        Their times [s].
    last : float
        The value at the last output.
    """

    name: str
    unit: str
    low: float
    low_at: float
    high: float
    high_at: float
    last: float


def extremes_of_run(result: Result, quantities: Sequence[str] = ()) -> list[Extreme]:
    """Return outputs of the file, loads by size, and coordinates of joints; of bodies where there is nothing else.

    A failed run has no loads, as its last ones tell of the failure alone. `quantities` takes the place of all that.
    """
    if quantities:
        return [*_rows(result, result.select(quantities))]
    loads = [] if result.status == "failed" else [*_loads(result)]
    rows = [*_rows(result, result.whole(("outputs",))), *loads]
    joints = result.whole(("joint_coordinates",))
    rows += (row for row in _rows(result, joints) if not row.name.endswith(".rate"))
    return rows or [*_rows(result, result.whole(("q",)))]


def without_doubles(names: Sequence[str]) -> list[int]:
    """Return the places of loads, without the sizes of reactions of drivers, whose efforts they repeat."""
    drivers = {name.removesuffix(_EFFORT) for name in names if name.endswith(_EFFORT)}
    doubled = {f"{driver}.{size}" for driver in drivers for size in ("F", "T")}
    return [i for i, name in enumerate(names) if name not in doubled]


def _loads(result: Result) -> Iterator[Extreme]:
    """Yield what drivers and force elements exert, then forces of joints, the largest first."""
    few = len(result.columns("elements")) <= MOST_ELEMENTS
    elements = result.whole(("elements",)) if few else result.select(())
    magnitudes = result.whole(("magnitudes",))
    every = (*elements.names, *magnitudes.names)
    kept = {every[i] for i in without_doubles(every)}
    for table in (elements, magnitudes):
        rows = [row for row in _rows(result, table) if row.unit in _LOADS and (row.low or row.high)]
        rows = [row for row in rows if row.name in kept]
        yield from sorted(rows, key=lambda row: (_LOADS.index(row.unit), -max(abs(row.low), abs(row.high))))


def _rows(result: Result, table: Labelled) -> Iterator[Extreme]:
    """Yield the extremes of the columns of a table that are defined at some output."""
    for name, unit, values in zip(table.names, table.units, table.values.T, strict=True):
        good: NDArray[np.int64] = np.flatnonzero(np.isfinite(values))
        if len(good):
            low, high = (int(good[place(values[good])]) for place in (np.argmin, np.argmax))
            ends = float(values[low]), float(result.t[low]), float(values[high]), float(result.t[high])
            yield Extreme(name, unit, *ends, float(values[-1]))
