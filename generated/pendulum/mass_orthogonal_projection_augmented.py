"""Method `mass-orthogonal-projection` for model `pendulum`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = augmented
p[5] penalty (default 10000000.0)
p[6] tolerance (default 1e-13)
"""

from .accept_augmented_19ad30113d640327 import accept
from .metric_augmented_e8d410660a2fe5d3 import geometry, spread
from .prepare_fcdd2978e11fc2a7 import prepare
from .rhs_iterated_84cff5a6e0165ad9 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
