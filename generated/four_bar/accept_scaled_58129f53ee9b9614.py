"""Treatment of accepted states, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry, measure, spread
from .rhs_tangent_eaaae4981768c3c7 import choose, project

CHANGE = 67  # sections of w
GAUGE = 85
DEPENDENT = 138
BASIS = 219
TRIAL = 282


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct and measure an accepted state, and carry the tangent basis on to it."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[24] * w[6]
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
            for j in range(9, 18):
                y[j] += w[CHANGE - 9 + j]
            break
        for j in range(9):
            y[j] += w[CHANGE + j]
        last = violation
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    if iw[5] == 0:
        if iw[7] == 0:  # the first basis: unit vectors of independent coordinates
            choose(p, w, iw)
            degrees = 0
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and degrees < 7:
                    for k in range(9):
                        w[BASIS + 9 * degrees + k] = 1.0 if k == j else 0.0
                    degrees += 1
            iw[8] = degrees
        project(p, w, iw)
        for c in range(iw[8]):
            for r in range(c + 1):  # orthogonal to the columns before it, then of length 1
                total = 0.0
                for j in range(9):
                    total += w[TRIAL + 9 * c + j] * w[(BASIS if r < c else TRIAL) + 9 * r + j] / w[GAUGE + j]
                if r == c:
                    for j in range(9):
                        w[BASIS + 9 * c + j] = w[TRIAL + 9 * c + j] / math.sqrt(total)
                else:
                    for j in range(9):
                        w[TRIAL + 9 * c + j] -= total * w[BASIS + 9 * r + j]
    measure(t, y, p, w)
    return bits
