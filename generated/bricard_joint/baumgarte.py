"""Method `baumgarte` for model `bricard`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest a434bc1850619abf59df99cd3f4a7f7d5156b781c8aa985ea07043e50b30d3a4, format 3, templates a694aa875a452a90
option solver = elimination
p[2] alpha (default 5.0)
p[3] beta (default 5.0)
"""

from .accept_measured_ff439807c5f4f6fd import accept
from .confirm_a8c5eeed4b294c1a import confirm
from .prepare_9f2c7ad49f4537ff import prepare
from .rhs_direct_8fd3d0bdeea00050 import rhs

__all__ = ["accept", "confirm", "prepare", "rhs"]
