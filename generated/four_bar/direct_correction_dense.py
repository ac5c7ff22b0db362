"""Method `direct-correction` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = dense
option weight = identity
p[21] tolerance (default 1e-13)
"""

from .accept_identity_e9bc01c92d556178 import accept
from .metric_identity_c01f538908e67c01 import geometry, spread
from .prepare_b53e6d0954ad35f8 import prepare
from .rhs_dense_8c68f8a0beef1cd4 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
