"""Method `baumgarte` for model `n-four-bar-2`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[2] alpha (default 5.0)
p[3] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_3d042f7111745bc7 import confirm
from .prepare_9f2c7ad49f4537ff import prepare
from .rhs_direct_cbb796bf69d33d5d import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
