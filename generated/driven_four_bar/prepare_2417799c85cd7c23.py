"""Numbers that depend on parameters alone, for model `driven-four-bar`. Emitted by symgen; do not edit.

digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 18 operations, 35 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    s3 = 1.0/p0
    s4 = 1.0/(0.3333333333333333*p0)
    s5 = 1.0/p1
    s6 = 1.0/p2
    s7 = s0*s3
    s8 = s1*s5
    s9 = s2*s6
    # outputs
    p[17] = s0  # 9.81*crank_mass
    p[18] = s1  # 9.81*coupler_mass
    p[19] = s2  # 9.81*rocker_mass
    p[20] = s3  # 1.0/crank_mass
    p[21] = s4  # 1.0/(0.3333333333333333*crank_mass)
    p[22] = s5  # 1.0/coupler_mass
    p[23] = 1.0/(5.333333333333333*p1)  # 1.0/(5.333333333333333*coupler_mass)
    p[24] = s6  # 1.0/rocker_mass
    p[25] = 1.0/(2.083333333333333*p2)  # 1.0/(2.083333333333333*rocker_mass)
    p[26] = s7  # 9.81*crank_mass*(1.0/crank_mass)
    p[27] = s9  # 9.81*rocker_mass*(1.0/rocker_mass)
    p[28] = s7 - s8
    p[29] = s8 - s9
    p[30] = 1e-06*s4  # 1e-06*(1.0/(0.3333333333333333*crank_mass))
    return 0
