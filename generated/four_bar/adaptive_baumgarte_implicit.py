"""Method `adaptive-baumgarte` for model `four-bar`. Emitted by symgen; do not edit.

Baumgarte's gains bounded by a multiple of one over the step
Chang, Nikravesh, J. Mech. Trans. Autom. Des. 107 (1985) 488-492; Lin, Huang, J. Mech. Des. 124 (2002) 633-640, doi 10.1115/1.1519277
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[28] gain (default 20.0)
p[29] a (default 1.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_b3e9dd4198ff1463 import confirm
from .form_acceleration_e94b0e1831cc6d7e import residual, tangent
from .prepare_a1b79ebc06238e1a import prepare
from .rhs_direct_0b360cef165baa90 import rhs

__all__ = ["accept", "confirm", "prepare", "residual", "rhs", "tangent"]
