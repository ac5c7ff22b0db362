"""Results of an ensemble as a data set of xarray, over its axes and time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.files import need_library
from symgen.study.ensemble.row_quantities import (
    NUMBERS,
    check_number_name,
    dataset_names,
    dimension_name,
    label_of_varied,
)
from symgen.study.ensemble.verdicts import summary_column

if TYPE_CHECKING:
    import xarray as xr

    from symgen.study.ensemble.sweep_study import Sweep


def sweep_dataset(sweep: Sweep) -> xr.Dataset:
    """Return all results, as `symgen.study.ensemble.sweep_study.Sweep.to_xarray` does."""
    need_library("to_xarray", "xarray")
    import xarray as xr

    ensemble = sweep.ensemble
    shape, dimensions = ensemble.grid.shape, tuple(map(dimension_name, ensemble.grid.axes))
    quantities = ensemble.recipe.kept
    variables: dict[str, Any] = {
        label: ((*dimensions, "time"), sweep[q.name], {"units": q.unit})
        for label, q in zip(dataset_names([q.name for q in quantities], ensemble.grid.axes), quantities, strict=True)
    }
    variables["status"] = (dimensions, sweep.status.reshape(shape))
    variables["reason"] = (dimensions, sweep.reason.reshape(shape))
    words = np.array(["; ".join(sentences) for sentences in sweep.warnings], dtype=object)
    variables["warnings"] = (dimensions, words.reshape(shape))
    for name, (unit, counts) in NUMBERS.items():
        numbers = summary_column(sweep.summary, name).reshape(shape)
        variables[check_number_name(name)] = (
            dimensions,
            numbers.astype(np.int64) if counts else numbers,
            {"units": unit},
        )
    for name, (_, unit) in sweep.events.items():
        variables[name] = (dimensions, sweep[name], {"units": unit})
    units = sweep.units()
    coordinates: dict[str, Any] = {"time": ("time", ensemble.recipe.kept_times, {"units": "s"})}
    for axis, dimension in zip(ensemble.grid.axes, dimensions, strict=True):
        for name, values in axis.values.items():
            coordinates[label_of_varied(name, axis)] = (dimension, values, {"units": units.get(name) or "1"})
        if axis.together:
            coordinates["run"] = ("run", np.arange(len(axis)))
    attributes = {key: "none" if value is None else value for key, value in sweep.attributes.items()}
    return xr.Dataset(variables, coordinates, attributes)
