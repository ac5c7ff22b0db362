"""Method `direct-correction` for model `n-four-bar-2`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
p[0] tolerance (default 1e-13)
"""

from .accept_identity_2790ea4258e73c49 import accept
from .confirm_bff92cd29e92f419 import confirm
from .metric_identity_9597cd34100af21b import geometry, spread
from .prepare_069764e87980f98a import prepare
from .rhs_direct_e2f706c7b92e7482 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
