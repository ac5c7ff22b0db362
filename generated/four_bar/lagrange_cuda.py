"""Method `lagrange` for model `four-bar`, for CUDA. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = elimination
"""

from .accept_measured_16f7c7b65cb5c9c1_cuda import accept
from .confirm_fc9117e8c09878aa_cuda import confirm
from .prepare_fb15419ced2f3f16_cuda import prepare
from .rhs_direct_5ec2304b56977532_cuda import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
