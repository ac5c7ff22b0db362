"""Right-hand side, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import numpy as np
from numba import njit

from .machine import (
    AUGMENTED_FACTOR, DRIVEN, FORCE, FRAMES, FULL, GAMMA, M, MASK, METHOD_PARAMETERS, MULTIPLIERS, NQ, NU, NV,
    PHI, PLAIN_FACTOR, RATES, VECTORS, VECTOR_SIZE, augment, columns_times, factorise_forward, rows_times,
    run, solve_rest, tables,
)

POWER = 18  # places in w and T
AUGMENTED_LOWER = 62


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers."""
    T = tables(w)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    multipliers = np.int64(T[MULTIPLIERS])
    mask = np.int64(T[MASK])
    nu = np.int64(T[NU])
    force = np.int64(T[FORCE])
    gamma = np.int64(T[GAMMA])
    phi = np.int64(T[PHI])
    augmented_lower = np.int64(T[AUGMENTED_LOWER])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    x3 = vectors + 3 * vector_size
    x4 = vectors + 4 * vector_size
    x5 = vectors + 5 * vector_size
    x6 = vectors + 6 * vector_size
    x7 = vectors + 7 * vector_size
    x8 = vectors + 8 * vector_size
    x9 = vectors + 9 * vector_size
    w[POWER] = 0.0
    run(FRAMES, t, y, p, w, T, w)
    run(FULL, t, y, p, w, T, w)
    a0 = p[method_parameters + 0]
    for j in range(m):
        w[x2 + j] = a0*(1.0*(1.0 > w[mask + j]))
    for j in range(nv):
        w[x3 + j] = y[nq + j]
    rows_times(T, p, w, x3, x4)
    a1 = 2.0*(p[method_parameters + 1]*p[method_parameters + 2])
    a2 = p[method_parameters + 1]*p[method_parameters + 1]
    for j in range(m):
        w[x5 + j] = w[gamma + j] - (w[x4 + j] - w[nu + j])*a1 - w[phi + j]*a2
        w[x6 + j] = w[x2 + j]*w[x5 + j]
    columns_times(T, p, w, x6, x7)
    for j in range(nv):
        w[x8 + j] = w[force + j] + w[x7 + j]
    augment(T, p, w, x2, augmented_lower)
    factorise_forward(T, p, w, AUGMENTED_FACTOR, augmented_lower, PLAIN_FACTOR, x8)
    solve_rest(T, p, w, AUGMENTED_FACTOR, augmented_lower, x8)
    rows_times(T, p, w, x8, x9)
    for j in range(m):
        w[multipliers + j] = w[x2 + j]*(w[x9 + j] - w[x5 + j])
    a3 = 0.0
    if T[DRIVEN] != 0:
        for j in range(m):
            a3 += w[nu + j]*w[multipliers + j]
    run(RATES, t, y, p, w, T, ydot)
    ydot[nq + nv] = w[POWER] - a3
    for j in range(nv):
        ydot[nq + j] = w[x8 + j]
    return 0
