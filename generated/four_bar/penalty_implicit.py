"""Method `penalty` for model `four-bar`. Emitted by symgen; do not edit.

constraints as stiff elements; the error falls like 1 / penalty
Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195; Ruzzeh, Kovecses, J. Comput. Nonlinear Dyn. 6 (2011) 021011
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
p[23] penalty (default 1000000000.0)
p[24] omega (default 10.0)
p[25] mu (default 1.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .form_acceleration_9e9e7755a8b97968 import residual, tangent
from .prepare_7e49cd42253cf997 import prepare
from .rhs_direct_0c6580103aa48b38 import rhs

__all__ = ["accept", "prepare", "residual", "rhs", "tangent"]
