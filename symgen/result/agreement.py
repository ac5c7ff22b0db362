"""Whether two runs agree: one criterion for ``--verify``, for automatic choices and for references of studies.

Distances are those that errors are measured by (`symgen.result.points`), so an angle counts as the distance by which it
moves a body's far end, and the limit is a share of the mechanism's size: no unit of length matters.

Nothing inside one run sees its global error. A second run with finer steps estimates it (`symgen.reruns`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.result.points import Points

Array = NDArray[np.float64]

#: Two motions agree when no point of a body is farther from its counterpart than this share of the mechanism's size:
#: of the longest body's own length, or of the extent of the motion where all bodies are point masses.
AGREEMENT = 1e-4


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
class Verification:
    """What a run with finer steps says of another one.

    Attributes
    ----------
    doubt : str or None
        Why the motion is not known well enough; None where two runs agree.
    note : str or None
        What was done, one sentence.
    error : float or None
        Estimated error of the run that is reported [m].
    evaluations : int
        Of all runs together.
    """

    doubt: str | None
    note: str | None
    error: float | None
    evaluations: int
