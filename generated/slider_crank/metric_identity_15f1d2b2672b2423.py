"""Corrections in another metric, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates a360905d90dcc4fd
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D G D^T that decide rank, and the factorisation of D D^T: 234 operations, 12469 before sharing."""
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
    gauge_2 = w[87]
    gauge_5 = w[90]
    gauge_8 = w[93]
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
    s12 = s3*gauge_2
    s13 = s0*gauge_2
    s14 = s8*gauge_5
    s15 = s5*gauge_5
    s16 = s3*s12
    s17 = 1.0 + s16
    s18 = s0*s12
    s19 = -1.0 + s16
    s20 = s0*s13
    s21 = 1.0 + s20
    s22 = s8*s14
    s23 = 1.0 + s17 + s22
    s24 = s5*s14
    s25 = -1.0 + s22
    s26 = s5*s15
    s27 = 1.0 + s21 + s26
    s28 = s8*s15
    s29 = 1.0 + 1.0 + s26
    s30 = 1.0/s17
    s31 = s18*s30
    s32 = s19*s30
    s33 = s18*s31
    s34 = s21 - s33
    s35 = s19*s31 - s3*s13
    s36 = -1.0 + s20 - s33
    s37 = 1.0*(s34 > mask_1 + 1e-12*s21)
    s38 = s37/max(s34, 1e-300)
    s39 = s35*s38
    s40 = 1.0/(1.0 + 1.0 + s22)
    s41 = s24*s40
    s42 = s25*s40
    s43 = s29 - 1.0 - s24*s41
    s44 = s25*s41 - s24
    s45 = -1.0 + s26 - s28*s41
    s46 = 1.0*(s43 > mask_5 + 1e-12*s29)
    s47 = s46/max(s43, 1e-300)
    s48 = s44*s47
    s49 = s23 - s19*s32 - s35*s39 - s25*s42 - s44*s48
    s50 = s18*s32 - (s18 + s24) - s36*s39 + s28*s42 - s45*s48
    s51 = 1.0*(s49 > mask_2 + 1e-12*s23)
    s52 = s27 - s33 - s36*(s36*s38) - s28*(s28*s40) - s45*(s45*s47) - s50*(s50*(s51/max(s49, 1e-300)))
    s53 = 1.0*(s52 > mask_3 + 1e-12*s27)
    s54 = s3*s3
    s55 = 1.0 + s54
    s56 = s0*s3
    s57 = -1.0 + s54
    s58 = s0*s0
    s59 = 1.0 + s58
    s60 = s8*s8
    s61 = s5*s8
    s62 = -1.0 + s60
    s63 = s5*s5
    s64 = 1.0/s55
    s65 = s56*s64
    s66 = -s65
    s67 = s57*s64
    s68 = s56*s65
    s69 = s57*s65 - s56
    s70 = -1.0 + s58 - s68
    s71 = s37/max(s59 - s68, 1e-300)
    s72 = s69*s71
    s73 = s70*s71
    s74 = 1.0/(1.0 + 1.0 + s60)
    s75 = s61*s74
    s76 = -s75
    s77 = s62*s74
    s78 = s61*s75
    s79 = s62*s75 - s61
    s80 = -1.0 + s63 - s78
    s81 = s46/max(1.0 + 1.0 + s63 - 1.0 - s78, 1e-300)
    s82 = s79*s81
    s83 = s80*s81
    s84 = s56*s67 - (s56 + s61) - s70*s72 + s61*s77 - s80*s82
    s85 = s51/max(1.0 + s55 + s60 - s57*s67 - s69*s72 - s62*s77 - s79*s82, 1e-300)
    s86 = s84*s85
    s87 = q8*status_6
    s88 = s2*s2 + s4*s4 + s7*s7 + s9*s9 + s10*s10 + s11*s11 + q7*q7
    s89 = s34/s21
    s90 = s49/s23
    s91 = s52/s27
    s92 = s43/s29
    # outputs
    w[43] = s2
    w[44] = s4
    w[45] = s7
    w[46] = s9
    w[47] = s10
    w[48] = s11
    w[49] = q7
    w[50] = q8
    w[0] = math.sqrt(s88 + q8*q8)
    w[8] = math.sqrt(s88 + s87*s87)
    w[102] = s3
    w[103] = s1
    w[104] = s3
    w[105] = s8
    w[106] = s1
    w[107] = s6
    w[108] = s8
    w[109] = s6
    w[60] = s89
    w[61] = s90
    w[62] = s91
    w[64] = s92
    w[5] = 1.0 + 1.0 + s46 + 1.0 + s53 + s51 + 1.0 + s37
    w[4] = min(min(min(min(1.0, mask_1 + s89), mask_2 + s90), mask_3 + s91), mask_5 + s92)
    w[10] = min(1.0, gauge_8*row_weight_7)
    w[128] = s66
    w[129] = s67
    w[130] = s66
    w[131] = s72
    w[132] = s73
    w[133] = s76
    w[134] = s77
    w[135] = s76
    w[136] = s82
    w[137] = s83
    w[138] = s86
    w[139] = s64
    w[140] = s71
    w[141] = s74
    w[142] = s81
    w[143] = s85
    w[144] = s53/max(1.0 + s59 + s63 - s68 - s70*s73 - s78 - s80*s83 - s84*s86, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 75 operations, 1621 before sharing."""
    # inputs
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
    law_reciprocal_0 = w[139]
    law_reciprocal_1 = w[140]
    law_reciprocal_2 = w[141]
    law_reciprocal_3 = w[142]
    law_reciprocal_4 = w[143]
    law_reciprocal_5 = w[144]
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
    s0 = law_lower_0*residual_0 - residual_1
    s1 = residual_6 - residual_5 + law_lower_5*residual_4
    s2 = law_lower_1*residual_0 - residual_2 - law_lower_3*s0 + law_lower_6*residual_4 - law_lower_8*s1
    s3 = law_lower_2*residual_0 - residual_3 - law_lower_4*s0 + law_lower_7*residual_4 - law_lower_9*s1
    s4 = law_reciprocal_5*(s3 - law_lower_10*s2)
    s5 = law_reciprocal_4*s2
    s6 = law_lower_10*s4
    s7 = s5 - s6
    s8 = law_reciprocal_3*s1 - law_lower_8*s7
    s9 = law_lower_9*s4
    s10 = s8 - s9
    s11 = law_reciprocal_2*residual_4 + law_lower_5*s10 + law_lower_6*s7 + law_lower_7*s4
    s12 = law_reciprocal_1*s0 - law_lower_3*s7 - law_lower_4*s4
    s13 = law_reciprocal_0*residual_0 + law_lower_0*s12 + law_lower_1*s7 + law_lower_2*s4
    # outputs
    w[67] = s6 - s5 - s13
    w[68] = s12 - s4
    w[69] = s12*jacobian_1 - s13*jacobian_0 + s7*jacobian_2 + s4*jacobian_4
    w[70] = s7 + s11
    w[71] = s4 + s9 - s8
    w[72] = s7*jacobian_3 + s4*jacobian_5 - s11*jacobian_6 + s10*jacobian_7
    w[73] = -s11
    w[74] = s10 - (residual_6 + s10)
    w[75] = -residual_7
    return 0
