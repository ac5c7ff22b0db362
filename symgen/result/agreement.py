"""Whether two runs agree: one criterion for ``--verify``, for automatic choices and for references of studies.

Distances are those that errors are measured by (`symgen.result.points`), so an angle counts as the distance by which it
moves a body's far end, and the limit is a share of the mechanism's size: no unit of length matters.

Nothing inside one run sees its global error. A second run with finer steps estimates it: `settle` makes one where it is
asked for (``--verify``) and where anything was chosen automatically, since who leaves the choice to the program has not
looked at tolerances either.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.evaluate import parameter_values
from symgen.result.points import Points
from symgen.runtime import abi
from symgen.runtime.run import integrate

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from symgen.describe.mechanism import Mechanism
    from symgen.plan import Plan
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.outcome import Outcome

Array = NDArray[np.float64]

#: Two motions agree when no point of a body is farther from its counterpart than this share of the mechanism's size:
#: of the longest body's own length, or of the extent of the motion where all bodies are point masses.
AGREEMENT = 1e-4
#: A finer run has this share of a constant step; or of tolerances, and the square of it where two runs differ by far.
HALF, TENTH = 0.5, 0.1
#: Tolerances are not made smaller than this.
SMALLEST_RTOL = 1e-13


@dataclass(frozen=True)
class Agreement:
    """How far two motions are apart.

    Attributes
    ----------
    distances : Array, shape (k,)
        Largest distance between corresponding points at each output [m].
    limit : float
        Up to which they agree [m].
    """

    distances: Array
    limit: float

    @property
    def apart(self) -> float:
        """Largest distance of all [m]; nan if a motion is not finite."""
        return float(self.distances.max(initial=0.0))

    @property
    def holds(self) -> bool:
        """Whether they agree."""
        return self.apart <= self.limit

    @property
    def parts(self) -> int | None:
        """First output at which they do not agree, None if they do."""
        away = np.flatnonzero(~(self.distances <= self.limit))
        return int(away[0]) if len(away) else None


def agreement(points: Points, a: Array, b: Array) -> Agreement:
    """Compare two motions.

    Parameters
    ----------
    points : Points
        What distances are measured between.
    a, b : Array, shape (k, nq)
        Coordinates at the same times.
    """
    with np.errstate(all="ignore"):
        return Agreement(points.distances(a, b), AGREEMENT * points.size(a))


@dataclass(frozen=True)
class Rerun:
    """A run repeated with finer steps.

    Attributes
    ----------
    plan, outcome : Plan, Outcome
        The second run.
    name : str
        What it was, with its step or tolerance.
    agreement : Agreement or None
        With the first one; None where the second one did not come to its end.
    """

    plan: Plan
    outcome: Outcome
    name: str
    agreement: Agreement | None

    @property
    def error(self) -> float | None:
        """Estimated error of the first run [m], None where nothing is known.

        With half the step h of a scheme of order p, errors c h^p and c (h/2)^p are apart by (1 - 2^-p) c h^p. With
        smaller tolerances the error of the second run is left out.
        """
        if self.agreement is None or not math.isfinite(self.agreement.apart):
            return None
        share = 0.0 if self.plan.spec.adaptive else HALF**self.plan.tableau.order
        return self.agreement.apart / (1.0 - share)

    @property
    def ended(self) -> str:
        """Why it did not come to its end."""
        return "it takes too many evaluations" if self.outcome.code == abi.STOPPED else self.outcome.reason


def run_again(
    compiled: CompiledModel,
    plan: Plan,
    outcome: Outcome,
    points: Points,
    tolerance: float = TENTH,
    positions: Callable[[Outcome], Array] | None = None,
) -> Rerun:
    """Run again from the same start with finer steps, and compare positions at all outputs.

    Parameters
    ----------
    compiled, plan, outcome : CompiledModel, Plan, Outcome
        A run that came to its end.
    points : Points
        What distances are measured between.
    tolerance : float, optional
        Tolerances of an adaptive run are multiplied by it; a constant step is halved.
    positions : callable, optional
        Returns the coordinates of bodies at the outputs, shape (k, nq), where they are not the state's.
    """
    spec = plan.spec
    if spec.adaptive:
        spec = replace(spec, rtol=spec.rtol * tolerance, atol=spec.atol * tolerance)
    else:
        assert spec.step is not None, "a constant step is given"
        spec = replace(spec, step=spec.step * HALF)
    other = replace(plan, spec=spec)
    start = replace(outcome.start, saved=None)  # another grid of steps begins there
    second, nq = integrate(compiled, plan.tableau, start, spec), compiled.info.nq
    found = None
    if second.code == abi.DONE:
        a, b = _comparable(outcome, second)
        first, other_one = (o.states[:, :nq] if positions is None else positions(o) for o in (outcome, second))
        found = agreement(points, first[a], other_one[b])
    return Rerun(other, second, f"a run with {steps_of(other)}", found)


def _comparable(first: Outcome, second: Outcome) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return which outputs of two runs to compare: those at the same times, and the last ones where both end early.

    Where only one of them has been stopped by an event, its last output stands beside that of the other one.
    """
    same = min(len(first.times), len(second.times))
    apart = np.flatnonzero(first.times[:same] != second.times[:same])
    same = int(apart[0]) if len(apart) else same
    rows = [np.arange(same) for _ in range(2)]
    if same < max(len(first.times), len(second.times)):
        rows = [np.append(rows[0], len(first.times) - 1), np.append(rows[1], len(second.times) - 1)]
    return rows[0], rows[1]


