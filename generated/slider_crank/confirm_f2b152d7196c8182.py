"""Second evaluation without rows that come out doubtful, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry
from .rhs_direct_dce5973c19fe90e7 import rhs

MASK = 27  # sections of w
SAVED = 35
PIVOT = 59


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(8):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(8):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0
