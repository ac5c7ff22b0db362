"""Status of a run, ok, unverified or failed, with its reason and warnings.

Small violations say nothing about the branch that was taken at a singular position, and there the step size does not
control the error. So every run that came near one says so; where moreover nothing corrected the positions, the run is
not ok unless a second run with finer steps agrees. Nor is it ok where the energy jumped over a passage: that is the
trace of what steps that are too long, or joints that give, have missed there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.ir.numerics import WARN
from symgen.describe.formulas.evaluate import parameter_values
from symgen.result.part_limits import doubt_on_outputs
from symgen.result.points import AGREEMENT, Points
from symgen.result.result import FAILED, INTERRUPTED, OK, UNVERIFIED
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.base.vocabulary.infos import LawInfo
    from symgen.result.points import Verification
    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.outcome import Ended, Outcome

#: Energy jump over a passage, as a fraction of the energy in motion: beyond the first a run is in doubt, beyond the
#: second it has failed.
JUMP_DOUBT, JUMP_FAILURE = 1e-5, 1e-3
#: Energy error of a run that passed near a singular position, as a fraction of the energy in motion, beyond which it is
#: in doubt: steps do not control the error there, and a finer run may err alike.
DRIFT_DOUBT = 1e-4
#: Forces that accelerations leave over, as a fraction of all forces: beyond the first a run is in doubt, beyond the
#: second it has failed. A finer run has the same error, so it settles nothing.
LEFT_DOUBT, LEFT_FAILURE = 1e-5, 1e-2
#: Energy error as a fraction of the energy in motion, beyond which one that finer steps leave as it is needs a word;
#: and one that no second run judges, over the tolerance.
LASTING_ERROR, OVER_TOLERANCE = 1e-6, 1e4
#: A run of adaptive steps with at most so many operations is checked by a second one by default; about 0.2 to 1 s of
#: explicit steps.
MOST_OPERATIONS = 2_000_000_000
#: Places of a motion at which its range is looked for; |Phi| over the length up to which no motion is too small for it.
_PLACES, _OPEN = 16, 1e-12
#: Operations that an evaluation takes beside its formulas; and those of looped code for each number of its scratch.
_CALL, _EACH = 100, 6
#: Why a run whose velocities are scaled to its energy is not ok.
HELD = "velocities are scaled to the energy, which then shows no error: a second run with finer steps has to agree"


@dataclass(frozen=True)
class Verdict:
    """Status and reason of a run, with warnings and notes."""

    status: str
    reason: str | None
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


def count_operations_of_run(run: Prepared, outcome: Outcome) -> int:
    """Return the number of operations of a run, on any machine: an evaluation calls one of the law's functions."""
    law = run.compiled.law
    return outcome.evaluations * (_CALL + (max(law.operations.values(), default=0) or _EACH * law.nw))


def reason_without_check(run: Prepared, outcome: Outcome) -> str | None:
    """Return why no second run estimates the error of a run; None where one does.

    Unless that is set, one does where something was chosen automatically, and where it takes few operations and nobody
    chose the steps or the tolerances.
    """
    verify, settings, count = run.plan.verify, run.plan.settings, count_operations_of_run(run, outcome)
    if verify is False:
        return "verify is off"
    if verify or run.plan.notes:
        return None
    if not run.spec.adaptive:
        return "its steps are constant"
    if settings.rtol is not None or settings.atol is not None:
        return "its tolerances were set"
    return None if count <= MOST_OPERATIONS else f"it took {count:.2g} operations, more than {MOST_OPERATIONS:.2g}"


def is_long(run: Prepared, outcome: Outcome) -> bool:
    """Whether a run that would have a second one by default takes too many operations: its first part is checked."""
    settings = run.plan.settings
    own = settings.rtol is not None or settings.atol is not None or run.plan.verify is not None
    return run.spec.adaptive and not own and outcome.code == abi.DONE and reason_without_check(run, outcome) is not None


