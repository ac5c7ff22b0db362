"""Outcome of a run: the results of its loop, and functions of the motion evaluated at the first use."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import plural
from symgen.run.layout import abi
from symgen.run.layout.probe import rate_functions
from symgen.run.single.new_state import model_sizes
from symgen.run.single.simulation import Simulation
from symgen.run.starts.assembler import row_chooser
from symgen.run.starts.assembly import Start

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Observed, Outputs, Sizes
    from symgen.run.single.events import Happening

Array = NDArray[np.float64]


@dataclass(frozen=True)
class RankEvent:
    """A passage near a singular position, or a change of rank.

    Attributes
    ----------
    t_in, t_out : float
        Beginning and end [s].
    rank : int
        Least rank of D between them.
    smallest_pivot : float
        Of D D^T with scaled rows, between them.
    """

    t_in: float
    t_out: float
    rank: int
    smallest_pivot: float


@dataclass(frozen=True, kw_only=True)
class Motion:
    """A motion at some times, integrated or prescribed, and its functions, evaluated at the first use.

    Arrays have one row a time. `status_columns` holds |Phi|, |D v - nu|, kinetic and potential energy, smallest pivot
    and rank, then the angles that count turns. `held` are the parameters of earlier pieces, each with the last time
    at which it holds; where an input jumps, outputs have the values before it.
    """

    times: Array
    states: Array
    status_columns: Array
    compiled: CompiledModel = field(repr=False)
    start: Start = field(repr=False)
    p: Array = field(repr=False)
    w: Array = field(repr=False)
    held: tuple[tuple[float, Array], ...] = field(default=(), repr=False)

    @property
    def accelerations(self) -> Array:
        """Return v' at the outputs, shape (k, nv)."""
        return np.asarray(self._rates.accelerations)

    @property
    def multipliers(self) -> Array:
        """Return lambda at the outputs, shape (k, m)."""
        return np.asarray(self._rates.multipliers)

    @property
    def acceleration_violations(self) -> Array:
        """Return |D v' - gamma| at the outputs, shape (k,)."""
        return np.asarray(np.linalg.norm(self._rows[:, : self.compiled.info.m], axis=1))

    @property
    def joint_coordinates(self) -> Array:
        """Return value and rate of every joint coordinate in turns at the outputs, shape (k, 2 n)."""
        return self._rows[:, self.compiled.info.m :]

    @cached_property
    def _seen(self) -> tuple[Sizes, Outputs, Observed]:
        """The outputs as compiled functions take them, and room for observed values."""
        from symgen.run.layout.records import Observed, Outputs

        info, k = self.compiled.info, len(self.times)
        observed = Observed(np.zeros((k, info.nv)), np.zeros((k, info.m)), np.zeros((k, 0)))
        return model_sizes(self.compiled), Outputs(self.times, self.states, self.status_columns), observed

    @property
    def last_step(self) -> float:
        """The step for laws whose gains depend on it [s]; 1 where the motion was not integrated."""
        return 1.0

    @property
    def _rates(self) -> Observed:
        return self._rates_by_law

    @cached_property
    def _rates_by_law(self) -> Observed:
        from symgen.run.single.observe import observe_rates

        (sizes, outputs, observed), law = self._seen, self.compiled.law_module
        model, iw = (sizes, *rate_functions(law), law.accept), np.zeros(abi.N_COUNTERS, dtype=np.int64)
        w, room = self.start.w.copy(), np.zeros(2 * sizes.ny)
        w[abi.STEP_STATUS] = self.last_step
        choose = row_chooser(self.compiled) if self.start.redundant_rows else None
        for first, last, p in self.parameters:
            # the independent rows depend on the position
            for k, count in [(first, last - first)] if choose is None else [(k, 1) for k in range(first, last)]:
                here, there = _rows_of(outputs, k, k + count), _rows_of(observed, k, k + count)
                observe_rates(model, here, count, p, w, iw, there, room)
                if choose is not None and choose(w):
                    observe_rates(model, here, count, p, w, iw, there, room)
        return observed

    @property
    def parameters(self) -> list[tuple[int, int, Array]]:
        """First and last output (exclusive) of each piece, and its parameters."""
        if not self.held:
            return [(0, len(self.times), self.p)] if len(self.times) else []
        pieces, first = list[tuple[int, int, Array]](), 0
        for until, p in (*self.held, (np.inf, self.p)):
            last = int(np.searchsorted(self.times, until, side="right"))
            if last > first:
                pieces.append((first, last, p))
            first = last
        return pieces

    @cached_property
    def _rows(self) -> Array:
        return self.observe_motion(self.compiled.model.observe, self.compiled.info.observed)

    def observe_motion(self, function: Any, length: int, multipliers: Array | None = None) -> Array:
        """Return the values of a function of the motion at the outputs, shape (k, length).

        Parameters
        ----------
        function : compiled function
            Of type `symgen.run.layout.abi.OBSERVE`.
        length : int
            Number of values that it writes.
        multipliers : Array, shape (k, m), optional
            Multipliers in place of those of the law.
        """
        from symgen.run.single.observe import observe_rows

        (sizes, outputs, _), rates = self._seen, self._rates
        result = rates._replace(rows=np.zeros((len(self.times), length)))
        if multipliers is not None:
            result = result._replace(multipliers=np.ascontiguousarray(multipliers))
        room, w = np.zeros(2 * sizes.ny + length), self.w.copy()
        for first, last, p in self.parameters:
            here, there = _rows_of(outputs, first, last), _rows_of(result, first, last)
            observe_rows(function, sizes, here, last - first, p, w, there, room)
        return np.asarray(result.rows)


