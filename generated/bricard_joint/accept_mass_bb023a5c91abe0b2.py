"""Treatment of accepted states, for model `bricard`. Emitted by symgen; do not edit.

digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .metric_mass_28bb27a708302091 import geometry, spread
from .model import measure

CHANGE = 50  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[0] * w[6]
    last = math.inf
    bits = 2
    for round in range(15):
        geometry(t, y, p, w)
        violation = w[8]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        # near a singular position what is left of a violation opens another way: no more than rounding may be left
        near = w[4] < 1e-4
        closed = violation <= (0.01 * tolerance if near else tolerance) or stalled or round == 14
        if closed:
            measure(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(5, 10):
                y[j] += w[CHANGE - 5 + j]
            break
        for j in range(5):
            y[j] += w[CHANGE + j]
        last = violation
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    measure(t, y, p, w)
    return bits
