"""Method `lagrange` for model `four-bar`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = augmented
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .prepare_9026ae072063da35 import prepare
from .rhs_iterated_c3fb399e1ddeaa14 import rhs

__all__ = ["accept", "prepare", "rhs"]
