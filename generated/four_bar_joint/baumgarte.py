"""Method `baumgarte` for model `four-bar`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[25] alpha (default 5.0)
p[26] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_cf6ddaf04e9a244a import confirm
from .prepare_b425a99e2e35ba0c import prepare
from .rhs_direct_50aca0743bddcdbe import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
