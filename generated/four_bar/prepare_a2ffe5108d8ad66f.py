"""Numbers that depend on parameters alone, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 20 operations, 23 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p26 = p[26]  # alpha
    p27 = p[27]  # beta
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    # outputs
    p[15] = 0.3333333333333333*p0  # 0.3333333333333333*crank_mass
    p[16] = -s0  # -9.81*crank_mass
    p[17] = 5.333333333333333*p1  # 5.333333333333333*coupler_mass
    p[18] = -s1  # -9.81*coupler_mass
    p[19] = 2.083333333333333*p2  # 2.083333333333333*rocker_mass
    p[20] = -s2  # -9.81*rocker_mass
    p[21] = 2.0*p26  # 2.0*alpha
    p[22] = p27*p27  # beta*beta
    p[23] = -s0*(1.0/p0)  # -9.81*crank_mass*(1.0/crank_mass)
    p[24] = -s1*(1.0/p1)  # -9.81*coupler_mass*(1.0/coupler_mass)
    p[25] = -s2*(1.0/p2)  # -9.81*rocker_mass*(1.0/rocker_mass)
    return 0
