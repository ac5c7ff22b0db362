"""Method `direct-correction` for model `andrews`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates a694aa875a452a90
option solver = elimination
option weight = mass
p[7] tolerance (default 1e-13)
"""

from .accept_mass_ac1064e4777a6c4a import accept
from .confirm_45bd826e55499040 import confirm
from .metric_mass_7b4744886fc9f23d import geometry, spread
from .prepare_5e6f3af61bb320e5 import prepare
from .rhs_direct_d28bf56970332796 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
