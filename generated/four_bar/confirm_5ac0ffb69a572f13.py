"""Second evaluation without rows that come out doubtful, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .metric_mass_ff018d814c36552d import geometry
from .rhs_direct_b39e1de949b53dc5 import rhs

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
