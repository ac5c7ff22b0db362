"""Tables over time, read by name, written to files and drawn: what runs and analyses along a motion have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, overload

import numpy as np

from symgen.base.arguments import kind_of_value, one_word_of, text, truth_value, words
from symgen.base.arguments import path_argument as argument_path
from symgen.base.errors import InputError, plural
from symgen.base.files import check_path
from symgen.describe.formulas.reported_columns import TABLES as FORMULAS
from symgen.describe.parts.columns import column_name
from symgen.result.contract import json_series
from symgen.result.export import COLUMNS, data_frame, write_columns
from symgen.result.labelled import Array, Labelled, label_columns
from symgen.result.plot import Plot, draw_or_save
from symgen.result.plots import figure_over_column
from symgen.result.signals import SignalTables, check_single, choose_columns, signals_of_formulas
from symgen.run.compiling.side import compile_side

if TYPE_CHECKING:
    import pandas as pd

    from symgen.describe.mechanism import Mechanism
    from symgen.result.player.motion_page import Page
    from symgen.result.reactions import Forces
    from symgen.run.single.outcome import Motion


@dataclass(frozen=True, repr=False)
class Measured:
    """Data from which quantities beside the state are evaluated.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism of the run.
    outcome : Motion
        States and accelerations at the outputs.
    multipliers : callable
        Returns lambda at the outputs, shape (k, m), of minimum norm where the rows of D are dependent.
    """

    mechanism: Mechanism
    outcome: Motion
    multipliers: Callable[[], Array]

    def __repr__(self) -> str:
        return f"<Measured of {self.mechanism.name} at {plural(len(self.outcome.times), 'output')}>"

    @cached_property
    def signals(self) -> SignalTables:
        """The columns of the tables that need code of their own."""
        return signals_of_formulas(self.mechanism)

    def table(self, table: str) -> Labelled:
        """Return the values of a table at the outputs."""
        columns = FORMULAS[table](self.mechanism)
        if not columns or not len(self.outcome.times):
            return label_columns(np.zeros((len(self.outcome.times), len(columns))), columns)
        formulas = [(column.name, column.formula) for column in columns]
        compiled = self.outcome.compiled
        side = compile_side(self.mechanism, compiled, table, f"the table {table} of results", formulas)
        return label_columns(self.outcome.observe_motion(side.function, len(columns), self.multipliers()), columns)


class Tables(ABC):
    """Tables over time; columns have the names that data frames of runs give them.

    A pickled or copied result contains all tables, computed when it is pickled or copied, but not the run, which
    belongs to the process that computed the motion.
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
    def drawn(self) -> tuple[str, ...]:
        """Quantities that a plot shows by default."""
        return self.names[:1]

    @property
    def signals(self) -> SignalTables:
        """Columns of the tables whose values take some computing: names are known without them."""
        return self.forces.signals

    @property
    def title(self) -> str:
        """Title of a plot."""
        return self.mechanism

    # -- multipliers and reactions -------------------------------------------------------------------------------------

    @cached_property
    def lam(self) -> Labelled:
        """Multipliers; where constraints are redundant, with minimum norm."""
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
    def body_reactions(self) -> Labelled:
        """The reactions in the axes of the bodies that they act on, with the same keys."""
        return self.forces.in_body_axes(self.reactions)

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
        """Return the keys of the columns of a table; values of a costly one are not computed for that."""
        one_word_of("table", table, self.names)
        if table not in self.__dict__ and table in self.signals:
            return tuple(signal.key for signal in self.signals[table])
        labelled: Labelled = getattr(self, table)
        return labelled.names

    @cached_property
    def _places(self) -> dict[str, tuple[str, int]]:
        """Table and place of every column, by name."""
        return {column_name(t, key): (t, i) for t in self.names for i, key in enumerate(self.columns(t))}

    def select(self, names: Sequence[str]) -> Labelled:
        """Return columns of any tables, in this order.

        Parameters
        ----------
        names : sequence of str
            Columns (``crank.theta``, ``knee.F``, ``motor.effort``, ``multiplier.A.x``), all that a body, a joint or a
            force has (``crank``, ``knee``), or tables (``q``, ``points``).

        Raises
        ------
        InputError
            If there is no such name; says the nearest one.
        """
        tables = {name: table for name, (table, _) in self._places.items()}
        return self._stack_columns(choose_columns(tables, names, self.mechanism, self.names))

    def whole(self, tables: Sequence[str] = ()) -> Labelled:
        """Return all columns of some tables, or of all of them, by the names that `select` takes."""
        chosen = tables or self.names
        if len(chosen) == 1 and chosen[0] in self.names:  # as it is, without a detour over its columns
            table: Labelled = getattr(self, chosen[0])
            return Labelled(table.values.copy(), tuple(column_name(chosen[0], key) for key in table.names), table.units)
        return self._stack_columns([name for name, (table, _) in self._places.items() if table in chosen])

    def overview(self) -> Labelled:
        """Return the columns that a plot shows by default."""
        return self.whole(self.drawn)

    def _stack_columns(self, names: Iterable[str]) -> Labelled:
        places = {name: self._places[name] for name in names}
        tables: dict[str, Labelled] = {t: getattr(self, t) for t in dict.fromkeys(t for t, _ in places.values())}
        columns = [(tables[t].values[:, i], tables[t].units[i]) for t, i in places.values()]
        values = np.column_stack([column for column, _ in columns]) if columns else np.zeros((len(self.t), 0))
        return Labelled(values, tuple(places), tuple(unit for _, unit in columns))

    def __getitem__(self, name: str) -> Array:
        """Return a column by its name: ``result["crank.x"]``, ``result["knee.F"]``, ``result["t"]``, shape (k,).

        The name of a body, a joint or a force gives all that it has, shape (k, n), whose names `select` says.
        """
        if not isinstance(name, str):
            hint = "outputs are rows: result.q.values[-1] holds the last coordinates, result.q.row(-1) by name"
            raise InputError("result", "the name of a column", kind_of_value(name), hint)
        if name == "t":
            return self.t
        if name in self._places:
            table, i = self._places[name]
            labelled: Labelled = getattr(self, table)
            return labelled.values[:, i]
        return self.select([name]).values

    def _repr_html_(self) -> str:
        return f"<p>{escape(repr(self))}</p>\n{self.whole(self.drawn)._repr_html_()}"

    # -- leaving Python ------------------------------------------------------------------------------------------------

    def to_dataframe(self) -> pd.DataFrame:
        """Return all tables as one data frame over time; ``attrs["units"]`` holds units.

        Raises
        ------
        InputError
            If pandas is not installed; says how to install it.
        """
        return data_frame(self.t, self.whole())

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
        names = words("quantities", quantities)
        chosen = self.select(names) if names else self.whole()
        return write_columns(where, self.t, chosen, True, {})

    def series(self, table: str) -> dict[str, list[float | None]]:
        """Return a table as JSON has it: lists by key; numbers that are not finite are None."""
        return json_series(getattr(self, one_word_of("table", table, self.names)))

    @overload
    def plot(self, path: None = None, what: Sequence[str] = (), over: str = "t") -> Plot: ...

    @overload
    def plot(self, path: str | PathLike[str], what: Sequence[str] = (), over: str = "t") -> Path: ...

    def plot(self, path: str | PathLike[str] | None = None, what: Sequence[str] = (), over: str = "t") -> Plot | Path:
        """Draw quantities over time, or over another quantity: a figure, or a PNG, SVG or PDF file.

        Each unit has a panel.

        Parameters
        ----------
        path : path, optional
            The file; its ending says the kind. Without one the figure comes back, which notebooks show.
        what : sequence of str, optional
            Quantities as `select` takes them: ``["motor.effort", "knee.F"]``; an overview by default.
        over : str
            The column along the horizontal axis: ``crank.theta``.

        Raises
        ------
        InputError
            If there is no such name, the ending is not known, matplotlib is missing, or the file cannot be written.
        """
        names = words("plot", what)

        def draw() -> Any:
            return figure_over_column(self.along(over), self.select(names) if names else self.overview(), self.title)

        return draw_or_save(path, draw)

    def along(self, over: str) -> Labelled:
        """Return the one column that other quantities are drawn over."""
        if text("over", over) == "t":
            return Labelled(self.t[:, np.newaxis], ("t",), ("s",))
        axis = self.select([over])
        check_single(over, axis.names)
        return axis


