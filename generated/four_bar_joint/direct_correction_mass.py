"""Method `direct-correction` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = mass
p[23] tolerance (default 1e-13)
"""

from .accept_mass_871025963da1ce73 import accept
from .confirm_424857e9721d94a9 import confirm
from .metric_mass_e0f60412748ee3ad import geometry, spread
from .prepare_5e969626a44f5ea9 import prepare
from .rhs_direct_14b54eb205a666ee import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
