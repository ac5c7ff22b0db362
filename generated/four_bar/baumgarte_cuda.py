"""Method `baumgarte` for model `four-bar`, for CUDA. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[30] alpha (default 5.0)
p[31] beta (default 5.0)
"""

from .accept_measured_16f7c7b65cb5c9c1_cuda import accept
from .confirm_efa5920a44591a5f_cuda import confirm
from .prepare_687571ff3fa92bda_cuda import prepare
from .rhs_direct_af11eb4718dd3a68_cuda import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
