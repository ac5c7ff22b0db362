"""Method `index3-augmented-lagrangian` for model `four-bar`. Emitted by symgen; do not edit.

trapezoidal rule in positions with iterated multipliers, velocities and accelerations projected (ALI3-P)
Cuadrado, Cardenal, Morer, Bayo, Multibody Syst. Dyn. 4 (2000) 55-73; Dopico, Gonzalez, Cuadrado, Kovecses, J. Comput. Nonlinear Dyn. 9 (2014) 041006
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[28] penalty (default 1000000000.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_455ae6a979b235c4 import confirm
from .form_projected_0e5fe4d671ee5b55 import residual, tangent
from .prepare_774a1f5c84145adc import prepare
from .rhs_direct_b39e1de949b53dc5 import rhs

__all__ = ["accept", "confirm", "prepare", "residual", "rhs", "tangent"]
