"""Treatment of accepted states, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import math

import numpy as np
from numba import njit

from .machine import CHANGE, M, MASK, METHOD_PARAMETERS, NQ, NV, RESIDUAL, tables
from .metric_augmented_2d13017f45e3ff7e import geometry, spread
from .model import measure, move, normalise

MOVED = 64  # places in w and T
FORCE_OF_CONSTRAINTS = 65


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state by mass-orthogonal projections and measure it; bits as for other corrections."""
    T = tables(w)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    mask = np.int64(T[MASK])
    residual = np.int64(T[RESIDUAL])
    change = np.int64(T[CHANGE])
    force_of_constraints = np.int64(T[FORCE_OF_CONSTRAINTS])
    moved = np.int64(T[MOVED])
    bits = 2
    normalise(y, w)
    tolerance = p[method_parameters + 1] * w[6]
    last = math.inf
    for j in range(nv):
        w[moved + j] = 0.0
    for round in range(20):
        geometry(t, y, p, w)
        violation = w[8]
        if round == 0:
            for i in range(m):
                w[force_of_constraints + i] = -p[method_parameters + 0] * w[residual + i] if w[mask + i] == 0.0 else 0.0
        if violation <= tolerance or (violation > 0.9 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        spread(p, w)
        move(y, w)
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    tolerance = p[method_parameters + 1] * w[7]
    last = math.inf
    for j in range(nv):
        w[moved + j] = 0.0
    for round in range(20):
        measure(t, y, p, w)
        violation = w[9]
        if round == 0:
            for i in range(m):
                w[force_of_constraints + i] = -p[method_parameters + 0] * w[residual + i] if w[mask + i] == 0.0 else 0.0
        if violation <= tolerance or violation > 0.9 * last:
            break
        last = violation
        spread(p, w)
        for j in range(nv):
            y[nq + j] += w[change + j]
        iw[3] += 1
    return bits
