"""Derivatives of rates by central differences."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def difference_steps(y: Array) -> Array:
    """Return the steps of central differences at a state."""
    return np.asarray(1e-6 * np.maximum(1.0, np.abs(y)))


def difference_jacobian(rate: Callable[[float, Array], Array], t: float, y: Array) -> Array:
    """Return the Jacobian of rates by central differences, shape (2 n, 2 n).

    SciPy's own differences enlarge the step of a coordinate that no rate depends on, at every call, until it overflows.
    """
    steps = difference_steps(y)
    columns = [
        (rate(t, y + step * unit) - rate(t, y - step * unit)) / (2.0 * step)
        for step, unit in zip(steps, np.eye(len(y)), strict=True)
    ]
    return np.column_stack(columns)
