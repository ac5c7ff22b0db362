"""Measured data: columns over time, from files, mappings and results; how far motions are from them, also as an aim."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.sampled_motions import Reached, Sampled, Taken
from symgen.base.csv_tables import numbers_in_unit, split_heading
from symgen.base.errors import InputError, plural, quote
from symgen.result.saved import Recorded, read_recorded

Array = NDArray[np.float64]


@dataclass(frozen=True)
class MeasuredData:
    """Measured columns over time.

    Attributes
    ----------
    whence : str
        Where they are from, for messages.
    t : Array, shape (k,)
        Times [s], increasing.
    columns : mapping of str to Array
        Measured quantities by name; nan where nothing was measured.
    units : mapping of str to str
        Units of those columns whose headings have one.
    """

    whence: str
    t: Array
    columns: Mapping[str, Array]
    units: Mapping[str, str] = field(default_factory=dict)

    def in_units(self, units: Mapping[str, str]) -> MeasuredData:
        """Return the columns that are named with the units of their quantities, converted from units of the headings.

        Raises
        ------
        InputError
            If a heading has a unit of another quantity.
        """
        columns = {name: values for name, values in self.columns.items() if name in units}
        for name, values in columns.items():
            where, written = f"{self.whence}: {name}", self.units.get(name, "")
            columns[name] = np.array(numbers_in_unit(where, values.tolist(), written, units[name]))
        return replace(self, columns=columns, units={name: units[name] for name in columns})

    def measured(self, name: str) -> NDArray[np.bool_]:
        """Return at which times a quantity was measured, shape (k,)."""
        return ~np.isnan(self.columns[name])


def measured_columns(source: object, number: int = 0, where: str = "identify: data") -> MeasuredData:
    """Return measured columns: of a file, of a mapping with ``t``, or of a result.

    Raises
    ------
    InputError
        If they are no columns over increasing times, or hold infinite numbers; cells without a number are gaps.
    """
    if isinstance(source, str | Path):
        record = read_recorded(where, Path(source))
        whence, t, columns, units = record.whence, record.t, dict(record.columns), record.units
    elif isinstance(source, Recorded):
        whence, t, columns, units = source.whence, source.t, dict(source.columns), source.units
    elif isinstance(source, Mapping):
        whence = f"{where} {number + 1}"
        headings = {str(heading): split_heading(str(heading)) for heading in source}
        columns = {headings[str(name)][0]: np.asarray(values, dtype=np.float64) for name, values in source.items()}
        units = dict(headings.values())
        if "t" not in columns:
            raise InputError(whence, "a column 't' of times", "none")
        t = columns.pop("t")
        t = np.array(numbers_in_unit(f"{whence}: t", t.tolist(), units.pop("t"), "s")) if units["t"] else t
    else:
        raise InputError(where, "files, or mappings with a column 't'", f"a {type(source).__name__}")
    if len(t) == 0 or not np.all(np.diff(t) > 0.0) or not np.all(np.isfinite(t)):
        raise InputError(whence, "increasing times", "others")
    if t[0] < 0.0:
        raise InputError(whence, "times from the start of the run at 0 s on", f"{t[0]:g} s")
    for name, values in columns.items():
        if values.shape != t.shape:
            raise InputError(whence, f"{len(t)} numbers of {name}", f"an array of shape {values.shape}")
        if np.any(np.isinf(values)):
            raise InputError(whence, "finite numbers", f"others in {name}")
    return MeasuredData(whence, t, columns, units)


class Residuals:
    """Motions less measured columns, each in parts of its scale: the deviation of the data unless a weight is given.

    Parameters
    ----------
    data : sequence of MeasuredData
        Measurements, each of a motion of its own.
    units : mapping of str to str
        Columns that count, with the units of their quantities.
    weights : mapping of str to float
        Factors of residuals by column.

    Attributes
    ----------
    factors : dict of str to float
        Of each column.
    """

    def __init__(self, data: Sequence[MeasuredData], units: Mapping[str, str], weights: Mapping[str, float]) -> None:
        self.data, self.names = tuple(each.in_units(units) for each in data), tuple(units)
        self.factors = {name: weights.get(name) or 1.0 / self.deviation(name) for name in self.names}

    def deviation(self, name: str) -> float:
        """Return the standard deviation of measured numbers, or their size where they do not change."""
        values = np.concatenate([d.columns[name][d.measured(name)] for d in self.data if name in d.columns])
        if not len(values):
            raise InputError(self.data[0].whence, f"numbers of {quote(name)}", "none")
        return float(np.std(values)) or float(np.abs(values).max(initial=0.0)) or 1.0

    def names_in(self, data: MeasuredData) -> list[str]:
        """Return the columns that count of one measurement."""
        return [name for name in self.names if name in data.columns]

    @property
    def count(self) -> int:
        """Number of residuals."""
        return sum(int(data.measured(name).sum()) for data in self.data for name in self.names_in(data))

    def gaps_in_words(self) -> list[str]:
        """Return a sentence on each column with cells without a number, which are left out."""
        gaps = dict.fromkeys(self.names, 0)
        for data in self.data:
            for name in self.names_in(data):
                gaps[name] += int((~data.measured(name)).sum())
        return [f"{plural(n, 'cell')} of {quote(name)} without a number left out" for name, n in gaps.items() if n]

    def of_motion(self, data: MeasuredData, values: Array, slopes: Array) -> tuple[Array, Array]:
        """Return the residuals of a motion, one column after the other, with their derivatives.

        Parameters
        ----------
        data : MeasuredData
            One of the measurements.
        values, slopes : Array, shapes (k, columns) and (k, columns, n)
            The columns `names_in` at its times, and their derivatives.
        """
        names = self.names_in(data)
        measured = np.array([data.columns[name] for name in names]).reshape(len(names), len(data.t))
        factors, known = np.array([self.factors[name] for name in names])[:, np.newaxis], ~np.isnan(measured)
        rows = factors * (values.T - measured)
        return rows[known], (factors[..., np.newaxis] * slopes.transpose(1, 0, 2))[known]

    def by_column(self, residuals: Array) -> dict[str, list[Array]]:
        """Return residuals of all measurements by column, in its unit."""
        found, first = dict[str, list[Array]](), 0
        for data in self.data:
            for name in self.names_in(data):
                count = int(data.measured(name).sum())
                found.setdefault(name, []).append(residuals[first : first + count] / self.factors[name])
                first += count
        return found


@dataclass(frozen=True)
class ColumnAim:
    """Columns that a motion shall have at given times.

    Attributes
    ----------
    columns : Residuals
        The columns of one measurement.
    places : tuple of int
        Places of the quantities.
    """

    columns: Residuals
    places: tuple[int, ...]
    unit: str = ""
    is_bounded: bool = False

    @property
    def times(self) -> Array:
        """Times of the columns."""
        return self.columns.data[0].t

    @property
    def taken(self) -> Taken:
        """What it is called."""
        return Taken("rms", f"distance to {', '.join(self.columns.names)}")

    def residuals(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return motion less data, in parts of the scales, with derivatives; one column after the other."""
        at = np.ix_(np.searchsorted(sampled.times, self.times), self.places)
        return self.columns.of_motion(self.columns.data[0], sampled.values[at], sampled.slopes[at])

    def reached(self, sampled: Sampled) -> Reached:
        """Return the root mean square of the residuals."""
        return Reached(self.score(sampled), None)

    def score(self, sampled: Sampled) -> float:
        """Return the root mean square of the residuals."""
        return float(np.sqrt(np.mean(self.residuals(sampled)[0] ** 2)))

    def number(self, sampled: Sampled) -> tuple[float, Array]:
        """Return the mean square of the residuals, with its derivatives."""
        residuals, slopes = self.residuals(sampled)
        return float(np.mean(residuals**2)), 2.0 * residuals @ slopes / len(residuals)
