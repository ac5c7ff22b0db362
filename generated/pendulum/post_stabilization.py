"""Method `post-stabilization` for model `pendulum`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
"""

from .accept_identity_b7f48108536fa4ed import accept
from .metric_identity_84285ead4685e78a import geometry, spread
from .prepare_2c9fe628787beb52 import prepare
from .rhs_direct_86a2e0a578b6e7d2 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
