"""Method `direct-correction` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = elimination
option weight = mass
p[28] tolerance (default 1e-13)
"""

from .accept_mass_c3b0f6316f39a63d import accept
from .confirm_ed4ac87406ed2761 import confirm
from .metric_mass_caa3cb8643e300c8 import geometry, spread
from .prepare_030af4547de87394 import prepare
from .rhs_direct_e37dc391c4609e3f import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
