"""Method `baumgarte` for model `driven-four-bar`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[33] alpha (default 5.0)
p[34] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_a4bc7c2de083ea47 import confirm
from .prepare_e28a5fd43aa8fbfb import prepare
from .rhs_direct_4ab0865a2cbfd0ae import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
