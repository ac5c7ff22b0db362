"""Method `direct-correction`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
format 3, generator of-golden-trees
option solver = augmented
option weight = identity
parameter 0: tolerance (default 1e-13)
"""

from .accept_identity_2bbaedda78e51723 import accept
from .metric_identity_3fda7db334446b39 import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_647ee94490eb9244 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
