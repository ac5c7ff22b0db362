"""Corrections in another metric, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import numpy as np
from numba import njit

from .machine import (
    AUGMENTED_FACTOR, CHANGE, M, MASK, METHOD_PARAMETERS, NV, PLAIN_FACTOR, RESIDUAL, VECTORS, VECTOR_SIZE,
    augment, columns_times, factorise, mass_times, solve, tables,
)
from .model import geometry as geometry_of_model

LAW_LOWER = 63  # places in w and T
MOVED = 64
FORCE_OF_CONSTRAINTS = 65


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of M + a D^T D from D, without the rows that depend on others."""
    T = tables(w)
    m = np.int64(T[M])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    mask = np.int64(T[MASK])
    law_lower = np.int64(T[LAW_LOWER])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    a0 = p[method_parameters + 0]
    for j in range(m):
        w[x2 + j] = a0*(1.0*(1.0 > w[mask + j]))
    augment(T, p, w, x2, law_lower)
    factorise(T, p, w, AUGMENTED_FACTOR, law_lower, PLAIN_FACTOR)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection."""
    T = tables(w)
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    mask = np.int64(T[MASK])
    residual = np.int64(T[RESIDUAL])
    change = np.int64(T[CHANGE])
    force_of_constraints = np.int64(T[FORCE_OF_CONSTRAINTS])
    law_lower = np.int64(T[LAW_LOWER])
    moved = np.int64(T[MOVED])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    x3 = vectors + 3 * vector_size
    x4 = vectors + 4 * vector_size
    x5 = vectors + 5 * vector_size
    x6 = vectors + 6 * vector_size
    x7 = vectors + 7 * vector_size
    a0 = p[method_parameters + 0]
    for j in range(m):
        w[x2 + j] = a0*(1.0*(1.0 > w[mask + j]))
        w[x3 + j] = w[x2 + j]*w[residual + j]
        w[x4 + j] = w[force_of_constraints + j] + w[x3 + j]
    mass_times(T, p, w, moved, x5)
    for j in range(m):
        w[x6 + j] = w[x3 + j] + w[x4 + j]
    columns_times(T, p, w, x6, x7)
    for j in range(nv):
        w[change + j] = -(w[x5 + j] + w[x7 + j])
    solve(T, p, w, AUGMENTED_FACTOR, law_lower, change)
    for j in range(nv):
        w[moved + j] = w[moved + j] + w[change + j]
    for j in range(m):
        w[force_of_constraints + j] = w[x4 + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
