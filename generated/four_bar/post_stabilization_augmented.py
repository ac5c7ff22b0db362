"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a360905d90dcc4fd
option solver = augmented
option weight = identity
"""

from .accept_identity_d0425a14030cd7ac import accept
from .metric_identity_6f4d8e54d731205b import geometry, spread
from .prepare_e9abfb5308afbaf9 import prepare
from .rhs_iterated_270a07b4c3e23db7 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
