"""One run: a start, a loop in a thread that can be stopped, and what is observed at its outputs."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.integrators._base import State
from symgen.ir.program import COUNTERS
from symgen.runtime import abi
from symgen.runtime.assembly import Start
from symgen.store.stats import cache_stats

if TYPE_CHECKING:
    from symgen.integrators._base import Integrator, LoopCall
    from symgen.model import CompiledModel

Array = NDArray[np.float64]

#: A pivot of D D^T (rows scaled) below this is near a singular position; as in `symgen.lower.algebra`.
WARN = 1e-4


@dataclass(frozen=True)
class RunSpec:
    """What a run is to do.

    Parameters
    ----------
    until : float
        End time [s]; the start is at 0.
    step : float or None
        Constant step, or first step of an adaptive run [s]; None lets an adaptive run choose.
    adaptive : bool
        Whether steps follow the error estimate.
    rtol, atol : float
        Tolerances of an adaptive run.
    times : Array
        Output times, increasing.
    largest_step : float
        Bound of adaptive steps [s].
    max_violation : float
        Largest |Phi| (times the largest coordinate) and |D v - nu| (times the largest speed) that is tolerated.
    max_velocity_violation : float or None
        The limit of |D v - nu| where it is another one.
    max_energy_error : float
        Largest energy error that is tolerated, as a fraction of the energy in motion.
    integrator_parameters : mapping
        Values of the integrator's parameters that differ from the defaults.
    max_evaluations : int or None
        The run is stopped some time after it took more right-hand sides than this.
    """

    until: float
    step: float | None
    adaptive: bool
    times: Array
    rtol: float = 1e-8
    atol: float = 1e-10
    largest_step: float = np.inf
    max_violation: float = 1e-6
    max_velocity_violation: float | None = None
    max_energy_error: float = 0.05
    integrator_parameters: Mapping[str, float] = field(default_factory=dict)
    max_evaluations: int | None = None

    @property
    def velocity_limit(self) -> float:
        """Largest |D v - nu| that is tolerated, as a fraction of the largest speed."""
        return self.max_violation if self.max_velocity_violation is None else self.max_velocity_violation


@dataclass(frozen=True)
class RankEvent:
    """A passage near a singular position, or a change of rank."""

    t_in: float
    t_out: float
    rank: int
    smallest_pivot: float


@dataclass(frozen=True)
class Outcome:
    """What a run gave; arrays have one row an output.

    `status_columns` holds |Phi|, |D v - nu|, kinetic and potential energy, smallest pivot and rank. What needs further
    evaluations at the outputs is computed when it is first asked for.
    """

    code: int
    reason: str
    end: float
    times: Array
    states: Array
    status_columns: Array
    steps: int
    rejected: int
    evaluations: int
    counters: dict[str, int]
    position_violation_max: float
    velocity_violation_max: float
    energy_start: float
    energy_drift_max: float
    energy_scale: float
    energy_jump: float
    smallest_pivot: float
    rank_events: tuple[RankEvent, ...]
    rank_event_count: int
    interrupted: bool
    run_seconds: float
    compile_seconds: float
    compiled: CompiledModel = field(repr=False)
    start: Start = field(repr=False)
    p: Array = field(repr=False)
    w: Array = field(repr=False)

    @property
    def accelerations(self) -> Array:
        """Return v' at the outputs, shape (k, nv)."""
        return self._rates[0]

    @property
    def multipliers(self) -> Array:
        """Return lambda at the outputs, shape (k, m)."""
        return self._rates[1]

    @property
    def acceleration_violations(self) -> Array:
        """Return |D v' - gamma| at the outputs, shape (k,)."""
        return np.asarray(np.linalg.norm(self._rows[:, : self.compiled.info.m], axis=1))

    @property
    def joint_coordinates(self) -> Array:
        """Return value and rate of every joint coordinate in turns at the outputs, shape (k, 2 n)."""
        return self._rows[:, self.compiled.info.m :]

    @property
    def _angles(self) -> Array:
        """What the section ``winding`` held at the outputs."""
        return np.ascontiguousarray(self.status_columns[:, abi.RANK + 1 :])

    @cached_property
    def _rates(self) -> tuple[Array, Array]:
        from symgen.runtime.observe import observe_rates

        info, law, k = self.compiled.info, self.compiled.law_module, len(self.times)
        accelerations, multipliers = np.zeros((k, info.nv)), np.zeros((k, info.m))
        rates = getattr(law, "rates", law.rhs)  # a law that integrates something else than v has rates of v beside
        confirm = getattr(law, "confirm", rates)
        iw = np.zeros(abi.N_COUNTERS, dtype=np.int64)
        observe_rates(
            *(rates, confirm, law.accept, self.times, self.states, self._angles, self.p, self.start.w.copy(), iw),
            *(info.nq, info.sections["multipliers"][0], accelerations, multipliers),
        )
        return accelerations, multipliers

    @cached_property
    def _rows(self) -> Array:
        from symgen.runtime.observe import observe_rows

        info = self.compiled.info
        observed = np.zeros((len(self.times), info.m + 2 * len(info.joint_coordinates)))
        arrays = (self.times, self.states, self.accelerations, self._angles, self.p, self.w.copy(), info.nq, observed)
        observe_rows(self.compiled.model.observe, *arrays)
        return observed


