"""The last state of a run, read back from its files to go on from."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.errors import InputError
from symgen.files import unheaded
from symgen.result.export import LAST_HEADER, LAST_PREFIX
from symgen.result.saved import read_saved
from symgen.runtime.last_state import LastState

if TYPE_CHECKING:
    pass


def read_last_state(option: str, path: Path) -> LastState:
    """Return the last state of a run from a file that its result was saved to.

    A NetCDF file holds all that the run kept; of other files, and of those that hold it no more, the last outputs are
    taken.

    Raises
    ------
    InputError
        If there is no such file, or it is none of a result.
    """
    return read_saved(option, path, _of_dataset, lambda _, path: _of_columns(_last_row(path)))


def _of_dataset(option: str, path: Path) -> LastState:
    import xarray as xr

    dataset = xr.load_dataset(path, engine="h5netcdf")
    if LAST_HEADER not in dataset.attrs:
        tables = {name: dict(zip(dataset[of].values, dataset[name].values[-1], strict=True)) for name, of in _TABLES}
        return _plain(str(dataset.attrs["mechanism"]), float(dataset["time"].values[-1]), tables)
    arrays = {
        str(name).removeprefix(LAST_PREFIX): v.values
        for name, v in dataset.data_vars.items()
        if v.dims == (f"{name}_index",)
    }
    found = LastState.of_header(json.loads(dataset.attrs[LAST_HEADER]), arrays)
    if found is None:
        raise InputError(option, "the last state as it was written", f"'{path}', in which it was changed")
    return found


_TABLES = (("q", "coordinate"), ("v", "velocity"))
_SPEEDS = ("vx", "vy", "vz", "omega", "wx", "wy", "wz")
_PLACES = ("x", "y", "z", "theta", "e0", "e1", "e2", "e3")


def _last_row(path: Path) -> dict[str, float]:
    """Return the last output of a file of columns."""
    if path.suffix.lower() == ".csv":
        with path.open(encoding="utf-8", newline="") as file:
            rows = csv.reader(file)
            names, row = next(rows), next(rows)
            for following in rows:
                row = following
        return {unheaded(name): float(x) for name, x in zip(names, row, strict=True)}
    import pandas as pd

    frame = pd.read_parquet(path, engine="pyarrow")
    last = {str(name): float(x) for name, x in frame.iloc[-1].items()}
    return last | {"t": float(np.asarray(frame.index, dtype=np.float64)[-1])}


def _of_columns(last: dict[str, float]) -> LastState:
    def table(words: tuple[str, ...]) -> dict[str, Any]:
        return {name: x for name, x in last.items() if name.count(".") == 1 and name.partition(".")[2] in words}

    return _plain("", last["t"], {"q": table(_PLACES), "v": table(_SPEEDS)}, last["energy.work"])


def _plain(mechanism: str, t: float, tables: dict[str, dict[str, Any]], work: float = 0.0) -> LastState:
    q, v = ({str(name): float(x) for name, x in tables[table].items()} for table in ("q", "v"))
    return LastState(mechanism, "", t, q, v, work)
