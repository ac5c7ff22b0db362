"""Method `lagrange` for model `bricard`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_11f0ac418dc56f30 import accept
from .confirm_49f47163ad48800d import confirm
from .prepare_069764e87980f98a import prepare
from .rhs_direct_192c668a04acfdcf import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
