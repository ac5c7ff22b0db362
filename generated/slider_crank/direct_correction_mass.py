"""Method `direct-correction` for model `slider-crank`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = mass
p[25] tolerance (default 1e-13)
"""

from .accept_mass_249ad5dfa6d38cf2 import accept
from .confirm_8929b77f9df52331 import confirm
from .metric_mass_45dd1d6ac2375a04 import geometry, spread
from .prepare_5cdce40289bf575b import prepare
from .rhs_direct_348e4bf1d0482392 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
