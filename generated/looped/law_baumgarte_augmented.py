"""Method `baumgarte`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
format 3, generator of-golden-trees
option solver = augmented
parameter 0: alpha (default 5.0)
parameter 1: beta (default 5.0)
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_eb5c20f620d9d181 import rhs

__all__ = ["accept", "prepare", "rhs"]
