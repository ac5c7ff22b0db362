"""Method `baumgarte` for model `pendulum`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = dense
p[6] alpha (default 5.0)
p[7] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .prepare_ee367e370fcad2e1 import prepare
from .rhs_dense_13c9b6b0ccc1db14 import rhs

__all__ = ["accept", "prepare", "rhs"]
