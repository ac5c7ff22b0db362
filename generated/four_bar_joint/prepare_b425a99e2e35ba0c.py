"""Numbers that depend on parameters alone, for model `four-bar`. Emitted by symgen; do not edit.

digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 17 operations, 18 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p25 = p[25]  # alpha
    p26 = p[26]  # beta
    # intermediate terms
    s0 = 4.0*p1
    # outputs
    p[16] = 9.81*p0  # 9.81*crank_mass
    p[17] = 9.81*p1  # 9.81*coupler_mass
    p[18] = 9.81*p2  # 9.81*rocker_mass
    p[19] = s0  # 4.0*coupler_mass
    p[20] = 5.333333333333333*p1 + 16.0*p1
    p[21] = 2.0*p25  # 2.0*alpha
    p[22] = p26*p26  # beta*beta
    p[23] = 1.0/(2.083333333333333*p2 + 6.25*p2)
    p[24] = 1.0/(s0 + p0 + 0.3333333333333333*p0)
    return 0
