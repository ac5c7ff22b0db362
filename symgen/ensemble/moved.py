"""What there is to say of the starts of rows, as of those of single runs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.evaluate import scalars
from symgen.describe.moved import moved
from symgen.describe.sides import sides_of
from symgen.ensemble.kernel import kernel_of
from symgen.ensemble.verdicts import column
from symgen.runtime import abi, decisions
from symgen.runtime.assembly import moved_far, state_scales
from symgen.runtime.start_words import changes_of, opposite

if TYPE_CHECKING:
    from symgen.ensemble.plan import Ensemble
    from symgen.ensemble.starts import Rows

Array = NDArray[np.float64]

#: Points that may move far stand at most so many lengths of the mechanism away from where their bodies turn.
_LEVER = 2.0
#: What is said of velocities that could not be what they were given as.
_PROJECTED = "given velocities contradicted the constraints and were projected; --strict lets such runs fail"


def warnings_of_starts(
    ensemble: Ensemble, summary: Array, begun: NDArray[np.bool_]
) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Yield rows with what there is to say of their starts; those of which there may be something are closed again.

    Parameters
    ----------
    ensemble : Ensemble
        What was run.
    summary : Array, shape (n, N_SUMMARY + width)
        See `symgen.runtime.ensemble_abi`.
    begun : Array of bool, shape (n,)
        Rows that have a start.
    """
    recipe, mechanism, size = ensemble.recipe, ensemble.model.mechanism, ensemble.chunk
    follows = recipe.held or recipe.joints or not all(side.held for side in sides_of(mechanism))
    scale = np.minimum(column(summary, "length_scale"), 1.0)
    asked = begun & (bool(follows) | (2.0 * _LEVER * column(summary, "start_moved") > decisions.FAR * scale))
    for first in sorted({i // size * size for i in np.flatnonzero(asked).tolist()}):
        which = np.flatnonzero(asked[first : first + size])
        rows = _some(ensemble.settled(first, min(first + size, len(ensemble))), which)
        now, starts = kernel_of(recipe).closed(rows)
        closed = now.y[: len(rows), : rows.q.shape[1]]
        for r in np.flatnonzero(_may_be_far(ensemble, rows, closed, now.w[: len(rows), abi.LENGTH])).tolist():
            start, q, y, p, w = starts(r), rows.q[r], now.y[r], now.p[r], now.w[r]
            values = dict(zip(ensemble.parameters, rows.parameters[r].tolist(), strict=True))
            changes = changes_of(start.compiled.info, q, y, state_scales(start.compiled, w, math.inf)[: len(q)])
            yield (
                first + int(which[r]),
                moved_far(start, q, y, p, w, changes, partial(moved, mechanism, scalars(values))),
            )
        for side in sides_of(mechanism):
            for row in which[side.cosine(closed.T) < 0.0].tolist() if not side.held else ():
                yield first + row, (opposite(side.joint),)
    for row in np.flatnonzero(begun & (column(summary, "start_velocities") == 1.0)).tolist():
        yield row, (_PROJECTED,)


def _may_be_far(ensemble: Ensemble, rows: Rows, closed: Array, lengths: Array) -> NDArray[np.bool_]:
    """Return in which rows a body may be far from where it is described, though nothing was asked to be far."""
    metres = np.array([quantity.unit == "m" for quantity in ensemble.compiled.info.coordinates])
    reach = np.where(metres, lengths[:, np.newaxis], 1.0 / _LEVER)
    far = np.max(np.abs(closed - rows.q) / reach, axis=1, where=metres, initial=0.0)
    far += np.max(np.abs(closed - rows.q) / reach, axis=1, where=~metres, initial=0.0)
    held = list(ensemble.recipe.held)
    limits = np.where(metres[held], decisions.FAR * lengths[:, np.newaxis], decisions.FAR_TURNED)
    return np.asarray((far > decisions.FAR) & ~(np.abs(rows.targets - rows.q[:, held]) > limits).any(axis=1))


def _some(rows: Rows, which: NDArray[np.int64]) -> Rows:
    """Return some of the rows."""
    parameters, q, v, targets, joints = (
        np.ascontiguousarray(array[which]) for array in (rows.parameters, rows.q, rows.v, rows.targets, rows.joints)
    )
    return replace(rows, parameters=parameters, q=q, v=v, targets=targets, joints=joints)
