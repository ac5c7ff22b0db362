"""Method `generalized-alpha` for model `pendulum`. Emitted by symgen; do not edit.

constraints at position level (index 3) with controlled numerical damping
Arnold, Bruls, Multibody Syst. Dyn. 18 (2007) 185-202, doi 10.1007/s11044-007-9084-0
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .form_position_5a4c760c329f1cbc import residual, tangent
from .prepare_2c9fe628787beb52 import prepare
from .rhs_direct_86a2e0a578b6e7d2 import rhs

__all__ = ["accept", "prepare", "residual", "rhs", "tangent"]
