"""Numbers that depend on parameters alone, for model `bricard`. Emitted by symgen; do not edit.

digest a434bc1850619abf59df99cd3f4a7f7d5156b781c8aa985ea07043e50b30d3a4, format 3, templates a694aa875a452a90
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0
