"""Treatment of accepted states, for model `andrews`. Emitted by symgen; do not edit.

digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
