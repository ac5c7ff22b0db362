"""Numbers that depend on parameters alone, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 29 operations, 53 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 1.0/math.sqrt(p0)
    s1 = 1.0/math.sqrt(p1)
    s2 = 1.0/math.sqrt(p2)
    s3 = 9.81*p0*(1.0/p0)
    s4 = 9.81*p1*(1.0/p1)
    s5 = 9.81*p2*(1.0/p2)
    # outputs
    p[15] = s0  # 1.0/math.sqrt(crank_mass)
    p[16] = 1.0/math.sqrt(0.3333333333333333*p0)  # 1.0/math.sqrt(0.3333333333333333*crank_mass)
    p[17] = s1  # 1.0/math.sqrt(coupler_mass)
    p[18] = 1.0/math.sqrt(5.333333333333333*p1)  # 1.0/math.sqrt(5.333333333333333*coupler_mass)
    p[19] = s2  # 1.0/math.sqrt(rocker_mass)
    p[20] = 1.0/math.sqrt(2.083333333333333*p2)  # 1.0/math.sqrt(2.083333333333333*rocker_mass)
    p[21] = s3  # 9.81*crank_mass*(1.0/crank_mass)
    p[22] = s4  # 9.81*coupler_mass*(1.0/coupler_mass)
    p[23] = s5  # 9.81*rocker_mass*(1.0/rocker_mass)
    p[24] = s0*s0
    p[25] = s1*s1
    p[26] = s2*s2
    p[27] = s3 - s4
    p[28] = s4 - s5
    return 0
