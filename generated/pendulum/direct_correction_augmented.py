"""Method `direct-correction` for model `pendulum`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = augmented
option weight = identity
p[5] tolerance (default 1e-13)
"""

from .accept_identity_bd26ca71f5308dfe import accept
from .metric_identity_c3cc8f0b3b650721 import geometry, spread
from .prepare_fcdd2978e11fc2a7 import prepare
from .rhs_iterated_84cff5a6e0165ad9 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
