"""The result of one run: its data, and the ways out of Python."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symgen.arguments import of_kind, switch, words
from symgen.arguments import path as argument_path
from symgen.result.run_data import RunData

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from symgen.player.motion_page import Page


@dataclass(frozen=True, repr=False)
class Result(RunData):
    """What a run gave; arrays have one row an output.

    Attributes
    ----------
    mechanism, method, integrator : str
        What was run.
    step, rtol, atol : float or None
        Constant (or asked first) step [s], and tolerances; None where they do not apply.
    until : float
        Asked end time [s].
    status : str
        ``"ok"``; ``"unverified"``: the run ended but nothing vouches for it; ``"failed"``.
    reason : str or None
        Why the status is not ok.
    warnings, notes : tuple of str
        Sentences: what to be careful with, and what was done or settled on the way.
    parameters : mapping
        Values of the mechanism's parameters.
    inputs : mapping
        What its inputs were: numbers, or formulas and data in words.
    t : Array, shape (k,)
        Output times [s].
    q, v : Labelled
        Coordinates and velocities.
    kinetic, potential, work, energy_error : Array, shape (k,)
        T, V, W (of forces without potential and of drivers) and T + V - E0 - W [J].
    smallest_pivot : Array, shape (k,)
        Of D D^T with scaled rows: how near the output is to a singular position.
    rank : Rank
        Rows and rank at the start.
    rank_events : tuple of RankEvent
        Passages near singular positions, at most 1000; `rank_event_count` counts all.
    steps, rejected, evaluations, iterations : int
        Counters: accepted and rejected steps, right-hand sides, iterations of corrections.
    seconds : Seconds
        Where the time went.
    coordinates : {"absolute", "joint"}
        What the state was made of: coordinates of bodies, or of the joints of a tree.
    state : tuple of str
        Names of the coordinates and velocities that were integrated.
    watched : tuple of (str, str)
        Names of the events that the run looked for, those of the file and others, and what each does: ``"record"``,
        ``"stop"`` or ``"reset"``.
    error_estimate : float or None
        About how far from the exact motion a point of a body is at worst [m], by a second run with finer steps; None
        where there was none.

    Notes
    -----
    A result that was pickled or copied holds all of its tables, worked out when that was done, but neither the code
    that ran nor `outcome`, `forces` and `ended`, which belong to the process of the run.
    """

    # -- leaving Python ------------------------------------------------------------------------------------------------

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen run --json``; numbers that are not finite become None."""
        from symgen.result.contract import contract

        return contract(self)

    def to_dataframe(self) -> pd.DataFrame:
        """Return all tables as one data frame over time; columns carry their table's name where it is needed.

        Raises
        ------
        InputError
            If pandas is not installed; says how to install it.
        """
        frame = super().to_dataframe()
        frame.attrs["run"] = self.to_json()
        return frame

    def to_xarray(self) -> xr.Dataset:
        """Return all tables as a dataset over time, with units and what was run; raises as `to_dataframe` does."""
        from symgen.result.export import to_xarray

        return to_xarray(self)

    def view(self, beside: Result | None = None, *, live: bool = True) -> Page:
        """Return a page that plays the motion, which notebooks show and ``.save("x.html")`` writes.

        The page is one file that works offline. Where the equations are not too large it holds them as well, so that
        sliders of parameters change the motion.

        Parameters
        ----------
        beside : Result, optional
            Another motion of the same mechanism, drawn faintly behind.
        live : bool
            Whether the page shall hold the equations.

        Raises
        ------
        InputError
            If there are no outputs, or `beside` is of another mechanism.
        """
        from symgen.result.viewed import view

        if beside is not None:
            of_kind("beside", beside, Result, "a Result")
        return view(self, beside, switch("live", live))

    def save(self, path: str | PathLike[str], quantities: Sequence[str] = (), units: bool = False) -> Path:
        """Write all tables to ``.nc`` (NetCDF), ``.parquet`` or ``.csv``; the file appears whole or not at all.

        Parameters
        ----------
        path : path
            The file; its ending says the kind.
        quantities : sequence of str, optional
            Columns to write, as `select` takes them, with units in the header of a CSV file. A ``.nc`` file always
            holds everything.
        units : bool
            Whether the header of a CSV file carries units, ``crank.theta [rad]``, also where it holds everything.

        Raises
        ------
        InputError
            If the ending is not known, the library for it is missing, or the file cannot be written.
        """
        from symgen.result.export import save

        return save(self, argument_path("save", path), words("quantities", quantities), switch("units", units))

    def plot(self, path: str | PathLike[str], what: Sequence[str] = ("positions", "energy", "violations")) -> Path:
        """Draw panels over time into a PNG, SVG or PDF file.

        Parameters
        ----------
        path : path
            The file; its ending says the kind.
        what : sequence of str
            Any of ``positions``, ``velocities``, ``energy``, ``violations``, ``reactions``.
        """
        from symgen.result.plots import plot

        return plot(self, argument_path("plot", path), words("plot", what))

    def __repr__(self) -> str:
        from symgen.result.summary import status_in_words

        return f"<Result of {self.mechanism}, {self.method}, {self.integrator}: {status_in_words(self)}>"

    def _repr_html_(self) -> str:
        from symgen.result.summary import html

        return html(self)
