"""Files that results were saved to, read back: as columns, as a recorded motion, as a last state to go on from."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from symgen.base.csv_tables import numbers_in_unit, read_csv_table, split_heading
from symgen.base.errors import InputError, quote, suggest
from symgen.base.files import check_file_name, need_library
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.parts.columns import FORMS
from symgen.describe.parts.topology import unit_of_column
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
        count turns; of files of columns all others too. Numbers are in the units of `units`.
    units : mapping of str to str
        Units that the source gives its columns, of those that have one there.
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
    units: Mapping[str, str] = field(default_factory=dict)
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

    def column(self, name: str, unit: str) -> Array:
        """Return a column in a unit, shape (k,); numbers of a column without a unit are in it already.

        Raises
        ------
        InputError
            If there is no such column, or its unit is one of another quantity.
        """
        if name not in self.columns:
            hint = suggest(name, self.columns) if self.columns else ""
            raise InputError(self.whence, "the motion of this mechanism", f"no column {quote(name)}", hint)
        written = self.units.get(name, "")
        if written in ("", unit):
            return self.columns[name]
        return np.array(numbers_in_unit(f"{self.whence}: {name}", self.columns[name].tolist(), written, unit))

    def table(self, columns: Iterable[tuple[str, str]]) -> Array:
        """Return columns by name and unit, in their order, shape (k, n).

        Raises
        ------
        InputError
            If one is missing, has a unit of another quantity, or holds numbers that are not finite.
        """
        read = [(name, self.column(name, unit)) for name, unit in columns]
        for name, values in read:
            if not np.all(np.isfinite(values)):
                raise InputError(self.whence, "finite numbers", f"others in {quote(name)}")
        return np.stack([values for _, values in read], axis=1) if read else np.zeros((len(self.t), 0))


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
        beside = sorted(p.name for p in path.parent.glob("*") if p.suffix in SAVED) if path.parent.is_dir() else []
        near = suggest(path.name, beside).partition("did you mean '")[2].removesuffix("'?")
        hint = f"did you mean '{path.parent / near}'?" if near else ""
        raise InputError(option, "a file of a result", f"'{path}', which is none", hint)
    try:
        return read(path)
    except InputError:
        raise
    except (OSError, ValueError, KeyError, IndexError, TypeError, StopIteration, RuntimeError) as error:
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
    dataset, columns, units = dataset_of(path), dict[str, Array](), dict[str, str]()
    check_names(dataset["kind_of_energy"].values.tolist())
    for table in _TABLES:
        values, names = np.asarray(dataset[table].values, dtype=np.float64), dataset[TABLES[table]].values
        columns |= {str(name): values[:, i] for i, name in enumerate(names)}
        units |= dict(zip(map(str, names), map(str, dataset[f"{TABLES[table]}_unit"].values), strict=True))
    last = None
    if LAST_HEADER in dataset.attrs:
        variables = {str(name): v.values for name, v in dataset.data_vars.items() if v.dims == (f"{name}_index",)}
        arrays = {name.removeprefix(LAST_PREFIX): array for name, array in variables.items()}
        last = json.loads(dataset.attrs[LAST_HEADER]), arrays
    t, facts = np.asarray(dataset["time"].values, dtype=np.float64), dataset.attrs
    return Recorded(whence, t, columns, units, str(facts["mechanism"]), json.loads(facts["run"]), last)


def _read_csv(path: Path, whence: str) -> Recorded:
    table = read_csv_table(whence, path)
    check_names(table.names)
    if not table.rows:
        raise ValueError("it has no rows")
    times = table.place_of_times()
    if times is None:
        named = ", ".join(map(quote, table.names[:8])) + (", ..." if len(table.names) > 8 else "")
        raise InputError(whence, "a column 't' or 'time'", f"the columns {named}")
    t = np.array(table.numbers_in_unit(times, "s"))
    own = [i for i in range(len(table.names)) if i != times and table.is_of_numbers(i)]
    columns = {table.names[i]: np.array(table.numbers(i, gaps=True)) for i in own}
    return Recorded(whence, t, columns, {table.names[i]: table.units[i] for i in own})


def _read_parquet(path: Path, whence: str) -> Recorded:
    import pandas as pd

    frame = pd.read_parquet(path, engine="pyarrow")
    check_names(list(map(str, frame.columns)))
    saved = {str(name): str(unit) for name, unit in frame.attrs.get("units", {}).items()}
    headings = {str(name): split_heading(str(name)) for name in frame.columns}
    columns = {headings[str(name)][0]: np.asarray(frame[name], dtype=np.float64) for name in frame.columns}
    units = {name: unit or saved.get(heading, "") for heading, (name, unit) in headings.items()}
    _, unit = split_heading(str(frame.index.name or ""))
    t = numbers_in_unit(f"{whence}: {frame.index.name}", np.asarray(frame.index, dtype=np.float64).tolist(), unit, "s")
    return Recorded(whence, np.array(t), columns, units)


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
    units = {name: unit for table in tables for name, unit in zip(table.names, table.units, strict=True)}
    run = {name: dict(getattr(motion, name, {})) for name in ("parameters", "inputs")}
    return Recorded("motion", np.asarray(motion.t, dtype=np.float64), columns, units, run=run)


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
        return {name: _last_number(saved, name, unit_of_column(name.rpartition(".")[2])) for name in own}

    work = 0.0 if saved.mechanism else _last_number(saved, "energy.work", "J")
    last = LastState(
        saved.mechanism, "", float(saved.t[-1]), row_of_columns(_PLACES), row_of_columns(ACCELERATIONS), work
    )
    # states of a file are columns with the names of outputs, which have no dot
    own = {name: float(column[-1]) for name, column in saved.columns.items() if "." not in name}
    return replace(last, states=own or None, state_units={name: saved.units.get(name, "") for name in own})


def _last_number(saved: Recorded, name: str, unit: str) -> float:
    """Return the last number of a column in a unit."""
    last = replace(saved, columns={key: column[-1:] for key, column in saved.columns.items()})
    return float(last.column(name, unit)[0])
