"""Outcome of a run of a stress study, by its distance to an independent motion, not by its own status."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.result.result import OK

Array = NDArray[np.float64]

#: Outcomes of cells, the best first.
GOOD, INACCURATE, WRONG_BRANCH, SINGULAR, DIVERGED, TOO_SLOW, REFUSED, UNJUDGED = OUTCOMES = (
    *("ok", "inaccurate", "wrong branch", "singular", "diverged", "too slow", "refused", "unjudged"),
)
#: Largest error of an accurate run, as a share of the mechanism's length.
ACCURATE = 1e-3
#: Largest estimated error of a usable reference, as a share of `ACCURATE`.
TRUSTED = 0.5
#: Errors above this share of the length are no longer those of the motion.
LOST = 0.1
#: Smallest singular value of the constraint rows (scaled to length 1), as a share of its largest over the motion, below
#: which the reference is near a singular position; outputs are some way apart, and it falls in a straight line.
NEAR = 0.15
#: |Phi| by the independent equations, as a share of the length, up to which a state is one of the mechanism.
CLOSED = 1e-3


@dataclass(frozen=True)
class CellRun:
    """Facts about a run, apart from its own status.

    Parameters
    ----------
    finished : bool
        Whether the run reached its end.
    errors : Array, shape (k,)
        Distance to the reference [m] at the outputs that it reached.
    sines : Array, shape (n,)
        Of the reference at all outputs: smallest singular value of the independent constraint rows, scaled to length
        1, as a share of the largest on the way.
    violation : float
        |Phi| by the independent equations at the last output reached.
    length : float
        Of the mechanism [m], as in comparisons.
    """

    finished: bool
    errors: Array
    sines: Array
    violation: float
    length: float


def classify_outcome(run: CellRun) -> str:
    """Return one of `OUTCOMES` for a run.

    An error up to `ACCURATE` of the length is ok. Beyond that, a run that keeps the constraints by the independent
    equations closed, after an error that arose near a singular position, is on a wrong branch; other finished runs are
    inaccurate while constraints are closed or the error is below `LOST` of the length, else diverged. A run that ended
    early is singular where the reference is near a singular position there, else diverged.
    """
    last = len(run.errors)
    largest = largest_error(run.errors)
    if run.finished:
        if largest is not None and largest <= ACCURATE * run.length:
            return GOOD
        closed = run.violation <= CLOSED * run.length
        if largest is None or not np.isfinite(run.violation):
            return DIVERGED
        if closed and largest > LOST * run.length and _lost_near_a_singular_position(run):
            return WRONG_BRANCH
        return INACCURATE if closed or largest <= LOST * run.length else DIVERGED
    # the outputs around the end: it lies between the last one reached and the next
    around = run.sines[max(0, last - 2) : last + 2]
    if len(around) and float(np.min(around)) < NEAR:
        return SINGULAR
    return DIVERGED


def largest_error(errors: Array) -> float | None:
    """Return the largest error, None where one is not finite or there is none."""
    if not len(errors) or not np.all(np.isfinite(errors)):
        return None
    return float(np.max(errors))


def _lost_near_a_singular_position(run: CellRun) -> bool:
    """Whether the error grew beyond bounds within a few outputs of a position where the rows are almost dependent."""
    lost = int(np.argmax(run.errors > LOST * run.length))
    began = int(np.argmax(run.errors > ACCURATE * run.length))
    before = run.sines[max(0, began - 3) : lost + 1]
    return bool(len(before)) and float(np.min(before)) < NEAR


def false_success(status: str, outcome: str) -> bool:
    """Whether a run says ok although its error exceeds `ACCURATE`; False without a reference."""
    return status == OK and outcome not in (GOOD, UNJUDGED, TOO_SLOW, REFUSED)


def count_outcomes(outcomes: Sequence[str]) -> dict[str, int]:
    """Return the number of occurrences of every outcome."""
    return {name: outcomes.count(name) for name in OUTCOMES}