class MotionTables(Tables):
    """Tables of a motion: with what joints report, and the quantities that a file names."""

    measured: Measured
    q: Labelled
    parameters: Mapping[str, float]

    @abstractmethod
    def run_facts(self) -> dict[str, Any]:
        """Return the settings that a page shows and begins its live part with, by the names of JSON."""

    def view(self, beside: MotionTables | None = None, *, live: bool | str = True) -> Page:
        """Return a page that plays the motion, which notebooks show and ``.save("x.html")`` writes.

        The page is one file that works offline. Where the equations are not too large it holds them as well, so that
        sliders of parameters change the motion.

        Parameters
        ----------
        beside : Result or Kinematics, optional
            Another motion of the same mechanism, drawn faintly behind.
        live : bool or str
            Whether the page shall hold the equations; a method's name for those of this method, whose gains have
            sliders as well.

        Raises
        ------
        InputError
            If there are no outputs, `beside` is of another mechanism, or there is no such method.
        """
        from symgen.result.viewed import view_motion

        if not (beside is None or isinstance(beside, MotionTables)):
            raise InputError("beside", "a result of a run, or a motion of kinematics", kind_of_value(beside))
        return view_motion(self, beside, live if isinstance(live, str) else truth_value("live", live))

    @property
    def signals(self) -> SignalTables:
        """Columns of the tables whose values take some computing: names are known without them."""
        return self.forces.signals | self.measured.signals

    @cached_property
    def joint_coordinates(self) -> Labelled:
        """Coordinates of joints, each followed by its rate: ``JOINT.angle``, ``JOINT.angle.rate``."""
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
