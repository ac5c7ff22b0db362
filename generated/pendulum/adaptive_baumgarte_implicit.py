"""Method `adaptive-baumgarte` for model `pendulum`. Emitted by symgen; do not edit.

Baumgarte's gains bounded by a multiple of one over the step
Chang, Nikravesh, J. Mech. Trans. Autom. Des. 107 (1985) 488-492; Lin, Huang, J. Mech. Des. 124 (2002) 633-640, doi 10.1115/1.1519277
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[6] gain (default 20.0)
p[7] a (default 1.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .form_acceleration_ccd305dcd7f6dcec import residual, tangent
from .prepare_2c9fe628787beb52 import prepare
from .rhs_direct_a5e3571fabdd921f import rhs

__all__ = ["accept", "prepare", "residual", "rhs", "tangent"]
