"""Files that results were saved to, read back as columns."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from symgen.describe.columns import PREFIX
from symgen.errors import InputError
from symgen.files import check_name, unheaded
from symgen.result.export import DIMENSIONS, LAST_HEADER, LAST_PREFIX, SAVED, need
from symgen.result.labelled import Array

_Value = TypeVar("_Value")
#: Tables of a NetCDF file that are read.
_TABLES = ("q", "v", "a", "joint_coordinates")


@dataclass(frozen=True)
class Saved:
    """The content of a file of a result.

    Attributes
    ----------
    t : Array, shape (k,)
        Times [s].
    columns : mapping of str to Array
        By the names of data frames, each of shape (k,); of a NetCDF file those of the motion.
    mechanism : str
        Its name, empty in files of columns.
    run : mapping
        Facts of the run, empty in files of columns.
    last : tuple of (mapping, mapping), or None
        Facts and arrays of the last state, in NetCDF files that hold it.
    """

    t: Array
    columns: Mapping[str, Array]
    mechanism: str = ""
    run: Mapping[str, Any] = field(default_factory=dict)
    last: tuple[dict[str, Any], dict[str, Any]] | None = None


def read_saved(option: str, path: Path, use: Callable[[Saved], _Value]) -> _Value:
    """Return what `use` makes of a file of a result.

    Parameters
    ----------
    option : str
        Option or argument, for messages.
    path : Path
        A ``.nc``, ``.parquet`` or ``.csv`` file.
    use : callable
        Called with the content; a `KeyError` means that something is missing in it.

    Raises
    ------
    InputError
        If there is no such file, or it is none of a result.
    """
    ending = path.suffix.lower()
    if ending not in SAVED:
        raise InputError(option, f"a file ending in {', '.join(SAVED)}", f"'{path}'")
    read = {".nc": _of_dataset, ".csv": _of_csv, ".parquet": _of_parquet}[ending]
    return checked(option, path, lambda path: use(read(path)), SAVED[ending])


def checked(option: str, path: Path, read: Callable[[Path], _Value], libraries: Sequence[str]) -> _Value:
    """Return what `read` makes of a file, with sentences about files that are missing or hold something else."""
    need(option, *libraries)
    check_name(option, path)
    if not path.is_file():
        raise InputError(option, "a file of a result", f"'{path}', which is none")
    try:
        return read(path)
    except InputError:
        raise
    except (OSError, ValueError, KeyError, IndexError, TypeError, StopIteration, csv.Error) as error:
        why = " ".join(str(error).split())[:80]
        raise InputError(option, "a file of a result", f"'{path}', which cannot be read as one ({why})") from None


def _of_dataset(path: Path) -> Saved:
    import xarray as xr

    dataset, columns = xr.load_dataset(path, engine="h5netcdf"), dict[str, Array]()
    for table in _TABLES:
        values = np.asarray(dataset[table].values, dtype=np.float64)
        columns |= {f"{PREFIX[table]}{name}": values[:, i] for i, name in enumerate(dataset[DIMENSIONS[table]].values)}
    last = None
    if LAST_HEADER in dataset.attrs:
        kept = {str(name): v.values for name, v in dataset.data_vars.items() if v.dims == (f"{name}_index",)}
        arrays = {name.removeprefix(LAST_PREFIX): array for name, array in kept.items()}
        last = json.loads(dataset.attrs[LAST_HEADER]), arrays
    t, facts = np.asarray(dataset["time"].values, dtype=np.float64), dataset.attrs
    return Saved(t, columns, str(facts["mechanism"]), json.loads(facts["run"]), last)


def _of_csv(path: Path) -> Saved:
    with path.open(encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        names = [unheaded(name) for name in next(rows)]
        values = np.array([[float(x or "nan") for x in row] for row in rows])
    if not len(values):
        raise ValueError("it has no rows")
    columns = {name: values[:, i] for i, name in enumerate(names)}
    return Saved(columns.pop("t"), columns)


def _of_parquet(path: Path) -> Saved:
    import pandas as pd

    frame = pd.read_parquet(path, engine="pyarrow")
    columns = {str(name): np.asarray(frame[name], dtype=np.float64) for name in frame.columns}
    return Saved(np.asarray(frame.index, dtype=np.float64), columns)
