"""Corrections in another metric, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import numpy as np
from numba import njit

from .machine import (
    CHANGE, GRAM_FACTOR, KEPT_FACTOR, M, RESIDUAL, VECTORS, VECTOR_SIZE, columns_times, factorise, gram,
    solve, tables,
)
from .model import geometry as geometry_of_model

LAW_LOWER = 63  # places in w and T


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D D^T from D, without the rows that depend on others."""
    T = tables(w)
    law_lower = np.int64(T[LAW_LOWER])
    gram(T, p, w, 0, law_lower)
    factorise(T, p, w, GRAM_FACTOR, law_lower, KEPT_FACTOR)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N."""
    T = tables(w)
    m = np.int64(T[M])
    residual = np.int64(T[RESIDUAL])
    change = np.int64(T[CHANGE])
    law_lower = np.int64(T[LAW_LOWER])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    for j in range(m):
        w[x2 + j] = -w[residual + j]
    solve(T, p, w, GRAM_FACTOR, law_lower, x2)
    columns_times(T, p, w, x2, change)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
