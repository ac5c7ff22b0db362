"""Second evaluation without rows that come out doubtful, for model `n-four-bar-2`. Emitted by symgen; do not edit.

digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry
from .rhs_direct_e2f706c7b92e7482 import rhs

MASK = 33  # sections of w
SAVED = 47
PIVOT = 89


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(14):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(14):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0
