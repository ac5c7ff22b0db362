"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = elimination
option weight = identity
"""

from .accept_identity_e2b1967159684479 import accept
from .confirm_e4d6575b6806aa49 import confirm
from .form_acceleration_ae84e57377bc258b import residual, tangent
from .metric_identity_788c34c771daa420 import geometry, spread
from .prepare_980c25ae6cc4d1f3 import prepare
from .rhs_direct_e37dc391c4609e3f import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "residual", "rhs", "spread", "tangent"]
