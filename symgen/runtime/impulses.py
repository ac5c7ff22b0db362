"""Velocities after a blow: the nearest ones, by kinetic energy, that obey the joints and have what is asked for.

An impulse along some directions C (the rows of joints, and what is given new velocities) changes velocities by
``M (v+ - v-) = C^T i``. With ``C v+ = c`` this is the v+ for which the kinetic energy of the change,
``(v+ - v-)^T M (v+ - v-) / 2``, is smallest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Singular values below this part of the largest one are rounding; so is this part of conditions that are met.
_ROUNDING, _MET = 1e-11, 1e-9


@dataclass(frozen=True)
class Blow:
    """What an impulse does.

    Attributes
    ----------
    v : Array, shape (nv,)
        Velocities afterwards.
    impulses : Array
        Of each row of C, in the directions of C; of least norm where rows depend on each other.
    contradictory : bool
        Whether more than rounding is left of ``C v+ - c``.
    """

    v: Array
    impulses: Array
    contradictory: bool


def strike(mass: Array, rows: Array, values: Array, v: Array) -> Blow:
    """Return what the smallest impulse along some rows makes of velocities.

    Changes are found in two parts: the shortest one that satisfies the rows, and one that the rows do not see. So M may
    be singular where velocities without mass are determined by the rows.

    Parameters
    ----------
    mass : Array, shape (nv, nv)
        M.
    rows, values : Array, shapes (k, nv), (k,)
        C and c.
    v : Array, shape (nv,)
        Velocities before.
    """
    diagonal = np.diag(mass)
    usual = float(diagonal.mean()) or 1.0
    unit = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, usual))  # velocities in units of equal kinetic energy
    long = np.linalg.norm(rows * unit, axis=1)
    scale = 1.0 / np.where(long > 0.0, long, 1.0)
    scaled, target = scale[:, np.newaxis] * rows * unit, scale * (values - rows @ v)
    metric = unit[:, np.newaxis] * mass * unit
    left_vectors, sizes, vectors = np.linalg.svd(scaled, full_matrices=True)
    rank = int(np.count_nonzero(sizes > _ROUNDING * sizes.max(initial=0.0)))
    seen, unseen = vectors[:rank], vectors[rank:].T
    back = left_vectors[:, :rank] / sizes[:rank]
    change = np.zeros(len(v))
    for _ in range(2):  # once more for what rounding has left
        change += seen.T @ (back.T @ (target - scaled @ change))
        change += unseen @ np.linalg.lstsq(unseen.T @ metric @ unseen, -unseen.T @ (metric @ change), rcond=None)[0]
    after = v + unit * change
    left = rows @ after - values
    largest = float(np.max(np.abs(scale * values), initial=0.0) + np.max(np.abs(scale * (rows @ v)), initial=0.0))
    contradictory = bool(np.any(np.abs(scale * left) > _MET * largest))
    return Blow(after, scale * (back @ (seen @ (metric @ change))), contradictory)
