"""Method `mass-orthogonal-projection`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
format 3, generator of-golden-trees
option solver = augmented
parameter 0: penalty (default 10000000.0)
parameter 1: tolerance (default 1e-13)
"""

from .accept_augmented_62e33386f098b1f6 import accept
from .metric_augmented_8359d8fa0786ce5c import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_647ee94490eb9244 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
