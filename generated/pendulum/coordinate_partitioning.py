"""Method `coordinate-partitioning` for model `pendulum`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[6] tolerance (default 1e-13)
"""

from .accept_independent_1d2dc63264ffebb4 import accept
from .metric_independent_efaa75fae69152cb import geometry, spread
from .prepare_2c9fe628787beb52 import prepare
from .rhs_closed_552a574f18089c42 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
