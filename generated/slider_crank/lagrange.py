"""Method `lagrange` for model `slider-crank`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_6ec4478d714c8ad4 import confirm
from .prepare_8949f3846893b2b7 import prepare
from .rhs_direct_348e4bf1d0482392 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
