"""Method `augmented-lagrangian` for model `four-bar`. Emitted by symgen; do not edit.

penalty terms with iterated multipliers and stabilised constraints
Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
p[26] penalty (default 10000000.0)
p[27] omega (default 10.0)
p[28] mu (default 1.0)
p[29] iteration_tolerance (default 1e-13)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .prepare_9bcb91c2d5a9e9b8 import prepare
from .rhs_iterated_728b9c7795171d0d import rhs

__all__ = ["accept", "prepare", "rhs"]
