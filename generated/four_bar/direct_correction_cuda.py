"""Method `direct-correction` for model `four-bar`, for CUDA. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
p[28] tolerance (default 1e-13)
"""

from .accept_identity_8260faada2d2185d_cuda import accept
from .confirm_d700aaec3c56956c_cuda import confirm
from .metric_identity_a8f6f5400d97c9c0_cuda import geometry, spread
from .prepare_751a15db5b311eef_cuda import prepare
from .rhs_direct_569c93bfda4a4206_cuda import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
