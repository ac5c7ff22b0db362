"""Method `augmented-hamiltonian` for model `four-bar`. Emitted by symgen; do not edit.

momenta are integrated; velocities satisfy their constraint in every evaluation
Bayo, Avello, Nonlinear Dyn. 5 (1994) 209-231, doi 10.1007/BF00045677
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
p[31] penalty (default 10000000.0)
p[32] iteration_tolerance (default 1e-13)
"""

from .accept_mass_a9a51d8f8d9f00cf import accept
from .metric_mass_4d1439948c57b01c import geometry, spread
from .prepare_811804f7174a8235 import prepare
from .rhs_iterated_2cc218d85b4834d4 import rates, rhs

__all__ = ["accept", "geometry", "prepare", "rates", "rhs", "spread"]
