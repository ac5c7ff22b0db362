"""One iteration, and its end, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import math

import numpy as np
from numba import njit

from .machine import (
    AUGMENTED_FACTOR, DRIVEN, FORCE, GAMMA, M, MULTIPLIERS, NQ, NU, NV, RATES, VECTORS, VECTOR_SIZE,
    columns_times, mass_times, rows_times, run, solve, tables,
)

LENGTH_SCALE = 6  # places in w and T
SPEED_SCALE = 7
MEAN_MASS = 11
INCREMENT = 13
POWER = 18
KEPT_PENALTIES = 62
KEPT_ACCELERATION = 63
AUGMENTED_LOWER = 64


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration."""
    T = tables(w)
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    multipliers = np.int64(T[MULTIPLIERS])
    force = np.int64(T[FORCE])
    gamma = np.int64(T[GAMMA])
    augmented_lower = np.int64(T[AUGMENTED_LOWER])
    kept_acceleration = np.int64(T[KEPT_ACCELERATION])
    kept_penalties = np.int64(T[KEPT_PENALTIES])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    x3 = vectors + 3 * vector_size
    x4 = vectors + 4 * vector_size
    x5 = vectors + 5 * vector_size
    x6 = vectors + 6 * vector_size
    x7 = vectors + 7 * vector_size
    x8 = vectors + 8 * vector_size
    x9 = vectors + 9 * vector_size
    x10 = vectors + 10 * vector_size
    rows_times(T, p, w, kept_acceleration, x2)
    mass_times(T, p, w, kept_acceleration, x3)
    for j in range(m):
        w[x4 + j] = w[multipliers + j] + w[kept_penalties + j]*(w[x2 + j] - w[gamma + j])
    columns_times(T, p, w, x4, x5)
    for j in range(nv):
        w[x6 + j] = w[force + j] - w[x3 + j] - w[x5 + j]
    solve(T, p, w, AUGMENTED_FACTOR, augmented_lower, x6)
    for j in range(nv):
        w[x7 + j] = w[kept_acceleration + j] + w[x6 + j]
    rows_times(T, p, w, x7, x8)
    mass_times(T, p, w, x6, x9)
    a0 = 0.0
    for j in range(nv):
        a0 += w[x6 + j]*w[x9 + j]
    mass_times(T, p, w, x7, x10)
    a1 = 0.0
    for j in range(nv):
        a1 += w[x7 + j]*w[x10 + j]
    s0 = w[SPEED_SCALE]*w[SPEED_SCALE]/w[LENGTH_SCALE]
    w[INCREMENT] = math.sqrt(a0/(s0*(w[MEAN_MASS]*s0) + a1))
    for j in range(nv):
        w[kept_acceleration + j] = w[x7 + j]
    for j in range(m):
        w[multipliers + j] = w[multipliers + j] + w[kept_penalties + j]*(w[x8 + j] - w[gamma + j])
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power."""
    T = tables(w)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    multipliers = np.int64(T[MULTIPLIERS])
    nu = np.int64(T[NU])
    kept_acceleration = np.int64(T[KEPT_ACCELERATION])
    a0 = 0.0
    if T[DRIVEN] != 0:
        for j in range(m):
            a0 += w[nu + j]*w[multipliers + j]
    run(RATES, t, y, p, w, T, ydot)
    ydot[nq + nv] = w[POWER] - a0
    for j in range(nv):
        ydot[nq + j] = w[kept_acceleration + j]
    return 0
