"""Eigenvalues and eigenvectors near a state.

At rest they are those of M r'' + C r' + K r = 0 along the shapes of M and K, where stiffnesses are the squares of
frequencies, each with its own digits. In the matrix of first order each has the rounding of the largest one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.algebra import ROUNDED, Complex, eigenvalues_of, squares_along, summed
from symgen.analyses.reduced import StateTangent
from symgen.analyses.steady import at_rest, system

Array = NDArray[np.float64]

#: What damping along two shapes may be of the faster one's frequency where there is none.
UNDAMPED = 1e-11


@dataclass(frozen=True)
class Vibration:
    """Small motions about a state of rest.

    Attributes
    ----------
    squares : Array, shape (n,)
        Squares of the frequencies without damping, in increasing order.
    shapes : Array, shape (nv, n)
        Their shapes in terms of velocities, normalised by masses, one a column.
    damping : Array, shape (n, n)
        Damping along the shapes; what is rounding is 0.
    """

    squares: Array
    shapes: Array
    damping: Array

    def changes(self, x: StateTangent) -> tuple[Array, Array]:
        """Return the shapes as changes of s and as changes of u."""
        found = [np.linalg.lstsq(basis, self.shapes, rcond=None)[0] for basis in (x.free, x.basis)]
        return np.asarray(found[0]), np.asarray(found[1])

    def eigenvectors(self, x: StateTangent) -> tuple[Complex, Complex]:
        """Return eigenvalues and eigenvectors in terms of s and u."""
        n = len(self.squares)
        fast = np.sqrt(np.abs(self.squares))
        # nothing depends on a coordinate without stiffness: its size must only not look like 0
        fast[fast == 0.0] = max(fast.max(initial=0.0), np.abs(self.damping).max(initial=0.0)) or 1.0
        first = np.block([[np.zeros((n, n)), np.eye(n)], [-np.diag(self.squares), -self.damping]])
        values, parts = eigenvalues_of(first, np.concatenate([1.0 / fast, np.ones(n)]))
        positions, speeds = self.changes(x)
        return values, np.vstack([positions @ parts[:n], speeds @ parts[n:]])


def vibration(x: StateTangent) -> Vibration | None:
    """Return the small motions about a state of rest.

    None where something moves or has no mass, a force follows, or joints hold velocities alone.
    """
    if not x.size or x.positions != x.velocities or not at_rest(x.subject, x):
        return None
    e, basis = x.base, x.subject.split(x.subject.rows(x.base))[0]
    try:
        squares, vectors, even = squares_along(e.by("balance", "a"), e.by("balance", "q") @ e.by("motion", "v"), basis)
    except np.linalg.LinAlgError:
        return None
    if not even:
        return None
    along, whole = basis @ vectors, e.by("balance", "v")
    fast, sizes = np.sqrt(np.abs(squares)), summed(whole, along)
    damping = along.T @ whole @ along
    limit = UNDAMPED * np.maximum.outer(fast, fast) + ROUNDED * np.sqrt(np.outer(sizes, sizes))
    return Vibration(squares, along, np.where(np.abs(damping) > limit, damping, 0.0))


def eigenvectors(x: StateTangent, names: Sequence[str], still: Vibration | None) -> tuple[Complex, Complex]:
    """Return eigenvalues and eigenvectors in terms of s and u.

    Parameters
    ----------
    x : StateTangent
        What they are of.
    names : sequence of str
        Independent states; some motions have fewer than there are s and u.
    still : Vibration, optional
        The small motions about a state of rest.
    """
    if len(names) == x.size:
        return eigenvalues_of(x.matrix, x.sizes) if still is None else still.eigenvectors(x)
    sizes = x.sizes_of(names)
    values, shapes = eigenvalues_of(system(x, names)[0], sizes)
    changes = x.changes_of(names)[:, : x.size] * x.sizes / sizes[:, np.newaxis]
    alike = np.linalg.lstsq(changes, shapes / sizes[:, np.newaxis], rcond=1e-11)[0]
    return values, np.asarray(alike * x.sizes[:, np.newaxis], dtype=np.complex128)
