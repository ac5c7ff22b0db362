"""Results as data frames, datasets and files; pandas and xarray are imported only here, and not for CSV."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.files import heading_with_unit, need_library, write_csv, write_whole
from symgen.describe.parts.columns import column_name
from symgen.result.contract import json_contract
from symgen.result.signals import TABLES

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from symgen.result.labelled import Array, Labelled
    from symgen.result.result import Result

#: Endings of data files -> the libraries needed; those of files of columns alone.
SAVED: Mapping[str, tuple[str, ...]] = {
    ".nc": ("xarray", "h5netcdf", "h5py"),
    ".parquet": ("pandas", "pyarrow"),
    ".csv": (),
}
COLUMNS: Mapping[str, tuple[str, ...]] = {ending: SAVED[ending] for ending in (".csv", ".parquet")}
#: Endings of plots -> the libraries needed.
PLOTTED: Mapping[str, tuple[str, ...]] = dict.fromkeys((".png", ".svg", ".pdf", ".pgf"), ("matplotlib",))

#: Attribute of a NetCDF file that describes the last state, and what its variables begin with.
LAST_HEADER, LAST_PREFIX = "last_state", "last_"


def netcdf_writer(dataset: xr.Dataset) -> Callable[[io.BytesIO], object]:
    """Return the writer of a dataset to an open file as NetCDF, with a checksum for every block of numbers."""
    summed = {
        str(name): {"fletcher32": True} for name, v in dataset.variables.items() if v.dtype.kind in "fi" and v.size
    }

    def write(file: io.BytesIO) -> None:
        with _without_dask_lock():
            dataset.to_netcdf(file, engine="h5netcdf", encoding=summed)

    return write


def _without_dask_lock() -> AbstractContextManager[object]:
    """Return an option that keeps xarray from requesting a Dask lock: a file in memory has no name to lock by."""
    dask = sys.modules.get("dask")  # who has not imported it has no cluster
    return nullcontext() if dask is None else dask.config.set(scheduler="synchronous")


def add_last_state(dataset: xr.Dataset, result: Result) -> xr.Dataset:
    """Return the dataset of a result with all that the run kept: variables ``last_...``, one dimension each."""
    last = result.last_state
    arrays = {
        LAST_PREFIX + name: ((f"{LAST_PREFIX}{name}_index",), array)
        for name, array in (last.arrays or {}).items()
        if len(array)
    }
    extended = dataset.assign(arrays)
    extended.attrs[LAST_HEADER] = json.dumps(last.header())
    return extended


def data_frame(t: Array, columns: Labelled) -> pd.DataFrame:
    """Return columns over time; ``attrs["units"]`` holds units."""
    need_library("to_dataframe", "pandas")
    import pandas as pd

    frame = pd.DataFrame(columns.values, columns=list(columns.names), index=pd.Index(t, name="t"))
    frame.attrs["units"] = dict(zip(columns.names, columns.units, strict=True))
    return frame


def write_columns(path: Path, t: Array, columns: Labelled, units: bool, facts: Mapping[str, Any]) -> Path:
    """Write columns over time to a Parquet or CSV file, as the ending of the path says.

    Parameters
    ----------
    path : Path
        The file.
    t, columns : Array, Labelled
        Times [s], and the columns.
    units : bool
        Whether headings of a CSV file carry units. Cells of numbers that are none are empty there.
    facts : mapping
        What a Parquet file holds beside its columns.
    """
    if path.suffix.lower() == ".parquet":
        frame = data_frame(t, columns)
        frame.attrs.update(facts)
        return write_whole(path, lambda file: frame.to_parquet(file, engine="pyarrow"))
    names, units_of = ("t", *columns.names), ("s", *columns.units)
    heading = [heading_with_unit(*of) for of in zip(names, units_of, strict=True)] if units else names
    rows = ([time, *row] for time, row in zip(t.tolist(), columns.values.tolist(), strict=True))
    return write_csv(path, heading, ([x if x == x else None for x in row] for row in rows))


def to_xarray(result: Result) -> xr.Dataset:
    """Return all tables as variables over time, their columns and units as coordinates."""
    need_library("to_xarray", "xarray")
    import xarray as xr

    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {"time": ("time", result.t, {"units": "s"})}
    for name, table in result.tables().items():
        dimension, names = TABLES[name], tuple(column_name(name, key) for key in table.names)
        variables[name] = (("time", dimension), table.values)
        coordinates[dimension] = (dimension, _text_array(names), {})
        coordinates[f"{dimension}_unit"] = (dimension, _text_array(table.units), {})
    variables["smallest_pivot"] = (("time",), result.smallest_pivot)
    if (by := result.sensitivities) is not None:
        coordinates["direction"] = ("direction", _text_array(by.names), {})
        coordinates["direction_unit"] = ("direction", _text_array(by.units), {})
        for name in by.saved(result):
            variables[f"sensitivity_{name}"] = (("time", TABLES[name], "direction"), by.table(name))
    facts = {
        "mechanism": result.mechanism,
        "method": result.method,
        "integrator": result.integrator,
        "status": result.status,
        "reason": result.reason or "",
        "error_estimate": np.nan if result.error_estimate is None else result.error_estimate,
        "run": json.dumps(json_contract(result), allow_nan=False),
    }
    return xr.Dataset(variables, coordinates, facts)


def _text_array(names: tuple[str, ...]) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    return np.array(names, dtype=object)
