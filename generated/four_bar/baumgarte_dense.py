"""Method `baumgarte` for model `four-bar`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = dense
p[23] alpha (default 5.0)
p[24] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .prepare_ef519d61066ea1f2 import prepare
from .rhs_dense_a4121ed44a28843f import rhs

__all__ = ["accept", "prepare", "rhs"]
