"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = elimination
p[28] tolerance (default 1e-13)
"""

from .accept_independent_7f2e190846084892 import accept
from .confirm_e135ec6d80b73872 import confirm
from .metric_independent_dba3048d724a8293 import geometry, spread
from .prepare_030af4547de87394 import prepare
from .rhs_closed_58d4a2a22dbd889c import rhs

__all__ = ["accept", "confirm", "geometry", "prepare", "rhs", "spread"]
