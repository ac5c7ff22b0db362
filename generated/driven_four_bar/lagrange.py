"""Method `lagrange` for model `driven-four-bar`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_6426526bdb16f276 import confirm
from .prepare_2417799c85cd7c23 import prepare
from .rhs_direct_1ad352335f0d6e20 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
