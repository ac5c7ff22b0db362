"""References through singular positions: runs whose steps fall differently, and whether they agree.

At an isolated singular position accelerations are not determined; an error estimate measures noise there, and steps
that follow it collapse. What carries a run through is a constant step with a projection after each. How well it does
depends on where its steps fall, so two runs with other steps have to agree before either is believed; small violations
say nothing about the branch.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.errors import SimulationError
from symgen.result.points import agreement
from symgen.study.references.solvers import Scheme, by_steps
from symgen.study.references.time_parts import longest_of

if TYPE_CHECKING:
    from symgen.result.points import Points
    from symgen.study.references.independent import IndependentEquations

Array = NDArray[np.float64]

#: A position counts as near-singular where the smallest singular value of D, rows scaled to length 1, is below this
#: fraction of its largest value of the run: the root of the runtime's threshold, which is one of squares. A fraction,
#: because short links in metres make the value itself small everywhere.
NEAR = 1e-2
#: Steps of the runs, as fractions of the first one's.
PHASES = (1.0, 0.93, 0.81, 1.11, 0.71, 0.62)
#: Two runs that differ by less, as a share of the mechanism's size, are not doubted further.
GOOD = 1e-9


def scaled_values(d: Array) -> Array:
    """Return the singular values of rows that are scaled to length 1."""
    lengths = np.linalg.norm(d, axis=1)
    return np.asarray(np.linalg.svd(d / np.where(lengths > 0.0, lengths, 1.0)[:, None], compute_uv=False))


class SingularWatch:
    """Keeps the smallest and the largest of the smallest singular values of D (rows scaled) that a run has met.

    Parameters
    ----------
    equations : IndependentEquations
        What is integrated.
    y : Array, shape (2 n,)
        The start, whose rank counts: rows that depend on others for ever are no passage.
    """

    def __init__(self, equations: IndependentEquations, y: Array) -> None:
        self.equations = equations
        values = self._values(0.0, y)
        self.rank = int(np.sum(values > 1e-6))
        self.smallest, self.largest = np.inf, 0.0
        self.see(0.0, y)

    def _values(self, t: float, y: Array) -> Array:
        n = self.equations.n
        d = self.equations.evaluate(t, y[:n], y[n:])[1]
        return scaled_values(d) if np.all(np.isfinite(d)) else np.zeros(len(d))

    def see(self, t: float, y: Array) -> None:
        """Look at a state."""
        if self.rank:
            value = float(self._values(t, y)[self.rank - 1])
            self.smallest, self.largest = min(self.smallest, value), max(self.largest, value)

    @property
    def passed(self) -> bool:
        """Whether a position seen was near a singular one."""
        return self.smallest < NEAR * self.largest


@dataclass(frozen=True)
class SingularPassage:
    """Two runs through singular positions.

    Attributes
    ----------
    q : Array, shape (k, n)
        Coordinates of one of them.
    difference : float
        Largest distance between the two [m].
    parted : float or None
        First output time at which they do not agree (`symgen.result.points`) [s]; None if they do.
    runs : int
        How many were made.
    step : float
        Step of the first [s].
    """

    q: Array
    difference: float
    parted: float | None
    runs: int
    step: float


def pass_through(
    equations: IndependentEquations,
    y: Array,
    times: Array,
    step: float,
    points: Points,
    phases: tuple[float, ...] = PHASES,
) -> SingularPassage:
    """Run with different steps until two runs agree well; of all pairs the one that agrees best is returned.

    Parameters
    ----------
    equations, y, times
        What is integrated, from which consistent state, and where it is wanted [s].
    step : float
        Step of the first run [s].
    points : Points
        What distances are measured between.
    phases : tuple of float
        Steps as fractions of `step`.

    Raises
    ------
    SimulationError
        If fewer than two runs come to the end.
    """
    motions, failures = list[Array](), list[str]()
    step = min(step, longest_of(equations, times) / max(phases))
    if len(times) > 1:  # steps that were longer than from one output to the next would all fall alike
        step = min(step, float(np.median(np.diff(times))) / max(phases))
    best: SingularPassage | None = None
    for i, phase in enumerate(phases):
        try:
            motion = march(equations, y, times, phase * step)
        except SimulationError as error:
            failures.append(str(error))
            continue
        for other in motions:
            found = agreement(points, other, motion)
            if best is None or found.apart < best.difference:
                best = SingularPassage(
                    other, found.apart, None if found.parts is None else float(times[found.parts]), i + 1, step
                )
        motions.append(motion)
        if best is not None and best.difference < GOOD * points.size(motion):
            break
    if best is None:
        raise SimulationError(failures[0])
    return best


def march(equations: IndependentEquations, y: Array, times: Array, step: float) -> Array:
    """Return q at `times` by DOP853 at a constant step, mass-weighted projections after each."""
    return by_steps(equations, y, times, Scheme("DOP853", np.inf, step=step))
