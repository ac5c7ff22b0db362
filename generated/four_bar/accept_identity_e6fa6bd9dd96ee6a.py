"""Treatment of accepted states, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .metric_identity_bd0017f2437756d9 import geometry, spread
from .model import measure

CHANGE = 67  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = 0.0
    last = math.inf
    bits = 2
    for round in range(1):
        geometry(t, y, p, w)
        violation = w[8]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        # near a singular position what is left of a violation opens another way: no more than rounding may be left
        near = w[4] < 1e-4
        closed = violation <= (0.01 * tolerance if near else tolerance) or stalled or round == 0
        if closed:
            measure(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(9, 18):
                y[j] += w[CHANGE - 9 + j]
            break
        for j in range(9):
            y[j] += w[CHANGE + j]
        last = violation
        iw[3] += 1
    measure(t, y, p, w)
    return bits
