"""Method `baumgarte` for model `bricard`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[2] alpha (default 5.0)
p[3] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_4de953f4e81e3f98 import confirm
from .prepare_9f2c7ad49f4537ff import prepare
from .rhs_direct_8d4f8b4bb0741476 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
