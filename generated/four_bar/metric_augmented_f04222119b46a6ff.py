"""Corrections in another metric, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of M + a D^T D from D, without the rows that depend on others: 192 operations, 10063 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]  # 0.3333333333333333*crank_mass
    p17 = p[17]  # 5.333333333333333*coupler_mass
    p19 = p[19]  # 2.083333333333333*rocker_mass
    p24 = p[24]  # penalty
    mask_0 = w[27]  # A.x
    mask_1 = w[28]  # A.y
    mask_2 = w[29]  # B.x
    mask_3 = w[30]  # B.y
    mask_4 = w[31]  # C.x
    mask_5 = w[32]  # C.y
    mask_6 = w[33]  # D.x
    mask_7 = w[34]  # D.y
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
    s0 = p24*(1.0*(1.0 > mask_0))
    s1 = p24*(1.0*(1.0 > mask_1))
    s2 = p24*(1.0*(1.0 > mask_2))
    s3 = p24*(1.0*(1.0 > mask_3))
    s4 = p24*(1.0*(1.0 > mask_4))
    s5 = p24*(1.0*(1.0 > mask_5))
    s6 = p24*(1.0*(1.0 > mask_6))
    s7 = p24*(1.0*(1.0 > mask_7))
    s8 = 1.0/(s2 + p0 + s0)
    s9 = s2*s8
    s10 = 1.0/(s3 + p0 + s1)
    s11 = s3*s10
    s12 = 1.0/(s6 + p2 + s4)
    s13 = s4*s12
    s14 = 1.0/(s7 + p2 + s5)
    s15 = s5*s14
    s16 = s0*jacobian_0
    s17 = s1*jacobian_1
    s18 = s2*jacobian_2
    s19 = s16 - s18
    s20 = s2*jacobian_3
    s21 = s3*jacobian_4
    s22 = s17 - s21
    s23 = s3*jacobian_5
    s24 = s4*jacobian_6
    s25 = s4*jacobian_7
    s26 = s5*jacobian_8
    s27 = s5*jacobian_9
    s28 = s6*jacobian_10
    s29 = s25 + s28
    s30 = s7*jacobian_11
    s31 = s27 + s30
    s32 = s8*s19
    s33 = s8*s20
    s34 = s18 + s2*s32
    s35 = s10*s22
    s36 = s10*s23
    s37 = p15 + jacobian_0*s16 + jacobian_1*s17 + jacobian_2*s18 + jacobian_4*s21 - s19*s32 - s22*s35
    s38 = s21 + s3*s35
    s39 = jacobian_3*s18 + jacobian_5*s21 + s20*s32 + s23*s35
    s40 = p17 + jacobian_3*s20 + jacobian_5*s23 + jacobian_6*s24 + jacobian_8*s26 - s20*s33 - s23*s36
    s41 = s12*s29
    s42 = s12*s24
    s43 = s4*s41 - s25
    s44 = s14*s31
    s45 = s14*s26
    s46 = p19 + jacobian_7*s25 + jacobian_9*s27 + jacobian_10*s28 + jacobian_11*s30 - s29*s41 - s31*s44
    s47 = s5*s44 - s27
    s48 = jacobian_7*s24 + jacobian_9*s26 - s24*s41 - s26*s44
    s49 = 1.0/s37
    s50 = s34*s49
    s51 = s38*s49
    s52 = s39*s49
    s53 = 1.0/s46
    s54 = s43*s53
    s55 = s47*s53
    s56 = s48*s53
    s57 = s38*s50 + s47*s54
    s58 = s20 - s24 - s9*s20 + s13*s24 - s39*s50 - s48*s54
    s59 = 1.0/(s4 + p1 + s2 - s2*s9 - s4*s13 - s34*s50 - s43*s54)
    s60 = s57*s59
    s61 = s58*s59
    s62 = s23 - s26 - s11*s23 + s15*s26 - s39*s51 - s48*s55 + s58*s60
    s63 = 1.0/(s5 + p1 + s3 - s3*s11 - s5*s15 - s38*s51 - s47*s55 - s57*s60)
    s64 = s62*s63
    # outputs
    w[208] = s32
    w[209] = -s9
    w[210] = -s33
    w[211] = s35
    w[212] = -s11
    w[213] = -s36
    w[214] = s41
    w[215] = -s13
    w[216] = s42
    w[217] = s44
    w[218] = -s15
    w[219] = s45
    w[220] = s50
    w[221] = s51
    w[222] = s52
    w[223] = s54
    w[224] = s55
    w[225] = s56
    w[226] = -s60
    w[227] = s61
    w[228] = s64
    w[229] = s8
    w[230] = s10
    w[231] = s12
    w[232] = s14
    w[233] = s49
    w[234] = s53
    w[235] = s59
    w[236] = s63
    w[237] = 1.0/(s40 - s24*s42 - s26*s45 - s39*s52 - s48*s56 - s58*s61 - s62*s64)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 191 operations, 98013 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]  # 0.3333333333333333*crank_mass
    p17 = p[17]  # 5.333333333333333*coupler_mass
    p19 = p[19]  # 2.083333333333333*rocker_mass
    p24 = p[24]  # penalty
    mask_0 = w[27]  # A.x
    mask_1 = w[28]  # A.y
    mask_2 = w[29]  # B.x
    mask_3 = w[30]  # B.y
    mask_4 = w[31]  # C.x
    mask_5 = w[32]  # C.y
    mask_6 = w[33]  # D.x
    mask_7 = w[34]  # D.y
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
    residual_0 = w[43]  # A.x
    residual_1 = w[44]  # A.y
    residual_2 = w[45]  # B.x
    residual_3 = w[46]  # B.y
    residual_4 = w[47]  # C.x
    residual_5 = w[48]  # C.y
    residual_6 = w[49]  # D.x
    residual_7 = w[50]  # D.y
    moved_0 = w[238]
    moved_1 = w[239]
    moved_2 = w[240]
    moved_3 = w[241]
    moved_4 = w[242]
    moved_5 = w[243]
    moved_6 = w[244]
    moved_7 = w[245]
    moved_8 = w[246]
    force_of_constraints_0 = w[247]
    force_of_constraints_1 = w[248]
    force_of_constraints_2 = w[249]
    force_of_constraints_3 = w[250]
    force_of_constraints_4 = w[251]
    force_of_constraints_5 = w[252]
    force_of_constraints_6 = w[253]
    force_of_constraints_7 = w[254]
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
    law_lower_16 = w[224]
    law_lower_17 = w[225]
    law_lower_18 = w[226]
    law_lower_19 = w[227]
    law_lower_20 = w[228]
    law_reciprocal_0 = w[229]
    law_reciprocal_1 = w[230]
    law_reciprocal_2 = w[231]
    law_reciprocal_3 = w[232]
    law_reciprocal_4 = w[233]
    law_reciprocal_5 = w[234]
    law_reciprocal_6 = w[235]
    law_reciprocal_7 = w[236]
    law_reciprocal_8 = w[237]
    # intermediate terms
    s0 = p24*(1.0*(1.0 > mask_0))*residual_0
    s1 = p24*(1.0*(1.0 > mask_1))*residual_1
    s2 = p24*(1.0*(1.0 > mask_2))*residual_2
    s3 = p24*(1.0*(1.0 > mask_3))*residual_3
    s4 = p24*(1.0*(1.0 > mask_4))*residual_4
    s5 = p24*(1.0*(1.0 > mask_5))*residual_5
    s6 = p24*(1.0*(1.0 > mask_6))*residual_6
    s7 = p24*(1.0*(1.0 > mask_7))*residual_7
    s8 = force_of_constraints_0 + s0
    s9 = force_of_constraints_1 + s1
    s10 = force_of_constraints_2 + s2
    s11 = force_of_constraints_3 + s3
    s12 = force_of_constraints_4 + s4
    s13 = force_of_constraints_5 + s5
    s14 = force_of_constraints_6 + s6
    s15 = force_of_constraints_7 + s7
    s16 = s0 + s8
    s17 = s1 + s9
    s18 = s2 + s10
    s19 = s3 + s11
    s20 = s4 + s12
    s21 = s5 + s13
    s22 = s6 + s14
    s23 = s7 + s15
    s24 = p0*moved_0 + s16 - s18
    s25 = p0*moved_1 + s17 - s19
    s26 = p2*moved_6 + s20 + s22
    s27 = p2*moved_7 + s21 + s23
    s28 = s24*law_lower_0 - (p15*moved_2 + jacobian_0*s16 + jacobian_1*s17 + jacobian_2*s18 + jacobian_4*s19)
    s29 = s24*law_lower_2 - (p17*moved_5 + jacobian_3*s18 + jacobian_5*s19 + jacobian_6*s20 + jacobian_8*s21)
    s30 = s28 + s25*law_lower_3
    s31 = s26*law_lower_6 - (p19*moved_8 + jacobian_7*s20 + jacobian_9*s21 + jacobian_10*s22 + jacobian_11*s23)
    s32 = s31 + s27*law_lower_9
    s33 = s24*law_lower_1 - (p1*moved_3 + s18 - s20) + s26*law_lower_7 - law_lower_12*s30 - law_lower_15*s32
    s34 = s25*law_lower_4 - (p1*moved_4 + s19 - s21) + s27*law_lower_10 - law_lower_13*s30 - law_lower_16*s32
    s35 = s29 + s25*law_lower_5 + s26*law_lower_8 + s27*law_lower_11 - law_lower_14*s30 - law_lower_17*s32
    s36 = s34 - law_lower_18*s33
    s37 = law_reciprocal_8*(s35 - law_lower_19*s33 - law_lower_20*s36)
    s38 = law_reciprocal_7*s36 - law_lower_20*s37
    s39 = law_reciprocal_6*s33 - law_lower_18*s38 - law_lower_19*s37
    s40 = law_reciprocal_5*s32 - law_lower_15*s39 - law_lower_16*s38 - law_lower_17*s37
    s41 = law_reciprocal_4*s30 - law_lower_12*s39 - law_lower_13*s38 - law_lower_14*s37
    s42 = s27*law_reciprocal_3 + law_lower_9*s40 + law_lower_10*s38 + law_lower_11*s37
    s43 = s26*law_reciprocal_2 + law_lower_6*s40 + law_lower_7*s39 + law_lower_8*s37
    s44 = s25*law_reciprocal_1 + law_lower_3*s41 + law_lower_4*s38 + law_lower_5*s37
    s45 = s24*law_reciprocal_0 + law_lower_0*s41 + law_lower_1*s39 + law_lower_2*s37
    # outputs
    w[67] = -s45  # crank.vx
    w[68] = -s44  # crank.vy
    w[69] = s41  # crank.omega
    w[70] = s39  # coupler.vx
    w[71] = s38  # coupler.vy
    w[72] = s37  # coupler.omega
    w[73] = -s43  # rocker.vx
    w[74] = -s42  # rocker.vy
    w[75] = s40  # rocker.omega
    w[238] = moved_0 - s45
    w[239] = moved_1 - s44
    w[240] = moved_2 + s41
    w[241] = moved_3 + s39
    w[242] = moved_4 + s38
    w[243] = moved_5 + s37
    w[244] = moved_6 - s43
    w[245] = moved_7 - s42
    w[246] = moved_8 + s40
    w[247] = s8
    w[248] = s9
    w[249] = s10
    w[250] = s11
    w[251] = s12
    w[252] = s13
    w[253] = s14
    w[254] = s15
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
