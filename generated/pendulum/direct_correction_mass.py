"""Method `direct-correction` for model `pendulum`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
option weight = mass
p[6] tolerance (default 1e-13)
"""

from .accept_mass_b3cfc68af147417d import accept
from .metric_mass_6f4957d414e14d81 import geometry, spread
from .prepare_2c9fe628787beb52 import prepare
from .rhs_direct_86a2e0a578b6e7d2 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