def integrate(
    compiled: CompiledModel,
    integrator: Integrator,
    start: Start,
    spec: RunSpec,
    progress: Callable[[float], None] | None = None,
) -> Outcome:
    """Integrate from a consistent start.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    integrator : Integrator
        The scheme and its loop.
    start : Start
        From `symgen.runtime.assembly.assemble`; not changed.
    spec : RunSpec
        What to do.
    progress : callable, optional
        Called about ten times a second with the time reached.

    Returns
    -------
    Outcome
        Also after an interruption (KeyboardInterrupt): with everything up to there and code `STOPPED`.
    """
    before = cache_stats()
    w, iw, gauges, control, events = _arrays(compiled, start, spec)
    y, p = start.y.copy(), start.p.copy()
    outputs = (
        spec.times,
        np.empty((len(spec.times), len(y))),
        np.empty((len(spec.times), abi.RANK + 1 + compiled.info.windings)),
    )
    call = integrator.call(compiled, spec, State(y, p, w, iw))
    watched = gauges, control, events
    _warm(call, outputs, watched)
    code, seconds, interrupted = _in_thread(call, (*outputs, *watched), gauges, control, progress, spec.max_evaluations)

    k = int(control[abi.OUTPUTS])
    after = cache_stats()
    n_events = int(min(control[abi.EVENTS], abi.MAX_EVENTS))
    table = events.reshape(-1, abi.N_EVENT)[:n_events]
    return Outcome(
        code=code,
        reason=end_reason(
            code,
            float(gauges[abi.TIME]),
            (float(w[abi.PHI]), float(w[abi.DRIFT]), float(w[abi.LENGTH]), float(w[abi.SPEED])),
            float(gauges[abi.ENERGY_SCALE]),
            spec,
        ),
        end=float(gauges[abi.TIME]),
        times=outputs[0][:k],
        states=outputs[1][:k],
        status_columns=outputs[2][:k],
        steps=int(control[abi.STEPS]),
        rejected=int(control[abi.REJECTED]),
        evaluations=int(control[abi.EVALUATIONS]),
        counters={name: int(iw[i]) for i, name in enumerate(COUNTERS)},
        position_violation_max=float(gauges[abi.MAX_PHI]),
        velocity_violation_max=float(gauges[abi.MAX_DRIFT]),
        energy_start=float(gauges[abi.ENERGY_START]),
        energy_drift_max=float(gauges[abi.MAX_ENERGY]),
        energy_scale=float(gauges[abi.ENERGY_SCALE]),
        energy_jump=float(gauges[abi.MAX_ENERGY_JUMP]),
        smallest_pivot=float(gauges[abi.SMALLEST_PIVOT]),
        rank_events=tuple(RankEvent(float(a), float(b), int(r), float(s)) for a, b, r, s in table),
        rank_event_count=int(control[abi.EVENTS]),
        interrupted=interrupted,
        run_seconds=seconds,
        compile_seconds=after["compile_seconds"]
        + after["load_seconds"]
        - before["compile_seconds"]
        - before["load_seconds"],
        compiled=compiled,
        start=start,
        p=p,
        w=w,
    )


