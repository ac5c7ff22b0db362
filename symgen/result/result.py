"""The result of one run: tables and facts, frozen and labelled, and the ways out of Python."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from symgen.base.arguments import kind_of_value, truth_value, words
from symgen.base.arguments import path_argument as argument_path
from symgen.base.arguments import text as text_argument
from symgen.base.errors import InputError, suggest
from symgen.base.files import check_path, write_whole
from symgen.base.memory import require_memory
from symgen.result.contract import json_contract
from symgen.result.export import SAVED, add_last_state, netcdf_writer, to_xarray, write_columns
from symgen.result.labelled import Array, Labelled, columns_at
from symgen.result.motion_tables import MotionTables
from symgen.result.signals import TABLES, acceleration_table

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from symgen.result.motion_tables import Measured
    from symgen.result.reactions import Forces
    from symgen.result.sensitivities import Sensitivities
    from symgen.run.single.events import EventRecord
    from symgen.run.single.last_state import LastState
    from symgen.run.single.outcome import Outcome, RankEvent

#: What a run can end as.
OK, UNVERIFIED, FAILED = "ok", "unverified", "failed"
#: Errors that are less beside the motion are not drawn by default.
NEGLIGIBLE = 1e-8
#: Reason of a run that was stopped from outside.
INTERRUPTED = "interrupted"


@dataclass(frozen=True)
class Rank:
    """Rank of D at the start, and rows that were left out because they repeat another row for all q."""

    rows: int
    rank: int
    identical_rows_dropped: int
    redundant_rows: tuple[str, ...] = ()


@dataclass(frozen=True)
class Seconds:
    """Times of the stages [s].

    `run` is the processor time of the integration loop alone, the best of several where repeated; other work of the
    machine changes it little. The others are on the wall.
    """

    derive: float
    emit: float
    compile: float
    run: float
    run_spread: float = 0.0


@dataclass(frozen=True, repr=False)
class Result(MotionTables):
    """Result of a run; arrays have one row an output.

    Attributes
    ----------
    mechanism, method, integrator : str
        Names of mechanism, method and integrator.
    step, rtol, atol : float or None
        Constant (or asked first) step [s], and tolerances; None where they do not apply.
    relative_atol : bool or None
        Whether `atol` counts coordinates over the mechanism's length and velocities over its speed, as the default
        does; else it is in the units of the state.
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
        Inputs of the run: numbers, or formulas and data in words.
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
    vector_width : int or None
        Numbers of a vector of the processor, where the right-hand side was evaluated in vectors.
    coordinates : {"absolute", "joint"}
        Coordinates of the state: of bodies, or of the joints of a tree.
    state : tuple of str
        Names of the coordinates and velocities that were integrated.
    watched : tuple of (str, str)
        Names of the events that the run looked for, in the file and elsewhere, and what each does: ``"record"``,
        ``"stop"`` or ``"reset"``.
    sensitivities : Sensitivities or None
        Derivatives of the motion by chosen numbers, which `gradient` returns; None where the run had none.
    error_estimate : float or None
        About how far from the exact motion a point of a body is at worst [m], by a second run with finer steps; None
        where there was none.
    unchecked : str or None
        Why there was no second run, such as ``"it took 1.2e+10 operations, more than 2e+08"``; None where there was.
    proposals : tuple of str
        Options of a run that would take fewer steps, such as ``"--integrator radau5"`` where the motion was stiff.

    Notes
    -----
    A pickled or copied result contains all tables, computed when it is pickled or copied, but neither the code
    that ran nor `outcome`, `forces` and `ended`, which belong to the process of the run.
    """

    of_process: ClassVar[tuple[str, ...]] = ("outcome", "forces", "measured", "ended")
    cached: ClassVar[tuple[str, ...]] = (
        *("non_unique_reactions", "shape", "start", "last_state"),
        "_final_multipliers",
    )

    mechanism: str
    method: str
    integrator: str
    step: float | None
    rtol: float | None
    atol: float | None
    relative_atol: bool | None
    until: float
    status: str
    reason: str | None
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    parameters: Mapping[str, float]
    t: Array
    q: Labelled
    v: Labelled
    kinetic: Array
    potential: Array
    work: Array
    energy_error: Array
    smallest_pivot: Array
    rank: Rank
    rank_events: tuple[RankEvent, ...]
    rank_event_count: int
    steps: int
    rejected: int
    evaluations: int
    iterations: int
    seconds: Seconds
    position_violation_max: float
    velocity_violation_max: float
    energy_drift_max: float
    error_estimate: float | None
    unchecked: str | None
    proposals: tuple[str, ...]
    outcome: Outcome
    forces: Forces
    measured: Measured
    ended: Callable[[], LastState]
    inputs: Mapping[str, str | float] = field(default_factory=dict)
    end: float = math.nan
    events: tuple[EventRecord, ...] = ()
    accumulation: float | None = None
    vector_width: int | None = None
    coordinates: str = "absolute"
    state: tuple[str, ...] = ()
    watched: tuple[tuple[str, str], ...] = ()
    sensitivities: Sensitivities | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the tables."""
        return tuple(TABLES)

    @property
    def drawn(self) -> tuple[str, ...]:
        """Quantities that a plot shows by default."""
        return ("q", "energy", "violations")

    @property
    def title(self) -> str:
        """Title of a plot."""
        status = self.status if self.reason is None else f"{self.status}: {self.reason}"
        return f"{self.mechanism}, {self.method}, {self.integrator} ({status})"

    def overview(self) -> Labelled:
        """Return coordinates, energies, and errors that are more than `NEGLIGIBLE` beside the motion."""
        whole = self.whole(self.drawn)
        if not len(self.t):
            return whole
        sizes = dict(zip(whole.names, np.nan_to_num(np.abs(whole.values)).max(axis=0).tolist(), strict=True))
        lengths = [sizes[name] for name, unit in zip(self.q.names, self.q.units, strict=True) if unit == "m"]
        scales = {
            "energy.error": max(sizes[f"energy.{name}"] for name in ("kinetic", "potential", "work")),
            "violation.position": max(lengths, default=0.0),
            "violation.velocity": float(np.nan_to_num(np.abs(self.v.values)).max(initial=0.0)),
        }
        small = {name for name, scale in scales.items() if sizes[name] <= NEGLIGIBLE * scale}
        small |= {"violation.acceleration"} if len(small - {"energy.error"}) == 2 else set()
        return columns_at(whole, [i for i, name in enumerate(whole.names) if name not in small])

    # -- derived at the first use --------------------------------------------------------------------------------------

    @cached_property
    def a(self) -> Labelled:
        """Accelerations v', named after the velocities: ``crank.ax``, ``crank.alpha``."""
        return acceleration_table(self.outcome.accelerations, self.v)

    @cached_property
    def violations(self) -> Labelled:
        """Norms of Phi, ``D v - nu`` and ``D v' - gamma``: ``position``, ``velocity``, ``acceleration``."""
        status = self.outcome.status_columns
        values = np.column_stack([status[:, 0], status[:, 1], self.outcome.acceleration_violations])
        return Labelled(values, ("position", "velocity", "acceleration"), ("m", "m/s", "m/s^2"))

    def reaction(self, joint: str) -> Array:
        """Return the reaction of one joint, shape (k, 3), in space (k, 6): force [N] and moment [N m]."""
        joints = list(dict.fromkeys(name.rpartition(".")[0] for name in self.reactions.names))
        if joint not in joints:
            raise InputError("joint", "the name of a joint", kind_of_value(joint), suggest(str(joint), joints))
        return self.reactions[joint]

    @cached_property
    def _final_multipliers(self) -> dict[str, float]:
        return self.forces.final()

    def gradient(self, name: str) -> Labelled:
        """Return the derivatives of a quantity over time, one column for each number in `sensitivities`.

        Parameters
        ----------
        name : str
            A column such as ``crank.theta``, ``arm.tip.x``, ``spring.force``, ``knee.F`` or ``energy.kinetic``, an
            output of the file, or a formula as in ``[outputs]``.

        Raises
        ------
        InputError
            If the run had no ``sensitivities``, or the quantity has none.
        """
        if self.sensitivities is None:
            raise InputError("gradient", "a run with sensitivities=(...)", "one without")
        return self.sensitivities.of_quantity(self, text_argument("gradient", name, "a quantity with sensitivities"))

    @property
    def interrupted(self) -> bool:
        """Whether the run was stopped from outside."""
        return self.reason == INTERRUPTED

    @property
    def ok(self) -> bool:
        """Whether the status is ``"ok"``."""
        return self.status == OK

    @cached_property
    def energy(self) -> Labelled:
        """Energies as one table: ``kinetic``, ``potential``, ``work``, ``total`` (T + V), ``error`` [J]."""
        parts = {"kinetic": self.kinetic, "potential": self.potential, "work": self.work}
        parts |= {"total": self.kinetic + self.potential, "error": self.energy_error}
        return Labelled(np.column_stack([*parts.values()]), tuple(parts), ("J",) * len(parts))

    @cached_property
    def last_state(self) -> LastState:
        """Where the run ended, with all that it kept: what another one goes on from."""
        return self.ended()

    @cached_property
    def start(self) -> dict[str, Any]:
        """State that the run began with: ``t``, and by name ``q`` and ``v``."""
        y, nq = self.outcome.start.y, len(self.q.names)
        return {
            "t": self.outcome.start.t,
            "q": dict(zip(self.q.names, y[:nq].tolist(), strict=True)),
            "v": dict(zip(self.v.names, y[nq : nq + len(self.v.names)].tolist(), strict=True)),
        }

    @cached_property
    def shape(self) -> str:
        """Return the shape of the code that ran: ``straight`` or ``looped``."""
        return self.outcome.compiled.shape

    # -- leaving Python ------------------------------------------------------------------------------------------------

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen run --json``; numbers that are not finite become None."""
        return json_contract(self)

    def to_dataframe(self) -> pd.DataFrame:
        """Return all tables as one data frame over time; columns have the names that `select` takes.

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
        return to_xarray(self)

    def run_facts(self) -> dict[str, Any]:
        """Return the settings that a page shows and begins its live part with, by the names of JSON."""
        names = ("method", "integrator", "status", "reason", "parameters", "inputs", "coordinates", "step", "until")
        return {
            **{name: getattr(self, name) for name in (*names, "start", "watched")},
            "rank_events": [asdict(event) for event in self.rank_events],
            "events": [{"t": event.t, "name": event.name} for event in self.events],
        }

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
        file = check_path("save", argument_path("save", path), SAVED, "data")
        chosen, ending, headed = words("quantities", quantities), file.suffix.lower(), truth_value("units", units)
        if headed and ending != ".csv":
            raise InputError("save: units", "a file ending in .csv, whose headings carry them", f"'{file}'")
        if chosen and ending != ".nc":
            return write_columns(file, self.t, self.select(chosen), True, {})
        size = 40.0 * len(self.t) * sum(len(self.columns(table)) for table in self.names)
        require_memory("save", f"{len(self.t)} outputs of {self.mechanism}", size)
        if ending == ".nc":
            return write_whole(file, netcdf_writer(add_last_state(to_xarray(self), self)))
        return write_columns(file, self.t, self.whole(), headed, {"run": self.to_json()})

    def __repr__(self) -> str:
        from symgen.result.summary import status_in_words

        return f"<Result of {self.mechanism}, {self.method}, {self.integrator}: {status_in_words(self)}>"

    def _repr_html_(self) -> str:
        from symgen.result.summary import summary_table

        return summary_table(self)
