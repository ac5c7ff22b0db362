"""Method `lagrange` for model `andrews`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates 774f5f3a0a6c3684
option solver = elimination
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_1590013dbfafd268 import confirm
from .prepare_70de031afcbda6a1 import prepare
from .rhs_direct_17b95175e0cc799e import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
