"""Method `direct-correction` for model `four-bar`, for CUDA. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = elimination
option weight = identity
p[28] tolerance (default 1e-13)
"""

from .accept_identity_43605f6bdfca67e8_cuda import accept
from .confirm_b836d06ae0b7052e_cuda import confirm
from .metric_identity_42eaf9545fae6995_cuda import geometry, spread
from .prepare_fb15419ced2f3f16_cuda import prepare
from .rhs_direct_5ec2304b56977532_cuda import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
