"""Right-hand side behind the closure of dependent coordinates, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .accept_independent_d2d3b4ddcd1099ab import close
from .rhs_iterated_c3fb399e1ddeaa14 import rhs as accelerate


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state, whose dependent part is closed first."""
    close(t, y, p, w, iw)
    return accelerate(t, y, p, w, iw, ydot)
