"""Treatment of accepted states, for model `bricard`. Emitted by symgen; do not edit.

digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure, normalise


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected but the length of Euler parameters."""
    changed = normalise(y)
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 2 * changed
