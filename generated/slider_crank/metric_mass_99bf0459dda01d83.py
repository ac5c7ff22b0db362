"""Corrections in another metric, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates a360905d90dcc4fd
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D G D^T that decide rank, and the factorisation of D M^-1 D^T: 244 operations, 12747 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # rod.x [m]
    q4 = y[4]  # rod.y [m]
    q5 = y[5]  # rod.theta [rad]
    q6 = y[6]  # slider.x [m]
    q7 = y[7]  # slider.y [m]
    q8 = y[8]  # slider.theta [rad]
    mask_1 = w[28]
    mask_2 = w[29]
    mask_3 = w[30]
    mask_5 = w[32]
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    gauge_2 = w[87]
    gauge_5 = w[90]
    gauge_8 = w[93]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    status_6 = w[6]
    row_weight_7 = w[101]
    # intermediate terms
    s0 = 0.075*math.cos(q2)
    s1 = -s0
    s2 = q0 - s0
    s3 = 0.075*math.sin(q2)
    s4 = q1 - s3
    s5 = 0.225*math.cos(q5)
    s6 = -s5
    s7 = q3 - q0 - s5 - s0
    s8 = 0.225*math.sin(q5)
    s9 = q4 - q1 - s8 - s3
    s10 = q6 - q3 - s5
    s11 = q7 - q4 - s8
    s12 = s3*p17
    s13 = s0*p17
    s14 = s8*p19
    s15 = s5*p19
    s16 = s3*s12
    s17 = p16 + s16
    s18 = s0*s12
    s19 = s16 - p16
    s20 = s0*s13
    s21 = p16 + s20
    s22 = s8*s14
    s23 = s5*s14
    s24 = s22 - p18
    s25 = s5*s15
    s26 = s8*s15
    s27 = s3*gauge_2
    s28 = s0*gauge_2
    s29 = s8*gauge_5
    s30 = s5*gauge_5
    s31 = s3*s27
    s32 = 1.0 + s31
    s33 = s0*s27
    s34 = -1.0 + s31
    s35 = s0*s28
    s36 = 1.0 + s35
    s37 = s8*s29
    s38 = 1.0 + s32 + s37
    s39 = s5*s29
    s40 = -1.0 + s37
    s41 = s5*s30
    s42 = 1.0 + s36 + s41
    s43 = s8*s30
    s44 = 1.0 + 1.0 + s41
    s45 = 1.0/s32
    s46 = s33*s45
    s47 = s34*s45
    s48 = s33*s46
    s49 = s36 - s48
    s50 = s34*s46 - s3*s28
    s51 = -1.0 + s35 - s48
    s52 = 1.0*(s49 > mask_1 + 1e-12*s36)
    s53 = s52/max(s49, 1e-300)
    s54 = s50*s53
    s55 = 1.0/(1.0 + 1.0 + s37)
    s56 = s39*s55
    s57 = s40*s55
    s58 = s44 - 1.0 - s39*s56
    s59 = s40*s56 - s39
    s60 = -1.0 + s41 - s43*s56
    s61 = 1.0*(s58 > mask_5 + 1e-12*s44)
    s62 = s61/max(s58, 1e-300)
    s63 = s59*s62
    s64 = s38 - s34*s47 - s50*s54 - s40*s57 - s59*s63
    s65 = s33*s47 - (s33 + s39) - s51*s54 + s43*s57 - s60*s63
    s66 = 1.0*(s64 > mask_2 + 1e-12*s38)
    s67 = s42 - s48 - s51*(s51*s53) - s43*(s43*s55) - s60*(s60*s62) - s65*(s65*(s66/max(s64, 1e-300)))
    s68 = 1.0*(s67 > mask_3 + 1e-12*s42)
    s69 = 1.0/s17
    s70 = s18*s69
    s71 = -s70
    s72 = s19*s69
    s73 = s18*s70
    s74 = s19*s70 - s3*s13
    s75 = s20 - p16 - s73
    s76 = s52/max(s21 - s73, 1e-300)
    s77 = s74*s76
    s78 = s75*s76
    s79 = 1.0/(p20 + p18 + s22)
    s80 = s23*s79
    s81 = s24*s79
    s82 = s26*s79
    s83 = s24*s80 - s23
    s84 = s25 - p18 - s26*s80
    s85 = s61/max(p20 + p18 + s25 - p28 - s23*s80, 1e-300)
    s86 = s83*s85
    s87 = s84*s85
    s88 = s18*s72 - (s18 + s23) - s75*s77 + s26*s81 - s84*s86
    s89 = s66/max(p18 + s17 + s22 - s19*s72 - s74*s77 - s24*s81 - s83*s86, 1e-300)
    s90 = s88*s89
    s91 = q8*status_6
    s92 = s2*s2 + s4*s4 + s7*s7 + s9*s9 + s10*s10 + s11*s11 + q7*q7
    s93 = s49/s36
    s94 = s64/s38
    s95 = s67/s42
    s96 = s58/s44
    # outputs
    w[43] = s2
    w[44] = s4
    w[45] = s7
    w[46] = s9
    w[47] = s10
    w[48] = s11
    w[49] = q7
    w[50] = q8
    w[0] = math.sqrt(s92 + q8*q8)
    w[8] = math.sqrt(s92 + s91*s91)
    w[102] = s3
    w[103] = s1
    w[104] = s3
    w[105] = s8
    w[106] = s1
    w[107] = s6
    w[108] = s8
    w[109] = s6
    w[60] = s93
    w[61] = s94
    w[62] = s95
    w[64] = s96
    w[5] = 1.0 + 1.0 + s61 + 1.0 + s68 + s66 + 1.0 + s52
    w[4] = min(min(min(min(1.0, mask_1 + s93), mask_2 + s94), mask_3 + s95), mask_5 + s96)
    w[10] = min(1.0, gauge_8*row_weight_7)
    w[128] = p27
    w[129] = s71
    w[130] = s72
    w[131] = s71
    w[132] = s77
    w[133] = s78
    w[134] = -s80
    w[135] = s81
    w[136] = -s82
    w[137] = s86
    w[138] = s87
    w[139] = s90
    w[140] = p26
    w[141] = s69
    w[142] = s76
    w[143] = s79
    w[144] = s85
    w[145] = s89
    w[146] = s68/max(p18 + s21 + s25 - s73 - s75*s78 - s26*s82 - s84*s87 - s88*s90, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 86 operations, 1738 before sharing."""
    # inputs
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    law_lower_0 = w[128]
    law_lower_1 = w[129]
    law_lower_2 = w[130]
    law_lower_3 = w[131]
    law_lower_4 = w[132]
    law_lower_5 = w[133]
    law_lower_6 = w[134]
    law_lower_7 = w[135]
    law_lower_8 = w[136]
    law_lower_9 = w[137]
    law_lower_10 = w[138]
    law_lower_11 = w[139]
    law_reciprocal_0 = w[140]
    law_reciprocal_1 = w[141]
    law_reciprocal_2 = w[142]
    law_reciprocal_3 = w[143]
    law_reciprocal_4 = w[144]
    law_reciprocal_5 = w[145]
    law_reciprocal_6 = w[146]
    residual_0 = w[43]
    residual_1 = w[44]
    residual_2 = w[45]
    residual_3 = w[46]
    residual_4 = w[47]
    residual_5 = w[48]
    residual_6 = w[49]
    residual_7 = w[50]
    jacobian_0 = w[102]
    jacobian_1 = w[103]
    jacobian_2 = w[104]
    jacobian_3 = w[105]
    jacobian_4 = w[106]
    jacobian_5 = w[107]
    jacobian_6 = w[108]
    jacobian_7 = w[109]
    # intermediate terms
    s0 = law_lower_1*residual_0 - residual_1
    s1 = law_lower_0*residual_6 - residual_5 + law_lower_6*residual_4
    s2 = law_lower_2*residual_0 - residual_2 - law_lower_4*s0 + law_lower_7*residual_4 - law_lower_9*s1
    s3 = law_lower_3*residual_0 - residual_3 - law_lower_5*s0 + law_lower_8*residual_4 - law_lower_10*s1
    s4 = law_reciprocal_6*(s3 - law_lower_11*s2)
    s5 = law_reciprocal_5*s2
    s6 = law_lower_11*s4
    s7 = s5 - s6
    s8 = law_reciprocal_4*s1 - law_lower_9*s7
    s9 = law_lower_10*s4
    s10 = s8 - s9
    s11 = law_reciprocal_3*residual_4 + law_lower_6*s10 + law_lower_7*s7 + law_lower_8*s4
    s12 = law_reciprocal_2*s0 - law_lower_4*s7 - law_lower_5*s4
    s13 = law_reciprocal_1*residual_0 + law_lower_1*s12 + law_lower_2*s7 + law_lower_3*s4
    # outputs
    w[67] = p16*(s6 - s5 - s13)
    w[68] = p16*(s12 - s4)
    w[69] = p17*(s12*jacobian_1 - s13*jacobian_0 + s7*jacobian_2 + s4*jacobian_4)
    w[70] = p18*(s7 + s11)
    w[71] = p18*(s4 + s9 - s8)
    w[72] = p19*(s7*jacobian_3 + s4*jacobian_5 - s11*jacobian_6 + s10*jacobian_7)
    w[73] = -p20*s11
    w[74] = p20*(s10 - (law_reciprocal_0*residual_6 + law_lower_0*s10))
    w[75] = -residual_7
    return 0
