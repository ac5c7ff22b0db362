"""Method `lagrange` for model `pendulum`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = dense
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .prepare_0ab9ab4f69bf87e4 import prepare
from .rhs_dense_65c3f5cb0dd1cf11 import rhs

__all__ = ["accept", "prepare", "rhs"]
