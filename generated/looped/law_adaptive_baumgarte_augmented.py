"""Method `adaptive-baumgarte`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

Baumgarte's gains bounded by a multiple of one over the step
Chang, Nikravesh, J. Mech. Trans. Autom. Des. 107 (1985) 488-492; Lin, Huang, J. Mech. Des. 124 (2002) 633-640, doi 10.1115/1.1519277
format 3, generator of-golden-trees
option solver = augmented
parameter 0: gain (default 20.0)
parameter 1: a (default 1.0)
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_fa984c3daeaaacc5 import rhs

__all__ = ["accept", "prepare", "rhs"]
