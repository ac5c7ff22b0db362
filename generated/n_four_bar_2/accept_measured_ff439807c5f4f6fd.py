"""Treatment of accepted states, for model `n-four-bar-2`. Emitted by symgen; do not edit.

digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
