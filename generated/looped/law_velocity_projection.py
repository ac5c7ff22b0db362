"""Method `velocity-projection`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
format 3, generator of-golden-trees
option solver = elimination
option weight = identity
"""

from .accept_identity_09f6a7f128e75291 import accept
from .confirm_562bfd91d9b3566c import confirm
from .metric_identity_56272e987929f96d import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
