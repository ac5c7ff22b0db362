"""Directions that the constraints leave free at an instant, where all directions of the state are at hand.

The way back through a run has the derivatives of everything by each element of the state, whether the joints allow such
a change or not. What has to vanish does so in the directions that they allow: it is a combination of the derivatives of
their rows, of positions and velocities.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.run.directions.moments import Directions, Moment, Moments

Array = NDArray[np.float64]

#: Part of a derivative below which it vanishes.
TOGETHER = 1e-6


class Free:
    """The directions that joints and rows in force allow.

    Parameters
    ----------
    moments : Moments
        The code.
    now : Moment
        The state.
    by : Directions
        All directions, and after them that of the motion.
    """

    def __init__(self, moments: Moments, now: Moment, by: Directions) -> None:
        self.moments, self.now, self.by = moments, now, by

    @cached_property
    def _rows(self) -> Array:
        """Derivatives of the rows in force, of their rates, and of the lengths of Euler parameters."""
        info, now, by = self.moments.compiled.info, self.now, self.by
        d, by_d, residual, nu = constraint_directions(self.moments, now, by)
        off = self.moments.compiled.off(now.w)
        force = [i for i, row in enumerate(info.rows) if row.name not in off]
        v, by_v = now.y[info.nq : info.work], by.y[info.nq : info.work, :-1]
        rates = np.einsum("ijk,j->ik", by_d[force], v) + d[force] @ by_v - nu[force]
        positions = residual[[i for i in force if info.rows[i].holonomic]]
        spins = [now.y[first : first + 4] @ by.y[first : first + 4, :-1] for first, _ in info.spins]
        rows = np.concatenate([positions, rates, np.array(spins).reshape(len(spins), rates.shape[1])])
        sizes = np.linalg.norm(rows, axis=1)
        return np.asarray(rows[sizes > 0.0] / sizes[sizes > 0.0, np.newaxis])

    def has_free_motion(self, rows: Array, of: Array) -> bool:
        """Whether derivatives, which are differences of others, do not vanish in all directions that are free."""
        left = rows
        if len(self._rows):
            left = rows - np.linalg.lstsq(self._rows.T, rows.T, rcond=1e-11)[0].T @ self._rows
        return bool(np.any(np.abs(left).max(axis=1) > TOGETHER * np.abs(of).max()))


def constraint_directions(moments: Moments, now: Moment, by: Directions) -> tuple[Array, Array, Array, Array]:
    """Return D, then directions of D, of residuals and of nu, shapes (m, nv), (m, nv, k), (m, k), (m, k)."""
    compiled, model = moments.compiled, moments.model
    info, columns = compiled.info, list[Array]()
    geometry = model.function(compiled.model.geometry, timed=True).caller(abi.MEASURE.signature.arguments)
    (first, _), (residual, m), (nu, _) = (info.sections[name] for name in ("jacobian", "residual", "nu"))
    d, places = np.zeros((info.m, info.nv)), [(i, j, slot) for i, j, _, slot in info.jacobian if slot is not None]
    for _, y, p, w in moments.chunks_of_states(now, by):
        geometry(now.t, y, p, w)
        d, own = compiled.jacobian(w[: model.sizes["w"]]), model.directions_after(w, "w")
        slopes = np.zeros((info.m, info.nv + 2, model.lanes))
        for i, j, slot in places:
            slopes[i, j] = own[first + slot]
        slopes[:, info.nv], slopes[:, info.nv + 1] = own[residual : residual + m], own[nu : nu + m]
        columns.append(slopes)
    every = np.concatenate(columns, axis=2)[:, :, : moments.count - 1]
    return d, every[:, : info.nv], every[:, info.nv], every[:, info.nv + 1]
