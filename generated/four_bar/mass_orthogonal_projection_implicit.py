"""Method `mass-orthogonal-projection` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = elimination
p[28] penalty (default 10000000.0)
p[29] tolerance (default 1e-13)
"""

from .accept_augmented_955cc712e85ac891 import accept
from .confirm_7655e8105f2948f8 import confirm
from .form_acceleration_8754c883271a7423 import residual, tangent
from .metric_augmented_14a1ba5f25743355 import geometry, spread
from .prepare_1fa6c94700d82bf8 import prepare
from .rhs_direct_e37dc391c4609e3f import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "residual", "rhs", "spread", "tangent"]
