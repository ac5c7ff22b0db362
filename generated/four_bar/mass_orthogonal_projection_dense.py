"""Method `mass-orthogonal-projection` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = dense
p[21] penalty (default 10000000.0)
p[22] tolerance (default 1e-13)
"""

from .accept_augmented_6bce4400b5610670 import accept
from .metric_augmented_4b254bef6830e696 import geometry, spread
from .prepare_b53e6d0954ad35f8 import prepare
from .rhs_dense_8c68f8a0beef1cd4 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
