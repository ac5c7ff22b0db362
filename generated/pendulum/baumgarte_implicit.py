"""Method `baumgarte` for model `pendulum`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[8] alpha (default 5.0)
p[9] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .form_acceleration_9f14003e81f0e969 import residual, tangent
from .prepare_65e03da746ed9ac8 import prepare
from .rhs_direct_0799ccf0a8a47ee6 import rhs

__all__ = ["accept", "prepare", "residual", "rhs", "tangent"]
