"""Treatment of accepted states, for model `four-bar`. Emitted by symgen; do not edit.

digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
