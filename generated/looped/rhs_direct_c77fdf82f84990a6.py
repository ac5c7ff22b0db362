"""Right-hand side, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import numpy as np
from numba import njit

from .machine import (
    DRIVEN, FORCE, FRAMES, GAMMA, GRAM_FACTOR, M, MASKED_FACTOR, MOTION, MULTIPLIERS, NQ, NU, NV, RATES,
    VECTORS, VECTOR_SIZE, columns_times, factorise_forward, gram, inverse_mass_times, rows_times, run,
    solve_rest, tables, weigh,
)

POWER = 18  # places in w and T
SCHUR_LOWER = 62


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious."""
    T = tables(w)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    multipliers = np.int64(T[MULTIPLIERS])
    nu = np.int64(T[NU])
    force = np.int64(T[FORCE])
    gamma = np.int64(T[GAMMA])
    schur_lower = np.int64(T[SCHUR_LOWER])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    x3 = vectors + 3 * vector_size
    x4 = vectors + 4 * vector_size
    x5 = vectors + 5 * vector_size
    w[POWER] = 0.0
    run(FRAMES, t, y, p, w, T, w)
    run(MOTION, t, y, p, w, T, w)
    inverse_mass_times(T, p, w, force, x2)
    rows_times(T, p, w, x2, x3)
    for j in range(m):
        w[multipliers + j] = w[x3 + j] - w[gamma + j]
    weigh(T, p, w)
    gram(T, p, w, 1, schur_lower)
    suspicious = factorise_forward(T, p, w, GRAM_FACTOR, schur_lower, MASKED_FACTOR, multipliers)
    solve_rest(T, p, w, GRAM_FACTOR, schur_lower, multipliers)
    columns_times(T, p, w, multipliers, x4)
    inverse_mass_times(T, p, w, x4, x5)
    a0 = 0.0
    if T[DRIVEN] != 0:
        for j in range(m):
            a0 += w[nu + j]*w[multipliers + j]
    run(RATES, t, y, p, w, T, ydot)
    ydot[nq + nv] = w[POWER] - a0
    for j in range(nv):
        ydot[nq + j] = w[x2 + j] - w[x5 + j]
    return int(suspicious)
