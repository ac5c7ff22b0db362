"""Corrections in another metric, for model `driven-four-bar`. Emitted by symgen; do not edit.

digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D M^-1 D^T from D, without the rows that depend on others: 185 operations, 8168 before sharing."""
    # inputs
    p20 = p[20]  # 1.0/crank_mass
    p21 = p[21]  # 1.0/(0.3333333333333333*crank_mass)
    p22 = p[22]  # 1.0/coupler_mass
    p23 = p[23]  # 1.0/(5.333333333333333*coupler_mass)
    p24 = p[24]  # 1.0/rocker_mass
    p25 = p[25]  # 1.0/(2.083333333333333*rocker_mass)
    reciprocal_1 = w[142]
    reciprocal_2 = w[143]
    reciprocal_3 = w[144]
    reciprocal_5 = w[146]
    reciprocal_6 = w[147]
    reciprocal_7 = w[148]
    reciprocal_8 = w[149]
    jacobian_0 = w[109]  # D A.x, crank.omega
    jacobian_1 = w[110]  # D A.y, crank.omega
    jacobian_2 = w[111]  # D B.x, crank.omega
    jacobian_3 = w[112]  # D B.x, coupler.omega
    jacobian_4 = w[113]  # D B.y, crank.omega
    jacobian_5 = w[114]  # D B.y, coupler.omega
    jacobian_6 = w[115]  # D C.x, coupler.omega
    jacobian_7 = w[116]  # D C.x, rocker.omega
    jacobian_8 = w[117]  # D C.y, coupler.omega
    jacobian_9 = w[118]  # D C.y, rocker.omega
    jacobian_10 = w[119]  # D D.x, rocker.omega
    jacobian_11 = w[120]  # D D.y, rocker.omega
    # intermediate terms
    s0 = p21*jacobian_0
    s1 = p21*jacobian_1
    s2 = p21*jacobian_2
    s3 = p23*jacobian_3
    s4 = p21*jacobian_4
    s5 = p23*jacobian_5
    s6 = p23*jacobian_6
    s7 = p25*jacobian_7
    s8 = p25*jacobian_9
    s9 = p25*jacobian_10
    s10 = jacobian_1*s0
    s11 = jacobian_2*s0 - p20
    s12 = jacobian_4*s0
    s13 = jacobian_6*s3 - p22
    s14 = jacobian_6*s5
    s15 = p24 + jacobian_10*s7
    s16 = jacobian_10*s8
    s17 = jacobian_11*s9
    s18 = 1.0/(p24 + jacobian_10*s9)
    s19 = s17*s18
    s20 = s15*s18
    s21 = s16*s18
    s22 = jacobian_11*s7 - s15*s19
    s23 = p24 + jacobian_11*s8 - s16*s19
    s24 = 1.0*(reciprocal_1 > 0.0)/max(p24 + jacobian_11*(p25*jacobian_11) - s17*s19, 1e-300)
    s25 = s22*s24
    s26 = s23*s24
    s27 = jacobian_8*s6 + jacobian_9*s7 - s16*s20 - s23*s25
    s28 = 1.0*(reciprocal_2 > 0.0)/max(p24 + p22 + jacobian_6*s6 + jacobian_7*s7 - s15*s20 - s22*s25, 1e-300)
    s29 = s27*s28
    s30 = s13*s28
    s31 = s14*s28
    s32 = jacobian_8*s3 - s13*s29
    s33 = jacobian_8*s5 - p22 - s14*s29
    s34 = max(p24 + p22 + jacobian_8*(p23*jacobian_8) + jacobian_9*s8 - s16*s21 - s23*s26 - s27*s29, 1e-300)
    s35 = 1.0*(reciprocal_3 > 0.0)/s34
    s36 = s32*s35
    s37 = s33*s35
    s38 = 1.0/(p20 + jacobian_0*s0)
    s39 = s10*s38
    s40 = s0*s38
    s41 = s11*s38
    s42 = s12*s38
    s43 = s1 - s0*s39
    s44 = jacobian_2*s1 - s11*s39
    s45 = jacobian_4*s1 - p20 - s12*s39
    s46 = 1.0*(reciprocal_5 > 0.0)/max(p20 + jacobian_1*s1 - s10*s39, 1e-300)
    s47 = s43*s46
    s48 = s44*s46
    s49 = s45*s46
    s50 = s2 - s11*s40 - s44*s47
    s51 = s4 - s12*s40 - s45*s47
    s52 = 1.0*(reciprocal_6 > 0.0)/max(p21 - s0*s40 - s43*s47, 1e-300)
    s53 = s50*s52
    s54 = s51*s52
    s55 = p22 + p20 + jacobian_2*s2 + jacobian_3*s3 - s13*s30 - s32*s36 - s11*s41 - s44*s48 - s50*s53
    s56 = jacobian_4*s2 + jacobian_5*s3 - s14*s30 - s33*s36 - s12*s41 - s45*s48 - s51*s53
    s57 = p22 + p20 + jacobian_4*s4 + jacobian_5*s5 - s14*s31 - s33*s37 - s12*s42 - s45*s49 - s51*s54
    s58 = 1.0*(reciprocal_7 > 0.0)/max(s55, 1e-300)
    s59 = s56*s58
    # outputs
    w[150] = s19
    w[151] = s20
    w[152] = s21
    w[153] = s25
    w[154] = s26
    w[155] = s29
    w[156] = s30
    w[157] = s31
    w[158] = s36
    w[159] = s37
    w[160] = s39
    w[161] = s40
    w[162] = s41
    w[163] = s42
    w[164] = s47
    w[165] = s48
    w[166] = s49
    w[167] = s53
    w[168] = s54
    w[169] = s59
    w[170] = s18
    w[171] = s24
    w[172] = s28
    w[173] = s35
    w[174] = s38
    w[175] = s46
    w[176] = s52
    w[177] = s58
    w[178] = 1.0*(reciprocal_8 > 0.0)/max(s57 - s56*s59, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 129 operations, 10073 before sharing."""
    # inputs
    p20 = p[20]  # 1.0/crank_mass
    p21 = p[21]  # 1.0/(0.3333333333333333*crank_mass)
    p22 = p[22]  # 1.0/coupler_mass
    p23 = p[23]  # 1.0/(5.333333333333333*coupler_mass)
    p24 = p[24]  # 1.0/rocker_mass
    p25 = p[25]  # 1.0/(2.083333333333333*rocker_mass)
    jacobian_0 = w[109]  # D A.x, crank.omega
    jacobian_1 = w[110]  # D A.y, crank.omega
    jacobian_2 = w[111]  # D B.x, crank.omega
    jacobian_3 = w[112]  # D B.x, coupler.omega
    jacobian_4 = w[113]  # D B.y, crank.omega
    jacobian_5 = w[114]  # D B.y, coupler.omega
    jacobian_6 = w[115]  # D C.x, coupler.omega
    jacobian_7 = w[116]  # D C.x, rocker.omega
    jacobian_8 = w[117]  # D C.y, coupler.omega
    jacobian_9 = w[118]  # D C.y, rocker.omega
    jacobian_10 = w[119]  # D D.x, rocker.omega
    jacobian_11 = w[120]  # D D.y, rocker.omega
    law_lower_0 = w[150]
    law_lower_1 = w[151]
    law_lower_2 = w[152]
    law_lower_3 = w[153]
    law_lower_4 = w[154]
    law_lower_5 = w[155]
    law_lower_6 = w[156]
    law_lower_7 = w[157]
    law_lower_8 = w[158]
    law_lower_9 = w[159]
    law_lower_10 = w[160]
    law_lower_11 = w[161]
    law_lower_12 = w[162]
    law_lower_13 = w[163]
    law_lower_14 = w[164]
    law_lower_15 = w[165]
    law_lower_16 = w[166]
    law_lower_17 = w[167]
    law_lower_18 = w[168]
    law_lower_19 = w[169]
    law_reciprocal_0 = w[170]
    law_reciprocal_1 = w[171]
    law_reciprocal_2 = w[172]
    law_reciprocal_3 = w[173]
    law_reciprocal_4 = w[174]
    law_reciprocal_5 = w[175]
    law_reciprocal_6 = w[176]
    law_reciprocal_7 = w[177]
    law_reciprocal_8 = w[178]
    residual_0 = w[46]  # A.x
    residual_1 = w[47]  # A.y
    residual_2 = w[48]  # B.x
    residual_3 = w[49]  # B.y
    residual_4 = w[50]  # C.x
    residual_5 = w[51]  # C.y
    residual_6 = w[52]  # D.x
    residual_7 = w[53]  # D.y
    residual_8 = w[54]  # motor.driver
    # intermediate terms
    s0 = law_lower_0*residual_6 - residual_7
    s1 = law_lower_1*residual_6 - residual_4 - law_lower_3*s0
    s2 = law_lower_2*residual_6 - residual_5 - law_lower_4*s0 - law_lower_5*s1
    s3 = law_lower_10*residual_0 - residual_1
    s4 = law_lower_11*residual_0 - residual_8 - law_lower_14*s3
    s5 = law_lower_12*residual_0 - (residual_2 + law_lower_6*s1 + law_lower_8*s2) - law_lower_15*s3 - law_lower_17*s4
    s6 = law_lower_13*residual_0 - (residual_3 + law_lower_7*s1 + law_lower_9*s2) - law_lower_16*s3 - law_lower_18*s4
    s7 = law_reciprocal_8*(s6 - law_lower_19*s5)
    s8 = law_reciprocal_7*s5
    s9 = law_lower_19*s7
    s10 = s8 - s9
    s11 = law_reciprocal_6*s4 - law_lower_17*s10 - law_lower_18*s7
    s12 = law_reciprocal_5*s3 - law_lower_14*s11 - law_lower_15*s10 - law_lower_16*s7
    s13 = law_reciprocal_4*residual_0 + law_lower_10*s12 + law_lower_11*s11 + law_lower_12*s10 + law_lower_13*s7
    s14 = law_reciprocal_3*s2 - law_lower_8*s10
    s15 = law_lower_9*s7
    s16 = s14 - s15
    s17 = law_reciprocal_2*s1 - law_lower_5*s16 - law_lower_6*s10
    s18 = law_lower_7*s7
    s19 = s17 - s18
    s20 = law_reciprocal_1*s0 - law_lower_3*s19 - law_lower_4*s16
    s21 = law_reciprocal_0*residual_6 + law_lower_0*s20 + law_lower_1*s19 + law_lower_2*s16
    # outputs
    w[73] = p20*(s9 - s8 - s13)  # crank.vx
    w[74] = p20*(s12 - s7)  # crank.vy
    w[75] = p21*(s11 + jacobian_1*s12 - jacobian_0*s13 + jacobian_2*s10 + jacobian_4*s7)  # crank.omega
    w[76] = p22*(s10 + s18 - s17)  # coupler.vx
    w[77] = p22*(s7 + s15 - s14)  # coupler.vy
    w[78] = p23*(jacobian_3*s10 + jacobian_5*s7 + jacobian_6*s19 + jacobian_8*s16)  # coupler.omega
    w[79] = p24*(s19 - s21)  # rocker.vx
    w[80] = p24*(s16 + s20)  # rocker.vy
    w[81] = p25*(jacobian_7*s19 + jacobian_9*s16 - jacobian_10*s21 + jacobian_11*s20)  # rocker.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
