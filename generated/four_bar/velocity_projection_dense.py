"""Method `velocity-projection` for model `four-bar`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = dense
option weight = identity
"""

from .accept_identity_4b2ae1ec0068b9be import accept
from .metric_identity_24d084413a7dc212 import geometry, spread
from .prepare_925146d10b1178fc import prepare
from .rhs_dense_23a402b45809043e import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
