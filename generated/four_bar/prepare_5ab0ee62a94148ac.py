"""Numbers that depend on parameters alone, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 19 operations, 34 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p30 = p[30]  # alpha
    p31 = p[31]  # beta
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    s3 = 1.0/p0
    s4 = 1.0/p1
    s5 = 1.0/p2
    s6 = s0*s3
    s7 = s1*s4
    s8 = s2*s5
    # outputs
    p[15] = s0  # 9.81*crank_mass
    p[16] = s1  # 9.81*coupler_mass
    p[17] = s2  # 9.81*rocker_mass
    p[18] = 2.0*p30  # 2.0*alpha
    p[19] = p31*p31  # beta*beta
    p[20] = s3  # 1.0/crank_mass
    p[21] = 1.0/(0.3333333333333333*p0)  # 1.0/(0.3333333333333333*crank_mass)
    p[22] = s4  # 1.0/coupler_mass
    p[23] = 1.0/(5.333333333333333*p1)  # 1.0/(5.333333333333333*coupler_mass)
    p[24] = s5  # 1.0/rocker_mass
    p[25] = 1.0/(2.083333333333333*p2)  # 1.0/(2.083333333333333*rocker_mass)
    p[26] = s6  # 9.81*crank_mass*(1.0/crank_mass)
    p[27] = s8  # 9.81*rocker_mass*(1.0/rocker_mass)
    p[28] = s6 - s7
    p[29] = s7 - s8
    return 0
