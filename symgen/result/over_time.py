"""Averages over time of values at given times, by the trapezoidal rule."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def time_mean(t: Array, x: Array) -> Array:
    """Return the mean over time of values at times t, shape (n,), of shape (..., n); a single value is its own mean."""
    span = t[-1] - t[0]
    return np.asarray(np.trapezoid(x, t, axis=-1) / span if span > 0.0 else x[..., -1])


def time_rms(t: Array, x: Array) -> Array:
    """Return the root of the mean square; arguments as of `time_mean`."""
    return np.asarray(np.sqrt(time_mean(t, x**2)))
