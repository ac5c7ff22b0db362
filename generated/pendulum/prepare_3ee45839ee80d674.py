"""Numbers that depend on parameters alone, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 7 operations, 8 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    p7 = p[7]  # alpha
    p8 = p[8]  # beta
    # intermediate terms
    s0 = 9.81*p0
    # outputs
    p[3] = -s0  # -9.81*bob_mass
    p[4] = 2.0*p7  # 2.0*alpha
    p[5] = p8*p8  # beta*beta
    p[6] = -s0*(1.0/p0)  # -9.81*bob_mass*(1.0/bob_mass)
    return 0
