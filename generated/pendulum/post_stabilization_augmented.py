"""Method `post-stabilization` for model `pendulum`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = augmented
option weight = identity
"""

from .accept_identity_93052814df6faf77 import accept
from .metric_identity_c3cc8f0b3b650721 import geometry, spread
from .prepare_fcdd2978e11fc2a7 import prepare
from .rhs_iterated_84cff5a6e0165ad9 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