def _arrays(compiled: CompiledModel, start: Start, spec: RunSpec) -> tuple[Array, Any, Array, Any, Array]:
    w = start.w.copy()
    iw = np.zeros(abi.N_COUNTERS, dtype=np.int64)
    gauges = np.zeros(abi.N_GAUGES)
    control = np.zeros(abi.N_CONTROL, dtype=np.int64)
    gauges[abi.LIMIT_PHI], gauges[abi.LIMIT_DRIFT] = spec.max_violation, spec.velocity_limit
    gauges[abi.LIMIT_ENERGY] = spec.max_energy_error
    gauges[abi.WARN_PIVOT] = WARN
    gauges[abi.SMALLEST_PIVOT] = gauges[abi.LAST_SINE] = 1.0
    control[abi.LAST_RANK] = int(np.sum(compiled.section(w, "pivot") >= 1e-12))
    return w, iw, gauges, control, np.zeros(abi.MAX_EVENTS * abi.N_EVENT)


def _warm(call: LoopCall, outputs: tuple[Array, ...], watched: tuple[Any, ...]) -> None:
    """Compile everything by a run that is told to stop before its first step, so that the clock sees the loop alone."""
    gauges, control, events = (a.copy() for a in watched)
    control[abi.STOP] = 1
    before, after = (
        tuple(a.copy() if isinstance(a, np.ndarray) else a for a in part) for part in (call.before, call.after)
    )
    call.loop(*before, *(a[:0] for a in outputs), gauges, control, events, *after)


def _in_thread(
    call: LoopCall,
    watched: tuple[Any, ...],
    gauges: Array,
    control: Any,
    progress: Callable[[float], None] | None,
    budget: int | None,
) -> tuple[int, float, bool]:
    """Run the loop, which holds no lock, in a thread; an interrupt raises the flag that it polls.

    Returns how the loop ended, its seconds, and whether it was interrupted, be it too late to stop it. A loop beyond
    its budget of evaluations is stopped as well; it does not count as interrupted.
    """
    result: list[Any] = []
    interrupted = False
    finished = threading.Event()

    def work() -> None:
        began = time.perf_counter()
        try:
            code = call.loop(*call.before, *watched, *call.after)
            result.append((code, time.perf_counter() - began))
        except BaseException as error:  # carried over to the caller's thread
            result.append(error)
        finally:
            finished.set()

    threading.Thread(target=work, name="symgen-run", daemon=True).start()
    while True:
        try:
            # not Thread.join: interrupted there, Python 3.11 takes a running thread for a stopped one
            while not finished.wait(0.1):
                if budget is not None and control[abi.EVALUATIONS] > budget:
                    control[abi.STOP] = 1
                if progress is not None:
                    progress(float(gauges[abi.TIME]))
            break
        except KeyboardInterrupt:
            interrupted = True
            control[abi.STOP] = 1
    outcome = result[0]
    if isinstance(outcome, BaseException):
        raise outcome
    return int(outcome[0]), float(outcome[1]), interrupted


def end_reason(code: int, time: float, violations: tuple[float, ...], scale: float, spec: RunSpec) -> str:
    """Return why a loop ended, empty where it reached the end.

    Parameters
    ----------
    code : int
        See `symgen.runtime.abi`.
    time : float
        Time reached [s].
    violations : tuple of float
        |Phi|, |D v - nu| and the largest coordinate and speed that they are judged by, at that time.
    scale : float
        Energy in motion [J].
    spec : RunSpec
        The limits.
    """
    if code == abi.DONE:
        return ""
    where = f" at t = {time:.6g} s"
    sentence = abi.REASONS[code]
    phi, drift, length, speed = violations
    if code == abi.POSITION:
        return f"{sentence} ({phi:.3g} > {spec.max_violation:g} x {length:.3g}){where}"
    if code == abi.VELOCITY:
        if spec.max_velocity_violation is not None:
            sentence = sentence.replace("max_violation", "the root of max_violation")
        return f"{sentence} ({drift:.3g} > {spec.velocity_limit:g} x {speed:.3g}){where}"
    if code == abi.ENERGY:
        return f"{sentence} ({spec.max_energy_error:g} of {scale:.3g} J){where}"
    return sentence + where
