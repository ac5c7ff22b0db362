"""Method `index3-augmented-lagrangian` for model `pendulum`. Emitted by symgen; do not edit.

trapezoidal rule in positions with iterated multipliers, velocities and accelerations projected (ALI3-P)
Cuadrado, Cardenal, Morer, Bayo, Multibody Syst. Dyn. 4 (2000) 55-73; Dopico, Gonzalez, Cuadrado, Kovecses, J. Comput. Nonlinear Dyn. 9 (2014) 041006
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[6] penalty (default 1000000000.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .form_projected_e93e4e1bfcbbcdd7 import residual, tangent
from .prepare_2c9fe628787beb52 import prepare
from .rhs_direct_86a2e0a578b6e7d2 import rhs

__all__ = ["accept", "prepare", "residual", "rhs", "tangent"]
