"""Second evaluation without rows that come out doubtful, for model `bricard`. Emitted by symgen; do not edit.

digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry
from .rhs_direct_c34c5fe08a51e276 import rhs

MASK = 25  # sections of w
SAVED = 30
PIVOT = 45


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(5):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(5):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0
