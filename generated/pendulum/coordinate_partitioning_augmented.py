"""Method `coordinate-partitioning` for model `pendulum`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 329873645fe3a239
option solver = augmented
p[5] tolerance (default 1e-13)
"""

from .accept_independent_94fc29cdbd4a0bff import accept
from .metric_independent_fa739cfe06bc9c56 import geometry, spread
from .prepare_fcdd2978e11fc2a7 import prepare
from .rhs_closed_fc61f193dd006ebe import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
