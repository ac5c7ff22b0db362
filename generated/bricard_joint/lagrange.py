"""Method `lagrange` for model `bricard`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest a434bc1850619abf59df99cd3f4a7f7d5156b781c8aa985ea07043e50b30d3a4, format 3, templates a694aa875a452a90
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_f2777c6e17246359 import confirm
from .prepare_069764e87980f98a import prepare
from .rhs_direct_d217e291597a315c import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
