"""Corrections in another metric, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D M^-1 D^T from D, without the rows that depend on others: 158 operations, 6664 before sharing."""
    # inputs
    p18 = p[18]  # 1.0/crank_mass
    p19 = p[19]  # 1.0/(0.3333333333333333*crank_mass)
    p20 = p[20]  # 1.0/coupler_mass
    p21 = p[21]  # 1.0/(5.333333333333333*coupler_mass)
    p22 = p[22]  # 1.0/rocker_mass
    p23 = p[23]  # 1.0/(2.083333333333333*rocker_mass)
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
    s0 = p19*jacobian_0
    s1 = p19*jacobian_1
    s2 = p19*jacobian_2
    s3 = p21*jacobian_3
    s4 = p21*jacobian_5
    s5 = p21*jacobian_6
    s6 = p23*jacobian_7
    s7 = p23*jacobian_9
    s8 = p23*jacobian_10
    s9 = jacobian_1*s0
    s10 = jacobian_2*s0 - p18
    s11 = jacobian_4*s0
    s12 = jacobian_6*s3 - p20
    s13 = jacobian_8*s3
    s14 = p22 + jacobian_10*s6
    s15 = jacobian_10*s7
    s16 = jacobian_11*s8
    s17 = 1.0/(p18 + jacobian_0*s0)
    s18 = s9*s17
    s19 = s10*s17
    s20 = s11*s17
    s21 = jacobian_2*s1 - s10*s18
    s22 = jacobian_4*s1 - p18 - s11*s18
    s23 = 1.0*(reciprocal_1 > 0.0)/max(p18 + jacobian_1*s1 - s9*s18, 1e-300)
    s24 = s21*s23
    s25 = s22*s23
    s26 = jacobian_4*s2 + jacobian_5*s3 - s11*s19 - s22*s24
    s27 = 1.0/(p22 + jacobian_10*s8)
    s28 = s16*s27
    s29 = s14*s27
    s30 = s15*s27
    s31 = jacobian_11*s6 - s14*s28
    s32 = p22 + jacobian_11*s7 - s15*s28
    s33 = 1.0*(reciprocal_3 > 0.0)/max(p22 + jacobian_11*(p23*jacobian_11) - s16*s28, 1e-300)
    s34 = s31*s33
    s35 = s32*s33
    s36 = 1.0*(reciprocal_4 > 0.0)/max(p20 + p18 + jacobian_2*s2 + jacobian_3*s3 - s10*s19 - s21*s24, 1e-300)
    s37 = s26*s36
    s38 = s12*s36
    s39 = s13*s36
    s40 = jacobian_6*s4 - s12*s37
    s41 = jacobian_8*s4 - p20 - s13*s37
    s42 = max(p20 + p18 + jacobian_4*(p19*jacobian_4) + jacobian_5*s4 - s11*s20 - s22*s25 - s26*s37, 1e-300)
    s43 = 1.0*(reciprocal_5 > 0.0)/s42
    s44 = s40*s43
    s45 = s41*s43
    s46 = jacobian_8*s5 + jacobian_9*s6 - s15*s29 - s32*s34 - s13*s38 - s41*s44
    s47 = p22 + p20 + jacobian_8*(p21*jacobian_8) + jacobian_9*s7 - s15*s30 - s32*s35 - s13*s39 - s41*s45
    s48 = max(p22 + p20 + jacobian_6*s5 + jacobian_7*s6 - s14*s29 - s31*s34 - s12*s38 - s40*s44, 1e-300)
    s49 = 1.0*(reciprocal_6 > 0.0)/s48
    s50 = s46*s49
    # outputs
    w[138] = s18
    w[139] = s19
    w[140] = s20
    w[141] = s24
    w[142] = s25
    w[143] = s28
    w[144] = s29
    w[145] = s30
    w[146] = s34
    w[147] = s35
    w[148] = s37
    w[149] = s38
    w[150] = s39
    w[151] = s44
    w[152] = s45
    w[153] = s50
    w[154] = s17
    w[155] = s23
    w[156] = s27
    w[157] = s33
    w[158] = s36
    w[159] = s43
    w[160] = s49
    w[161] = 1.0*(reciprocal_7 > 0.0)/max(s47 - s46*s50, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 111 operations, 6990 before sharing."""
    # inputs
    p18 = p[18]  # 1.0/crank_mass
    p19 = p[19]  # 1.0/(0.3333333333333333*crank_mass)
    p20 = p[20]  # 1.0/coupler_mass
    p21 = p[21]  # 1.0/(5.333333333333333*coupler_mass)
    p22 = p[22]  # 1.0/rocker_mass
    p23 = p[23]  # 1.0/(2.083333333333333*rocker_mass)
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
    law_lower_0 = w[138]
    law_lower_1 = w[139]
    law_lower_2 = w[140]
    law_lower_3 = w[141]
    law_lower_4 = w[142]
    law_lower_5 = w[143]
    law_lower_6 = w[144]
    law_lower_7 = w[145]
    law_lower_8 = w[146]
    law_lower_9 = w[147]
    law_lower_10 = w[148]
    law_lower_11 = w[149]
    law_lower_12 = w[150]
    law_lower_13 = w[151]
    law_lower_14 = w[152]
    law_lower_15 = w[153]
    law_reciprocal_0 = w[154]
    law_reciprocal_1 = w[155]
    law_reciprocal_2 = w[156]
    law_reciprocal_3 = w[157]
    law_reciprocal_4 = w[158]
    law_reciprocal_5 = w[159]
    law_reciprocal_6 = w[160]
    law_reciprocal_7 = w[161]
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
    w[67] = p18*(s14 - s13 - s19)  # crank.vx
    w[68] = p18*(s18 + s11 - s10)  # crank.vy
    w[69] = p19*(jacobian_1*s18 - jacobian_0*s19 + jacobian_2*s15 + jacobian_4*s12)  # crank.omega
    w[70] = p20*(s15 + s8 - s7)  # coupler.vx
    w[71] = p20*(s12 - s6)  # coupler.vy
    w[72] = p21*(jacobian_3*s15 + jacobian_5*s12 + jacobian_6*s9 + jacobian_8*s6)  # coupler.omega
    w[73] = p22*(s9 - s17)  # rocker.vx
    w[74] = p22*(s6 + s16)  # rocker.vy
    w[75] = p23*(jacobian_7*s9 + jacobian_9*s6 - jacobian_10*s17 + jacobian_11*s16)  # rocker.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
