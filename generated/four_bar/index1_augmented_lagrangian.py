"""Method `index1-augmented-lagrangian` for model `four-bar`. Emitted by symgen; do not edit.

iterated multipliers for accelerations, mass-orthogonal projections of positions and velocities
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130; Cuadrado, Cardenal, Bayo, Multibody Syst. Dyn. 1 (1997) 259-280
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
p[24] penalty (default 10000000.0)
p[25] iteration_tolerance (default 1e-13)
p[26] tolerance (default 1e-13)
"""

from .accept_augmented_d2ab66343cded2cd import accept
from .metric_augmented_f04222119b46a6ff import geometry, spread
from .prepare_9026ae072063da35 import prepare
from .rhs_iterated_36858f4489c07bfc import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
