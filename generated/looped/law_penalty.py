"""Method `penalty`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

constraints as stiff elements; the error falls like 1 / penalty
Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195; Ruzzeh, Kovecses, J. Comput. Nonlinear Dyn. 6 (2011) 021011
format 3, generator of-golden-trees
parameter 0: penalty (default 1000000000.0)
parameter 1: omega (default 10.0)
parameter 2: mu (default 1.0)
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_05eaa19b5769f59b import rhs

__all__ = ["accept", "prepare", "rhs"]
