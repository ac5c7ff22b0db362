"""Method `velocity-projection` for model `pendulum`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates a694aa875a452a90
option solver = elimination
option weight = identity
"""

from .accept_identity_f85e81df352fc8e0 import accept
from .form_acceleration_2eaff8a27c1bb933 import residual, tangent
from .metric_identity_bd7f4cf885b349d5 import geometry, spread
from .prepare_ff3d175fb6c40462 import prepare
from .rhs_direct_e8071acbf2bf5192 import rhs

__all__ = ["accept", "geometry", "prepare", "residual", "rhs", "spread", "tangent"]
