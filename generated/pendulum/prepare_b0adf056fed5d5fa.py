"""Numbers that depend on parameters alone, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 5 operations, 5 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # outputs
    p[3] = 1.0/math.sqrt(p0)  # 1.0/math.sqrt(bob_mass)
    p[4] = 9.81*p0*(1.0/p0)  # 9.81*bob_mass*(1.0/bob_mass)
    return 0
