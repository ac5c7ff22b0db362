"""Treatment of accepted states, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .metric_augmented_5f8665dda85e0ed8 import geometry, spread
from .model import measure

MASK = 20  # sections of w
RESIDUAL = 22
CHANGE = 25
MOVED = 38
FORCE_OF_CONSTRAINTS = 40


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state by mass-orthogonal projections and measure it; bits as for other corrections."""
    bits = 2
    tolerance = p[7] * w[6]
    last = math.inf
    for j in range(2):
        w[MOVED + j] = 0.0
    for round in range(20):
        geometry(t, y, p, w)
        violation = w[8]
        if round == 0:
            for i in range(1):
                w[FORCE_OF_CONSTRAINTS + i] = -p[6] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or (violation > 0.9 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        spread(p, w)
        for j in range(2):
            y[j] += w[CHANGE + j]
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    tolerance = p[7] * w[7]
    last = math.inf
    for j in range(2):
        w[MOVED + j] = 0.0
    for round in range(20):
        measure(t, y, p, w)
        violation = w[9]
        if round == 0:
            for i in range(1):
                w[FORCE_OF_CONSTRAINTS + i] = -p[6] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or violation > 0.9 * last:
            break
        last = violation
        spread(p, w)
        for j in range(2):
            y[2 + j] += w[CHANGE + j]
        iw[3] += 1
    return bits
