"""Numbers that depend on parameters alone, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 20 operations, 47 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 0.3333333333333333*p0
    s1 = 9.81*p0
    s2 = 5.333333333333333*p1
    s3 = 9.81*p1
    s4 = 2.083333333333333*p2
    s5 = 9.81*p2
    s6 = 1.0/p0
    s7 = 1.0/p1
    s8 = 1.0/p2
    s9 = s1*s6
    s10 = s3*s7
    s11 = s5*s8
    # outputs
    p[15] = s1  # 9.81*crank_mass
    p[16] = s3  # 9.81*coupler_mass
    p[17] = s5  # 9.81*rocker_mass
    p[18] = s6  # 1.0/crank_mass
    p[19] = 1.0/s0  # 1.0/(0.3333333333333333*crank_mass)
    p[20] = s7  # 1.0/coupler_mass
    p[21] = 1.0/s2  # 1.0/(5.333333333333333*coupler_mass)
    p[22] = s8  # 1.0/rocker_mass
    p[23] = 1.0/s4  # 1.0/(2.083333333333333*rocker_mass)
    p[24] = s9  # 9.81*crank_mass*(1.0/crank_mass)
    p[25] = s11  # 9.81*rocker_mass*(1.0/rocker_mass)
    p[26] = s9 - s10
    p[27] = s10 - s11
    p[28] = s0  # 0.3333333333333333*crank_mass
    p[29] = s2  # 5.333333333333333*coupler_mass
    p[30] = s4  # 2.083333333333333*rocker_mass
    p[33] = -s9  # -9.81*crank_mass*(1.0/crank_mass)
    p[34] = -s10  # -9.81*coupler_mass*(1.0/coupler_mass)
    p[35] = -s11  # -9.81*rocker_mass*(1.0/rocker_mass)
    return 0
