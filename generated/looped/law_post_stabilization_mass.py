"""Method `post-stabilization`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
format 3, generator of-golden-trees
option solver = elimination
option weight = mass
"""

from .accept_mass_59d0d2c311e6802a import accept
from .confirm_b760304a2fbff870 import confirm
from .metric_mass_c7faa0aba1f9ae61 import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
