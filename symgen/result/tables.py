"""Tables over time, read by name, written to files and drawn: what runs and analyses along a motion have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from symgen.arguments import one_of, shown, words
from symgen.arguments import path as argument_path
from symgen.compiling.side import compile_side
from symgen.describe.columns import PREFIX
from symgen.describe.readings import TABLES, Column
from symgen.errors import InputError, nearest, quoted
from symgen.files import check_path
from symgen.result.export import COLUMNS, PLOTTED, data_frame, write_frame
from symgen.result.labelled import Array, Labelled, labelled
from symgen.result.plots import by_unit, over_time, write_figure

if TYPE_CHECKING:
    import pandas as pd

    from symgen.describe.mechanism import Mechanism
    from symgen.result.reactions import Forces
    from symgen.runtime.outcome import Motion


@dataclass(frozen=True, repr=False)
class Measured:
    """What quantities beside the state are evaluated from.

    Attributes
    ----------
    mechanism : Mechanism
        What was run.
    outcome : Motion
        States and accelerations at the outputs.
    multipliers : callable
        Returns lambda at the outputs, shape (k, m), of minimum norm where the rows of D are dependent.
    """

    mechanism: Mechanism
    outcome: Motion
    multipliers: Callable[[], Array]

    def __repr__(self) -> str:
        return f"<Measured of {self.mechanism.name} at {len(self.outcome.times)} outputs>"

    def columns(self, table: str) -> tuple[Column, ...]:
        """Return the columns of a table of `symgen.describe.outputs`: names, units and formulas."""
        return TABLES[table](self.mechanism)

    def table(self, table: str) -> Labelled:
        """Return the values of a table at the outputs."""
        columns = self.columns(table)
        if not columns or not len(self.outcome.times):
            return labelled(np.zeros((len(self.outcome.times), len(columns))), columns)
        formulas = [(column.name, column.formula) for column in columns]
        compiled = self.outcome.compiled
        side = compile_side(self.mechanism, compiled, table, f"the table {table} of results", formulas)
        return labelled(self.outcome.observed(side.function, len(columns), self.multipliers()), columns)


#: Tables that need code of their own, and tables of forces: names of their columns are there without their values.
SIDE = ("points", "elements", "outputs")
_OF_FORCES = ("lam", "reactions", "body_reactions", "magnitudes")


class Tables(ABC):
    """Tables over time; columns have the names that data frames of runs give them.

    What was pickled or copied holds all of its tables, worked out when that was done, but not what they are worked out
    from, which belongs to the process that computed the motion.
    """

    t: Array
    mechanism: str
    forces: Forces

    #: Attributes that belong to the process: compiled code is no data. And what a copy keeps beside its tables.
    of_process: ClassVar[tuple[str, ...]] = ("motion", "forces", "measured")
    cached: ClassVar[tuple[str, ...]] = ("non_unique_reactions",)

    @property
    @abstractmethod
    def names(self) -> tuple[str, ...]:
        """Names of the tables, in the order of files."""

    @property
    def searched(self) -> tuple[str, ...]:
        """Tables in which a column is looked for by its name alone, cheap ones first."""
        return self.names

    @property
    def title(self) -> str:
        """What stands above a plot."""
        return self.mechanism

    # -- multipliers and reactions -------------------------------------------------------------------------------------

    @cached_property
    def lam(self) -> Labelled:
        """Multipliers; where constraints are redundant, those of minimum norm."""
        return self.forces.multipliers()

    @cached_property
    def reactions(self) -> Labelled:
        """Reaction of each joint on its first body: ``JOINT.Fx``, ``JOINT.Fy`` [N], ``JOINT.M`` [N m].

        In space ``JOINT.Fx`` ... ``.Fz`` and ``JOINT.Mx`` ... ``.Mz``, all in ground axes. ``-D^T lambda`` of the
        joint's rows; moments are about the joint's own point on that body, and where a kind of joint has none about
        the body's centre of mass, on the ground about the origin.
        """
        return self.forces.reactions(self.lam)

    @cached_property
    def magnitudes(self) -> Labelled:
        """Magnitudes of the reactions: ``JOINT.F`` [N] and, in space, ``JOINT.T`` [N m] of their moments."""
        return self.forces.magnitudes(self.reactions)

    @cached_property
    def non_unique_reactions(self) -> tuple[str, ...]:
        """Joints whose reactions the motion does not determine, because constraints are redundant."""
        return self.forces.non_unique

    # -- copies and other processes ------------------------------------------------------------------------------------

    def __getstate__(self) -> dict[str, Any]:
        for name in (*self.names, *self.cached):
            getattr(self, name)  # kept by the instance
        return {name: value for name, value in self.__dict__.items() if name not in self.of_process}

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name in self.of_process and "mechanism" in self.__dict__:
                got = "one that was pickled or copied: it has its tables only"
                raise InputError(f"result.{name}", "a result of this process", got)
            raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'")

    # -- columns by name -----------------------------------------------------------------------------------------------

    def tables(self) -> dict[str, Labelled]:
        """Return all tables by name."""
        return {name: getattr(self, name) for name in self.names}

    def columns(self, table: str) -> tuple[str, ...]:
        """Return the names of the columns of a table; values of a costly one are not computed for that."""
        one_of("table", table, self.names)
        if table not in self.__dict__ and table in _OF_FORCES:
            return self.forces.columns(table)
        labelled: Labelled = getattr(self, table)
        return labelled.names

    def select(self, names: Sequence[str]) -> Labelled:
        """Return columns of any tables, in this order.

        Parameters
        ----------
        names : sequence of str
            Columns of a data frame (``crank.theta``, ``lam.A.x``, ``reaction.A.Fx``, ``spring.force``), all columns of
            a body, a joint, an element or a prefix (``crank``, ``energy``), or tables (``q``, ``points``).

        Raises
        ------
        InputError
            If there is no such name; says the nearest one.
        """
        columns = {PREFIX[table] + name: table for table in self.names for name in self.columns(table)}
        chosen = choose(columns, names, self.mechanism, self.names)
        tables = {
            PREFIX[table] + name: (i, values)
            for table in dict.fromkeys(chosen.values())
            for values in (getattr(self, table),)
            for i, name in enumerate(values.names)
        }
        places = [tables[name] for name in chosen]
        stacked = [table.values[:, i] for i, table in places]
        values = np.column_stack(stacked) if stacked else np.zeros((len(self.t), 0))
        return Labelled(values, tuple(chosen), tuple(table.units[i] for i, table in places))

    def __getitem__(self, name: str) -> Array:
        """Return a column of whatever table has it: ``result["crank.x"]``, ``result["crank.omega"]``, ``result["t"]``.

        Multipliers of a joint that is called like a body are hidden by the body's coordinates here; they are in `lam`.
        Names of data frames, such as ``lam.A.x``, tell them apart.
        """
        if not isinstance(name, str):
            hint = "outputs are rows: result.q.values[-1] holds the last coordinates, result.q.row(-1) by name"
            raise InputError("result", "the name of a column", shown(name), hint)
        if name == "t":
            return self.t
        every = list[str]()
        for table in self.searched:
            names = self.columns(table)
            if name in names:
                labelled: Labelled = getattr(self, table)
                return labelled[name]
            every += names
        for table in self.names:
            if name.startswith(PREFIX[table]) and (own := name.removeprefix(PREFIX[table])) in self.columns(table):
                labelled = getattr(self, table)
                return labelled[own]
        raise InputError("result", "the name of a column", quoted(name), nearest(name, every))

    # -- leaving Python ------------------------------------------------------------------------------------------------

    def to_dataframe(self) -> pd.DataFrame:
        """Return all tables as one data frame over time; ``attrs["units"]`` holds units.

        Raises
        ------
        InputError
            If pandas is not installed; says how to install it.
        """
        return data_frame(self.t, self.select(self.names))

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
        where = argument_path("save", path)
        check_path("save", where, COLUMNS, "data")
        chosen = self.select(words("quantities", quantities) or self.names)
        return write_frame(data_frame(self.t, chosen, where.suffix.lower() == ".csv"), where)

    def plot(self, path: str | PathLike[str], what: Sequence[str] = ()) -> Path:
        """Draw quantities over time into a PNG, SVG or PDF file, a panel for each unit.

        Parameters
        ----------
        path : path
            The file; its ending says the kind.
        what : sequence of str, optional
            As `select` takes them; the first table by default.
        """
        where = argument_path("plot", path)
        check_path("plot", where, PLOTTED, "plot")
        chosen = words("plot", what) or self.names[:1]
        panels = [panel for name in chosen for panel in by_unit(self.select([name]), name)]
        return write_figure(over_time(self.t, panels, self.title), where)

    def series(self, table: str) -> dict[str, list[Any]]:
        """Return a table as JSON has it: lists by name; numbers that are not finite are None."""
        labelled: Labelled = getattr(self, one_of("table", table, self.names))
        if np.all(np.isfinite(labelled.values)):
            return {name: labelled.values[:, i].tolist() for i, name in enumerate(labelled.names)}
        columns = ((name, labelled.values[:, i].tolist()) for i, name in enumerate(labelled.names))
        return {name: [x if np.isfinite(x) else None for x in column] for name, column in columns}


class MotionTables(Tables):
    """Tables of a motion: with what joints report, and the quantities that a file names."""

    measured: Measured

    def columns(self, table: str) -> tuple[str, ...]:
        """Return the names of the columns of a table; values of a costly one are not computed for that."""
        if table in SIDE and table not in self.__dict__:
            return tuple(column.name for column in self.measured.columns(table))
        return super().columns(table)

    @cached_property
    def joint_coordinates(self) -> Labelled:
        """What joints report, each followed by its rate: ``JOINT.angle``, ``JOINT.angle.rate``."""
        motion = self.measured.outcome
        quantities = motion.compiled.info.joint_coordinates
        names = tuple(name for q in quantities for name in (q.name, f"{q.name}.rate"))
        units = tuple(unit for q in quantities for unit in (q.unit, f"{q.unit}/s"))
        return Labelled(motion.joint_coordinates, names, units)

    @cached_property
    def points(self) -> Labelled:
        """Named points of bodies in the ground frame: ``arm.tip.x``, ``.vx``, ``.ax``, ..."""
        return self.measured.table("points")

    @cached_property
    def elements(self) -> Labelled:
        """Force elements and drivers: ``spring.length``, ``.rate``, ``.force``, ``.power``; ``motor.effort``, ..."""
        return self.measured.table("elements")

    @cached_property
    def outputs(self) -> Labelled:
        """The formulas of the file's ``[outputs]``; integrals are left out where nothing is integrated."""
        return self.measured.table("outputs")


def choose(
    columns: Mapping[str, str], names: Sequence[str], mechanism: str, tables: Sequence[str] = ()
) -> dict[str, str]:
    """Return the columns that names mean, with their tables.

    Parameters
    ----------
    columns : mapping of str to str
        All columns, with their tables.
    names : sequence of str
        See `Tables.select`.
    mechanism : str
        Its name, for the message.
    tables : sequence of str
        Tables that may be named although they have no columns.

    Raises
    ------
    InputError
        If there is no such name; says the nearest one.
    """
    chosen, groups = dict[str, str](), dict.fromkeys((*columns.values(), *tables))
    for name in words("quantities", names):
        if name in columns:
            matches = {name: columns[name]}
        elif name in groups:
            matches = {column: table for column, table in columns.items() if table == name}
        else:
            matches = {column: table for column, table in columns.items() if column.startswith(f"{name}.")}
        if not matches and name not in tables:
            groups |= dict.fromkeys(column.partition(".")[0] for column in columns)
            candidates = [*columns, *groups] if len(columns) <= 60 or "." in name else [*groups]
            expected = f"a quantity of {mechanism}"
            raise InputError(f"quantity '{name}'", expected, "none of that name", nearest(name, candidates))
        chosen |= matches
    return chosen
