"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[28] tolerance (default 1e-13)
"""

from .accept_independent_c65e83d6d85d12ec import accept
from .confirm_4bc3e8acb1cf725d import confirm
from .metric_independent_b394b9a15d327fc9 import geometry, spread
from .prepare_763b84c4155bae06 import prepare
from .rhs_closed_cc55681a1457d194 import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
