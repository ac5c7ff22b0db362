"""Method `velocity-projection` for model `four-bar`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = augmented
option weight = identity
"""

from .accept_identity_0ae7888fd6e05e27 import accept
from .metric_identity_4455e6aac6180ded import geometry, spread
from .prepare_e9abfb5308afbaf9 import prepare
from .rhs_iterated_270a07b4c3e23db7 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
