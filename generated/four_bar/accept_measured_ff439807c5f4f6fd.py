"""Treatment of accepted states, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
