"""Consistent starts of large mechanisms: what `symgen.runtime.assembly` does with dense matrices, done sparsely.

Minimum-norm corrections come from the model's own ``spread``; completing or projecting velocities in another metric is
a least-norm problem that conjugate gradients solve on the sparse D.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.model import CompiledModel

Array = NDArray[np.float64]

#: From this many entries of a dense D on starts are found sparsely.
LARGEST_DENSE = 250_000


def is_large(compiled: CompiledModel) -> bool:
    """Whether D is too large for dense algebra and the model's functions take sizes in their stride."""
    return compiled.sparse and compiled.info.m * compiled.info.nv > LARGEST_DENSE


class SparseRows:
    """D at a state, from what ``geometry`` left in ``w``."""

    def __init__(self, compiled: CompiledModel, w: Array) -> None:
        entries = compiled.info.jacobian
        self.m, self.nv = compiled.info.m, compiled.info.nv
        self.rows = np.array([e[0] for e in entries])
        self.columns = np.array([e[1] for e in entries])
        stored = compiled.section(w, "jacobian")
        self.values = np.array([e[2] if e[3] is None else stored[e[3]] for e in entries])

    def times(self, x: Array) -> Array:
        """Return D x."""
        return np.asarray(np.bincount(self.rows, self.values * x[self.columns], self.m), dtype=np.float64)

    def transposed(self, y: Array) -> Array:
        """Return D^T y."""
        return np.asarray(np.bincount(self.columns, self.values * y[self.rows], self.nv), dtype=np.float64)

    def least_norm(self, right: Array, scale: Array) -> Array:
        """Return the x with D x = right whose x / scale is smallest; 0 where scale is 0.

        Conjugate gradients on the normal equations (CGLS) begin at 0 and so never leave the row space.
        """
        x = np.zeros(self.nv)
        residual = right.copy()
        gradient = scale * self.transposed(residual)
        direction, size = gradient.copy(), float(gradient @ gradient)
        start = size
        for _ in range(20 * self.m + 100):
            if size <= 1e-30 * start or size == 0.0:
                break
            step = self.times(scale * direction)
            alpha = size / float(step @ step)
            x += alpha * direction
            residual -= alpha * step
            gradient = scale * self.transposed(residual)
            following = float(gradient @ gradient)
            direction = gradient + (following / size) * direction
            size = following
        return np.asarray(scale * x)


def minimum_norm_step(compiled: CompiledModel, p: Array, w: Array, residual: Array) -> Array:
    """Return -D^+ residual by the factorisation that ``geometry`` left."""
    compiled.section(w, "residual")[:] = residual
    compiled.model.spread(p, w)
    return np.asarray(compiled.section(w, "change").copy())


def tangent_direction(compiled: CompiledModel, p: Array, w: Array, k: int) -> Array:
    """Return a direction along the constraints, another one for each k."""
    d = SparseRows(compiled, w)
    direction = np.cos((k + 1.0) * np.arange(1, compiled.info.nv + 1))
    return np.asarray(direction + minimum_norm_step(compiled, p, w, d.times(direction)))
