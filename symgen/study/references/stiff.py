"""Whether the decay of a motion is much faster than it lasts, so that implicit steps suit it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.study.references.solvers import jacobian

if TYPE_CHECKING:
    from symgen.study.references.motion import CompiledEquations

Array = NDArray[np.float64]

#: Decay of so many e-foldings over the motion is left to Radau.
STIFF_FOLDINGS = 3e4


def decay(equations: CompiledEquations, y: Array) -> float:
    """Return the fastest decay of the linearised equations at a state [1/s]."""
    return _modes(equations, y)[0]


def is_stiff(equations: CompiledEquations, y: Array, until: float) -> bool:
    """Whether something decays over a motion by more than `STIFF_FOLDINGS`.

    What conserves energy has modes in pairs, one that grows for each that decays, and is not stiff however long it
    lasts; what counts is by how much decay exceeds growth.
    """
    falling, growing = _modes(equations, y)
    return (falling - growing) * until > STIFF_FOLDINGS


def _modes(equations: CompiledEquations, y: Array) -> tuple[float, float]:
    """Return the fastest decay and the fastest growth [1/s]."""
    slopes = jacobian(equations.rate, 0.0, y)
    if not np.all(np.isfinite(slopes)):
        return 0.0, 0.0
    real = np.linalg.eigvals(slopes).real
    return float(max(0.0, -real.min(initial=0.0))), float(real.max(initial=0.0))
