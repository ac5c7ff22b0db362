"""Method `udwadia-kalaba` for model `four-bar`. Emitted by symgen; do not edit.

accelerations closest to the free ones in the metric of M, by a pseudoinverse
Udwadia, Kalaba, Proc. R. Soc. Lond. A 439 (1992) 407-410, doi 10.1098/rspa.1992.0158
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_c515b1783fd9cbe4 import confirm
from .prepare_6eb087d8a1ab6ad3 import prepare
from .rhs_direct_c045b1f8abd28df8 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
