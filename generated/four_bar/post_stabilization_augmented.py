"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = augmented
option weight = identity
"""

from .accept_identity_5e1987622ccf3950 import accept
from .metric_identity_4455e6aac6180ded import geometry, spread
from .prepare_e9abfb5308afbaf9 import prepare
from .rhs_iterated_270a07b4c3e23db7 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
