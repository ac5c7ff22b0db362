"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = dense
option weight = identity
"""

from .accept_identity_6bc920d1cc14195d import accept
from .metric_identity_24d084413a7dc212 import geometry, spread
from .prepare_925146d10b1178fc import prepare
from .rhs_dense_23a402b45809043e import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
