"""The error of a run, estimated by a second run with finer steps.

A second run is made on request (``--verify``), where anything was chosen automatically, and where a run with default
tolerances took few operations: who leaves the choice to the program has not looked at tolerances either.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.formulas.evaluate import parameter_values
from symgen.result import judge
from symgen.result.points import Agreement, Points, Verification, compare_motions
from symgen.run.layout import abi

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.outcome import Outcome

#: A finer run has this share of a constant step; or of tolerances, and the square of it where two runs differ by far.
HALF, TENTH = 0.5, 0.1
#: An energy error that finer steps leave above this part is none of theirs: with half a step even Euler's halves.
LASTING = 0.75
#: Tolerances are not made smaller than this.
SMALLEST_RTOL = 1e-13
#: Operations of a run with a tenth of the tolerances, over those of the run, at most as a rule.
DEARER = 1.5
#: Of a long run at least this part is checked, at so many outputs or more.
LEAST_PART, FEWEST = 1e-9, 1001


def rerun_with_finer_steps(
    run: Prepared, outcome: Outcome, points: Points, tolerance: float, by_motion: bool = False
) -> tuple[Prepared, Outcome, Agreement | None]:
    """Run again from the same start with finer steps, and compare positions at all outputs.

    Parameters
    ----------
    run, outcome : Prepared, Outcome
        A run that came to its end.
    points : Points
        Points between which distances are measured.
    tolerance : float
        Tolerances of an adaptive run are multiplied by it; a constant step is halved.
    by_motion : bool
        As for `symgen.result.points.compare_motions`.

    Returns
    -------
    run, outcome : Prepared, Outcome
        The second run.
    agreement : Agreement or None
        With the first one; None where the second one did not come to its end.
    """
    spec = run.spec
    if spec.adaptive:
        finer = run.with_spec(rtol=spec.rtol * tolerance, atol=spec.atol * tolerance)
    else:
        assert spec.step is not None, "a constant step is given"
        finer = run.with_spec(step=spec.step * HALF)
    start = outcome.start
    if start.saved is not None:  # another grid of steps begins there, and with it another balance of energy
        y = start.y.copy()
        y[outcome.compiled.info.work] = 0.0
        start = replace(start, saved=None, y=y)
    second = finer.integrate(start=start)
    if second.code != abi.DONE:
        return finer, second, None
    a, b = _outputs_to_compare(outcome, second)
    return finer, second, compare_motions(points, run.positions(outcome)[a], run.positions(second)[b], by_motion)


def verify_first_part(run: Prepared, outcome: Outcome) -> Verification:
    """Compare the first part of a long run with a finer one, which takes about as many operations as a check may.

    Parameters
    ----------
    run, outcome : Prepared, Outcome
        A run that came to its end, with adaptive steps.

    Returns
    -------
    Verification
        With a doubt: where the part agrees, nothing is known of what follows.
    """
    begin, times = run.start.t, outcome.times
    share = judge.MOST_OPERATIONS / (DEARER * max(judge.count_operations_of_run(run, outcome), 1))
    until = begin + share * (outcome.end - begin)
    count = int(np.searchsorted(times, until, side="right"))
    if share < LEAST_PART:
        return Verification("no part of it was checked", None, None, outcome.evaluations, whole=False)
    if count < FEWEST:  # the run itself has no outputs to compare
        shorter = run.with_spec(until=until, times=np.linspace(begin, until, FEWEST))
        outcome = shorter.integrate()
        times = outcome.times
    else:
        until, times = float(times[count - 1]), times[:count]
        shorter = run.with_spec(until=until, times=times)
        outcome = replace(outcome, times=times, states=outcome.states[:count])
    points = Points.of_mechanism(run.plan.mechanism, parameter_values(run.plan.mechanism, run.plan.parameters))
    finer, second, agreed = rerun_with_finer_steps(shorter, outcome, points, TENTH)
    total, name = outcome.evaluations + second.evaluations, f"a run with {_steps_in_words(finer)}"
    if second.interrupted or agreed is None:
        doubt = f"a check of its part up to t = {until:.6g} s did not come to its end: {second.reason}"
        return Verification(doubt, None, None, total, whole=False)
    error = max(agreed.apart, agreed.rounding)
    if agreed.holds:
        doubt = f"checked up to t = {until:.6g} s alone: there {name} agrees within {error:.2g} m"
        return Verification(doubt, None, None, total, whole=False)
    return Verification(_difference_of_runs(name, agreed, times), None, error if math.isfinite(error) else None, total)


def _difference_of_runs(name: str, agreed: Agreement, times: NDArray[np.float64]) -> str:
    """Return by how much two runs differ, and up to when they agree."""
    first = agreed.parts or 0
    upto = f"; they agree up to t = {times[first - 1]:.6g} s" if first > 1 else ""
    motion = f" in a motion of {agreed.small:.2g} m" if agreed.small else ""
    return f"{name} differs by {agreed.apart:.2g} m{motion}{upto}"


def _lasting_energy_error(first: Outcome, second: Outcome) -> float:
    """Return the energy error [J] that finer steps do not make smaller, 0 where they do."""
    error, finer = first.energy_drift_max, second.energy_drift_max
    return min(error, finer) if finer > LASTING * error else 0.0


def _outputs_to_compare(first: Outcome, second: Outcome) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return which outputs of two runs to compare: those at the same times, and the last ones where both end early.

    Where an event has stopped only one of them, its last output is compared with that of the other one.
    """
    same = min(len(first.times), len(second.times))
    apart = np.flatnonzero(first.times[:same] != second.times[:same])
    same = int(apart[0]) if len(apart) else same
    rows = [np.arange(same) for _ in range(2)]
    if same < max(len(first.times), len(second.times)):
        rows = [np.append(rows[0], len(first.times) - 1), np.append(rows[1], len(second.times) - 1)]
    return rows[0], rows[1]


