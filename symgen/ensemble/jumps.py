"""Rows of an ensemble in which the motion of a driver jumps, where that depends on what varies."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.derived import derived
from symgen.runtime.motions import jump_of, names_of_motions

if TYPE_CHECKING:
    from collections.abc import Container

    from numpy.typing import NDArray

    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.plan import Ensemble

#: Rows whose parameters are looked at together.
_TOGETHER = 65536


def read_by_motions(mechanism: Mechanism, varied: Container[str]) -> tuple[str, ...]:
    """Return the parameters that motions which may jump read, if some of them differ from row to row; else none."""
    read, formulas = names_of_motions(mechanism), {name for name, _ in derived(mechanism.parameters)}
    known = tuple(p.name for p in mechanism.parameters if p.name in read)
    return known if any(name in varied or name in formulas for name in known) else ()


def rows_that_jump(ensemble: Ensemble, done: NDArray[np.bool_]) -> Iterator[tuple[NDArray[np.int64], str]]:
    """Yield rows in which the motion of a driver jumps, and what is said of each such group.

    Each combination of the values that the motions read is looked at once.

    Parameters
    ----------
    ensemble : Ensemble
        What was run.
    done : Array of bool, shape (n,)
        Rows that are asked for.
    """
    mechanism, until = ensemble.model.mechanism, ensemble.recipe.spec.until
    read = read_by_motions(mechanism, ensemble.grid.names)
    places = [list(ensemble.parameters).index(name) for name in read]
    said = dict[tuple[float, ...], str]()
    for first in range(0, len(ensemble) if read else 0, _TOGETHER):
        last = min(first + _TOGETHER, len(ensemble))
        found, which = np.unique(ensemble.settled(first, last).parameters[:, places], axis=0, return_inverse=True)
        which, asked = which.ravel(), np.flatnonzero(done[first:last])
        for k in np.unique(which[asked]).tolist():
            values = tuple(found[k].tolist())
            if values not in said:
                said[values] = _said(mechanism, dict(zip(read, values, strict=True)), until)
            if said[values]:
                yield first + asked[which[asked] == k], said[values]


def _said(mechanism: Mechanism, values: dict[str, float], until: float) -> str:
    """Return what jumps, empty where nothing does; what is not defined fails at its start."""
    told = jump_of(mechanism, values, until) if all(map(math.isfinite, values.values())) else None
    return "" if told is None else str(told)
