"""Numbers that depend on parameters alone, for model `bricard`. Emitted by symgen; do not edit.

digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
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
