"""Method `post-stabilization`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
format 3, generator of-golden-trees
option solver = augmented
option weight = identity
"""

from .accept_identity_1810517e3900c3ca import accept
from .metric_identity_3fda7db334446b39 import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_647ee94490eb9244 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
