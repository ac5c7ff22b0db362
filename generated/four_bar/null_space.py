"""Method `null-space` for model `four-bar`. Emitted by symgen; do not edit.

accelerations in a tangent basis that is carried on from step to step
Mani, Haug, Atkinson, J. Mech. Trans. Autom. Des. 107 (1985) 82-87; Kim, Vanderploeg, J. Mech. Trans. Autom. Des. 108 (1986) 183-188
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
p[24] tolerance (default 1e-13)
"""

from .accept_scaled_58129f53ee9b9614 import accept
from .prepare_9ce7f8a2e48deb9d import prepare
from .rhs_tangent_eaaae4981768c3c7 import rhs

__all__ = ["accept", "prepare", "rhs"]