@dataclass(frozen=True, kw_only=True)
class PrescribedMotion(Motion):
    """A motion with its accelerations; multipliers follow from it where they are not prescribed.

    Attributes
    ----------
    prescribed_accelerations : Array, shape (k, nv)
    prescribed_multipliers : Array, shape (k, m), optional
    """

    prescribed_accelerations: Array = field(repr=False)
    prescribed_multipliers: Array | None = field(default=None, repr=False)

    @cached_property
    def _rates(self) -> Observed:
        accelerations = np.ascontiguousarray(self.prescribed_accelerations)
        if self.prescribed_multipliers is None:
            return self._rates_by_law._replace(accelerations=accelerations)
        multipliers = np.ascontiguousarray(self.prescribed_multipliers)
        return self._seen[2]._replace(accelerations=accelerations, multipliers=multipliers)

    @cached_property
    def responses(self) -> Observed:
        """Accelerations and multipliers of the law in these states, even where they are prescribed."""
        return self._rates_by_law

    def measure_motion(self) -> Array:
        """Return the status of all states, shape of `status_columns`.

        Angles that count turns keep their values; where these are nan, they are followed from state to state.
        """
        from symgen.run.single.observe import observe_status

        (sizes, outputs, _), w = self._seen, self.start.w.copy()
        status = self.status_columns.copy()
        model = self.compiled.model
        for first, last, p in self.parameters:
            here = _rows_of(outputs._replace(status=status), first, last)
            observe_status(model.geometry, model.measure, sizes, here, p, w, np.zeros(sizes.ny))
        return status


@dataclass(frozen=True, kw_only=True)
class Ended:
    """End and statistics of the loop of a run: an `Outcome`, or a row of an ensemble.

    Attributes
    ----------
    code, reason : int, str
        End code, see `symgen.run.layout.abi`, and the reason in words; empty where the run reached its end.
    smallest_pivot : float
        Of D D^T with scaled rows, over the run.
    rank_events, rank_event_count : tuple of RankEvent, int
        Recorded passages near singular positions, and the number of all passages.
    energy_drift_max, energy_jump, energy_scale : float
        Largest error of the energy balance, its largest change over a passage, and the energy in motion [J].
    counters : dict of str to int
        Counts of the emitted code by name.
    """

    code: int
    reason: str
    smallest_pivot: float
    rank_events: tuple[RankEvent, ...]
    rank_event_count: int
    energy_drift_max: float
    energy_jump: float
    energy_scale: float
    counters: dict[str, int]


@dataclass(frozen=True, kw_only=True, repr=False)
class Outcome(Motion, Ended):
    """Outcome of a run: its motion at the outputs, and the statistics of its loop.

    The last output of a run that an event has ended is at the event.
    """

    end: float
    steps: int
    rejected: int
    evaluations: int
    position_violation_max: float
    velocity_violation_max: float
    energy_start: float
    interrupted: bool
    run_seconds: float
    simulation: Simulation = field(repr=False)
    compile_seconds: float = 0.0
    cpu_seconds: float = 0.0
    happened: tuple[Happening, ...] = ()
    accumulation: float | None = None

    def __repr__(self) -> str:
        return f"<Outcome of {self.compiled.info.name}: {plural(len(self.times), 'output')} until {self.end:g} s>"

    @cached_property
    def imbalance(self) -> float:
        """Largest |M v' + D^T lambda - f| over its terms at the start and at some outputs.

        It is 0 for laws whose last operation is v' = M^-1 (f - D^T lambda). Others solve with penalties or by
        factorisations that may round M away: such a run stands still and violates nothing.
        """
        law, k = self.compiled.law_module, len(self.times)
        if not hasattr(law, "balance") or not k:
            return 0.0
        from symgen.run.layout.records import Outputs
        from symgen.run.single.observe import observe_balance

        # a run of some milliseconds has this too: without room for what is observed, which may never be
        sizes, outputs = self.simulation.sizes, Outputs(self.times, self.states, self.status_columns)
        model = (sizes, *rate_functions(law), law.accept, law.balance)
        w, iw, room = self.start.w.copy(), np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros(2 * sizes.ny)
        w[abi.STEP_STATUS] = self.last_step
        return max(  # nan ends a run before
            observe_balance(model, outputs, k, self.evaluations, first, last, p, w, iw, room)
            for first, last, p in self.parameters
        )

    @property
    def last_step(self) -> float:
        """The last step [s]."""
        return float(self.simulation.state.w[abi.STEP_STATUS]) or 1.0


def _rows_of(arrays: Any, first: int, last: int) -> Any:
    """Return a record of arrays with some of their rows."""
    return type(arrays)(*(array[first:last] for array in arrays))
