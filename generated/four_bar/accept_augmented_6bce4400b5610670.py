"""Treatment of accepted states, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .metric_augmented_4b254bef6830e696 import geometry, spread
from .model import measure

MASK = 27  # sections of w
RESIDUAL = 43
CHANGE = 67
MOVED = 470
FORCE_OF_CONSTRAINTS = 479


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state by mass-orthogonal projections and measure it; bits as for other corrections."""
    bits = 2
    tolerance = p[22] * w[6]
    last = math.inf
    for j in range(9):
        w[MOVED + j] = 0.0
    for round in range(20):
        geometry(t, y, p, w)
        violation = w[8]
        if round == 0:
            for i in range(8):
                w[FORCE_OF_CONSTRAINTS + i] = -p[21] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or (violation > 0.9 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        spread(p, w)
        for j in range(9):
            y[j] += w[CHANGE + j]
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    tolerance = p[22] * w[7]
    last = math.inf
    for j in range(9):
        w[MOVED + j] = 0.0
    for round in range(20):
        measure(t, y, p, w)
        violation = w[9]
        if round == 0:
            for i in range(8):
                w[FORCE_OF_CONSTRAINTS + i] = -p[21] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or violation > 0.9 * last:
            break
        last = violation
        spread(p, w)
        for j in range(9):
            y[9 + j] += w[CHANGE + j]
        iw[3] += 1
    return bits
