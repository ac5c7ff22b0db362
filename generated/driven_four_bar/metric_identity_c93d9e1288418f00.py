"""Corrections in another metric, for model `driven-four-bar`. Emitted by symgen; do not edit.

digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D D^T from D, without the rows that depend on others: 173 operations, 6103 before sharing."""
    # inputs
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
    s0 = jacobian_0*jacobian_1
    s1 = -1.0 + jacobian_0*jacobian_2
    s2 = jacobian_0*jacobian_4
    s3 = -1.0 + jacobian_3*jacobian_6
    s4 = jacobian_5*jacobian_6
    s5 = 1.0 + jacobian_7*jacobian_10
    s6 = jacobian_9*jacobian_10
    s7 = jacobian_10*jacobian_11
    s8 = 1.0/(1.0 + jacobian_10*jacobian_10)
    s9 = s7*s8
    s10 = s5*s8
    s11 = s6*s8
    s12 = jacobian_7*jacobian_11 - s5*s9
    s13 = 1.0 + jacobian_9*jacobian_11 - s6*s9
    s14 = 1.0*(reciprocal_1 > 0.0)/max(1.0 + jacobian_11*jacobian_11 - s7*s9, 1e-300)
    s15 = s12*s14
    s16 = s13*s14
    s17 = jacobian_6*jacobian_8 + jacobian_7*jacobian_9 - s6*s10 - s13*s15
    s18 = 1.0*(reciprocal_2 > 0.0)/max(1.0 + 1.0 + jacobian_6*jacobian_6 + jacobian_7*jacobian_7 - s5*s10 - s12*s15, 1e-300)
    s19 = s17*s18
    s20 = s3*s18
    s21 = s4*s18
    s22 = jacobian_3*jacobian_8 - s3*s19
    s23 = -1.0 + jacobian_5*jacobian_8 - s4*s19
    s24 = max(1.0 + 1.0 + jacobian_8*jacobian_8 + jacobian_9*jacobian_9 - s6*s11 - s13*s16 - s17*s19, 1e-300)
    s25 = 1.0*(reciprocal_3 > 0.0)/s24
    s26 = s22*s25
    s27 = s23*s25
    s28 = 1.0/(1.0 + jacobian_0*jacobian_0)
    s29 = s0*s28
    s30 = jacobian_0*s28
    s31 = s1*s28
    s32 = s2*s28
    s33 = jacobian_1 - jacobian_0*s29
    s34 = jacobian_1*jacobian_2 - s1*s29
    s35 = -1.0 + jacobian_1*jacobian_4 - s2*s29
    s36 = 1.0*(reciprocal_5 > 0.0)/max(1.0 + jacobian_1*jacobian_1 - s0*s29, 1e-300)
    s37 = s33*s36
    s38 = s34*s36
    s39 = s35*s36
    s40 = jacobian_2 - s1*s30 - s34*s37
    s41 = jacobian_4 - s2*s30 - s35*s37
    s42 = 1.0 + 1.0 + jacobian_2*jacobian_2 + jacobian_3*jacobian_3 - s3*s20 - s22*s26 - s1*s31 - s34*s38
    s43 = 1.0 + 1.0 + jacobian_4*jacobian_4 + jacobian_5*jacobian_5 - s4*s21 - s23*s27 - s2*s32 - s35*s39
    s44 = 1.0*(reciprocal_6 > 0.0)/max(1.0 - jacobian_0*s30 - s33*s37, 1e-300)
    s45 = s40*s44
    s46 = s41*s44
    s47 = jacobian_2*jacobian_4 + jacobian_3*jacobian_5 - s4*s20 - s23*s26 - s2*s31 - s35*s38 - s41*s45
    s48 = 1.0*(reciprocal_7 > 0.0)/max(s42 - s40*s45, 1e-300)
    s49 = s47*s48
    # outputs
    w[150] = s9
    w[151] = s10
    w[152] = s11
    w[153] = s15
    w[154] = s16
    w[155] = s19
    w[156] = s20
    w[157] = s21
    w[158] = s26
    w[159] = s27
    w[160] = s29
    w[161] = s30
    w[162] = s31
    w[163] = s32
    w[164] = s37
    w[165] = s38
    w[166] = s39
    w[167] = s45
    w[168] = s46
    w[169] = s49
    w[170] = s8
    w[171] = s14
    w[172] = s18
    w[173] = s25
    w[174] = s28
    w[175] = s36
    w[176] = s44
    w[177] = s48
    w[178] = 1.0*(reciprocal_8 > 0.0)/max(s43 - s41*s46 - s47*s49, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 120 operations, 10064 before sharing."""
    # inputs
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
    w[73] = s9 - s8 - s13  # crank.vx
    w[74] = s12 - s7  # crank.vy
    w[75] = s11 + jacobian_1*s12 - jacobian_0*s13 + jacobian_2*s10 + jacobian_4*s7  # crank.omega
    w[76] = s10 + s18 - s17  # coupler.vx
    w[77] = s7 + s15 - s14  # coupler.vy
    w[78] = jacobian_3*s10 + jacobian_5*s7 + jacobian_6*s19 + jacobian_8*s16  # coupler.omega
    w[79] = s19 - s21  # rocker.vx
    w[80] = s16 + s20  # rocker.vy
    w[81] = jacobian_7*s19 + jacobian_9*s16 - jacobian_10*s21 + jacobian_11*s20  # rocker.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
