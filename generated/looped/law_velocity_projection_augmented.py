"""Method `velocity-projection`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
format 3, generator of-golden-trees
option solver = augmented
option weight = identity
"""

from .accept_identity_8007248f92ffffec import accept
from .metric_identity_3fda7db334446b39 import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_647ee94490eb9244 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
