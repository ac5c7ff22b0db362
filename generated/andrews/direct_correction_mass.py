"""Method `direct-correction` for model `andrews`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = mass
p[7] tolerance (default 1e-13)
"""

from .accept_mass_95fc9a1518c8f3ac import accept
from .confirm_75a63bf0e99a1470 import confirm
from .metric_mass_39258feb26e296cc import geometry, spread
from .prepare_70de031afcbda6a1 import prepare
from .rhs_direct_17b95175e0cc799e import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
