"""Method `baumgarte` for model `slider-crank`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[27] alpha (default 5.0)
p[28] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_f2b152d7196c8182 import confirm
from .prepare_f2590f8531bdddee import prepare
from .rhs_direct_dce5973c19fe90e7 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
