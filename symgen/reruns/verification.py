"""The error of a run, estimated by a second run with finer steps.

A second run is made on request (``--verify``), where anything was chosen automatically, and where a run with default
tolerances took few operations: who leaves the choice to the program has not looked at tolerances either.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.evaluate import parameter_values
from symgen.layout import abi
from symgen.result.points import Agreement, Points, Verification, agreement

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.running.prepare import Prepared
    from symgen.runs.outcome import Outcome

#: A finer run has this share of a constant step; or of tolerances, and the square of it where two runs differ by far.
HALF, TENTH = 0.5, 0.1
#: Tolerances are not made smaller than this.
SMALLEST_RTOL = 1e-13


def run_again(
    run: Prepared, outcome: Outcome, points: Points, tolerance: float
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
    a, b = _comparable(outcome, second)
    return finer, second, agreement(points, run.positions(outcome)[a], run.positions(second)[b])


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


def _steps_of(run: Prepared) -> str:
    """Return in words how the steps of a run are chosen."""
    return f"rtol = {run.spec.rtol:g}" if run.spec.adaptive else f"step = {run.spec.step:g} s"


def verified(run: Prepared, outcome: Outcome, free: bool = False) -> tuple[Prepared, Outcome, Verification]:
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
    points = Points.of(run.plan.mechanism, parameter_values(run.plan.mechanism, run.plan.parameters))
    # with half the step h of a scheme of order p, errors c h^p and c (h/2)^p are apart by (1 - 2^-p) c h^p; with
    # smaller tolerances the error of the second run is left out
    apart_of_error = 1.0 - (0.0 if run.spec.adaptive else HALF**run.plan.integrator.order)
    free, share, error = free and run.spec.adaptive, TENTH, None
    while True:
        if error is not None and run.spec.rtol * share < SMALLEST_RTOL:
            doubt = f"two runs still differ by {error:.2g} m at {_steps_of(run)}"
            return run, outcome, Verification(doubt, None, error, total)
        finer, second, agreed = run_again(run, outcome, points, share)
        total += second.evaluations
        name = f"a run with {_steps_of(finer)}"
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
            verification = Verification(None, f"verified: {name} agrees within {apart:.2g} m", error, total)
            return (finer, second, verification) if free else (run, outcome, verification)
        if not free or error is None:
            return run, outcome, Verification(f"{name} differs by {apart:.2g} m", None, error, total)
        # errors fall about as tolerances do: far from agreement, the next but one is tried
        share = TENTH**2 if apart > agreed.limit / TENTH else TENTH
        run, outcome = finer, second
