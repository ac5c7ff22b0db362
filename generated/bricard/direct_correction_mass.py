"""Method `direct-correction` for model `bricard`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates a360905d90dcc4fd
option solver = elimination
option weight = mass
p[0] tolerance (default 1e-13)
"""

from .accept_mass_4020a61e9a0fd389 import accept
from .confirm_c140b8eeead76369 import confirm
from .metric_mass_534890caa995df17 import geometry, spread
from .prepare_069764e87980f98a import prepare
from .rhs_direct_deacf1a33f51e6f8 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
