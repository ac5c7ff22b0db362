"""Method `post-stabilization`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
format 3, generator of-golden-trees
option solver = elimination
option weight = identity
"""

from .accept_identity_f9dacbbc00f39c10 import accept
from .confirm_921e44bd2082aeab import confirm
from .metric_identity_d9ffd2c418c22c08 import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
