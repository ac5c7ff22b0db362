"""Method `ggl` for model `pendulum`. Emitted by symgen; do not edit.

stabilised index 2: constraints at position and velocity level in every implicit stage
Gear, Leimkuhler, Gupta, J. Comput. Appl. Math. 12-13 (1985) 77-90, doi 10.1016/0377-0427(85)90008-1
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .form_stabilised_524b9685c922d50d import residual, tangent
from .prepare_2c9fe628787beb52 import prepare
from .rhs_direct_86a2e0a578b6e7d2 import rhs

__all__ = ["accept", "prepare", "residual", "rhs", "tangent"]