def _steps_in_words(run: Prepared) -> str:
    """Return in words how the steps of a run are chosen."""
    return f"rtol = {run.spec.rtol:g}" if run.spec.adaptive else f"step = {run.spec.step:g} s"


def verify_run(run: Prepared, outcome: Outcome, free: bool = False) -> tuple[Prepared, Outcome, Verification]:
    """Compare a run with a finer one.

    Parameters
    ----------
    run, outcome : Prepared, Outcome
        The run.
    free : bool
        Whether the tolerances of an adaptive run are defaults: they are made smaller then until two runs agree, and
        the finer one of these is reported.

    Returns
    -------
    run, outcome : Prepared, Outcome
        The run that is reported: the first one, or the finest where tolerances were made smaller.
    verification : Verification
        Verification by the finer run; nothing where the first run did not reach its end.
    """
    total = outcome.evaluations
    if outcome.code != abi.DONE:
        return run, outcome, Verification(None, None, None, total)
    points = Points.of_mechanism(run.plan.mechanism, parameter_values(run.plan.mechanism, run.plan.parameters))
    # with half the step h of a scheme of order p, errors c h^p and c (h/2)^p are apart by (1 - 2^-p) c h^p; with
    # smaller tolerances the error of the second run is left out
    apart_of_error = 1.0 - (0.0 if run.spec.adaptive else HALF**run.plan.integrator.order)
    free, share, error = free and run.spec.adaptive, TENTH, None
    while True:
        if error is not None and run.spec.rtol * share < SMALLEST_RTOL:
            doubt = f"two runs still differ by {error:.2g} m at {_steps_in_words(run)}"
            return run, outcome, Verification(doubt, None, error, total)
        finer, second, agreed = rerun_with_finer_steps(run, outcome, points, share, by_motion=not free)
        total += second.evaluations
        name = f"a run with {_steps_in_words(finer)}"
        if second.interrupted:
            doubt = "the check with finer steps was interrupted"
            return run, replace(outcome, interrupted=True), Verification(doubt, None, error, total)
        if agreed is None:
            end = "it takes too many evaluations" if second.code == abi.STOPPED else second.reason
            doubt = f"a check by {name} did not come to its end: {end}"
            return run, outcome, Verification(doubt, None, error, total)
        apart = agreed.apart
        # two runs may agree to the last bit, and neither is exact
        error = max(apart / apart_of_error, agreed.rounding) if math.isfinite(apart) else None
        if agreed.holds:
            note, energy = f"verified: {name} agrees within {apart:.2g} m", _lasting_energy_error(outcome, second)
            verification = Verification(None, note, error, total, energy=energy)
            return (finer, second, verification) if free else (run, outcome, verification)
        if not free or error is None:
            return run, outcome, Verification(_difference_of_runs(name, agreed, outcome.times), None, error, total)
        # errors fall about as tolerances do: far from agreement, the next but one is tried
        share = TENTH**2 if apart > agreed.limit / TENTH else TENTH
        run, outcome = finer, second
