"""Corrections in another metric, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D D^T from D, without the rows that depend on others: 146 operations, 5015 before sharing."""
    # inputs
    reciprocal_1 = w[131]
    reciprocal_3 = w[133]
    reciprocal_4 = w[134]
    reciprocal_5 = w[135]
    reciprocal_6 = w[136]
    reciprocal_7 = w[137]
    jacobian_0 = w[102]  # D A.x, crank.omega
    jacobian_1 = w[103]  # D A.y, crank.omega
    jacobian_2 = w[104]  # D B.x, crank.omega
    jacobian_3 = w[105]  # D B.x, coupler.omega
    jacobian_4 = w[106]  # D B.y, crank.omega
    jacobian_5 = w[107]  # D B.y, coupler.omega
    jacobian_6 = w[108]  # D C.x, coupler.omega
    jacobian_7 = w[109]  # D C.x, rocker.omega
    jacobian_8 = w[110]  # D C.y, coupler.omega
    jacobian_9 = w[111]  # D C.y, rocker.omega
    jacobian_10 = w[112]  # D D.x, rocker.omega
    jacobian_11 = w[113]  # D D.y, rocker.omega
    # intermediate terms
    s0 = jacobian_0*jacobian_1
    s1 = -1.0 + jacobian_0*jacobian_2
    s2 = jacobian_0*jacobian_4
    s3 = -1.0 + jacobian_3*jacobian_6
    s4 = jacobian_3*jacobian_8
    s5 = 1.0 + jacobian_7*jacobian_10
    s6 = jacobian_9*jacobian_10
    s7 = jacobian_10*jacobian_11
    s8 = 1.0/(1.0 + jacobian_0*jacobian_0)
    s9 = s0*s8
    s10 = s1*s8
    s11 = s2*s8
    s12 = jacobian_1*jacobian_2 - s1*s9
    s13 = -1.0 + jacobian_1*jacobian_4 - s2*s9
    s14 = 1.0*(reciprocal_1 > 0.0)/max(1.0 + jacobian_1*jacobian_1 - s0*s9, 1e-300)
    s15 = s12*s14
    s16 = s13*s14
    s17 = jacobian_2*jacobian_4 + jacobian_3*jacobian_5 - s2*s10 - s13*s15
    s18 = 1.0/(1.0 + jacobian_10*jacobian_10)
    s19 = s7*s18
    s20 = s5*s18
    s21 = s6*s18
    s22 = jacobian_7*jacobian_11 - s5*s19
    s23 = 1.0 + jacobian_9*jacobian_11 - s6*s19
    s24 = 1.0*(reciprocal_3 > 0.0)/max(1.0 + jacobian_11*jacobian_11 - s7*s19, 1e-300)
    s25 = s22*s24
    s26 = s23*s24
    s27 = 1.0*(reciprocal_4 > 0.0)/max(1.0 + 1.0 + jacobian_2*jacobian_2 + jacobian_3*jacobian_3 - s1*s10 - s12*s15, 1e-300)
    s28 = s17*s27
    s29 = s3*s27
    s30 = s4*s27
    s31 = jacobian_5*jacobian_6 - s3*s28
    s32 = -1.0 + jacobian_5*jacobian_8 - s4*s28
    s33 = max(1.0 + 1.0 + jacobian_4*jacobian_4 + jacobian_5*jacobian_5 - s2*s11 - s13*s16 - s17*s28, 1e-300)
    s34 = 1.0*(reciprocal_5 > 0.0)/s33
    s35 = s31*s34
    s36 = s32*s34
    s37 = 1.0 + 1.0 + jacobian_6*jacobian_6 + jacobian_7*jacobian_7 - s5*s20 - s22*s25 - s3*s29 - s31*s35
    s38 = jacobian_6*jacobian_8 + jacobian_7*jacobian_9 - s6*s20 - s23*s25 - s4*s29 - s32*s35
    s39 = 1.0 + 1.0 + jacobian_8*jacobian_8 + jacobian_9*jacobian_9 - s6*s21 - s23*s26 - s4*s30 - s32*s36
    s40 = 1.0*(reciprocal_6 > 0.0)/max(s37, 1e-300)
    s41 = s38*s40
    # outputs
    w[208] = s9
    w[209] = s10
    w[210] = s11
    w[211] = s15
    w[212] = s16
    w[213] = s19
    w[214] = s20
    w[215] = s21
    w[216] = s25
    w[217] = s26
    w[218] = s28
    w[219] = s29
    w[220] = s30
    w[221] = s35
    w[222] = s36
    w[223] = s41
    w[224] = s8
    w[225] = s14
    w[226] = s18
    w[227] = s24
    w[228] = s27
    w[229] = s34
    w[230] = s40
    w[231] = 1.0*(reciprocal_7 > 0.0)/max(s39 - s38*s41, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 102 operations, 6981 before sharing."""
    # inputs
    jacobian_0 = w[102]  # D A.x, crank.omega
    jacobian_1 = w[103]  # D A.y, crank.omega
    jacobian_2 = w[104]  # D B.x, crank.omega
    jacobian_3 = w[105]  # D B.x, coupler.omega
    jacobian_4 = w[106]  # D B.y, crank.omega
    jacobian_5 = w[107]  # D B.y, coupler.omega
    jacobian_6 = w[108]  # D C.x, coupler.omega
    jacobian_7 = w[109]  # D C.x, rocker.omega
    jacobian_8 = w[110]  # D C.y, coupler.omega
    jacobian_9 = w[111]  # D C.y, rocker.omega
    jacobian_10 = w[112]  # D D.x, rocker.omega
    jacobian_11 = w[113]  # D D.y, rocker.omega
    law_lower_0 = w[208]
    law_lower_1 = w[209]
    law_lower_2 = w[210]
    law_lower_3 = w[211]
    law_lower_4 = w[212]
    law_lower_5 = w[213]
    law_lower_6 = w[214]
    law_lower_7 = w[215]
    law_lower_8 = w[216]
    law_lower_9 = w[217]
    law_lower_10 = w[218]
    law_lower_11 = w[219]
    law_lower_12 = w[220]
    law_lower_13 = w[221]
    law_lower_14 = w[222]
    law_lower_15 = w[223]
    law_reciprocal_0 = w[224]
    law_reciprocal_1 = w[225]
    law_reciprocal_2 = w[226]
    law_reciprocal_3 = w[227]
    law_reciprocal_4 = w[228]
    law_reciprocal_5 = w[229]
    law_reciprocal_6 = w[230]
    law_reciprocal_7 = w[231]
    residual_0 = w[43]  # A.x
    residual_1 = w[44]  # A.y
    residual_2 = w[45]  # B.x
    residual_3 = w[46]  # B.y
    residual_4 = w[47]  # C.x
    residual_5 = w[48]  # C.y
    residual_6 = w[49]  # D.x
    residual_7 = w[50]  # D.y
    # intermediate terms
    s0 = law_lower_0*residual_0 - residual_1
    s1 = law_lower_1*residual_0 - residual_2 - law_lower_3*s0
    s2 = law_lower_5*residual_6 - residual_7
    s3 = law_lower_2*residual_0 - residual_3 - law_lower_4*s0 - law_lower_10*s1
    s4 = law_lower_6*residual_6 - residual_4 - law_lower_8*s2 - law_lower_11*s1 - law_lower_13*s3
    s5 = law_lower_7*residual_6 - residual_5 - law_lower_9*s2 - law_lower_12*s1 - law_lower_14*s3 - law_lower_15*s4
    s6 = law_reciprocal_7*s5
    s7 = law_reciprocal_6*s4
    s8 = law_lower_15*s6
    s9 = s7 - s8
    s10 = law_reciprocal_5*s3 - law_lower_13*s9
    s11 = law_lower_14*s6
    s12 = s10 - s11
    s13 = law_reciprocal_4*s1 - law_lower_10*s12 - law_lower_11*s9
    s14 = law_lower_12*s6
    s15 = s13 - s14
    s16 = law_reciprocal_3*s2 - law_lower_8*s9 - law_lower_9*s6
    s17 = law_reciprocal_2*residual_6 + law_lower_5*s16 + law_lower_6*s9 + law_lower_7*s6
    s18 = law_reciprocal_1*s0 - law_lower_3*s15 - law_lower_4*s12
    s19 = law_reciprocal_0*residual_0 + law_lower_0*s18 + law_lower_1*s15 + law_lower_2*s12
    # outputs
    w[67] = s14 - s13 - s19  # crank.vx
    w[68] = s18 + s11 - s10  # crank.vy
    w[69] = jacobian_1*s18 - jacobian_0*s19 + jacobian_2*s15 + jacobian_4*s12  # crank.omega
    w[70] = s15 + s8 - s7  # coupler.vx
    w[71] = s12 - s6  # coupler.vy
    w[72] = jacobian_3*s15 + jacobian_5*s12 + jacobian_6*s9 + jacobian_8*s6  # coupler.omega
    w[73] = s9 - s17  # rocker.vx
    w[74] = s6 + s16  # rocker.vy
    w[75] = jacobian_7*s9 + jacobian_9*s6 - jacobian_10*s17 + jacobian_11*s16  # rocker.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
