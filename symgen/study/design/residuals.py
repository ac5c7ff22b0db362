"""Columns over time as an aim: least squares, with the scales of `symgen.analyses.fit.identification`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.study.design.rows import Reached, Sampled
from symgen.study.design.wording import Taken

if TYPE_CHECKING:
    from symgen.analyses.fit.measured_data import MeasuredData
    from symgen.study.design.problem import QuantityReader
    from symgen.study.design.search import Search

Array = NDArray[np.float64]

#: Residuals of candidates without a motion, in parts of the deviation of the data.
FAR = 1e3


@dataclass(frozen=True)
class DataAim:
    """Columns that a motion shall have at given times.

    Attributes
    ----------
    data : MeasuredData
        Times and columns.
    names : tuple of str
        Columns that count.
    places : tuple of int
        Places of the quantities.
    scales : Array
        Deviation of each column, or its size where it does not change.
    """

    data: MeasuredData
    names: tuple[str, ...]
    places: tuple[int, ...]
    scales: Array
    signs: tuple[float, ...] = ()
    unit: str = ""

    @property
    def taken(self) -> Taken:
        """What it is called."""
        return Taken("rms", f"distance to {', '.join(self.names)}")

    def with_times(self, times: Array, both: bool = True) -> Array:
        """Return times with the times of the data; the latter alone unless `both`."""
        return np.union1d(times, self.data.t) if both else self.data.t

    def residuals(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return motion less data, in parts of the scales, with derivatives; one column after the other."""
        at = np.searchsorted(sampled.times, self.data.t)
        rows, slopes = list[Array](), list[Array]()
        for name, place, scale in zip(self.names, self.places, self.scales, strict=True):
            rows.append((sampled.values[at, place] - self.data.columns[name]) / scale)
            slopes.append(sampled.slopes[at, place] / scale)
        return np.concatenate(rows), np.concatenate(slopes)

    def reached(self, sampled: Sampled) -> Reached:
        """Return the root mean square of the residuals."""
        residuals, _ = self.residuals(sampled)
        return Reached(float(np.sqrt(np.mean(residuals**2))), None)

    def score(self, value: float) -> float:
        """Return a value such that less of it is better."""
        return value

    def number(self, sampled: Sampled) -> tuple[float, Array]:
        """Return the mean square of the residuals, with its derivatives."""
        residuals, slopes = self.residuals(sampled)
        return float(np.mean(residuals**2)), 2.0 * residuals @ slopes / len(residuals)

    def signed(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return nothing: the aim is one number."""
        return np.zeros(0), np.zeros((0, sampled.slopes.shape[2]))

    def fit(self, search: Search, first: Array) -> Array:
        """Return the values of least squares within bounds."""
        from scipy.optimize import least_squares

        count, n = len(self.data.t) * len(self.names), len(first)

        def both(u: Any) -> tuple[Array, Array]:
            sampled = search.sampled(u, search.even, search.even)
            if sampled is None:
                return np.full(count, np.inf), np.zeros((count, n))
            return self.residuals(sampled)

        def residuals(u: Any) -> Array:
            return both(u)[0]

        def slopes(u: Any) -> Array:
            return both(u)[1]

        inside = np.clip(first, 1e-10, 1.0 - 1e-10)
        found = least_squares(
            residuals,
            inside,
            jac=slopes,
            bounds=(0.0, 1.0),
            x_scale="jac",
            xtol=1e-12,
            ftol=1e-12,
            gtol=1e-12,
            max_nfev=100,
        )
        return np.asarray(found.x)


def data_aim(reader: QuantityReader, data: MeasuredData, until: float | None) -> DataAim:
    """Return columns over time as an aim.

    Parameters
    ----------
    reader : QuantityReader
        Reads their names.
    data : MeasuredData
        The columns.
    until : float, optional
        Last time that is asked for [s].

    Raises
    ------
    InputError
        If there are none, or they go on after the last time.
    """
    if not data.columns:
        raise InputError(data.whence, "columns of the machine over t, such as coupler.x", "none")
    if until is not None and data.t[-1] > until:
        raise InputError(data.whence, f"times up to {until:g} s", f"{data.t[-1]:g} s")
    names = tuple(data.columns)
    places = tuple(reader.place(data.whence, name) for name in names)
    return DataAim(data, names, places, _deviations(data.columns, names))


def _deviations(columns: Mapping[str, Array], names: Sequence[str]) -> Array:
    values = (columns[name] for name in names)
    return np.array([float(np.std(x)) or float(np.abs(x).max(initial=0.0)) or 1.0 for x in values])
