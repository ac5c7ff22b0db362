"""Method `direct-correction` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
p[28] tolerance (default 1e-13)
"""

from .accept_identity_1927b0ace5822aa8 import accept
from .confirm_8a47bcaa805f0e65 import confirm
from .metric_identity_bd0017f2437756d9 import geometry, spread
from .prepare_763b84c4155bae06 import prepare
from .rhs_direct_b39e1de949b53dc5 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
