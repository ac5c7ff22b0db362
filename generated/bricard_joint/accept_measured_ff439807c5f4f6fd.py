"""Treatment of accepted states, for model `bricard`. Emitted by symgen; do not edit.

digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
