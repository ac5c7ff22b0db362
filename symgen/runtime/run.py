"""One run: a start, a loop in a thread that can be stopped, and what is observed at its outputs."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.ir.program import COUNTERS
from symgen.runtime import abi
from symgen.runtime.assembly import Start
from symgen.store.stats import cache_stats

if TYPE_CHECKING:
    from symgen.integrators._tableau import Tableau
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
    max_energy_error : float
        Largest energy error that is tolerated, as a fraction of the energy in motion.
    """

    until: float
    step: float | None
    adaptive: bool
    times: Array
    rtol: float = 1e-8
    atol: float = 1e-10
    largest_step: float = np.inf
    max_violation: float = 1e-6
    max_energy_error: float = 0.05


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

    `status_columns` holds |Phi|, |D v - nu|, kinetic and potential energy, smallest pivot and rank.
    """

    code: int
    reason: str
    end: float
    times: Array
    states: Array
    status_columns: Array
    accelerations: Array
    multipliers: Array
    acceleration_violations: Array
    joint_coordinates: Array
    steps: int
    rejected: int
    evaluations: int
    counters: dict[str, int]
    position_violation_max: float
    velocity_violation_max: float
    energy_drift_max: float
    energy_scale: float
    energy_jump: float
    smallest_pivot: float
    rank_events: tuple[RankEvent, ...]
    rank_event_count: int
    run_seconds: float
    compile_seconds: float
    start: Start = field(repr=False)


def integrate(
    compiled: CompiledModel,
    tableau: Tableau,
    start: Start,
    spec: RunSpec,
    progress: Callable[[float], None] | None = None,
) -> Outcome:
    """Integrate from a consistent start.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    tableau : Tableau
        The integrator.
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
    states = np.empty((len(spec.times), len(y)))
    status = np.empty((len(spec.times), abi.RANK + 1))
    packed = tableau.packed()
    law = compiled.law_module
    common = (law.rhs, law.confirm, law.accept, *packed, tableau.stages)
    room = np.zeros((len(packed[3]) + 2) * len(y))
    tail = (spec.times, states, status, gauges, control, events, room)
    if spec.adaptive:
        from symgen.runtime.explicit import adaptive_steps as loop

        assert tableau.dense is not None, "every adaptive tableau has dense output"
        arguments: tuple[Any, ...] = (
            *common,
            np.concatenate(tableau.errors),
            len(tableau.errors),
            tableau.error_order,
            np.ascontiguousarray(tableau.dense).ravel(),
            *(y, p, w, iw, 0.0, spec.step or 0.0, spec.largest_step, spec.until, spec.rtol, spec.atol),
            *tail,
        )
    else:
        from symgen.runtime.explicit import fixed_steps as loop

        assert spec.step is not None, "a constant step is given"
        arguments = (*common, y, p, w, iw, 0.0, spec.step, spec.until, *tail)
    _warm(loop, arguments, control)
    code, seconds = _in_thread(loop, arguments, gauges, control, progress)

    k = int(control[abi.OUTPUTS])
    observed = _observe(compiled, spec.times[:k], states[:k], p, w, iw)
    after = cache_stats()
    n_events = int(min(control[abi.EVENTS], abi.MAX_EVENTS))
    table = events.reshape(-1, abi.N_EVENT)[:n_events]
    return Outcome(
        code=code,
        reason=_reason(code, w, gauges, spec),
        end=float(gauges[abi.TIME]),
        times=spec.times[:k],
        states=states[:k],
        status_columns=status[:k],
        accelerations=observed[0],
        multipliers=observed[1],
        acceleration_violations=np.linalg.norm(observed[2][:, : compiled.info.m], axis=1),
        joint_coordinates=observed[2][:, compiled.info.m :],
        steps=int(control[abi.STEPS]),
        rejected=int(control[abi.REJECTED]),
        evaluations=int(control[abi.EVALUATIONS]),
        counters={name: int(iw[i]) for i, name in enumerate(COUNTERS)},
        position_violation_max=float(gauges[abi.MAX_PHI]),
        velocity_violation_max=float(gauges[abi.MAX_DRIFT]),
        energy_drift_max=float(gauges[abi.MAX_ENERGY]),
        energy_scale=float(gauges[abi.ENERGY_SCALE]),
        energy_jump=float(gauges[abi.MAX_ENERGY_JUMP]),
        smallest_pivot=float(gauges[abi.SMALLEST_PIVOT]),
        rank_events=tuple(RankEvent(float(a), float(b), int(r), float(s)) for a, b, r, s in table),
        rank_event_count=int(control[abi.EVENTS]),
        run_seconds=seconds,
        compile_seconds=after["compile_seconds"] + after["load_seconds"] - before["compile_seconds"] - before["load_seconds"],
        start=start,
    )


