"""Method `lagrange` for model `bricard`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_5550770b0e041e52 import confirm
from .prepare_069764e87980f98a import prepare
from .rhs_direct_c34c5fe08a51e276 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
