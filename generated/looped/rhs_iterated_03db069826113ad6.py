"""Right-hand side, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import math

import numpy as np
from numba import njit

from .iterate_040ed71b080e99a3 import finish, iterate
from .machine import (
    AUGMENTED_FACTOR, FORCE, FRAMES, FULL, GAMMA, M, MASK, METHOD_PARAMETERS, MULTIPLIERS, NQ, NU, NV, PHI,
    PLAIN_FACTOR, VECTORS, VECTOR_SIZE, augment, factorise, inverse_mass_times, rows_times, run, tables,
)

POWER = 18  # places in w and T
KEPT_PENALTIES = 62
KEPT_ACCELERATION = 63
AUGMENTED_LOWER = 64
KEPT_TARGET = 65


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration."""
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
    kept_acceleration = np.int64(T[KEPT_ACCELERATION])
    kept_penalties = np.int64(T[KEPT_PENALTIES])
    kept_target = np.int64(T[KEPT_TARGET])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    x3 = vectors + 3 * vector_size
    w[POWER] = 0.0
    run(FRAMES, t, y, p, w, T, w)
    run(FULL, t, y, p, w, T, w)
    for j in range(nv):
        w[x2 + j] = y[nq + j]
    rows_times(T, p, w, x2, x3)
    a0 = 2.0*(p[method_parameters + 1]*p[method_parameters + 2])
    a1 = p[method_parameters + 1]*p[method_parameters + 1]
    a2 = p[method_parameters + 0]
    for j in range(m):
        w[kept_penalties + j] = a2*(1.0*(1.0 > w[mask + j]))
    inverse_mass_times(T, p, w, force, kept_acceleration)
    augment(T, p, w, kept_penalties, augmented_lower)
    factorise(T, p, w, AUGMENTED_FACTOR, augmented_lower, PLAIN_FACTOR)
    for j in range(m):
        w[kept_target + j] = w[gamma + j] - (w[x3 + j] - w[nu + j])*a0 - w[phi + j]*a1
        w[multipliers + j] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state by iteration until v' changes no more, at most 30 times."""
    T = tables(w)
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    begin(t, y, p, w)
    last = math.inf
    for _ in range(30):
        iterate(p, w)
        iw[6] += 1
        increment = w[13]
        # increments in the metric of M do not show massless bodies, which the second iteration sets right if no other moves;
        # at the floor of rounding another iteration gains nothing
        if last < math.inf and (increment <= p[method_parameters + 3] or (increment > 0.5 * last and increment < 1e-6)):
            break
        last = increment
    finish(t, y, p, w, ydot)
    return 0
