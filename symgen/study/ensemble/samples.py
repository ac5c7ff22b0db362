"""Samples: which axes are random, and how much of a quantity's variance each varied number contributes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, plural
from symgen.study.ensemble.axes import Axis, Grid

Array = NDArray[np.float64]

#: What tables show of a sample [%].
PERCENTILES = (5.0, 50.0, 95.0)
#: A sample has so many values at least.
FEWEST = 10


def is_sample(axis: Axis) -> bool:
    """Whether many values of an axis go up and down: they are random, and a line through them means nothing."""
    if len(axis) < FEWEST:  # typed in any order
        return False
    steps = [np.diff(values) for values in axis.values.values()]
    return any(bool(np.any(step > 0.0) and np.any(step < 0.0)) for step in steps)


def has_samples(grid: Grid) -> bool:
    """Whether an axis of a grid is a sample."""
    return any(is_sample(axis) for axis in grid.axes)


def contributions(varied: Mapping[str, Array], values: Array) -> dict[str, float]:
    """Return each number's share of the variance of a quantity, from its straight line over all of them.

    The shares are b cov(x, y) / var(y) with the slopes b of least squares. Their sum is the share that straight lines
    explain; where the numbers are drawn independently, a share is never below 0 but by chance.

    Parameters
    ----------
    varied : mapping of str to Array, shape (n,)
        Values of what varies.
    values : Array, shape (n,)
        The quantity; runs without it (nan) do not count.

    Raises
    ------
    InputError
        If fewer runs have the quantity than the slopes need.
    """
    there = np.isfinite(values)
    y = values[there] - np.mean(values[there]) if there.any() else np.zeros(0)
    names = [name for name, x in varied.items() if len(y) and np.ptp(x[there]) > 0.0]
    if len(y) < len(names) + 2:
        expected = f"at least {plural(len(names) + 2, 'run')} with the quantity"
        raise InputError("contributions", expected, str(len(y)))
    columns = np.array([varied[name][there] for name in names]).T.reshape(len(y), len(names))
    columns = columns - columns.mean(axis=0)
    scales = np.abs(columns).max(axis=0) if names else np.ones(0)
    slopes = np.linalg.lstsq(columns / scales, y, rcond=None)[0]
    total = float(y @ y)
    covariances = (columns / scales).T @ y
    shares = dict.fromkeys(varied, 0.0)
    if total > 0.0:
        shares |= {name: float(b * c / total) for name, b, c in zip(names, slopes, covariances, strict=True)}
    return shares
