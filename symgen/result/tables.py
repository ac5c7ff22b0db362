"""What a motion gives beside runs: tables over time, read by name, written to files and drawn."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.arguments import path as argument_path
from symgen.arguments import words
from symgen.describe.columns import PREFIX
from symgen.errors import MOST_LISTED, InputError, nearest
from symgen.files import headed
from symgen.result.export import PLOTTED, check_path, need
from symgen.result.labelled import Labelled

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]

#: What tables are worked out from: compiled code among it, which is no data.
_OF_THE_PROCESS = ("motion", "forces", "measured")
#: Endings of data files.
SAVED: Mapping[str, tuple[str, ...]] = {".csv": ("pandas",), ".parquet": ("pandas", "pyarrow")}


class Tables(ABC):
    """Tables over time; columns have the names that data frames of runs give them.

    What was pickled or copied holds all of its tables, worked out when that was done, but not what they are worked out
    from, which belongs to the process that found the motion.
    """

    t: Array
    mechanism: str

    @property
    @abstractmethod
    def names(self) -> tuple[str, ...]:
        """Names of the tables, those first that cost least."""

    @property
    def title(self) -> str:
        """What stands above a plot."""
        return self.mechanism

    def __getstate__(self) -> dict[str, Any]:
        for name in (*self.names, "non_unique_reactions"):
            getattr(self, name)  # kept by the instance
        return {name: value for name, value in self.__dict__.items() if name not in _OF_THE_PROCESS}

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name in _OF_THE_PROCESS and "mechanism" in self.__dict__:
                got = "one that was pickled or copied: it has its tables only"
                raise InputError(f"result.{name}", "a result of this process", got)
            raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'")

    def tables(self) -> dict[str, Labelled]:
        """Return all tables by name."""
        return {name: getattr(self, name) for name in self.names}

    def select(self, names: Sequence[str]) -> Labelled:
        """Return columns of any tables, in this order.

        Parameters
        ----------
        names : sequence of str
            Columns (``crank.theta``, ``reaction.A.Fx``), bodies or joints (``crank``), or tables (``points``).

        Raises
        ------
        InputError
            If there is no such name; says the nearest one.
        """
        found: dict[str, tuple[Array, str]] = {}
        for name in words("quantities", names):
            found |= self._named(name)
        values = [column for column, _ in found.values()]
        stacked = np.column_stack(values) if values else np.zeros((len(self.t), 0))
        return Labelled(stacked, tuple(found), tuple(unit for _, unit in found.values()))

    def __getitem__(self, name: str) -> Array:
        """Return one column of whatever table has it, or ``t``; shape (k,)."""
        if name == "t":
            return self.t
        for table in self.names:
            found: Labelled = getattr(self, table)
            if name in found.names:
                return found[name]
        return self.select([name]).values[:, 0]

    def _named(self, name: str) -> dict[str, tuple[Array, str]]:
        known = list[str]()
        if name in self.names:
            return dict(_columns(name, getattr(self, name)))
        for table in self.names:
            columns = dict(_columns(table, getattr(self, table)))
            if name in columns:
                return {name: columns[name]}
            group = {full: column for full, column in columns.items() if full.startswith(f"{name}.")}
            if group:
                return group
            known += columns
        if len(known) > MOST_LISTED and "." not in name:
            known = [*self.names, *dict.fromkeys(column.partition(".")[0] for column in known)]
        raise InputError(
            f"quantity '{name}'", f"a quantity of {self.mechanism}", "none of that name", nearest(name, known)
        )

    def to_dataframe(self) -> pd.DataFrame:
        """Return all tables as one data frame over time; ``attrs["units"]`` holds units.

        Raises
        ------
        InputError
            If pandas is not installed; says how to install it.
        """
        return self._frame(dict(c for name, table in self.tables().items() for c in _columns(name, table)), False)

    def save(self, path: str | PathLike[str], quantities: Sequence[str] = ()) -> Path:
        """Write all tables, or chosen columns, to ``.csv`` with units in its header, or ``.parquet``.

        Parameters
        ----------
        path : path
            The file; it appears whole or not at all.
        quantities : sequence of str, optional
            As `select` takes them.

        Raises
        ------
        InputError
            If the ending is not known, a library is missing, or the file cannot be written.
        """
        from symgen.files import write_whole

        where = argument_path("save", path)
        check_path("save", where, SAVED, "data")
        columns = dict[str, tuple[Array, str]]()
        for name in words("quantities", quantities) or self.names:
            columns |= self._named(name)
        if where.suffix.lower() == ".parquet":
            frame = self._frame(columns, False)
            return write_whole(where, lambda file: frame.to_parquet(file, engine="pyarrow"))
        frame = self._frame(columns, True)
        return write_whole(where, lambda file: frame.to_csv(file, mode="wb"))

    def _frame(self, columns: Mapping[str, tuple[Array, str]], units: bool) -> pd.DataFrame:
        need("to_dataframe", "pandas")
        import pandas as pd

        names = {name: headed(name, unit) if units else name for name, (_, unit) in columns.items()}
        index = pd.Index(self.t, name=headed("t", "s") if units else "t")
        frame = pd.DataFrame({names[name]: values for name, (values, _) in columns.items()}, index=index)
        frame.attrs["units"] = {names[name]: unit for name, (_, unit) in columns.items()}
        return frame

    def plot(self, path: str | PathLike[str], what: Sequence[str] = ()) -> Path:
        """Draw quantities over time into a PNG, SVG or PDF file, a panel for each unit.

        Parameters
        ----------
        path : path
            The file; its ending says the kind.
        what : sequence of str, optional
            As `select` takes them; the first table by default.
        """
        from symgen.result.plots import by_unit, over_time, write_figure

        where = argument_path("plot", path)
        check_path("plot", where, PLOTTED, "plot")
        chosen = words("plot", what) or self.names[:1]
        panels = [panel for name in chosen for panel in by_unit(self.select([name]), name)]
        return write_figure(over_time(self.t, panels, self.title), where)

    def series(self, table: str) -> dict[str, list[Any]]:
        """Return a table as JSON has it: lists by name; numbers that are not finite are None."""
        found: Labelled = getattr(self, table)
        if np.all(np.isfinite(found.values)):
            return {name: found.values[:, i].tolist() for i, name in enumerate(found.names)}
        columns = ((name, found.values[:, i].tolist()) for i, name in enumerate(found.names))
        return {name: [x if np.isfinite(x) else None for x in column] for name, column in columns}


def _columns(table: str, found: Labelled) -> Iterable[tuple[str, tuple[Array, str]]]:
    prefix = PREFIX[table]
    for i, (name, unit) in enumerate(zip(found.names, found.units, strict=True)):
        yield prefix + name, (found.values[:, i], unit)
