"""Method `mass-orthogonal-projection` for model `pendulum`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = dense
p[4] penalty (default 10000000.0)
p[5] tolerance (default 1e-13)
"""

from .accept_augmented_8ce17d6c1f46d3b9 import accept
from .metric_augmented_ca17b98f7b6621f4 import geometry, spread
from .prepare_0ab9ab4f69bf87e4 import prepare
from .rhs_dense_65c3f5cb0dd1cf11 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
