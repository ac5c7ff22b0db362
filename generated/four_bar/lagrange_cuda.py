"""Method `lagrange` for model `four-bar`, for CUDA. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_16f7c7b65cb5c9c1_cuda import accept
from .confirm_5dc7b6438d08cb73_cuda import confirm
from .prepare_751a15db5b311eef_cuda import prepare
from .rhs_direct_569c93bfda4a4206_cuda import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
