"""What a run may claim: ok, unverified or failed, and the sentences that go with it.

Small violations say nothing about the branch that was taken at a singular position, and there the step size does not
control the error. So every run that came near one says so; where moreover nothing corrected the positions, the run is
not ok unless a second run with other steps agrees.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from symgen.result.result import FAILED, INTERRUPTED, OK, UNVERIFIED
from symgen.runtime import abi
from symgen.runtime.run import WARN, integrate

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from symgen.model import CompiledModel
    from symgen.plan import Plan, Settings
    from symgen.runtime.run import Outcome, RankEvent

#: Two runs agree when no coordinate differs by more than this, times the largest coordinate (at least 1).
AGREEMENT = 1e-6
#: Energy jump over a passage, as a fraction of the energy in motion: from the first on a warning, the second failure.
JUMP_WARNING, JUMP_FAILURE = 1e-6, 1e-3
#: A rerun with a constant step takes this fraction of it; an adaptive one takes this fraction of the tolerances.
OTHER_STEP, OTHER_TOLERANCE = 0.9, 0.1


@dataclass(frozen=True)
class Verdict:
    """Status and reason of a run, with warnings and notes."""

    status: str
    reason: str | None
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


class Seen(Protocol):
    """What the loop of a run saw: an `Outcome`, or a row of an ensemble."""

    @property
    def code(self) -> int:
        """How it ended; see `symgen.runtime.abi`."""

    @property
    def reason(self) -> str:
        """Why, in words; empty at its end."""

    @property
    def smallest_pivot(self) -> float:
        """Of D D^T with scaled rows."""

    @property
    def rank_events(self) -> Sequence[RankEvent]:
        """Passages near singular positions."""

    @property
    def rank_event_count(self) -> int:
        """How many there were, listed or not."""

    @property
    def energy_jump(self) -> float:
        """Largest change of the energy error over a passage [J]."""

    @property
    def energy_scale(self) -> float:
        """Energy in motion [J]."""

    @property
    def counters(self) -> Mapping[str, int]:
        """Counts of the emitted code by name."""


def judge(settings: Settings, plan: Plan, compiled: CompiledModel, outcome: Outcome) -> Verdict:
    """Judge a run by what its loop saw; with ``settings.verify``, run again at another step to settle doubts.

    Parameters
    ----------
    settings, plan : Settings, Plan
        What was asked for.
    compiled : CompiledModel
        Model and method.
    outcome : Outcome
        What the loop gave.
    """
    verdict = judge_alone(outcome, compiled.law.position_correction)
    verdict = replace(verdict, warnings=(*verdict.warnings, *_velocity_warning(plan, outcome)))
    if verdict.status == FAILED or not settings.verify:
        return verdict
    if not _passed(outcome):
        return replace(verdict, notes=("nothing to verify: the run met no position near a singular one",))
    return _verified(verdict, plan, compiled, outcome)


def judge_alone(outcome: Seen, position_correction: bool) -> Verdict:
    """Judge a run by what its loop saw, without a second opinion.

    Parameters
    ----------
    outcome : Seen
        What the loop gave.
    position_correction : bool
        Whether the method corrects positions.
    """
    passed = _passed(outcome)
    warnings = tuple(_warnings(outcome, passed))
    if outcome.code == abi.STOPPED:
        return Verdict(FAILED, INTERRUPTED, warnings)
    if outcome.code != abi.DONE:
        return Verdict(FAILED, outcome.reason, warnings)
    jump = relative_jump(outcome)
    if jump > JUMP_FAILURE:
        reason = (
            f"energy jumped by {outcome.energy_jump:.3g} J, {jump:.2g} of the energy in motion, over a singular passage"
        )
        return Verdict(FAILED, reason, warnings)
    verdict = Verdict(OK, None, warnings)
    if passed and not position_correction:
        reason = (
            f"passed near a singular position{_when(outcome)} and positions are not corrected: "
            "nothing tells whether the right branch was taken"
        )
        verdict = Verdict(UNVERIFIED, reason, warnings)
    return verdict


def _passed(outcome: Seen) -> bool:
    return outcome.rank_event_count > 0 or outcome.smallest_pivot < WARN


def relative_jump(outcome: Seen) -> float:
    """Return the largest change of the energy error over a passage, as a fraction of the energy in motion."""
    return outcome.energy_jump / outcome.energy_scale if outcome.energy_jump > 0.0 else 0.0


def _warnings(outcome: Seen, passed: bool) -> list[str]:
    warnings = []
    if passed:
        count = outcome.rank_event_count
        where = _when(outcome) + ("" if count <= 1 else f", {count} times in all")
        warnings.append(f"passed near a singular position{where}; the error there is not controlled by the step size")
    jump = relative_jump(outcome)
    if JUMP_WARNING < jump <= JUMP_FAILURE:
        warnings.append(_jumped(outcome))
    light = outcome.counters.get("light", 0)
    if light and not passed:  # near a singular position pivots of D M^-1 D^T are small with any masses
        warnings.append(
            f"light bodies made D M^-1 D^T ill-conditioned in {light} evaluations although D has full rank; "
            "accelerations there lose digits"
        )
    return warnings


def _velocity_warning(plan: Plan, outcome: Outcome) -> list[str]:
    """Say by how much velocities are off that only follow from positions, where it is more than other methods may."""
    speed, found = float(outcome.w[abi.SPEED]), outcome.velocity_violation_max
    if not plan.choice.method.velocities_follow or found <= plan.spec.max_violation * speed:
        return []
    return [
        f"velocities are off their constraints by up to {found:.3g}, {found / speed:.2g} of the largest speed: "
        f"{plan.choice.method.name} holds positions only, and this is an error of order {plan.tableau.order}"
    ]


def _jumped(outcome: Seen) -> str:
    share = relative_jump(outcome)
    return f"energy jumped by {outcome.energy_jump:.3g} J, {share:.2g} of the energy in motion, over a singular passage"


def _when(outcome: Seen) -> str:
    """Return time and pivot of the narrowest passage."""
    if not outcome.rank_events:
        return f": smallest pivot {outcome.smallest_pivot:.2g}"
    event = min(outcome.rank_events, key=lambda e: e.smallest_pivot)
    return f" at t = {event.t_in:.6g} s: smallest pivot {event.smallest_pivot:.2g}"


# -- a second opinion --------------------------------------------------------------------------------------------------


def _verified(verdict: Verdict, plan: Plan, compiled: CompiledModel, outcome: Outcome) -> Verdict:
    """Run again with other steps and compare positions at all outputs."""
    spec = plan.spec
    if spec.adaptive:
        spec = replace(spec, rtol=spec.rtol * OTHER_TOLERANCE, atol=spec.atol * OTHER_TOLERANCE)
        other = f"a rerun with rtol = {spec.rtol:g}"
    else:
        assert spec.step is not None, "a constant step is given"
        spec = replace(spec, step=spec.step * OTHER_STEP)
        other = f"a rerun with step = {spec.step:g} s"
    second = integrate(compiled, plan.tableau, outcome.start, spec)
    if second.code == abi.STOPPED:
        return replace(verdict, notes=("the verification was interrupted",))
    if second.code != abi.DONE:
        return Verdict(UNVERIFIED, f"{other} failed: {second.reason}", verdict.warnings)
    nq = compiled.info.nq
    scale = max(1.0, float(np.abs(outcome.states[:, :nq]).max(initial=0.0)))
    difference = float(np.abs(outcome.states[:, :nq] - second.states[:, :nq]).max(initial=0.0))
    if not difference <= AGREEMENT * scale:
        return Verdict(
            UNVERIFIED,
            f"passed near a singular position{_when(outcome)}, and {other} differs by {difference:.3g} in a coordinate",
            verdict.warnings,
        )
    note = f"verified: {other} agrees within {difference:.2g} in every coordinate"
    return Verdict(OK, None, verdict.warnings, (note,))
