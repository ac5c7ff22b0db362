"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = dense
option weight = identity
"""

from .accept_identity_e1ea1e6166407631 import accept
from .metric_identity_c01f538908e67c01 import geometry, spread
from .prepare_b53e6d0954ad35f8 import prepare
from .rhs_dense_8c68f8a0beef1cd4 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
