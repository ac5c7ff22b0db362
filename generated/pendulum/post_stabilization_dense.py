"""Method `post-stabilization` for model `pendulum`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = dense
option weight = identity
"""

from .accept_identity_b15c62c362217a6b import accept
from .metric_identity_f2e8c58f7dcdc2c5 import geometry, spread
from .prepare_0ab9ab4f69bf87e4 import prepare
from .rhs_dense_65c3f5cb0dd1cf11 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
