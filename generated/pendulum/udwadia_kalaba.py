"""Method `udwadia-kalaba` for model `pendulum`. Emitted by symgen; do not edit.

accelerations closest to the free ones in the metric of M, by a pseudoinverse
Udwadia, Kalaba, Proc. R. Soc. Lond. A 439 (1992) 407-410, doi 10.1098/rspa.1992.0158
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .prepare_b0adf056fed5d5fa import prepare
from .rhs_direct_e6f20503147a40dd import rhs

__all__ = ["accept", "prepare", "rhs"]
