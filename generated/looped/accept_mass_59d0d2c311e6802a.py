"""Treatment of accepted states, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import math

import numpy as np
from numba import njit

from .machine import CHANGE, NQ, NV, tables
from .metric_mass_c7faa0aba1f9ae61 import geometry, spread
from .model import measure, move, normalise


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    T = tables(w)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    change = np.int64(T[CHANGE])
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = 0.0
    last = math.inf
    bits = 2
    normalise(y, w)
    for round in range(2):
        geometry(t, y, p, w)
        violation = w[8]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        # near a singular position what is left of a violation opens another way: no more than rounding may be left
        near = w[4] < 1e-4
        closed = violation <= (0.01 * tolerance if near else tolerance) or stalled or round == 1
        if closed:
            measure(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(nq, nq + nv):
                y[j] += w[change - nq + j]
            break
        move(y, w)
        last = violation
        iw[3] += 1
    measure(t, y, p, w)
    return bits
