"""Corrections in another metric, for model `four-bar`. Emitted by symgen; do not edit.

digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots that decide rank, and the factorisation of D W^-1 D^T: 111 operations, 1547 before sharing."""
    # inputs
    q0 = y[0]  # crank.theta [rad]
    q1 = y[1]  # rocker.theta [rad]
    q2 = y[2]  # coupler.theta [rad]
    p19 = p[19]  # 4.0*coupler_mass
    mask_0 = w[21]  # C.x
    mask_1 = w[22]  # C.y
    gauge_0 = w[37]  # crank.omega
    gauge_1 = w[38]  # rocker.omega
    gauge_2 = w[39]  # coupler.omega
    # intermediate terms
    s0 = math.cos(q0)
    s1 = math.sin(q0)
    s2 = math.cos(q1)
    s3 = math.sin(q1)
    s4 = math.cos(q2)
    s5 = math.sin(q2)
    s6 = 2.0*s0
    s7 = 2.0*s1
    s8 = 5.0*s2
    s9 = 8.0*s4
    s10 = 10.0 - s6 + s8 - s9
    s11 = 5.0*s3
    s12 = 8.0*s5
    s13 = s11 - s7 - s12
    s14 = s7*(4.0*s5) + s6*(4.0*s4)
    s15 = s7*gauge_0
    s16 = s11*gauge_1
    s17 = s12*gauge_2
    s18 = s7*s15 + s11*s16 + s12*s17
    s19 = s6*s15 + s8*s16 + s9*s17
    s20 = s6*(s6*gauge_0) + s8*(s8*gauge_1) + s9*(s9*gauge_2)
    s21 = max(s18, 2.0)
    s22 = 1.0*(s18 > mask_0 + 1e-12*s21)
    s23 = s20 - s19*(s19*(s22/max(s18, 1e-300)))
    s24 = max(s20, 2.0)
    s25 = 1.0*(s23 > mask_1 + 1e-12*s24)
    s26 = 0.16666666666666666*s14
    s27 = 1.0/(17.0 - s14*s26)
    s28 = s12 - s7*s26
    s29 = s6*s26 - s9
    s30 = 0.3333333333333333*s1
    s31 = 0.6896551724137931*s3
    s32 = s27*s28
    s33 = s29*s32 - (s6*s30 + s8*s31)
    s34 = s22/max(s7*s30 + s11*s31 + s28*s32, 1e-300)
    s35 = s33*s34
    s36 = max(s6*(0.3333333333333333*s0) + s8*(0.6896551724137931*s2) + s29*(s27*s29) - s33*s35, 1e-300)
    s37 = math.sqrt(s10*s10 + s13*s13)
    s38 = s18/s21
    s39 = s23/s24
    # outputs
    w[25] = s10  # C.x
    w[26] = s13  # C.y
    w[0] = s37  # position_violation
    w[8] = s37  # position_measure
    w[42] = s7  # D C.x, crank.omega
    w[43] = -s11  # D C.x, rocker.omega
    w[44] = s12  # D C.x, coupler.omega
    w[45] = -s6  # D C.y, crank.omega
    w[46] = s8  # D C.y, rocker.omega
    w[47] = -s9  # D C.y, coupler.omega
    w[29] = s38  # C.x
    w[30] = s39  # C.y
    w[5] = s22 + s25  # rank
    w[4] = min(min(1.0, mask_0 + s38), mask_1 + s39)  # smallest_pivot
    w[10] = 1.0  # shortest_row
    w[53] = s35
    w[54] = s34
    w[55] = s25/s36
    w[52] = s14
    w[51] = s7*(s5*p19) + s6*(s4*p19)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 26 operations, 93 before sharing."""
    # inputs
    law_lower_0 = w[53]
    law_reciprocal_0 = w[54]
    law_reciprocal_1 = w[55]
    residual_0 = w[25]  # C.x
    residual_1 = w[26]  # C.y
    jacobian_0 = w[42]  # D C.x, crank.omega
    jacobian_1 = w[43]  # D C.x, rocker.omega
    jacobian_2 = w[44]  # D C.x, coupler.omega
    jacobian_3 = w[45]  # D C.y, crank.omega
    jacobian_4 = w[46]  # D C.y, rocker.omega
    jacobian_5 = w[47]  # D C.y, coupler.omega
    body_entry_0 = w[52]
    # intermediate terms
    s0 = law_reciprocal_1*(law_lower_0*residual_0 - residual_1)
    s1 = law_reciprocal_0*residual_0 + law_lower_0*s0
    s2 = s0*jacobian_3 - s1*jacobian_0
    s3 = 0.16666666666666666*body_entry_0
    s4 = 1.0/(17.0 - body_entry_0*s3)*(s0*jacobian_5 - s1*jacobian_2 - s2*s3)
    # outputs
    w[31] = 0.16666666666666666*s2 - s3*s4  # crank.omega
    w[32] = 0.13793103448275862*(s0*jacobian_4 - s1*jacobian_1)  # rocker.omega
    w[33] = s4  # coupler.omega
    return 0
