"""Treatment of accepted states, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

from numba import njit

from .model import geometry, measure, normalise


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected but the length of Euler parameters."""
    changed = normalise(y, w)
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 2 * changed
