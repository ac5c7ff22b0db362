"""Method `direct-correction` for model `bricard`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
p[0] tolerance (default 1e-13)
"""

from .accept_identity_f76982397a5321e1 import accept
from .confirm_58c6a1d21be96b28 import confirm
from .metric_identity_19ea7bb1370ba888 import geometry, spread
from .prepare_069764e87980f98a import prepare
from .rhs_direct_192c668a04acfdcf import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
