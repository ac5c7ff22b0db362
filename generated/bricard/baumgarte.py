"""Method `baumgarte` for model `bricard`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[2] alpha (default 5.0)
p[3] beta (default 5.0)
"""

from .accept_measured_11f0ac418dc56f30 import accept
from .confirm_b21ddba3daed60dd import confirm
from .prepare_9f2c7ad49f4537ff import prepare
from .rhs_direct_2559a406ce932529 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
