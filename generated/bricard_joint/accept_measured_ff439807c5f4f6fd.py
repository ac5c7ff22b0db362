"""Treatment of accepted states, for model `bricard`. Emitted by symgen; do not edit.

digest a434bc1850619abf59df99cd3f4a7f7d5156b781c8aa985ea07043e50b30d3a4, format 3, templates a694aa875a452a90
"""

from numba import njit

from .model import geometry, measure


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
