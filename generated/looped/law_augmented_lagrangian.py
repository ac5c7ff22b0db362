"""Method `augmented-lagrangian`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

penalty terms with iterated multipliers and stabilised constraints
Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195
format 3, generator of-golden-trees
parameter 0: penalty (default 10000000.0)
parameter 1: omega (default 10.0)
parameter 2: mu (default 1.0)
parameter 3: iteration_tolerance (default 1e-13)
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_03db069826113ad6 import rhs

__all__ = ["accept", "prepare", "rhs"]
