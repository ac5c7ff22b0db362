"""Measured data: columns over time, from files, mappings and results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symgen.base.csv_tables import numbers_in_unit, split_heading
from symgen.base.errors import InputError
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
        """Return the named columns in the units of their quantities, converted from the units of the headings.

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
