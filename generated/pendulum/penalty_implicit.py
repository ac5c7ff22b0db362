"""Method `penalty` for model `pendulum`. Emitted by symgen; do not edit.

constraints as stiff elements; the error falls like 1 / penalty
Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195; Ruzzeh, Kovecses, J. Comput. Nonlinear Dyn. 6 (2011) 021011
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
p[6] penalty (default 1000000000.0)
p[7] omega (default 10.0)
p[8] mu (default 1.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .form_acceleration_5769be78e260ce0f import residual, tangent
from .prepare_df6e3be716dfa677 import prepare
from .rhs_direct_7e5af27f23eb0af5 import rhs

__all__ = ["accept", "prepare", "residual", "rhs", "tangent"]
