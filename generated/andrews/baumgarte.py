"""Method `baumgarte` for model `andrews`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[9] alpha (default 5.0)
p[10] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_c6c0474f3420c232 import confirm
from .prepare_94e1ccfc7667d991 import prepare
from .rhs_direct_3750d1f136c753a2 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
