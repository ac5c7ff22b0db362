"""Method `direct-correction` for model `slider-crank`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates a694aa875a452a90
option solver = elimination
option weight = mass
p[25] tolerance (default 1e-13)
"""

from .accept_mass_5a3aa8a7a3297349 import accept
from .confirm_437b92d133b6cbe9 import confirm
from .metric_mass_b7816793bada957b import geometry, spread
from .prepare_af5f5b3313db3c68 import prepare
from .rhs_direct_4076c3e3d5b7a910 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
