"""Numbers that depend on parameters alone, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Nothing depends on parameters of the method alone."""
    return 0
