"""Method `mass-orthogonal-projection` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[28] penalty (default 10000000.0)
p[29] tolerance (default 1e-13)
"""

from .accept_augmented_82e2cb0b78e0c58c import accept
from .confirm_6129ed4b3f390359 import confirm
from .metric_augmented_2305310f8e7cfdfc import geometry, spread
from .prepare_a1b79ebc06238e1a import prepare
from .rhs_direct_b39e1de949b53dc5 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
