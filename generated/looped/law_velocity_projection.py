"""Method `velocity-projection`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
format 3, generator of-golden-trees
option solver = elimination
option weight = identity
"""

from .accept_identity_2b5e52d19ab9de15 import accept
from .confirm_921e44bd2082aeab import confirm
from .metric_identity_d9ffd2c418c22c08 import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
