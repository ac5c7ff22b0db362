"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = augmented
p[24] tolerance (default 1e-13)
"""

from .accept_independent_d2d3b4ddcd1099ab import accept
from .metric_independent_5c9960393a5e2c95 import geometry, spread
from .prepare_9026ae072063da35 import prepare
from .rhs_closed_5ad526d42317fa58 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