def steps_of(plan: Plan) -> str:
    """Return what chooses the steps of a run, in words."""
    return f"rtol = {plan.spec.rtol:g}" if plan.spec.adaptive else f"step = {plan.spec.step:g} s"


@dataclass(frozen=True)
class Settled:
    """A run that was repeated with finer steps.

    Attributes
    ----------
    plan, outcome : Plan, Outcome
        The run that is reported: the first one, or the finest where tolerances were made smaller.
    doubt : str or None
        Why the motion is not known well enough; None where two runs agree.
    note : str or None
        What was done, one sentence.
    error : float or None
        Estimated error of the run that is reported [m].
    evaluations : int
        Of all runs together.
    """

    plan: Plan
    outcome: Outcome
    doubt: str | None
    note: str | None
    error: float | None
    evaluations: int


def settle(
    mechanism: Mechanism,
    parameters: Mapping[str, float],
    plan: Plan,
    compiled: CompiledModel,
    outcome: Outcome,
    free: bool = False,
    positions: Callable[[Outcome], Array] | None = None,
) -> Settled:
    """Compare a run with a finer one.

    Parameters
    ----------
    mechanism, parameters : Mechanism, mapping
        What was run, and the values of parameters that differ from the described ones.
    plan, compiled, outcome : Plan, CompiledModel, Outcome
        The run.
    free : bool
        Whether nobody asked for the tolerances of an adaptive run: they are made smaller then until two runs agree, and
        the finer one of these is reported.
    positions : callable, optional
        See `run_again`.

    Returns
    -------
    Settled
        The run as it is where it did not come to its end.
    """
    total = outcome.evaluations
    if outcome.code != abi.DONE:
        return Settled(plan, outcome, None, None, None, total)
    points = Points.of(mechanism, parameter_values(mechanism, parameters))
    free, share, error = free and plan.spec.adaptive, TENTH, None
    while True:
        if error is not None and plan.spec.rtol * share < SMALLEST_RTOL:
            doubt = f"two runs still differ by {error:.2g} m at {steps_of(plan)}"
            return Settled(plan, outcome, doubt, None, error, total)
        second = run_again(compiled, plan, outcome, points, share, positions)
        total += second.outcome.evaluations
        if second.outcome.interrupted:
            doubt = "the check with finer steps was interrupted"
            return Settled(plan, replace(outcome, interrupted=True), doubt, None, error, total)
        if second.agreement is None:
            doubt = f"a check by {second.name} did not come to its end: {second.ended}"
            return Settled(plan, outcome, doubt, None, error, total)
        apart, error = second.agreement.apart, second.error
        if second.agreement.holds:
            kept, result = (second.plan, second.outcome) if free else (plan, outcome)
            note = f"verified: {second.name} agrees within {apart:.2g} m"
            return Settled(kept, result, None, note, error, total)
        if not free or error is None:
            return Settled(plan, outcome, f"{second.name} differs by {apart:.2g} m", None, error, total)
        # errors fall about as tolerances do: far from agreement, the next but one is tried
        share = TENTH**2 if apart > second.agreement.limit / TENTH else TENTH
        plan, outcome = second.plan, second.outcome
