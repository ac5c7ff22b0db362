"""Numbers that depend on parameters alone, for model `n-four-bar-2`. Emitted by symgen; do not edit.

digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 3, templates 774f5f3a0a6c3684
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