def judge(run: Prepared, outcome: Outcome, second: Verification | None = None) -> Verdict:
    """Judge a run by what its loop saw, by a second run where there was one, and by how far its parts bend.

    Parameters
    ----------
    run, outcome : Prepared, Outcome
        The run, and its outcome in coordinates of bodies.
    second : Verification, optional
        Verification by a run with finer steps; it settles all doubts but those of energy that jumped and of parts.
    """
    verdict, plan = _judge_motion(run, outcome, second), run.plan
    if verdict.status == FAILED:
        return verdict
    doubt = doubt_on_outputs(plan.mechanism, parameter_values(plan.mechanism, plan.parameters), outcome)
    return verdict if doubt is None else replace(verdict, status=UNVERIFIED, reason=doubt)


def _judge_motion(run: Prepared, outcome: Outcome, second: Verification | None = None) -> Verdict:
    """Judge a run by what its loop saw, and by a second run where there was one."""
    verdict = judge_alone(outcome, run.compiled.law)
    verdict = replace(
        verdict, warnings=(*verdict.warnings, *_velocity_warning(run, outcome), *_energy_warning(run, outcome, second))
    )
    unbalanced = verdict if verdict.status == FAILED else judge_balance(verdict, outcome.imbalance, run.compiled.law)
    if unbalanced is not verdict:
        return unbalanced
    if verdict.status != FAILED and (loose := _doubt_on_violation(run, outcome)) is not None:
        return replace(verdict, status=UNVERIFIED, reason=loose)
    if second is None or verdict.status == FAILED:
        return verdict
    if second.doubt is not None:
        return replace(verdict, status=UNVERIFIED, reason=second.doubt)
    if relative_jump(outcome) > JUMP_DOUBT or _drifted_where_singular(outcome):  # what joints give is in both runs
        return verdict
    reports = run.plan.verify or run.plan.notes  # else the status alone has the estimate
    notes = (second.note,) if reports and second.note is not None else ()
    return replace(verdict, status=OK, reason=None, notes=notes)


def judge_balance(verdict: Verdict, left: float, law: LawInfo) -> Verdict:
    """Judge a run that has not failed by what its accelerations leave of the forces, as a share of all of them."""
    if left <= LEFT_DOUBT:
        return verdict
    reason = (
        f"accelerations leave {left:.2g} of the forces unbalanced: rounding of large penalties or of light bodies "
        f"stands in for masses ({law.method})"
    )
    return replace(verdict, status=UNVERIFIED if left <= LEFT_FAILURE else FAILED, reason=reason)


def judge_alone(outcome: Ended, law: LawInfo) -> Verdict:
    """Judge a run by what its loop saw, without a second opinion.

    Parameters
    ----------
    outcome : Ended
        Outcome of the loop.
    law : LawInfo
        Corrections of the method.
    """
    passed = _passed_singularity(outcome)
    warnings = tuple(_warnings_of_run(outcome, passed))
    if outcome.code == abi.STOPPED:
        return Verdict(FAILED, INTERRUPTED, warnings)
    if outcome.code != abi.DONE:
        return Verdict(FAILED, outcome.reason, warnings)
    jump = relative_jump(outcome)
    if jump > JUMP_FAILURE:
        return Verdict(FAILED, _sentence_on_jump(outcome), warnings)
    if law.energy_correction:
        return Verdict(UNVERIFIED, HELD, warnings)
    if jump > JUMP_DOUBT:
        return Verdict(UNVERIFIED, _sentence_on_jump(outcome), warnings)
    if _drifted_where_singular(outcome):
        drift = _drift_in_words(outcome, outcome.energy_drift_max)
        reason = f"{drift}, in a run that passed near a singular position{_time_of_passage(outcome)}"
        return Verdict(UNVERIFIED, reason, warnings)
    if not passed or law.position_correction:
        return Verdict(OK, None, warnings)
    reason = (
        f"passed near a singular position{_time_of_passage(outcome)} and positions are not corrected: "
        "nothing tells whether the right branch was taken"
    )
    return Verdict(UNVERIFIED, reason, warnings)


def _passed_singularity(outcome: Ended) -> bool:
    return outcome.rank_event_count > 0 or outcome.smallest_pivot < WARN


