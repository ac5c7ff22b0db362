"""The little linear algebra that analyses share: dependent rows are decided once, the same way everywhere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Singular values of D below this fraction of the largest one count as zero.
DEPENDENT = 1e-9


def split(d: Array) -> tuple[Array, Array, Array]:
    """Return an orthonormal basis of the directions that rows leave free, their pseudo-inverse, and what depends.

    Parameters
    ----------
    d : Array, shape (m, n)
        Rows; each is scaled to length 1 before its rank is decided.

    Returns
    -------
    basis : Array, shape (n, n - r)
        Z with D Z = 0.
    inverse : Array, shape (n, m)
        D^+ of the scaled rows, scaled back: right sides give changes of least norm.
    left : Array, shape (m, m - r)
        Combinations of the scaled rows that vanish.
    """
    m, n = d.shape
    if m == 0:
        return np.eye(n), np.zeros((n, 0)), np.zeros((0, 0))
    sizes = np.linalg.norm(d, axis=1)
    sizes[sizes == 0.0] = 1.0
    u, s, vt = np.linalg.svd(d / sizes[:, None], full_matrices=True)
    rank = int(np.sum(s > DEPENDENT * s.max(initial=0.0)))
    inverse = (vt[:rank].T / s[:rank]) @ (u[:, :rank] / sizes[:, None]).T
    return vt[rank:].T.copy(), inverse, u[:, rank:]


def symmetric(a: Array) -> Array:
    """Return the symmetric part of a matrix."""
    return 0.5 * (a + a.T)
