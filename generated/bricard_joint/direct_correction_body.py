"""Method `direct-correction` for model `bricard`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = body
p[0] tolerance (default 1e-13)
"""

from .accept_body_b0f859f2514e0291 import accept
from .confirm_89b6c1aa2f021fff import confirm
from .metric_body_5065a5f705fcdd90 import geometry, spread
from .prepare_069764e87980f98a import prepare
from .rhs_direct_c34c5fe08a51e276 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
