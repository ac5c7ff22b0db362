"""Treatment of accepted states, for model `driven-four-bar`. Emitted by symgen; do not edit.

digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
