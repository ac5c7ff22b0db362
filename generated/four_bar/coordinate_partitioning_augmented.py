"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a694aa875a452a90
option solver = augmented
p[24] tolerance (default 1e-13)
"""

from .accept_independent_1ff915060c67d058 import accept
from .metric_independent_3ab9c1a38c7d8eeb import geometry, spread
from .prepare_e9abfb5308afbaf9 import prepare
from .rhs_closed_bd65dfcdf1967c40 import rhs

__all__ = ["accept", "geometry", "prepare", "rhs", "spread"]
