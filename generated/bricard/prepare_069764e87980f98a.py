"""Numbers that depend on parameters alone, for model `bricard`. Emitted by symgen; do not edit.

digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0
