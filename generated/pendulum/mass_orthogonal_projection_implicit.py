"""Method `mass-orthogonal-projection` for model `pendulum`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[6] penalty (default 10000000.0)
p[7] tolerance (default 1e-13)
"""

from .accept_augmented_1b9506d9ca83f035 import accept
from .form_acceleration_a9d69cf31924d2f5 import residual, tangent
from .metric_augmented_5f8665dda85e0ed8 import geometry, spread
from .prepare_2c9fe628787beb52 import prepare
from .rhs_direct_86a2e0a578b6e7d2 import rhs

__all__ = ["accept", "geometry", "prepare", "residual", "rhs", "spread", "tangent"]
