"""Method `lagrange` for model `four-bar`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest fd145c51c4014a3d11ca6e04efb375ff159e658ad3f57f365eaa8110a7de8531, format 3, templates a694aa875a452a90
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_b88ee2707047bb6e import confirm
from .prepare_97e25336ba4f9ea1 import prepare
from .rhs_direct_f0b37fbebfd6ca93 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
