"""Numbers that depend on parameters alone, for model `bricard`. Emitted by symgen; do not edit.

digest a434bc1850619abf59df99cd3f4a7f7d5156b781c8aa985ea07043e50b30d3a4, format 3, templates a694aa875a452a90
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 2 operations, 2 before sharing."""
    # inputs
    p2 = p[2]  # alpha
    p3 = p[3]  # beta
    # outputs
    p[0] = 2.0*p2  # 2.0*alpha
    p[1] = p3*p3  # beta*beta
    return 0
