"""Method `augmented-hamiltonian` for model `pendulum`. Emitted by symgen; do not edit.

momenta are integrated; velocities satisfy their constraint in every evaluation
Bayo, Avello, Nonlinear Dyn. 5 (1994) 209-231, doi 10.1007/BF00045677
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
p[6] penalty (default 10000000.0)
p[7] iteration_tolerance (default 1e-13)
"""

from .accept_mass_86df66257fe222f6 import accept
from .metric_mass_d5bfbb9d66af4a14 import geometry, spread
from .prepare_2c9fe628787beb52 import prepare
from .rhs_iterated_dfcca869999aeb25 import rates, rhs

__all__ = ["accept", "geometry", "prepare", "rates", "rhs", "spread"]
