"""Method `direct-correction`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
format 3, generator of-golden-trees
option solver = elimination
option weight = identity
parameter 0: tolerance (default 1e-13)
"""

from .accept_identity_72d4f05a19e47e9d import accept
from .confirm_921e44bd2082aeab import confirm
from .metric_identity_d9ffd2c418c22c08 import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
