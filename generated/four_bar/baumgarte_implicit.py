"""Method `baumgarte` for model `four-bar`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[30] alpha (default 5.0)
p[31] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_4c84d583dd4b3373 import confirm
from .form_acceleration_bf6bfeb8bd3e8243 import residual, tangent
from .prepare_16cf2140a5a34dd9 import prepare
from .rhs_direct_d51925b07420e4df import rhs

__all__ = ["accept", "confirm", "prepare", "residual", "rhs", "tangent"]
