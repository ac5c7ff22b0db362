"""Method `augmented-lagrangian` for model `pendulum`. Emitted by symgen; do not edit.

penalty terms with iterated multipliers and stabilised constraints
Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
p[7] penalty (default 10000000.0)
p[8] omega (default 10.0)
p[9] mu (default 1.0)
p[10] iteration_tolerance (default 1e-13)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .prepare_82bed4058e811bc7 import prepare
from .rhs_iterated_9e22e91f9ca70e2c import rhs

__all__ = ["accept", "prepare", "rhs"]
