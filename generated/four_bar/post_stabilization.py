"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a360905d90dcc4fd
option solver = elimination
option weight = identity
"""

from .accept_identity_44dd6c1fbb22ce2e import accept
from .confirm_1590cea5faa16a58 import confirm
from .metric_identity_718fe1511f11ea96 import geometry, spread
from .prepare_030af4547de87394 import prepare
from .rhs_direct_e37dc391c4609e3f import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
