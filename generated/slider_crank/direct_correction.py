"""Method `direct-correction` for model `slider-crank`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
p[25] tolerance (default 1e-13)
"""

from .accept_identity_6ab633ff6dff5c36 import accept
from .confirm_8ed5d98430acfba3 import confirm
from .metric_identity_cea80e60b7981cae import geometry, spread
from .prepare_8949f3846893b2b7 import prepare
from .rhs_direct_348e4bf1d0482392 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
