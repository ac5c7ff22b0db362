"""Method `direct-correction` for model `driven-four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = mass
p[31] tolerance (default 1e-13)
"""

from .accept_mass_2649ff9346795a57 import accept
from .confirm_ea3c1079ded4f76f import confirm
from .metric_mass_a33bab9607d770b6 import geometry, spread
from .prepare_2417799c85cd7c23 import prepare
from .rhs_direct_1ad352335f0d6e20 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
