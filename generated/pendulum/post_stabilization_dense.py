"""Method `post-stabilization` for model `pendulum`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates a694aa875a452a90
option solver = dense
option weight = identity
"""

from .accept_identity_1d76c3a0a06062a7 import accept
from .metric_identity_d09fcc5caf99d72e import geometry, spread
from .prepare_fe8af80990da6385 import prepare
from .rhs_dense_4c756d6f2d37ebf2 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
