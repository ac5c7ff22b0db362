"""Method `index1-augmented-lagrangian` for model `pendulum`. Emitted by symgen; do not edit.

iterated multipliers for accelerations, mass-orthogonal projections of positions and velocities
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130; Cuadrado, Cardenal, Bayo, Multibody Syst. Dyn. 1 (1997) 259-280
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
p[5] penalty (default 10000000.0)
p[6] iteration_tolerance (default 1e-13)
p[7] tolerance (default 1e-13)
"""

from .accept_augmented_e409c6381da19969 import accept
from .metric_augmented_e8d410660a2fe5d3 import geometry, spread
from .prepare_fcdd2978e11fc2a7 import prepare
from .rhs_iterated_de630c91fd6603d3 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
