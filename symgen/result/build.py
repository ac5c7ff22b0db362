"""From what a loop left behind to a result: labels, energies, and the judgement of the run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.describe.digest import digest
from symgen.describe.evaluate import parameter_values
from symgen.result.judge import judge
from symgen.result.labelled import labelled
from symgen.result.measured import Measured
from symgen.result.parts import Rank, Seconds
from symgen.result.reactions import Forces, seats
from symgen.result.result import FAILED, Result
from symgen.run_setup import made_of
from symgen.runtime import abi
from symgen.runtime.events import record_of, stopped
from symgen.runtime.last_state import LastState
from symgen.runtime.simulation import SHOWN
from symgen.tree_run import CarriedOutcome

if TYPE_CHECKING:
    from collections.abc import Mapping

    from symgen.describe.mechanism import Mechanism
    from symgen.plan import Plan
    from symgen.result.agreement import Settled
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.outcome import Outcome
    from symgen.settings import Settings


def build_result(
    mechanism: Mechanism,
    settings: Settings,
    plan: Plan,
    compiled: CompiledModel,
    outcome: Outcome,
    run_spread: float = 0.0,
    second: Settled | None = None,
    inputs: Mapping[str, str | float] | None = None,
    state: CompiledModel | None = None,
) -> Result:
    """Label and judge the outcome of a run.

    Parameters
    ----------
    mechanism : Mechanism
        What was run.
    settings, plan : Settings, Plan
        How it was asked for, and what the loop got.
    compiled : CompiledModel
        The emitted functions that were run.
    outcome : Outcome
        What the loop gave.
    run_spread : float, optional
        Longest minus shortest run time of repeated runs [s].
    second : Settled, optional
        What a run with finer steps said of this one.
    inputs : mapping, optional
        What inputs were, in words or numbers.
    state : CompiledModel, optional
        What was run where it was in joint coordinates; `compiled` and `outcome` are of bodies then.

    Returns
    -------
    Result
        With status, reason, warnings and notes settled.
    """
    info, spec, start = compiled.info, plan.spec, outcome.start
    values = parameter_values(mechanism, settings.parameters)
    parameters = {name: value for name, value in values.items() if name not in mechanism.inputs}
    forces = Forces(outcome, seats(mechanism, values))
    measured = Measured(mechanism, outcome, lambda: forces.multipliers().values)
    verdict = judge(plan, compiled, outcome, second, settings.verify)
    notes = (*start.notes, *_redundancy(compiled, outcome, forces), *_dense(compiled, outcome))
    verdict = replace(verdict, notes=(*notes, *verdict.notes, *stopped(outcome)))
    states, status = outcome.states, outcome.status_columns
    q, v = info.parts(states)
    kinetic, potential, work = status[:, abi.KINETIC], status[:, abi.POTENTIAL], states[:, info.work]
    law = compiled.law
    return Result(
        mechanism=mechanism.name,
        method=law.method,
        integrator=plan.tableau.name,
        step=spec.step,
        rtol=spec.rtol if spec.adaptive else None,
        atol=spec.atol if spec.adaptive else None,
        until=spec.until,
        status=verdict.status,
        reason=verdict.reason,
        warnings=(*plan.warnings, *outcome.start.warnings, *verdict.warnings),
        notes=verdict.notes,
        parameters=parameters,
        t=outcome.times,
        q=labelled(q, info.coordinates),
        v=labelled(v, info.velocities),
        kinetic=kinetic,
        potential=potential,
        work=work + start.work if start.work else work,
        energy_error=kinetic + potential - outcome.energy_start - work,
        smallest_pivot=status[:, abi.PIVOT],
        rank=Rank(info.m, start.rank, len(info.dropped_rows), start.redundant_rows),
        rank_events=outcome.rank_events,
        rank_event_count=outcome.rank_event_count,
        steps=outcome.steps,
        rejected=outcome.rejected,
        evaluations=outcome.evaluations,
        iterations=outcome.counters.get("iterations", 0),
        seconds=Seconds(
            compiled.derive_seconds + (0.0 if state is None else state.derive_seconds),
            compiled.emit_seconds + (0.0 if state is None else state.emit_seconds),
            outcome.compile_seconds,
            outcome.run_seconds,
            run_spread,
        ),
        position_violation_max=outcome.position_violation_max,
        velocity_violation_max=outcome.velocity_violation_max,
        energy_drift_max=outcome.energy_drift_max,
        error_estimate=None if second is None or verdict.status == FAILED else second.error,
        outcome=outcome,
        forces=forces,
        measured=measured,
        end=outcome.end,
        events=tuple(record_of(info, event) for event in outcome.happened),
        accumulation=outcome.accumulation,
        inputs=dict(inputs or {}),
        coordinates=plan.coordinates,
        watched=tuple((event.name, event.action) for event in plan.events),
        state=tuple(x.name for own in [(state or compiled).info] for x in (*own.coordinates, *own.velocities)),
        ended=partial(_last_state, mechanism, plan, compiled, outcome, parameters),
    )


def _last_state(
    mechanism: Mechanism, plan: Plan, compiled: CompiledModel, outcome: Outcome, parameters: Mapping[str, float]
) -> LastState:
    """Return where a run ended, with all that it kept; of one that failed, the last state that it accepted."""
    info, start = compiled.info, outcome.start
    if isinstance(outcome, CarriedOutcome):  # in joint coordinates: where bodies are, and all that was kept of joints
        y, work, w = outcome.end_state, outcome.work, outcome.w
        made, arrays = outcome.tree.made(plan, parameters), _arrays(outcome.inner) | outcome.tree.kept(outcome)
    else:
        made, arrays = made_of(compiled, plan, parameters), _arrays(outcome)
        y, work, w = arrays["y"], arrays["y"][info.work], arrays["w"]
    whole = outcome.code in (abi.DONE, abi.STOPPED)
    return LastState(
        mechanism=mechanism.name,
        digest=digest(mechanism),
        t=outcome.end,
        q={q.name: float(x) for q, x in zip(info.coordinates, y, strict=False)},
        v={v.name: float(x) for v, x in zip(info.velocities, y[info.nq :], strict=False)},
        work=float(work + start.work),
        work_before=start.work,
        windings=tuple(w[abi.WINDING : abi.WINDING + info.windings].tolist()),
        rank=start.rank,
        made=made,
        failed="" if whole else outcome.reason,
        arrays=arrays,
    )


def _arrays(outcome: Outcome) -> dict[str, NDArray[Any]]:
    """Return all that a run kept, with its last output."""
    info, arrays = outcome.compiled.info, outcome.simulation.save()
    y, w = arrays["y"], arrays["w"]
    shown = y[: info.ny].copy(), np.append(w[: abi.N_STATUS], w[abi.WINDING : abi.WINDING + info.windings])
    if len(outcome.times) and outcome.times[-1] == outcome.end:
        shown = outcome.states[-1].copy(), outcome.status_columns[-1].copy()
    return arrays | dict(zip(SHOWN, shown, strict=True))


def _redundancy(compiled: CompiledModel, outcome: Outcome, forces: Forces) -> list[str]:
    """Return what redundant constraints mean for this run, as sentences."""
    info, start, notes = compiled.info, outcome.start, list[str]()
    if start.rank < info.m:
        extra = info.m - start.rank
        rows = f" ({', '.join(start.redundant_rows)})" if start.redundant_rows else ""
        subject = "1 constraint row depends" if extra == 1 else f"{extra} constraint rows depend"
        notes.append(f"{subject} on the others at the start{rows}; multipliers are those of minimum norm")
    if forces.non_unique:
        notes.append("reactions are not unique at " + ", ".join(forces.non_unique))
    return notes


def _dense(compiled: CompiledModel, outcome: Outcome) -> list[str]:
    """Return what the dense factorisation met, where it was used."""
    count = outcome.counters["dense_solves"]
    if count == 0:
        return []
    rank, rows = outcome.counters["dense_rank"], compiled.info.m
    return [
        f"accelerations solved by dense orthogonal factorisation in {count} evaluations, rank {rank} of {rows} rows"
    ]
