"""Files that results were saved to, read back: as columns, as a recorded motion, as a last state to go on from."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from symgen.base.errors import InputError, quote
from symgen.base.files import check_csv_rows, check_file_name, name_without_unit, need_library
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.parts.columns import FORMS
from symgen.result.export import LAST_HEADER, LAST_PREFIX, SAVED
from symgen.result.labelled import Array
from symgen.result.signals import TABLES
from symgen.run.single.last_state import LastState

if TYPE_CHECKING:
    import xarray as xr

_Value = TypeVar("_Value")
#: Most bytes in one of a file, as the compression that NetCDF has can be.
DENSEST = 1032
#: Tables of a NetCDF file that are read.
_TABLES = ("q", "v", "a", "joint_coordinates", "outputs")
#: Variables of a NetCDF file that are loaded, beside those of the last state.
_READ = frozenset({"time", *TABLES, *TABLES.values(), *(f"{dimension}_unit" for dimension in TABLES.values())})


@dataclass(frozen=True)
class Recorded:
    """A recorded motion, of a run or of a file that its result was saved to.

    Attributes
    ----------
    whence : str
        Where it is from, for messages.
    t : Array, shape (k,)
        Times [s].
    columns : mapping of str to Array
        By name, each of shape (k,): coordinates, velocities, accelerations, and coordinates of joints, where angles
        count turns; of files of columns all others too.
    mechanism : str
        Its name, empty in files of columns.
    run : mapping
        Facts of the run by the names of JSON, empty in files of columns.
    last : tuple of (mapping, mapping), or None
        Facts and arrays of the last state, in NetCDF files that hold it.
    """

    whence: str
    t: Array
    columns: Mapping[str, Array]
    mechanism: str = ""
    run: Mapping[str, Any] = field(default_factory=dict)
    last: tuple[dict[str, Any], dict[str, Any]] | None = None

    @property
    def parameters(self) -> Mapping[str, float]:
        """Values of parameters in the run, as far as they are recorded."""
        return dict(self.run.get("parameters", {}))

    @property
    def inputs(self) -> Mapping[str, float | str]:
        """Values of inputs in the run, in words where they were no numbers."""
        return dict(self.run.get("inputs", {}))

    def table(self, names: Sequence[str]) -> Array:
        """Return columns in an order, shape (k, n).

        Raises
        ------
        InputError
            If one is missing, or holds numbers that are not finite.
        """
        for name in names:
            if name not in self.columns:
                raise InputError(self.whence, "the motion of this mechanism", f"no column {quote(name)}")
        values = np.zeros((len(self.t), len(names)))
        for i, name in enumerate(names):
            values[:, i] = self.columns[name]
        if not np.all(np.isfinite(values)):
            raise InputError(self.whence, "finite numbers", "others")
        return values


def _read_or_refuse(option: str, path: Path, use: Callable[[Recorded], _Value]) -> _Value:
    """Return the value of `use` for a file of a result; a `KeyError` means that something is missing in it."""
    ending = path.suffix.lower()
    if ending not in SAVED:
        raise InputError(option, f"a file ending in {', '.join(SAVED)}", f"'{path}'")
    read = {".nc": _read_dataset, ".csv": _read_csv, ".parquet": _read_parquet}[ending]
    return read_result_file(option, path, lambda path: use(read(path, f"{option} '{path.name}'")), SAVED[ending])


def read_result_file(option: str, path: Path, read: Callable[[Path], _Value], libraries: Sequence[str]) -> _Value:
    """Return the value of `read` for a file, with sentences about files that are missing or hold something else."""
    need_library(option, *libraries)
    check_file_name(option, path)
    if not path.is_file():
        raise InputError(option, "a file of a result", f"'{path}', which is none")
    try:
        return read(path)
    except InputError:
        raise
    except (OSError, ValueError, KeyError, IndexError, TypeError, StopIteration, RuntimeError, csv.Error) as error:
        why = " ".join(str(error).split())[:80]
        raise InputError(option, "a file of a result", f"'{path}', which cannot be read as one ({why})") from None


def check_names(columns: Sequence[str]) -> None:
    """Refuse columns of a version that called other things so: its energies had no sum, and their own names."""
    if {"kinetic", "energy.kinetic"} & set(columns) and {"error", "energy.error"} & set(columns):
        if "energy.total" not in columns:
            raise ValueError("it is of an older version, whose columns had other names")


def dataset_of(path: Path) -> xr.Dataset:
    """Return the content of a NetCDF file; libraries raise errors of many types where it is damaged."""
    import h5py
    import xarray as xr

    most = DENSEST * path.stat().st_size
    with h5py.File(path) as file:  # without it, h5netcdf leaves an object that prints a traceback when it is deleted
        for name, variable in file["/"].items():
            if (name in _READ or name.startswith(LAST_PREFIX)) and getattr(variable, "nbytes", 0) > most:
                raise ValueError(f"'{name}' has {variable.nbytes:.2g} bytes, more than such a file can hold")
    with xr.open_dataset(path, engine="h5netcdf") as dataset:
        sizes = json.loads(dataset.attrs.get(LAST_HEADER, "{}")).get("sizes", {})
        last = {LAST_PREFIX + name: size for name, (_, size) in sizes.items()}
        own = [name for name, v in dataset.data_vars.items() if name in TABLES or last.get(str(name)) == v.size]
        for name in own:
            _check_table(str(name), dataset[name])
        return dataset[own].load()  # other variables may be larger than the memory


def _check_table(name: str, variable: xr.DataArray) -> None:
    """Refuse a table that is none of numbers over time and its labels."""
    if name in TABLES and (variable.dims != ("time", TABLES[name]) or variable.dtype.kind not in "fiu"):
        raise ValueError(f"'{name}' is no table of numbers over time and {TABLES[name]}")
    if name in TABLES and variable.size and TABLES[name] not in variable.coords:
        raise ValueError(f"'{name}' has no labels {TABLES[name]}")


def _read_dataset(path: Path, whence: str) -> Recorded:
    dataset, columns = dataset_of(path), dict[str, Array]()
    check_names(dataset["kind_of_energy"].values.tolist())
    for table in _TABLES:
        values = np.asarray(dataset[table].values, dtype=np.float64)
        columns |= {str(name): values[:, i] for i, name in enumerate(dataset[TABLES[table]].values)}
    last = None
    if LAST_HEADER in dataset.attrs:
        variables = {str(name): v.values for name, v in dataset.data_vars.items() if v.dims == (f"{name}_index",)}
        arrays = {name.removeprefix(LAST_PREFIX): array for name, array in variables.items()}
        last = json.loads(dataset.attrs[LAST_HEADER]), arrays
    t, facts = np.asarray(dataset["time"].values, dtype=np.float64), dataset.attrs
    return Recorded(whence, t, columns, str(facts["mechanism"]), json.loads(facts["run"]), last)


def _read_csv(path: Path, whence: str) -> Recorded:
    with path.open(encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        names, cells = [name_without_unit(name) for name in next(rows)], list(rows)
    check_names(names)
    check_csv_rows(whence, names, cells)
    values = np.array([[float(x or "nan") for x in row] for row in cells])
    if not len(values):
        raise ValueError("it has no rows")
    columns = {name: values[:, i] for i, name in enumerate(names)}
    return Recorded(whence, columns.pop("t"), columns)


def _read_parquet(path: Path, whence: str) -> Recorded:
    import pandas as pd

    frame = pd.read_parquet(path, engine="pyarrow")
    check_names(list(map(str, frame.columns)))
    columns = {str(name): np.asarray(frame[name], dtype=np.float64) for name in frame.columns}
    return Recorded(whence, np.asarray(frame.index, dtype=np.float64), columns)


def recorded_motion(motion: Any) -> Recorded:
    """Return the motion of a result, or of whatever has the tables ``q``, ``v`` and ``a`` over ``t``.

    Raises
    ------
    InputError
        If it has not.
    """
    if isinstance(motion, Recorded):
        return motion
    if not all(hasattr(motion, name) for name in ("t", "q", "v", "a")):
        raise InputError("motion", "a result of a run, or a motion of kinematics", f"a {type(motion).__name__}")
    tables = [getattr(motion, name) for name in _TABLES if hasattr(motion, name)]
    columns = {name: table.values[:, i] for table in tables for i, name in enumerate(table.names)}
    run = {name: dict(getattr(motion, name, {})) for name in ("parameters", "inputs")}
    return Recorded("motion", np.asarray(motion.t, dtype=np.float64), columns, run=run)


def read_recorded(option: str, path: Path) -> Recorded:
    """Return the motion that a file of a result holds.

    Parameters
    ----------
    option : str
        Option or argument, for messages.
    path : Path
        A ``.nc``, ``.parquet`` or ``.csv`` file with all columns of coordinates, velocities and accelerations.

    Raises
    ------
    InputError
        If there is no such file, or it is none of a result.
    """
    return _read_or_refuse(option, path, lambda motion: motion)


_OF_BODY = re.compile(r"(\w+)(\.(?:start|end|[0-9]+))?\.(\w+)")
_PLACES = ("x", "y", "z", "theta", "e0", "e1", "e2", "e3")


def read_last_state(option: str, path: Path) -> LastState:
    """Return the last state of a run from a file that its result was saved to.

    A NetCDF file holds all that the run kept; of other files, and of those that hold it no more, the last outputs are
    taken.

    Raises
    ------
    InputError
        If there is no such file, or it is none of a result.
    """

    def last_state_of(saved: Recorded) -> LastState:
        if saved.last is None:
            return _state_of_columns(saved)
        last = LastState.of_header(*saved.last)
        if last is None:
            raise InputError(option, "the last state as it was written", f"'{path}', in which it was changed")
        return last

    return _read_or_refuse(option, path, last_state_of)


def _state_of_columns(saved: Recorded) -> LastState:
    def row_of_columns(labels: Iterable[str]) -> dict[str, float]:
        # bodies have names without a dot, nodes of beams with one, which no head of a table precedes
        heads = {form.partition(".")[0] for form in FORMS.values()}
        own = (
            name
            for name in saved.columns
            if (m := _OF_BODY.fullmatch(name)) and m[3] in labels and not (m[2] and m[1] in heads)
            if not (m[2] and f"{m[1]}.{m[3]}" in saved.columns)
        )
        return {name: float(saved.columns[name][-1]) for name in own}

    work = 0.0 if saved.mechanism else float(saved.columns["energy.work"][-1])
    last = LastState(
        saved.mechanism, "", float(saved.t[-1]), row_of_columns(_PLACES), row_of_columns(ACCELERATIONS), work
    )
    # states of a file are columns with the names of outputs, which have no dot
    own = {name: float(column[-1]) for name, column in saved.columns.items() if "." not in name}
    return replace(last, states=own or None)