def _drifted_where_singular(outcome: Ended) -> bool:
    return _passed_singularity(outcome) and outcome.energy_drift_max > DRIFT_DOUBT * outcome.energy_scale > 0.0


def relative_jump(outcome: Ended) -> float:
    """Return the largest change of the energy error over a passage, as a fraction of the energy in motion."""
    return outcome.energy_jump / outcome.energy_scale if outcome.energy_jump > 0.0 else 0.0


def _warnings_of_run(outcome: Ended, passed: bool) -> list[str]:
    warnings = []
    if passed:
        count = outcome.rank_event_count
        where = _time_of_passage(outcome) + ("" if count <= 1 else f", {count} times in all")
        warnings.append(f"passed near a singular position{where}; the error there is not controlled by the step size")
    light = outcome.counters.get("light", 0)
    if light and not passed:  # near a singular position pivots of D M^-1 D^T are small with any masses
        warnings.append(
            f"light bodies made D M^-1 D^T ill-conditioned in {light} evaluations although D has full rank; "
            "accelerations there lose digits"
        )
    return warnings


def _velocity_warning(run: Prepared, outcome: Outcome) -> list[str]:
    """Say by how much velocities are off that only follow from positions, where it is more than other methods may."""
    speed, violation = float(outcome.w[abi.SPEED]), outcome.velocity_violation_max
    method = run.plan.choice.method
    if not method.velocities_follow or violation <= run.spec.max_violation * speed:
        return []
    return [
        f"velocities are off their constraints by up to {violation:.3g}, {violation / speed:.2g} of the largest speed: "
        f"{method.name} holds positions only, and this is an error of order {run.plan.integrator.order}"
    ]


def _energy_warning(run: Prepared, outcome: Outcome, second: Verification | None) -> list[str]:
    """Say where an energy error is none of the integrator's: some work is not in the balance, or forces jump."""
    if outcome.code != abi.DONE or not outcome.energy_scale > 0.0 or run.compiled.law.energy_correction:
        return []
    if second is not None:
        error, least, why = second.energy, LASTING_ERROR, "finer steps leave it as it is"
    else:
        rtol = run.spec.rtol if run.spec.adaptive else math.inf
        error, least, why = outcome.energy_drift_max, OVER_TOLERANCE * rtol, f"far more than rtol = {rtol:g} explains"
    return [f"{_drift_in_words(outcome, error)}: {why}"] if error / outcome.energy_scale > least else []


def _drift_in_words(outcome: Ended, error: float) -> str:
    share = error / outcome.energy_scale
    return f"the energy leaves its balance by {error:.3g} J, {share:.2g} of the energy in motion"


def _doubt_on_violation(run: Prepared, outcome: Outcome) -> str | None:
    """Say where constraints are open by more than a small motion forgives: finer steps leave joints that give."""
    violation, plan = outcome.position_violation_max, run.plan
    if not violation > _OPEN * float(outcome.w[abi.LENGTH]) or outcome.code != abi.DONE:
        return None
    points = Points.of_mechanism(plan.mechanism, parameter_values(plan.mechanism, plan.parameters))
    q = outcome.states[:, : outcome.compiled.info.nq]
    q = q[np.linspace(0, len(q) - 1, min(len(q), _PLACES)).astype(int)]
    scale = points.scale_of_errors(q)
    if violation <= AGREEMENT * scale:
        return None
    return f"constraints are open by {violation:.2g} m, in a motion of {scale:.2g} m"


def _sentence_on_jump(outcome: Ended) -> str:
    share = relative_jump(outcome)
    jump = f"energy jumped by {outcome.energy_jump:.3g} J, {share:.2g} of the energy in motion"
    return f"{jump}, over a passage near a singular position"


def _time_of_passage(outcome: Ended) -> str:
    """Return time and pivot of the narrowest passage."""
    if not outcome.rank_events:
        return f": smallest pivot {outcome.smallest_pivot:.2g}"
    event = min(outcome.rank_events, key=lambda e: e.smallest_pivot)
    return f" at t = {event.t_in:.6g} s: smallest pivot {event.smallest_pivot:.2g}"
