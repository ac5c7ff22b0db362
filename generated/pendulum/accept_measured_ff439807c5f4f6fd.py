"""Treatment of accepted states, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
