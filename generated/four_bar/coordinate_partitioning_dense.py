"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = dense
p[21] tolerance (default 1e-13)
"""

from .accept_independent_50212e7a5df6ea71 import accept
from .metric_independent_5019f28a409b003d import geometry, spread
from .prepare_b53e6d0954ad35f8 import prepare
from .rhs_closed_913657cfd49e2e2c import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
