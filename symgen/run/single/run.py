"""One run: a start, a loop in a thread that can be stopped, and its outcome."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.ir.program import COUNTERS
from symgen.compile.native.machine import vector_width
from symgen.compile.store.stats import CPU_CLOCK, processor_seconds_in_cache, seconds_in_cache
from symgen.describe.bounds.advice import JUMPING
from symgen.run.layout import abi
from symgen.run.layout.model_arrays import triplets_of_entries
from symgen.run.loops.run_spec import RunSpec
from symgen.run.loops.watch import iterations_in
from symgen.run.single.outcome import Outcome, RankEvent
from symgen.run.single.simulation import Simulation
from symgen.run.starts.assembly import Start

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Outputs
    from symgen.run.loops.integrator import Integrator

Array = NDArray[np.float64]
Progress = Callable[[float], None]

#: Message for runs without progress.
STIFF = "where the motion is stiff, an implicit integrator (radau5) takes longer steps"


def integrate(
    compiled: CompiledModel,
    integrator: Integrator,
    start: Start,
    spec: RunSpec,
    progress: Progress | None = None,
) -> Outcome:
    """Integrate from a consistent start.

    Parameters
    ----------
    compiled, integrator, start, spec
        As for `symgen.run.single.simulation.Simulation`.
    progress : callable, optional
        Called about ten times a second with the time reached.

    Returns
    -------
    Outcome
        After an interruption (KeyboardInterrupt) as well: with all results up to there and code `STOPPED`.
    """
    return complete_run(Simulation(compiled, integrator, start, spec), progress)


def complete_run(simulation: Simulation, progress: Progress | None = None) -> Outcome:
    """Run to the end, as `integrate` does, and return the outcome."""
    start, spec = simulation.start, simulation.spec
    outputs = simulation.outputs(spec.times)
    if start.saved is not None:
        simulation.store_first(outputs)
    simulation.compile_all(outputs)
    control, first = simulation.state.control, simulation.before[abi.EVALUATIONS]
    if spec.max_evaluations is not None:
        control[abi.STOP] = max(first + spec.max_evaluations, abi.AT_ONCE + 1)
    code, seconds, cpu_seconds, interrupted = _in_thread(simulation, outputs, progress)
    control[abi.STOP] = abi.AT_ONCE if code == abi.STOPPED else 0  # whoever goes on with it has no limit
    return outcome_of(simulation, outputs, code, seconds, interrupted, cpu_seconds)


def outcome_of(
    simulation: Simulation,
    outputs: Outputs,
    code: int,
    seconds: float = 0.0,
    interrupted: bool = False,
    cpu_seconds: float = 0.0,
) -> Outcome:
    """Return the outcome of a run whose loop has ended.

    Parameters
    ----------
    simulation, outputs : Simulation, Outputs
        The run, and its outputs.
    code : int
        End code of its loop, see `symgen.run.layout.abi`.
    seconds : float
        Time that the loop took [s].
    interrupted : bool
        Whether it was stopped from outside.
    cpu_seconds : float
        CPU time of its thread [s].
    """
    compiled, spec, start, state = simulation.compiled, simulation.spec, simulation.start, simulation.state
    w, clock, gauges, control = state.w, state.clock, state.gauges, state.control
    end = spec.until if code == abi.DONE else float(clock[abi.TIME])  # a grid of steps meets it up to rounding
    k = int(control[abi.OUTPUTS])
    before_it = simulation.before
    counters = {name: int(state.iw[i]) for i, name in enumerate(COUNTERS)}
    counters["iterations"] = iterations_in(state) - simulation.iterations_before
    together = hasattr(simulation.scheme, "vector")  # nodes of a step
    counters["vector_width"] = vector_width() if together and simulation.scheme.vector else 0
    counters["slow_steps"] = int(control[abi.POINTS]) if together else 0
    times, states, status = (array[:k] for array in outputs)
    if code in (abi.MET, abi.GATHERED) and not (k and times[-1] >= end):
        here = np.concatenate([w[: abi.N_STATUS], w[abi.WINDING : abi.WINDING + compiled.info.kept]])
        times, states = np.append(times, end), np.vstack([states, state.y[: compiled.info.ny]])
        status = np.vstack([status, here])
    events = simulation.events
    code = abi.DONE if code == abi.MET else code  # an event at which the run was to end
    n_passages = int(min(control[abi.PASSAGES], abi.MAX_PASSAGES))
    table = state.passages.reshape(-1, abi.N_PASSAGE)[:n_passages]
    return Outcome(
        code=code,
        reason=reason_of(simulation, code, end),
        end=end,
        times=times,
        states=states,
        status_columns=status,
        steps=int(control[abi.STEPS] - before_it[abi.STEPS]),
        rejected=int(control[abi.REJECTED] - before_it[abi.REJECTED]),
        evaluations=int(control[abi.EVALUATIONS] - before_it[abi.EVALUATIONS]),
        counters=counters,
        position_violation_max=float(gauges[abi.MAX_PHI]),
        velocity_violation_max=float(gauges[abi.MAX_DRIFT]),
        energy_start=float(gauges[abi.ENERGY_START]),
        energy_drift_max=float(gauges[abi.MAX_ENERGY]),
        energy_scale=float(gauges[abi.ENERGY_SCALE]),
        energy_jump=float(gauges[abi.MAX_ENERGY_JUMP]),
        smallest_pivot=float(gauges[abi.SMALLEST_PIVOT]),
        rank_events=tuple(RankEvent(float(a), float(b), int(r), float(s)) for a, b, r, s in table),
        rank_event_count=int(control[abi.PASSAGES]),
        interrupted=interrupted,
        run_seconds=seconds,
        cpu_seconds=cpu_seconds,
        compiled=compiled,
        start=start,
        p=state.p,
        w=w,
        simulation=simulation,
        held=simulation.changes.earlier_parameters(times),
        happened=() if events is None else tuple(events.happened),
        accumulation=None if events is None else events.accumulation,
    )


def reason_of(simulation: Simulation, code: int, end: float) -> str:
    """Return the reason why a run ended at a time, empty where it reached its end; see `end_reason`."""
    state = simulation.state
    measures = (abi.PHI_MEASURE, abi.DRIFT_MEASURE, abi.LENGTH, abi.SPEED)
    attempts = int(state.control[abi.STEPS] + state.control[abi.REJECTED])
    scale = float(state.gauges[abi.ENERGY_SCALE])
    if code in (abi.GATHERED, abi.UNDEFINED) and simulation.events is not None:
        return simulation.events.reason(code, state, end)
    if code == abi.HALTED and simulation.halt is not None:
        return str(simulation.halt)
    failed = code not in (abi.DONE, abi.STOPPED, abi.GATHERED)
    jump = simulation.events.jump(state) if failed and simulation.events is not None else ""
    if jump:  # whatever it has led to
        return jump
    reason = end_reason(code, end, tuple(float(state.w[i]) for i in measures), scale, attempts, simulation.spec)
    return reason + (f" (row {_shortest_row(simulation.compiled, state.w)})" if code == abi.VANISHED else "")


def _shortest_row(compiled: CompiledModel, w: Array) -> str:
    """Return the name of the row on an angle that has lost most of its gradient."""
    info = compiled.info
    rows, columns, values = triplets_of_entries(info, compiled.section(w, "jacobian"))
    squares = np.bincount(rows, values**2 * compiled.section(w, "gauge")[columns], info.m)
    left = squares * compiled.section(w, "row_weight")
    return min((left[i], row.name) for i, row in enumerate(info.rows) if row.unit == "rad")[1]


def _in_thread(simulation: Simulation, outputs: Outputs, progress: Progress | None) -> tuple[int, float, float, bool]:
    """Run the loop, which holds no lock, in a thread; an interrupt raises the flag that it polls.

    Returns the end code of the loop, its seconds, those of the processor, and whether it was interrupted, even if too
    late to stop it. Functions that a run compiles on its way, for modes and effects that come up, are no part of its
    seconds.
    """
    result: list[Any] = []
    interrupted = False
    finished = threading.Event()
    clock, control = simulation.state.clock, simulation.state.control
    begun = int(control[abi.STEPS])

    def work() -> None:
        began, compiled = time.perf_counter(), seconds_in_cache()
        cpu = CPU_CLOCK() - processor_seconds_in_cache()
        try:
            code = simulation.enter(outputs)
            seconds = time.perf_counter() - began - (seconds_in_cache() - compiled)
            result.append((code, max(seconds, 0.0), CPU_CLOCK() - processor_seconds_in_cache() - cpu))
        except InputError as error:
            if control[abi.STEPS] == begun:  # nothing has run yet
                result.append(error)
            else:  # a run that has begun ends with its reason, and keeps what it has
                simulation.halt = error
                result.append((abi.HALTED, time.perf_counter() - began, CPU_CLOCK() - cpu))
        except BaseException as error:  # carried over to the caller's thread
            result.append(error)
        finally:
            finished.set()

    threading.Thread(target=work, name="symgen-run", daemon=True).start()
    while True:
        try:
            # not Thread.join: interrupted there, Python 3.11 takes a running thread for a stopped one
            while not finished.wait(0.1):
                if progress is not None:
                    progress(float(clock[abi.TIME]))
            break
        except KeyboardInterrupt:
            interrupted = True
            control[abi.STOP] = abi.AT_ONCE
    outcome = result[0]
    if isinstance(outcome, BaseException):
        raise outcome
    return int(outcome[0]), float(outcome[1]), float(outcome[2]), interrupted


def end_reason(
    code: int, time: float, violations: tuple[float, ...], scale: float, attempts: int, spec: RunSpec
) -> str:
    """Return the reason why a loop ended, empty where it reached the end.

    Parameters
    ----------
    code : int
        See `symgen.run.layout.abi`.
    time : float
        Time reached [s].
    violations : tuple of float
        |Phi|, |D v - nu|, and the largest coordinate and speed that scale them, at that time.
    scale : float
        Energy in motion [J].
    attempts : int
        Number of accepted and rejected steps.
    spec : RunSpec
        The limits.
    """
    if code == abi.DONE:
        return ""
    where = f" at t = {time:.6g} s"
    sentence = abi.REASONS[code]
    phi, drift, length, speed = violations
    jumps, jumping = spec.events is not None and spec.events.jumps, f"{JUMPING}; {spec.in_place}"
    if code == abi.POSITION:
        return f"{sentence} ({phi:.3g} > {spec.max_violation:g} x {length:.3g}){where}"
    if code == abi.VELOCITY:
        if spec.max_velocity_violation is not None:
            sentence = sentence.replace("max_violation", "the root of max_violation")
        return f"{sentence} ({drift:.3g} > {spec.velocity_limit:g} x {speed:.3g}){where}"
    if code == abi.NO_PROGRESS:
        more = "at the present rate the rest would take more than" if attempts < spec.max_attempts else "that is all of"
        return (
            f"{sentence}: {attempts} attempts at a step brought it to t = {time:.6g} of {spec.until:g} s, and {more} "
            f"max_attempts = {spec.max_attempts:g}; {jumping if jumps else STIFF}"
        )
    if (code == abi.TINY_STEP and jumps) or (code == abi.NEWTON and not spec.adaptive and spec.in_place):
        return f"{sentence}{where}; {jumping}"
    if code == abi.ENERGY:
        return f"{sentence} ({spec.max_energy_error:g} of {scale:.3g} J){where}"
    return sentence + where
