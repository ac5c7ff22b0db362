"""Method `ggl`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

stabilised index 2: constraints at position and velocity level in every implicit stage
Gear, Leimkuhler, Gupta, J. Comput. Appl. Math. 12-13 (1985) 77-90, doi 10.1016/0377-0427(85)90008-1
format 3, generator of-golden-trees
option solver = elimination
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .confirm_9ef84cd0e3e67521 import confirm
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
