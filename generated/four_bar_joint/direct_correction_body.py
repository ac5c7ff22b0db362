"""Method `direct-correction` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = body
p[23] tolerance (default 1e-13)
"""

from .accept_body_9237af08d4eb2843 import accept
from .confirm_59f5c5a217c93296 import confirm
from .metric_body_18bac4810ae506a3 import geometry, spread
from .prepare_5e969626a44f5ea9 import prepare
from .rhs_direct_14b54eb205a666ee import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
