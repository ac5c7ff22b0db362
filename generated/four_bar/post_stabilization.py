"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
"""

from .accept_identity_f2689e7f258bd816 import accept
from .confirm_8a47bcaa805f0e65 import confirm
from .metric_identity_bd0017f2437756d9 import geometry, spread
from .prepare_763b84c4155bae06 import prepare
from .rhs_direct_b39e1de949b53dc5 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
