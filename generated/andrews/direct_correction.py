"""Method `direct-correction` for model `andrews`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = identity
p[7] tolerance (default 1e-13)
"""

from .accept_identity_63016fd4dad7e4d1 import accept
from .confirm_5743116709c0de56 import confirm
from .metric_identity_81041b14508829c8 import geometry, spread
from .prepare_70de031afcbda6a1 import prepare
from .rhs_direct_17b95175e0cc799e import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
