"""Method `mass-orthogonal-projection` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = augmented
p[24] penalty (default 10000000.0)
p[25] tolerance (default 1e-13)
"""

from .accept_augmented_8e59d3b7b64f427e import accept
from .metric_augmented_fdc93732d7bd8d08 import geometry, spread
from .prepare_9026ae072063da35 import prepare
from .rhs_iterated_c3fb399e1ddeaa14 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
