"""What varies in a sweep and changes nothing that its rows report."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.result.unmoved import unmoved_sentence
from symgen.study.ensemble.verdicts import summary_column

if TYPE_CHECKING:
    from symgen.study.ensemble.sweep_study import Sweep

Array = NDArray[np.float64]

#: Quantities that differ by less than this part of the largest of their unit are the same: they differ by roundings.
SAME = 1e-12


def unmoved_axes(sweep: Sweep) -> Iterator[str]:
    """Yield a sentence for each axis along which all that the sweep keeps is the same.

    Rows are compared by the quantities that were kept, by their ends and by their events. An axis of samples varies
    all its numbers at once, so that they are named together. Options of methods are meant to change nothing but errors.

    Parameters
    ----------
    sweep : Sweep
        A sweep; one that was interrupted or has rows that failed says nothing.
    """
    grid, kept = sweep.ensemble.grid, sweep.ensemble.recipe.kept
    if not kept or not np.all(sweep.done) or not np.all(np.isfinite(sweep.values)):
        return
    numbers = [summary_column(sweep.summary, "end"), *(sweep.summary[:, at] for at, _ in sweep.events.values())]
    others = np.column_stack(numbers).reshape(*grid.shape, -1)
    values = sweep.values.reshape(*grid.shape, *sweep.values.shape[1:])
    sizes = _size_of_each_quantity(sweep)
    for i, axis in enumerate(grid.axes):
        names = [name for name, x in axis.values.items() if np.ptp(x) > 0.0 and not name.startswith("method.")]
        if not names or len(names) < len(axis.values):
            continue
        each = (values[..., k, :] for k in range(len(kept)))  # one after the other: sweeps may be large
        same = all(_differ_by(x, i) <= SAME * size for x, size in zip(each, sizes, strict=True))
        if same and np.all(_are_same(others, i)):
            yield unmoved_sentence(names, "that this sweep keeps")


def _differ_by(numbers: Array, axis: int) -> float:
    """Return the largest difference from the first row along an axis."""
    return float(np.abs(numbers - numbers.take([0], axis=axis)).max(initial=0.0))


def _are_same(numbers: Array, axis: int) -> NDArray[np.bool_]:
    """Return where numbers of rows do not change along an axis; those that are missing everywhere do not."""
    first = numbers.take([0], axis=axis)
    return (np.abs(numbers - first) <= SAME * np.abs(first)) | (np.isnan(numbers) & np.isnan(first))


def _size_of_each_quantity(sweep: Sweep) -> Array:
    """Return for each quantity the largest absolute value among all quantities of its unit."""
    largest = np.abs(sweep.values).max(axis=(0, 2), initial=0.0)
    units = [q.unit for q in sweep.ensemble.recipe.kept]
    of_unit = {unit: max(x for x, own in zip(largest, units, strict=True) if own == unit) for unit in units}
    return np.array([of_unit[unit] for unit in units])
