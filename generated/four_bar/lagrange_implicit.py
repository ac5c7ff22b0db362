"""Method `lagrange` for model `four-bar`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_455ae6a979b235c4 import confirm
from .form_acceleration_49a5fc2b5ec7ef8a import residual, tangent
from .prepare_f61c701a13b4eb1b import prepare
from .rhs_direct_b39e1de949b53dc5 import rhs

__all__ = ["accept", "confirm", "prepare", "residual", "rhs", "tangent"]
