"""Method `index3-augmented-lagrangian`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

trapezoidal rule in positions with iterated multipliers, velocities and accelerations projected (ALI3-P)
Cuadrado, Cardenal, Morer, Bayo, Multibody Syst. Dyn. 4 (2000) 55-73; Dopico, Gonzalez, Cuadrado, Kovecses, J. Comput. Nonlinear Dyn. 9 (2014) 041006
format 3, generator of-golden-trees
option solver = elimination
parameter 0: penalty (default 1000000000.0)
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .confirm_9ef84cd0e3e67521 import confirm
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
