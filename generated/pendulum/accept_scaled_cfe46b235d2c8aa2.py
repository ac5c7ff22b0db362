"""Treatment of accepted states, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry, measure, spread
from .rhs_tangent_f2198442fe1e46cc import choose, project

CHANGE = 25  # sections of w
GAUGE = 29
DEPENDENT = 35
BASIS = 39
TRIAL = 43


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct and measure an accepted state, and carry the tangent basis on to it."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[5] * w[6]
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
            for j in range(2, 4):
                y[j] += w[CHANGE - 2 + j]
            break
        for j in range(2):
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
            for j in range(2):
                if w[DEPENDENT + j] == 0.0 and degrees < 2:
                    for k in range(2):
                        w[BASIS + 2 * degrees + k] = 1.0 if k == j else 0.0
                    degrees += 1
            iw[8] = degrees
        project(p, w, iw)
        for c in range(iw[8]):
            for r in range(c + 1):  # orthogonal to the columns before it, then of length 1
                total = 0.0
                for j in range(2):
                    total += w[TRIAL + 2 * c + j] * w[(BASIS if r < c else TRIAL) + 2 * r + j] / w[GAUGE + j]
                if r == c:
                    for j in range(2):
                        w[BASIS + 2 * c + j] = w[TRIAL + 2 * c + j] / math.sqrt(total)
                else:
                    for j in range(2):
                        w[TRIAL + 2 * c + j] -= total * w[BASIS + 2 * r + j]
    measure(t, y, p, w)
    return bits
