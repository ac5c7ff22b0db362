"""Method `velocity-projection` for model `pendulum`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = augmented
option weight = identity
"""

from .accept_identity_0109b0c92efbb552 import accept
from .metric_identity_c3cc8f0b3b650721 import geometry, spread
from .prepare_fcdd2978e11fc2a7 import prepare
from .rhs_iterated_84cff5a6e0165ad9 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
