"""Method `null-space` for model `pendulum`. Emitted by symgen; do not edit.

accelerations in a tangent basis that is carried on from step to step
Mani, Haug, Atkinson, J. Mech. Trans. Autom. Des. 107 (1985) 82-87; Kim, Vanderploeg, J. Mech. Trans. Autom. Des. 108 (1986) 183-188
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
p[5] tolerance (default 1e-13)
"""

from .accept_scaled_cfe46b235d2c8aa2 import accept
from .prepare_c87633aa2ec39f08 import prepare
from .rhs_tangent_f2198442fe1e46cc import rhs

__all__ = ["accept", "prepare", "rhs"]
