"""Method `lagrange` for model `pendulum`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = augmented
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .prepare_fcdd2978e11fc2a7 import prepare
from .rhs_iterated_84cff5a6e0165ad9 import rhs

__all__ = ["accept", "prepare", "rhs"]
