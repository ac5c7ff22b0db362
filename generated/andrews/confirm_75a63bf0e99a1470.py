"""Second evaluation without rows that come out doubtful, for model `andrews`. Emitted by symgen; do not edit.

digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .metric_mass_39258feb26e296cc import geometry
from .rhs_direct_17b95175e0cc799e import rhs

MASK = 39  # sections of w
SAVED = 59
PIVOT = 119


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(20):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(20):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0
