"""Method `baumgarte` for model `four-bar`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest fd145c51c4014a3d11ca6e04efb375ff159e658ad3f57f365eaa8110a7de8531, format 3, templates a694aa875a452a90
option solver = elimination
p[25] alpha (default 5.0)
p[26] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_cf6ddaf04e9a244a import confirm
from .prepare_b425a99e2e35ba0c import prepare
from .rhs_direct_50aca0743bddcdbe import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
