"""Sensitivities of the rows of a sweep: each row is made again as a single run with directions."""

from __future__ import annotations

from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.free_numbers import put_numbers
from symgen.base import arguments
from symgen.base.errors import InputError, SymgenError, plural, quote, suggest
from symgen.base.files import check_path, need_library, write_whole
from symgen.describe.facts.lifted import lift_numbers
from symgen.result.build import build_result
from symgen.result.export import netcdf_writer
from symgen.result.result import FAILED
from symgen.result.sensitivities import TABLES, Differentiated, derivative_unit
from symgen.study.ensemble.row_quantities import dataset_names, dimension_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from symgen.result.result import Result
    from symgen.study.ensemble.sweep_study import Sweep

Array = NDArray[np.float64]


@dataclass(frozen=True, repr=False)
class RowSensitivities:
    """Derivatives of the quantities of a sweep by chosen numbers, with one row a run in the order of the grid.

    Attributes
    ----------
    sweep : Sweep
        The sweep.
    names, units : tuple of str
        What rows are differentiated by, and the units of that.
    quantities : tuple of str
        Quantities of the sweep that have derivatives.
    values : Array, shape (runs, quantities, times, n)
        Derivatives at the output times; nan where a run did not get there.
    status, reason : Array, shape (runs,)
        Of the runs with directions; a reason is empty where a run is ok.
    """

    sweep: Sweep
    names: tuple[str, ...]
    units: tuple[str, ...]
    quantities: tuple[str, ...]
    values: Array
    status: NDArray[np.object_]
    reason: NDArray[np.object_]

    def __repr__(self) -> str:
        return f"<Sensitivities of {plural(len(self.sweep), 'row')} to {', '.join(self.names)}>"

    def __getitem__(self, name: str) -> Array:
        """Return the derivatives of a quantity over the grid and time, shape (*grid, times, n).

        Raises
        ------
        InputError
            If it was not kept, or has no derivatives; says the nearest name.
        """
        if name not in self.quantities:
            expected = "a quantity that was kept and has derivatives"
            raise InputError(
                "sensitivities", expected, arguments.kind_of_value(name), suggest(str(name), self.quantities)
            )
        values = self.values[:, self.quantities.index(name)]
        return values.reshape(*self.sweep.ensemble.grid.shape, *values.shape[1:])

    def to_xarray(self) -> xr.Dataset:
        """Return the data set of the sweep with derivatives, which have one dimension more, ``direction``.

        Raises
        ------
        InputError
            If xarray is not installed; says how to install it.
        """
        need_library("to_xarray", "xarray")
        grid = self.sweep.ensemble.grid
        dimensions, shape = tuple(map(dimension_name, grid.axes)), grid.shape
        labels = {q.name: (label, q.unit) for label, q in _quantities_with_labels(self.sweep)}
        variables: dict[str, Any] = {}
        for name in self.quantities:
            label, unit = labels[name]
            units = "; ".join(derivative_unit(unit, own) for own in self.units)
            variables[f"sensitivity_{label}"] = ((*dimensions, "time", "direction"), self[name], {"units": units})
        for label, texts in (("status", self.status), ("reason", self.reason)):
            variables[f"sensitivity_{label}"] = (dimensions, texts.reshape(shape))
        directions = {
            "direction": ("direction", np.array(self.names, dtype=object)),
            "direction_unit": ("direction", np.array(self.units, dtype=object)),
        }
        return self.sweep.to_xarray().assign_coords(directions).assign(variables)

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the data set to a NetCDF file (``.nc``), which appears whole or not at all.

        Raises
        ------
        InputError
            If the ending is another, a library is missing, or the file cannot be written.
        """
        file = arguments.path_argument("save", path)
        check_path("save", file, {".nc": ("xarray", "h5netcdf", "h5py")}, "data")
        return write_whole(file, netcdf_writer(self.to_xarray()))


def _quantities_with_labels(sweep: Sweep) -> Any:
    quantities = sweep.ensemble.recipe.shown
    return zip(dataset_names([q.name for q in quantities], sweep.ensemble.grid.axes), quantities, strict=True)


def row_sensitivities(sweep: Sweep, by: Sequence[str]) -> RowSensitivities:
    """Return the derivatives of the rows of a sweep, as `Sweep.sensitivities` does."""
    ensemble, spec = sweep.ensemble, sweep.ensemble.recipe.spec
    names = tuple(arguments.words("sensitivities", by))
    if not names:
        raise InputError("sensitivities", "names of numbers", "none")
    if ensemble.recipe.over is not None:
        got = f"{ensemble.recipe.kept[0].name}"
        raise InputError("sensitivities", "a sweep that keeps histories or ends of quantities", quote(got))
    own = lift_numbers("sensitivities", ensemble.model.mechanism, names)
    times = spec.times.tolist()
    common = replace(ensemble.plan.settings, until=spec.until, times=times, output_step=None, verify=False)
    columns, count = ensemble.grid.values(0, len(sweep)), len(sweep)
    status, reason = np.full(count, FAILED, dtype=object), np.full(count, "", dtype=object)
    values, units, quantities = None, tuple[str, ...](), tuple[str, ...]()
    for i in range(count):
        numbers = {name: float(column[i]) for name, column in columns.items()}
        try:
            run = Differentiated(own.mechanism, put_numbers(own.mechanism, common, numbers), own.keys)
            result = run.result(build_result(run.run, run.integrate()))
        except SymgenError as error:
            if values is None:  # names, schemes and formulas are the same in all rows
                raise
            reason[i] = str(error)
            continue
        if values is None:
            quantities = _differentiable_quantities(sweep, result)
            units = result.sensitivities.units if result.sensitivities else ()
            values = np.full((count, len(quantities), len(times), len(names)), np.nan)
        status[i], reason[i] = result.status, result.reason or ""
        for k, name in enumerate(quantities):
            slopes = result.gradient(name).values
            values[i, k, : len(slopes)] = slopes[: len(times)]
    assert values is not None, "a sweep has rows"
    return RowSensitivities(sweep, names, units, quantities, values, status, reason)


def _differentiable_quantities(sweep: Sweep, result: Result) -> tuple[str, ...]:
    """Return the quantities of a sweep that have derivatives."""
    own = {name for table in TABLES for name in getattr(result, table).names}
    quantities = tuple(q.name for q in sweep.ensemble.recipe.quantities if q.name in own)
    if not quantities:
        got = ", ".join(q.name for q in sweep.ensemble.recipe.quantities) or "none"
        raise InputError("sensitivities", "a sweep that keeps a quantity with derivatives, such as coordinates", got)
    return quantities
