"""Method `velocity-projection` for model `four-bar`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = elimination
option weight = mass
"""

from .accept_mass_1e94a4ade23f38d8 import accept
from .confirm_ed4ac87406ed2761 import confirm
from .metric_mass_caa3cb8643e300c8 import geometry, spread
from .prepare_030af4547de87394 import prepare
from .rhs_direct_e37dc391c4609e3f import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
