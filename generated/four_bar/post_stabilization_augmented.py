"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = augmented
option weight = identity
"""

from .accept_identity_dfab0219ac7d5f54 import accept
from .metric_identity_0a5690aa82831f05 import geometry, spread
from .prepare_9026ae072063da35 import prepare
from .rhs_iterated_c3fb399e1ddeaa14 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
