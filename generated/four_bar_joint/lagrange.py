"""Method `lagrange` for model `four-bar`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest fd145c51c4014a3d11ca6e04efb375ff159e658ad3f57f365eaa8110a7de8531, format 3, templates a694aa875a452a90
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_806463b4664a02a9 import confirm
from .prepare_5e969626a44f5ea9 import prepare
from .rhs_direct_14b54eb205a666ee import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
