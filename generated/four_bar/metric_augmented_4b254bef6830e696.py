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
    p18 = p[18]  # 0.3333333333333333*crank_mass
    p19 = p[19]  # 5.333333333333333*coupler_mass
    p20 = p[20]  # 2.083333333333333*rocker_mass
    p21 = p[21]  # penalty
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
    s0 = p21*(1.0*(1.0 > mask_0))
    s1 = p21*(1.0*(1.0 > mask_1))
    s2 = p21*(1.0*(1.0 > mask_2))
    s3 = p21*(1.0*(1.0 > mask_3))
    s4 = p21*(1.0*(1.0 > mask_4))
    s5 = p21*(1.0*(1.0 > mask_5))
    s6 = p21*(1.0*(1.0 > mask_6))
    s7 = p21*(1.0*(1.0 > mask_7))
    s8 = jacobian_0*s0
    s9 = jacobian_1*s1
    s10 = jacobian_2*s2
    s11 = s8 - s10
    s12 = jacobian_3*s2
    s13 = jacobian_4*s3
    s14 = s9 - s13
    s15 = jacobian_5*s3
    s16 = jacobian_6*s4
    s17 = jacobian_7*s4
    s18 = jacobian_8*s5
    s19 = jacobian_9*s5
    s20 = jacobian_10*s6
    s21 = s17 + s20
    s22 = jacobian_11*s7
    s23 = s19 + s22
    s24 = 1.0/(s2 + p0 + s0)
    s25 = s11*s24
    s26 = s2*s24
    s27 = s12*s24
    s28 = s10 + s2*s25
    s29 = 1.0/(s3 + p0 + s1)
    s30 = s14*s29
    s31 = s3*s29
    s32 = s15*s29
    s33 = s13 + s3*s30
    s34 = jacobian_3*s10 + jacobian_5*s13 + s12*s25 + s15*s30
    s35 = p19 + jacobian_3*s12 + jacobian_5*s15 + jacobian_6*s16 + jacobian_8*s18 - s12*s27 - s15*s32
    s36 = 1.0/(s6 + p2 + s4)
    s37 = s21*s36
    s38 = s4*s36
    s39 = s16*s36
    s40 = s4*s37 - s17
    s41 = 1.0/(s7 + p2 + s5)
    s42 = s23*s41
    s43 = s5*s41
    s44 = s18*s41
    s45 = p20 + jacobian_7*s17 + jacobian_9*s19 + jacobian_10*s20 + jacobian_11*s22 - s21*s37 - s23*s42
    s46 = s5*s42 - s19
    s47 = jacobian_7*s16 + jacobian_9*s18 - s16*s37 - s18*s42
    s48 = 1.0/(p18 + jacobian_0*s8 + jacobian_1*s9 + jacobian_2*s10 + jacobian_4*s13 - s11*s25 - s14*s30)
    s49 = s28*s48
    s50 = s33*s48
    s51 = s34*s48
    s52 = 1.0/s45
    s53 = s40*s52
    s54 = s46*s52
    s55 = s47*s52
    s56 = s33*s49 + s46*s53
    s57 = s12 - s16 - s12*s26 + s16*s38 - s34*s49 - s47*s53
    s58 = 1.0/(s4 + p1 + s2 - s2*s26 - s4*s38 - s28*s49 - s40*s53)
    s59 = s56*s58
    s60 = s57*s58
    s61 = s15 - s18 - s15*s31 + s18*s43 - s34*s50 - s47*s54 + s57*s59
    s62 = 1.0/(s5 + p1 + s3 - s3*s31 - s5*s43 - s33*s50 - s46*s54 - s56*s59)
    s63 = s61*s62
    # outputs
    w[440] = s25
    w[441] = -s26
    w[442] = -s27
    w[443] = s30
    w[444] = -s31
    w[445] = -s32
    w[446] = s37
    w[447] = -s38
    w[448] = s39
    w[449] = s42
    w[450] = -s43
    w[451] = s44
    w[452] = s49
    w[453] = s50
    w[454] = s51
    w[455] = s53
    w[456] = s54
    w[457] = s55
    w[458] = -s59
    w[459] = s60
    w[460] = s63
    w[461] = s24
    w[462] = s29
    w[463] = s36
    w[464] = s41
    w[465] = s48
    w[466] = s52
    w[467] = s58
    w[468] = s62
    w[469] = 1.0/(s35 - s16*s39 - s18*s44 - s34*s51 - s47*s55 - s57*s60 - s61*s63)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 191 operations, 98013 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p18 = p[18]  # 0.3333333333333333*crank_mass
    p19 = p[19]  # 5.333333333333333*coupler_mass
    p20 = p[20]  # 2.083333333333333*rocker_mass
    p21 = p[21]  # penalty
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
    moved_0 = w[470]
    moved_1 = w[471]
    moved_2 = w[472]
    moved_3 = w[473]
    moved_4 = w[474]
    moved_5 = w[475]
    moved_6 = w[476]
    moved_7 = w[477]
    moved_8 = w[478]
    force_of_constraints_0 = w[479]
    force_of_constraints_1 = w[480]
    force_of_constraints_2 = w[481]
    force_of_constraints_3 = w[482]
    force_of_constraints_4 = w[483]
    force_of_constraints_5 = w[484]
    force_of_constraints_6 = w[485]
    force_of_constraints_7 = w[486]
    law_lower_0 = w[440]
    law_lower_1 = w[441]
    law_lower_2 = w[442]
    law_lower_3 = w[443]
    law_lower_4 = w[444]
    law_lower_5 = w[445]
    law_lower_6 = w[446]
    law_lower_7 = w[447]
    law_lower_8 = w[448]
    law_lower_9 = w[449]
    law_lower_10 = w[450]
    law_lower_11 = w[451]
    law_lower_12 = w[452]
    law_lower_13 = w[453]
    law_lower_14 = w[454]
    law_lower_15 = w[455]
    law_lower_16 = w[456]
    law_lower_17 = w[457]
    law_lower_18 = w[458]
    law_lower_19 = w[459]
    law_lower_20 = w[460]
    law_reciprocal_0 = w[461]
    law_reciprocal_1 = w[462]
    law_reciprocal_2 = w[463]
    law_reciprocal_3 = w[464]
    law_reciprocal_4 = w[465]
    law_reciprocal_5 = w[466]
    law_reciprocal_6 = w[467]
    law_reciprocal_7 = w[468]
    law_reciprocal_8 = w[469]
    # intermediate terms
    s0 = p21*(1.0*(1.0 > mask_0))*residual_0
    s1 = p21*(1.0*(1.0 > mask_1))*residual_1
    s2 = p21*(1.0*(1.0 > mask_2))*residual_2
    s3 = p21*(1.0*(1.0 > mask_3))*residual_3
    s4 = p21*(1.0*(1.0 > mask_4))*residual_4
    s5 = p21*(1.0*(1.0 > mask_5))*residual_5
    s6 = p21*(1.0*(1.0 > mask_6))*residual_6
    s7 = p21*(1.0*(1.0 > mask_7))*residual_7
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
    s28 = s24*law_lower_0 - (p18*moved_2 + jacobian_0*s16 + jacobian_1*s17 + jacobian_2*s18 + jacobian_4*s19)
    s29 = s24*law_lower_2 - (p19*moved_5 + jacobian_3*s18 + jacobian_5*s19 + jacobian_6*s20 + jacobian_8*s21)
    s30 = s28 + s25*law_lower_3
    s31 = s26*law_lower_6 - (p20*moved_8 + jacobian_7*s20 + jacobian_9*s21 + jacobian_10*s22 + jacobian_11*s23)
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
    w[470] = moved_0 - s45
    w[471] = moved_1 - s44
    w[472] = moved_2 + s41
    w[473] = moved_3 + s39
    w[474] = moved_4 + s38
    w[475] = moved_5 + s37
    w[476] = moved_6 - s43
    w[477] = moved_7 - s42
    w[478] = moved_8 + s40
    w[479] = s8
    w[480] = s9
    w[481] = s10
    w[482] = s11
    w[483] = s12
    w[484] = s13
    w[485] = s14
    w[486] = s15
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
