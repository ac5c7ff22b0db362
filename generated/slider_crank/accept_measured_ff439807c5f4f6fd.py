"""Treatment of accepted states, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
