"""Second evaluation without rows that come out doubtful, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import math

import numpy as np
from numba import njit

from .machine import M, MASK, PIVOT, SAVED, tables
from .metric_augmented_2d13017f45e3ff7e import geometry
from .rhs_direct_793f158db7f08688 import rhs


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    T = tables(w)
    m = np.int64(T[M])
    mask = np.int64(T[MASK])
    saved = np.int64(T[SAVED])
    pivot = np.int64(T[PIVOT])
    geometry(t, y, p, w)
    skipped = 0
    for i in range(m):
        w[saved + i] = w[mask + i]
        if w[pivot + i] < 1e-12:
            w[mask + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(m):
        w[mask + i] = w[saved + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0
