"""Method `index1-augmented-lagrangian` for model `pendulum`. Emitted by symgen; do not edit.

iterated multipliers for accelerations, mass-orthogonal projections of positions and velocities
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130; Cuadrado, Cardenal, Bayo, Multibody Syst. Dyn. 1 (1997) 259-280
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates a694aa875a452a90
p[5] penalty (default 10000000.0)
p[6] iteration_tolerance (default 1e-13)
p[7] tolerance (default 1e-13)
"""

from .accept_augmented_96627e5e10b7f513 import accept
from .metric_augmented_332864fc37a99dd2 import geometry, spread
from .prepare_bce06b5282bbe7ed import prepare
from .rhs_iterated_46fff9259fc116bc import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
