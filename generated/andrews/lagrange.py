"""Method `lagrange` for model `andrews`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates a694aa875a452a90
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_9be92fe8a7ff0ce8 import confirm
from .prepare_5e6f3af61bb320e5 import prepare
from .rhs_direct_d28bf56970332796 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
