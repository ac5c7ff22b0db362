"""Method `lagrange` for model `four-bar`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_63608e04c7369e22 import confirm
from .form_acceleration_ae84e57377bc258b import residual, tangent
from .prepare_980c25ae6cc4d1f3 import prepare
from .rhs_direct_e37dc391c4609e3f import rhs

__all__ = ["accept", "confirm", "prepare", "residual", "rhs", "tangent"]
