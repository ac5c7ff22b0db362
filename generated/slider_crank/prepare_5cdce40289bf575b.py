"""Numbers that depend on parameters alone, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 18 operations, 42 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # rod_mass [kg]
    p2 = p[2]  # slider_mass [kg]
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
    s9 = 1.0/s5
    s10 = s5*s9
    # outputs
    p[13] = s0  # 9.81*crank_mass
    p[14] = s1  # 9.81*rod_mass
    p[15] = s2  # 9.81*slider_mass
    p[16] = s3  # 1.0/crank_mass
    p[17] = 1.0/(0.001875*p0)  # 1.0/(0.001875*crank_mass)
    p[18] = s4  # 1.0/rod_mass
    p[19] = 1.0/(0.016875*p1)  # 1.0/(0.016875*rod_mass)
    p[20] = s5  # 1.0/slider_mass
    p[21] = s6  # 9.81*crank_mass*(1.0/crank_mass)
    p[22] = s8  # 9.81*slider_mass*(1.0/slider_mass)
    p[23] = s6 - s7
    p[24] = s7 - s8
    p[26] = s9  # 1.0/(1.0/slider_mass)
    p[27] = s10
    p[28] = s5*s10
    return 0
