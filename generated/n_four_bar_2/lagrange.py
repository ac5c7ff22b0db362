"""Method `lagrange` for model `n-four-bar-2`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_4f37007dfa1dab82 import confirm
from .prepare_069764e87980f98a import prepare
from .rhs_direct_e2f706c7b92e7482 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
