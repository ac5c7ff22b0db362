"""Treatment of accepted states, for model `four-bar`. Emitted by symgen; do not edit.

digest fd145c51c4014a3d11ca6e04efb375ff159e658ad3f57f365eaa8110a7de8531, format 3, templates a694aa875a452a90
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
