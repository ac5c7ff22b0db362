"""Second evaluation without rows that come out doubtful, for model `bricard`. Emitted by symgen; do not edit.

digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .metric_identity_19ea7bb1370ba888 import geometry
from .rhs_direct_192c668a04acfdcf import rhs

MASK = 55  # sections of w
SAVED = 85
PIVOT = 175


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(30):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(30):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0
