"""Treatment of accepted states, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .metric_independent_5c9960393a5e2c95 import expand, geometry, spread
from .model import measure

CHANGE = 67  # sections of w
MASS = 76
GAUGE = 85
DEPENDENT = 208
DENSE = 217


@njit(error_model="numpy", fastmath={"contract"})
def reduce(w, step, column):
    """Make a column of the dense D a unit vector with its 1 in row `step` (Gauss, Jordan)."""
    pivot = w[DENSE + 9 * step + column]
    for j in range(9):
        w[DENSE + 9 * step + j] /= pivot
    for i in range(8):
        factor = w[DENSE + 9 * i + column]
        if i != step and factor != 0.0:
            for j in range(9):
                w[DENSE + 9 * i + j] -= factor * w[DENSE + 9 * step + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def choose(p, w, iw):
    """Choose the dependent columns of D: by complete pivoting, then by exchange while that enlarges their determinant."""
    for k in range(72):
        w[DENSE + k] = 0.0
    expand(p, w)
    for j in range(9):
        w[DEPENDENT + j] = 0.0
    for i in range(8):  # rows of unequal size must not decide
        total = 0.0
        for j in range(9):
            w[DENSE + 9 * i + j] *= math.sqrt(w[GAUGE + j])
            total += w[DENSE + 9 * i + j] ** 2
        for j in range(9):
            w[DENSE + 9 * i + j] /= math.sqrt(total)
    rank = 0
    for step in range(8):
        largest, row, column = 0.0, -1, -1
        for i in range(step, 8):
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 9 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 9 * i + j]), i, j
        if largest < 1e-6:  # the square root of the threshold at which D D^T skips a row
            break
        w[DEPENDENT + column] = 1.0
        for j in range(9):
            a, b = DENSE + 9 * step + j, DENSE + 9 * row + j
            w[a], w[b] = w[b], w[a]
        reduce(w, step, column)
        rank += 1
    # what is left in the other columns is how fast dependent coordinates follow independent ones, with the sign changed
    for exchange in range(9):
        largest, row, column = 1.01, -1, -1
        for i in range(rank):
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 9 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 9 * i + j]), i, j
        if row < 0:
            break
        for j in range(9):
            if w[DEPENDENT + j] == 1.0 and w[DENSE + 9 * row + j] != 0.0:
                w[DEPENDENT + j] = 0.0
        w[DEPENDENT + column] = 1.0
        reduce(w, row, column)
    iw[7] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def close(t, y, p, w, iw):
    """Dependent coordinates from Phi = 0 and dependent velocities from D v = nu, the independent ones kept."""
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
    return bits


@njit(error_model="numpy", fastmath={"contract"})
def release(w):
    """Make all coordinates dependent, weighted by M^-1: near a singular position no partition determines the motion."""
    largest = 0.0
    for j in range(9):
        largest = max(largest, w[MASS + j] * w[GAUGE + j])
    for j in range(9):
        w[DEPENDENT + j] = 1.0 / max(w[MASS + j] * w[GAUGE + j], 1e-6 * largest)  # massless bodies give way, within reason
    w[15] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Close an accepted state, choose another partition where this one has become poor, and measure."""
    poor = False
    if iw[5] == 0:
        geometry(t, y, p, w)
        # the root of the smallest pivot is the sine of an angle: it says whether the next step meets a singular position
        sine = math.sqrt(max(w[4], 0.0))
        fall = max(w[17] - sine, 0.0)
        w[17] = sine
        first = iw[7] == 0
        released = w[15] == 0.0 and not first
        if sine - fall < 0.01:
            if not released:
                release(w)
                iw[7] += 1
        else:
            quality = w[14]
            w[15] = max(w[15], quality)
            ahead = quality - max(w[16] - quality, 0.0)
            poor = released or ahead < 0.3 * w[15]
            w[16] = quality
            if first:
                choose(p, w, iw)
                geometry(t, y, p, w)
                w[15] = w[14]
    bits = close(t, y, p, w, iw)
    if poor:  # after closing: the partition that was integrated with is better for it than one from a singular position
        choose(p, w, iw)
        geometry(t, y, p, w)
        w[15] = w[14]
        w[16] = w[14]
    measure(t, y, p, w)
    return bits
