"""Method `lagrange` for model `four-bar`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_806463b4664a02a9 import confirm
from .prepare_5e969626a44f5ea9 import prepare
from .rhs_direct_14b54eb205a666ee import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
