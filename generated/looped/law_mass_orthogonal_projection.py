"""Method `mass-orthogonal-projection`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
format 3, generator of-golden-trees
option solver = elimination
parameter 0: penalty (default 10000000.0)
parameter 1: tolerance (default 1e-13)
"""

from .accept_augmented_4151ffd8e4ef0536 import accept
from .confirm_923b9de2db674584 import confirm
from .metric_augmented_2d13017f45e3ff7e import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_793f158db7f08688 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
