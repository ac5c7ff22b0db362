"""Numbers that depend on parameters alone, for model `n-four-bar-2`. Emitted by symgen; do not edit.

digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0
