"""Right-hand side behind the closure of dependent coordinates, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .accept_independent_8b21095df4a4854d import close
from .rhs_dense_65c3f5cb0dd1cf11 import rhs as accelerate


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state, whose dependent part is closed first."""
    close(t, y, p, w, iw)
    return accelerate(t, y, p, w, iw, ydot)
