"""Method `generalized-alpha`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

constraints at position level (index 3) with controlled numerical damping
Arnold, Bruls, Multibody Syst. Dyn. 18 (2007) 185-202, doi 10.1007/s11044-007-9084-0
format 3, generator of-golden-trees
option solver = elimination
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .confirm_9ef84cd0e3e67521 import confirm
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
