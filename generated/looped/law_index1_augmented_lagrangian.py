"""Method `index1-augmented-lagrangian`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

iterated multipliers for accelerations, mass-orthogonal projections of positions and velocities
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130; Cuadrado, Cardenal, Bayo, Multibody Syst. Dyn. 1 (1997) 259-280
format 3, generator of-golden-trees
parameter 0: penalty (default 10000000.0)
parameter 1: iteration_tolerance (default 1e-13)
parameter 2: tolerance (default 1e-13)
"""

from .accept_augmented_a68e55f09167ed54 import accept
from .metric_augmented_8359d8fa0786ce5c import geometry, spread
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_c17aa93eae110c6d import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
