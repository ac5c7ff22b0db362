"""Method `baumgarte` for model `andrews`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates a694aa875a452a90
option solver = elimination
p[9] alpha (default 5.0)
p[10] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_9254a80d54539e8e import confirm
from .prepare_fe441edcf48e7463 import prepare
from .rhs_direct_7c81ebad45ca951f import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
