"""From what a loop left to a result: labels, energies, and the judgement of the run."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.describe.facts.digest import digest
from symgen.describe.formulas.evaluate import parameter_values
from symgen.result.judge import judge, reason_without_check
from symgen.result.labelled import label_columns
from symgen.result.motion_tables import Measured
from symgen.result.reactions import Forces, seats_of_reactions
from symgen.result.result import FAILED, Rank, Result, Seconds
from symgen.run.layout import abi
from symgen.run.planning.automatic import stiff_by_steps
from symgen.run.planning.continuation import settings_as_json
from symgen.run.planning.dead_centre import dead_centre_at_end
from symgen.run.planning.tree import CarriedOutcome
from symgen.run.planning.undefined import undefined_at_end
from symgen.run.single.events import gap_notes, impact_notes, record_of, rest_notes, sharing_notes, stop_notes
from symgen.run.single.last_state import LastState
from symgen.run.single.simulation import SHOWN

if TYPE_CHECKING:
    from collections.abc import Mapping

    from symgen.result.judge import Verdict
    from symgen.result.points import Verification
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.outcome import Outcome


def build_result(
    run: Prepared, outcome: Outcome, run_spread: float = 0.0, verification: Verification | None = None
) -> Result:
    """Label and judge the outcome of a run.

    Parameters
    ----------
    run : Prepared
        The prepared run.
    outcome : Outcome
        Outcome of the loop, in the coordinates of the state.
    run_spread : float, optional
        Longest minus shortest run time of repeated runs [s].
    verification : Verification, optional
        Verification by a run with finer steps.

    Returns
    -------
    Result
        With status, reason, warnings and notes settled.
    """
    plan, spec, outcome = run.plan, run.spec, run.of_bodies(outcome)
    mechanism, compiled, start = plan.mechanism, outcome.compiled, outcome.start
    info, own = compiled.info, run.compiled.info
    values = parameter_values(mechanism, plan.parameters)
    parameters = {name: value for name, value in values.items() if name not in mechanism.inputs}
    forces = Forces(outcome, seats_of_reactions(mechanism, values))
    measured = Measured(mechanism, outcome, lambda: forces.multipliers().values)
    unknown = None
    if verification is None or not verification.whole:
        unknown = reason_without_check(run, outcome) or "it went step by step"
    verdict = _judge_outcome(run, outcome, verification, values)
    stiff = () if verdict.status == FAILED else stiff_by_steps(run, outcome)
    notes = (
        *start.notes,
        *gap_notes(outcome),
        *_sentences_on_rows(compiled, outcome, forces),
        *sharing_notes(outcome),
        *_warnings_of_dense_factorisation(compiled, outcome),
        *stiff,
    )
    notes = (*notes, *verdict.notes, *rest_notes(outcome), *impact_notes(outcome), *stop_notes(outcome))
    states, status = outcome.states, outcome.status_columns
    q, v = info.parts(states)
    kinetic, potential, work = status[:, abi.KINETIC], status[:, abi.POTENTIAL], states[:, info.work]
    law = compiled.law
    return Result(
        mechanism=mechanism.name,
        method=law.method,
        integrator=plan.integrator.name,
        step=plan.settings.step if spec.adaptive else spec.step,
        rtol=spec.rtol if spec.adaptive else None,
        atol=spec.atol if spec.adaptive else None,
        relative_atol=spec.relative if spec.adaptive else None,
        until=spec.until,
        status=verdict.status,
        reason=verdict.reason,
        warnings=(*plan.all_warnings, *start.warnings, *verdict.warnings),
        notes=notes,
        parameters=parameters,
        t=outcome.times,
        q=label_columns(q, info.coordinates),
        v=label_columns(v, info.velocities),
        kinetic=kinetic,
        potential=potential,
        work=work + start.work if start.work else work,
        energy_error=kinetic + potential - outcome.energy_start - work,
        smallest_pivot=status[:, abi.PIVOT],
        rank=Rank(compiled.in_force(start.w), start.rank, len(info.dropped_rows), start.redundant_rows),
        rank_events=outcome.rank_events,
        rank_event_count=outcome.rank_event_count,
        steps=outcome.steps,
        rejected=outcome.rejected,
        evaluations=outcome.evaluations,
        iterations=outcome.counters.get("iterations", 0),
        vector_width=outcome.counters.get("vector_width") or None,
        seconds=_seconds_by_stage(run, outcome, run_spread),
        position_violation_max=outcome.position_violation_max,
        velocity_violation_max=outcome.velocity_violation_max,
        energy_drift_max=outcome.energy_drift_max,
        error_estimate=None if verification is None or verdict.status == FAILED else verification.error,
        unchecked="the run failed" if verdict.status == FAILED else unknown,
        proposals=("--integrator radau5",) if stiff else (),
        outcome=outcome,
        forces=forces,
        measured=measured,
        end=outcome.end,
        events=tuple(record_of(info, event) for event in outcome.happened),
        accumulation=outcome.accumulation,
        inputs=dict(plan.inputs.words),
        coordinates=plan.coordinates,
        watched=tuple((event.name, event.action) for event in plan.events),
        state=tuple(x.name for x in (*own.coordinates, *own.velocities)),
        ended=partial(_last_state, run, outcome),
    )


def _seconds_by_stage(run: Prepared, outcome: Outcome, run_spread: float) -> Seconds:
    """Return what the run took, stage by stage; on a tree code of bodies and of the tree has been derived."""
    derived = (outcome.compiled,) if run.tree is None else (outcome.compiled, run.compiled)
    derive, emit = sum(code.derive_seconds for code in derived), sum(code.emit_seconds for code in derived)
    return Seconds(derive, emit, outcome.compile_seconds, outcome.cpu_seconds, run_spread)


def _judge_outcome(
    run: Prepared, outcome: Outcome, verification: Verification | None, values: Mapping[str, float]
) -> Verdict:
    """Judge an outcome in coordinates of bodies; say what is undefined, or is at a dead centre."""
    mechanism, verdict = run.plan.mechanism, judge(run, outcome, verification)
    if verdict.status == FAILED and (undefined := undefined_at_end(mechanism, outcome)):
        verdict = replace(verdict, reason=f"{str(verdict.reason).partition('; ')[0]}: {undefined}")
    if verdict.status == FAILED and (locked := dead_centre_at_end(mechanism, outcome)):
        verdict = replace(verdict, reason=locked)
    return verdict


def _last_state(run: Prepared, outcome: Outcome) -> LastState:
    """Return where a run ended, with all that it kept; of one that failed, the last state that it accepted."""
    mechanism, info, start = run.plan.mechanism, outcome.compiled.info, outcome.start
    if isinstance(outcome, CarriedOutcome):  # in joint coordinates: where bodies are, and all that was kept of joints
        y, work, w = outcome.end_state, outcome.work, outcome.w
        arrays = _arrays_of_outcome(outcome.inner) | outcome.tree.arrays(outcome)
    else:
        arrays = _arrays_of_outcome(outcome)
        y, work, w = arrays["y"], arrays["y"][info.work], arrays["w"]
    own = arrays["y"][run.compiled.info.own_states].tolist()
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
        made=settings_as_json(run.compiled, run.plan, run.spec),
        failed="" if whole else outcome.reason,
        arrays=arrays,
        states=dict(zip((x.name for x in info.states), own, strict=True)) or None,
    )


def _arrays_of_outcome(outcome: Outcome) -> dict[str, NDArray[Any]]:
    """Return all that a run kept, with its last output."""
    info, arrays = outcome.compiled.info, outcome.simulation.save()
    y, w = arrays["y"], arrays["w"]
    shown = y[: info.ny].copy(), np.append(w[: abi.N_STATUS], w[abi.WINDING : abi.WINDING + info.kept])
    if len(outcome.times) and outcome.times[-1] == outcome.end:
        shown = outcome.states[-1].copy(), outcome.status_columns[-1].copy()
    return arrays | dict(zip(SHOWN, shown, strict=True))


def _sentences_on_rows(compiled: CompiledModel, outcome: Outcome, forces: Forces) -> list[str]:
    """Return sentences about rows that are redundant, and about rows that are off, in this run."""
    info, start, notes = compiled.info, outcome.start, list[str]()
    extra = compiled.in_force(start.w) - start.rank
    if extra > 0:
        rows = f" ({', '.join(start.redundant_rows)})" if start.redundant_rows else ""
        subject = "1 constraint row depends" if extra == 1 else f"{extra} constraint rows depend"
        which = "shared like the stiffness of rows" if compiled.law.unique_multipliers else "those of minimum norm"
        notes.append(f"{subject} on the others at the start{rows}; multipliers are {which}")
    bounded = {info.rows[row].name for row in info.bounded}
    if off := [name for name in compiled.off(outcome.w) if name not in bounded]:
        notes.append(f"rows off at the end, which exert nothing: {', '.join(off)}")
    if forces.non_unique:
        notes.append("reactions are not unique at " + ", ".join(forces.non_unique))
    return notes


def _warnings_of_dense_factorisation(compiled: CompiledModel, outcome: Outcome) -> list[str]:
    """Return the warnings of the dense factorisation, where it was used."""
    count = outcome.counters["dense_solves"]
    if count == 0:
        return []
    rank, rows = outcome.counters["dense_rank"], compiled.info.m
    return [
        f"accelerations solved by dense orthogonal factorisation in {count} evaluations, rank {rank} of {rows} rows"
    ]
