"""Numbers that depend on parameters alone, for model `bricard`. Emitted by symgen; do not edit.

digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0
