"""Method `udwadia-kalaba`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

accelerations closest to the free ones in the metric of M, by a pseudoinverse
Udwadia, Kalaba, Proc. R. Soc. Lond. A 439 (1992) 407-410, doi 10.1098/rspa.1992.0158
format 3, generator of-golden-trees
"""

from .accept_measured_ab971c7af7dbf312 import accept
from .confirm_aa81911da2768f61 import confirm
from .prepare_a037fc2ae027d686 import prepare
from .rhs_direct_c77fdf82f84990a6 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
