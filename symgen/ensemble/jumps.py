"""Rows of an ensemble that fail by what formulas of the time do, where that depends on what varies."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from symgen.ensemble.driving import read_by_motions
from symgen.runtime.motions import jump_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.ensemble.plan import Ensemble

#: Rows whose parameters are looked at together.
_TOGETHER = 65536


def rows_that_jump(ensemble: Ensemble, done: NDArray[np.bool_]) -> Iterator[tuple[int, str]]:
    """Yield rows in which the motion of a driver jumps, and how.

    Each combination of what motions read is looked at once; what is not defined fails at its start.

    Parameters
    ----------
    ensemble : Ensemble
        What was run.
    done : Array of bool, shape (n,)
        Rows that are asked for.
    """
    mechanism, until = ensemble.model.mechanism, ensemble.recipe.spec.until
    read = read_by_motions(mechanism, ensemble.grid.names)
    places, found = [list(ensemble.parameters).index(name) for name in read], dict[tuple[float, ...], str]()
    for first in range(0, len(ensemble), _TOGETHER) if read else ():
        last = min(first + _TOGETHER, len(ensemble))
        rows = np.flatnonzero(done[first:last])
        for row, values in zip(rows, ensemble.settled(first, last).parameters[rows][:, places].tolist(), strict=True):
            key = tuple(values)
            if key not in found and all(map(math.isfinite, key)):
                found[key] = str(jump_of(mechanism, dict(zip(read, key, strict=True)), until) or "")
            if found.get(key):
                yield first + int(row), found[key]


def rows_whose_inputs_cannot_be(ensemble: Ensemble, failed: NDArray[np.bool_]) -> Iterator[tuple[int, str]]:
    """Yield rows whose inputs jump too often, and what single runs say of each.

    Parameters
    ----------
    ensemble : Ensemble
        What was run.
    failed : Array of bool, shape (n,)
        Rows without a start.
    """
    for row in np.flatnonzero(failed).tolist() if ensemble.driving.own else ():
        values = dict(zip(ensemble.parameters, ensemble.settled(row, row + 1).parameters[0].tolist(), strict=True))
        if all(map(math.isfinite, values.values())) and (told := ensemble.driving.refusal(values)):
            yield row, told
