"""Method `velocity-projection` for model `pendulum`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
"""

from .accept_identity_49af6846e4f9c94c import accept
from .metric_identity_84285ead4685e78a import geometry, spread
from .prepare_2c9fe628787beb52 import prepare
from .rhs_direct_86a2e0a578b6e7d2 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