def _arrays(compiled: CompiledModel, start: Start, spec: RunSpec) -> tuple[Array, Any, Array, Any, Array]:
    from symgen.runtime.probe import call_measure

    w = start.w.copy()
    iw = np.zeros(abi.N_COUNTERS, dtype=np.int64)
    gauges = np.zeros(abi.N_GAUGES)
    control = np.zeros(abi.N_CONTROL, dtype=np.int64)
    call_measure(compiled.model.energies, 0.0, start.y, start.p, w)
    gauges[abi.ENERGY_START] = w[abi.KINETIC] + w[abi.POTENTIAL]
    gauges[abi.POTENTIAL_START] = w[abi.POTENTIAL]
    gauges[abi.LIMIT_PHI] = spec.max_violation * w[abi.LENGTH]
    gauges[abi.LIMIT_DRIFT] = spec.max_violation * w[abi.SPEED]
    gauges[abi.LIMIT_ENERGY] = spec.max_energy_error
    gauges[abi.WARN_PIVOT] = WARN
    gauges[abi.SMALLEST_PIVOT] = 1.0
    control[abi.LAST_RANK] = int(np.sum(compiled.section(w, "pivot") >= 1e-12))
    return w, iw, gauges, control, np.zeros(abi.MAX_EVENTS * abi.N_EVENT)


def _warm(loop: Any, arguments: tuple[Any, ...], control: Any) -> None:
    """Compile everything by a run that is told to stop before its first step, so that the clock sees the loop alone."""
    control[abi.STOP] = 1
    fresh = tuple(a.copy() if isinstance(a, np.ndarray) else a for a in arguments)
    loop(*fresh)
    control[abi.STOP] = 0


def _in_thread(
    loop: Any, arguments: tuple[Any, ...], gauges: Array, control: Any, progress: Callable[[float], None] | None
) -> tuple[int, float]:
    """Run the loop, which holds no lock, in a thread; an interrupt raises the flag that it polls."""
    result: list[Any] = []

    def work() -> None:
        began = time.perf_counter()
        try:
            code = loop(*arguments)
            result.append((code, time.perf_counter() - began))
        except BaseException as error:  # carried over to the caller's thread
            result.append(error)

    thread = threading.Thread(target=work, name="symgen-run", daemon=True)
    thread.start()
    while thread.is_alive():
        try:
            thread.join(0.1)
            if progress is not None:
                progress(float(gauges[abi.TIME]))
        except KeyboardInterrupt:
            control[abi.STOP] = 1
    outcome = result[0]
    if isinstance(outcome, BaseException):
        raise outcome
    return int(outcome[0]), float(outcome[1])


def _observe(
    compiled: CompiledModel, times: Array, states: Array, p: Array, w: Array, iw: Any
) -> tuple[Array, Array, Array]:
    from symgen.runtime.observe import observe_outputs

    info, k = compiled.info, len(times)
    accelerations = np.zeros((k, info.nv))
    multipliers = np.zeros((k, info.m))
    observed = np.zeros((k, info.m + 2 * len(info.joint_coordinates)))
    observe_outputs(
        compiled.law_module.rhs,
        compiled.law_module.confirm,
        compiled.model.observe,
        times,
        states,
        p,
        w,
        iw.copy(),
        info.nq,
        info.nv,
        info.m,
        info.sections["multipliers"][0],
        accelerations,
        multipliers,
        observed,
    )
    return accelerations, multipliers, observed


def _reason(code: int, w: Array, gauges: Array, spec: RunSpec) -> str:
    if code == abi.DONE:
        return ""
    where = f" at t = {gauges[abi.TIME]:.6g} s"
    sentence = abi.REASONS[code]
    if code == abi.POSITION:
        return f"{sentence} ({w[abi.PHI]:.3g} > {gauges[abi.LIMIT_PHI]:.3g}){where}"
    if code == abi.VELOCITY:
        return f"{sentence} ({w[abi.DRIFT]:.3g} > {gauges[abi.LIMIT_DRIFT]:.3g}){where}"
    if code == abi.ENERGY:
        return f"{sentence} ({spec.max_energy_error:g} of {gauges[abi.ENERGY_SCALE]:.3g} J){where}"
    return sentence + where
