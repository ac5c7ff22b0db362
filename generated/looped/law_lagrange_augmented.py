"""Method `lagrange`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
format 3, generator of-golden-trees
option solver = augmented
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .prepare_a037fc2ae027d686 import prepare
from .rhs_iterated_647ee94490eb9244 import rhs

__all__ = ["accept", "prepare", "rhs"]
