"""Right-hand side, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import numpy as np
from numba import njit

from .machine import (
    DRIVEN, FORCE, FRAMES, FULL, GAMMA, GRAM_FACTOR, M, MASKED_FACTOR, METHOD_PARAMETERS, MULTIPLIERS, NQ, NU,
    NV, PHI, RATES, VECTORS, VECTOR_SIZE, columns_times, factorise_forward, gram, inverse_mass_times,
    rows_times, run, solve_rest, tables, weigh,
)

STEP = 12  # places in w and T
POWER = 18
SCHUR_LOWER = 62


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious."""
    T = tables(w)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    multipliers = np.int64(T[MULTIPLIERS])
    nu = np.int64(T[NU])
    force = np.int64(T[FORCE])
    gamma = np.int64(T[GAMMA])
    phi = np.int64(T[PHI])
    schur_lower = np.int64(T[SCHUR_LOWER])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    x3 = vectors + 3 * vector_size
    x4 = vectors + 4 * vector_size
    x5 = vectors + 5 * vector_size
    x6 = vectors + 6 * vector_size
    x7 = vectors + 7 * vector_size
    x8 = vectors + 8 * vector_size
    w[POWER] = 0.0
    run(FRAMES, t, y, p, w, T, w)
    run(FULL, t, y, p, w, T, w)
    for j in range(nv):
        w[x2 + j] = y[nq + j]
    rows_times(T, p, w, x2, x3)
    a0 = 2.0*min(p[method_parameters + 0], p[method_parameters + 1]*(1.0/w[STEP]))
    s0 = min(p[method_parameters + 0], p[method_parameters + 1]*(1.0/w[STEP]))
    a1 = s0*s0
    inverse_mass_times(T, p, w, force, x4)
    rows_times(T, p, w, x4, x5)
    for j in range(m):
        w[multipliers + j] = w[x5 + j] - (w[gamma + j] - (w[x3 + j] - w[nu + j])*a0 - w[phi + j]*a1)
    weigh(T, p, w)
    gram(T, p, w, 1, schur_lower)
    suspicious = factorise_forward(T, p, w, GRAM_FACTOR, schur_lower, MASKED_FACTOR, multipliers)
    solve_rest(T, p, w, GRAM_FACTOR, schur_lower, multipliers)
    columns_times(T, p, w, multipliers, x6)
    for j in range(nv):
        w[x7 + j] = w[force + j] - w[x6 + j]
    inverse_mass_times(T, p, w, x7, x8)
    a2 = 0.0
    if T[DRIVEN] != 0:
        for j in range(m):
            a2 += w[nu + j]*w[multipliers + j]
    run(RATES, t, y, p, w, T, ydot)
    ydot[nq + nv] = w[POWER] - a2
    for j in range(nv):
        ydot[nq + j] = w[x8 + j]
    return int(suspicious)
