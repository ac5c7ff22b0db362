"""Method `velocity-projection` for model `four-bar`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = mass
"""

import math

from numba import njit

from .model import measure

MASK = 23  # sections of w
SAVED = 31
PIVOT = 55
CHANGE = 63


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 17 operations, 32 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    s3 = 1.0/p0
    s4 = 1.0/p1
    s5 = 1.0/p2
    s6 = s0*s3
    s7 = s1*s4
    s8 = s2*s5
    # outputs
    p[15] = s0
    p[16] = s1
    p[17] = s2
    p[18] = s3
    p[19] = 1.0/(0.3333333333333333*p0)
    p[20] = s4
    p[21] = 1.0/(5.333333333333333*p1)
    p[22] = s5
    p[23] = 1.0/(2.083333333333333*p2)
    p[24] = s6
    p[25] = s8
    p[26] = s6 - s7
    p[27] = s7 - s8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by velocity-projection; 1 where a pivot of S is suspicious: 288 operations, 1442826 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p15 = p[15]
    p16 = p[16]
    p17 = p[17]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = s0*s2
    s4 = s1*s2
    s5 = math.cos(q5)
    s6 = math.sin(q5)
    s7 = 4.0*s5
    s8 = 4.0*s6
    s9 = 4.0*(v5*v5)
    s10 = s5*s9
    s11 = s6*s9
    s12 = math.cos(q8)
    s13 = math.sin(q8)
    s14 = 2.5*s12
    s15 = 2.5*s13
    s16 = 2.5*(v8*v8)
    s17 = s12*s16
    s18 = s13*s16
    s19 = s1*p19
    s20 = s0*p19
    s21 = s8*p21
    s22 = s7*p21
    s23 = s15*p23
    s24 = s14*p23
    s25 = s1*s19
    s26 = p18 + s25
    s27 = s0*s19
    s28 = s25 - p18
    s29 = s0*s20
    s30 = p18 + s29
    s31 = s8*s21
    s32 = p20 + s26 + s31
    s33 = s7*s21
    s34 = s31 - p20
    s35 = s7*s22
    s36 = p20 + s30 + s35
    s37 = s15*s23
    s38 = p22 + p20 + s31 + s37
    s39 = s14*s23
    s40 = p22 - s37
    s41 = s14*s24
    s42 = p22 + p20 + s35 + s41
    s43 = s15*s24
    s44 = p22 + s41
    s45 = 1.0/(mask_0 + s26)
    s46 = s27*s45
    s47 = s28*s45
    s48 = s27*s46
    s49 = s28*s46 - s1*s20
    s50 = s29 - p18 - s48
    s51 = mask_1 + s30 - s48
    s52 = 1.0/s51
    s53 = s49*s52
    s54 = s50*s52
    s55 = s27*s47 - (s27 + s33) - s50*s53
    s56 = 1.0/(mask_6 + p22 + s37)
    s57 = s39*s56
    s58 = s40*s56
    s59 = s43*s56
    s60 = s39 + s40*s57
    s61 = p22 - s41 + s43*s57
    s62 = mask_7 + s44 - s39*s57
    s63 = 1.0/s62
    s64 = s60*s63
    s65 = s61*s63
    s66 = mask_2 + s32 - s28*s47 - s49*s53
    s67 = 1.0/s66
    s68 = s55*s67
    s69 = s34*s67
    s70 = s33*s67
    s71 = s8*s22 + s34*s68
    s72 = s35 - p20 + s33*s68
    s73 = mask_3 + s36 - s48 - s50*s54 - s55*s68
    s74 = 1.0/s73
    s75 = s71*s74
    s76 = s72*s74
    s77 = s33*s69 - (s33 + s39 + s43*s58 + s61*s64) + s72*s75
    s78 = mask_4 + s38 - s40*s58 - s60*s64 - s34*s69 - s71*s75
    s79 = 1.0/s78
    s80 = s77*s79
    s81 = mask_5 + s42 - s43*s59 - s61*s65 - s33*s70 - s72*s76 - s77*s80
    s82 = s3*s46
    s83 = s4 - p24 + s82
    s84 = s3 + s10 - s3*s47 - s53*s83
    s85 = s18 - p25 + s17*s57
    s86 = s4 + s11 + p26 + s82 - s54*s83 - s68*s84
    s87 = s10 - s17 - s17*s58 - s64*s85 - s69*s84 + s75*s86
    s88 = 1.0/s81*(p27 - (s18 - s11) - s17*s59 - s65*s85 + s70*s84 - s76*s86 - s80*s87)
    s89 = s79*s87
    s90 = s80*s88
    s91 = s89 - s90
    s92 = s74*s86 + s75*s91
    s93 = s76*s88
    s94 = s92 - s93
    s95 = s67*s84 - s68*s94 - s69*s91 + s70*s88
    s96 = s63*s85 - s64*s91 - s65*s88
    s97 = s17*s56 + s57*s96 - s58*s91 - s59*s88
    s98 = s52*s83 - s53*s95 - s54*s94
    s99 = s3*s45 + s46*s98 - s47*s95 + s46*s94
    s100 = (((((s51 < 1e-06*s30) | (s62 < 1e-06*s44)) | (s66 < 1e-06*s32)) | (s73 < 1e-06*s36)) | (s78 < 1e-06*s38))
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = v2
    ydot[3] = v3
    ydot[4] = v4
    ydot[5] = v5
    ydot[6] = v6
    ydot[7] = v7
    ydot[8] = v8
    ydot[9] = p18*(s95 - s99)
    ydot[10] = -p18*(p15 + s98 + s93 - s92)
    ydot[11] = p19*(s0*s94 - (s1*s99 - s0*s98 + s1*s95))
    ydot[12] = -p20*(s95 + s90 - s89)
    ydot[13] = -p20*(p16 + s94 - s88)
    ydot[14] = p21*(s7*s88 - (s8*s95 - s7*s94 + s8*s91))
    ydot[15] = -p22*(s91 + s97)
    ydot[16] = -p22*(p17 + s88 + s96)
    ydot[17] = p23*(s14*s96 - (s14*s88 - s15*s91 + s15*s97))
    ydot[18] = 0.0
    w[15] = s99
    w[16] = s98
    w[17] = s95
    w[18] = s94
    w[19] = s91
    w[20] = s88
    w[21] = s97
    w[22] = s96
    return int((s100 | (s81 < 1e-06*s42)))


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 332 operations, 219464 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_7 = w[30]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = q0 - s0
    s4 = q1 - s1
    s5 = 4.0*math.cos(q5)
    s6 = -s5
    s7 = q3 - q0 - s5 - s0
    s8 = 4.0*math.sin(q5)
    s9 = q4 - q1 - s8 - s1
    s10 = 2.5*math.cos(q8)
    s11 = q6 - q3 + s10 - s5
    s12 = 2.5*math.sin(q8)
    s13 = q7 - q4 + s12 - s8
    s14 = q6 - 10.0 - s10
    s15 = q7 - s12
    s16 = s1*p19
    s17 = s0*p19
    s18 = s8*p21
    s19 = s5*p21
    s20 = s12*p23
    s21 = s10*p23
    s22 = s1*s16
    s23 = p18 + s22
    s24 = s0*s16
    s25 = s22 - p18
    s26 = s0*s17
    s27 = p18 + s26
    s28 = s8*s18
    s29 = s5*s18
    s30 = s28 - p20
    s31 = s5*s19
    s32 = s12*s20
    s33 = s10*s20
    s34 = p22 - s32
    s35 = s10*s21
    s36 = s12*s21
    s37 = s1*s1
    s38 = 1.0 + s37
    s39 = s0*s1
    s40 = -1.0 + s37
    s41 = s0*s0
    s42 = 1.0 + s41
    s43 = s8*s8
    s44 = 1.0 + s38 + s43
    s45 = s5*s8
    s46 = -1.0 + s43
    s47 = s5*s5
    s48 = 1.0 + s42 + s47
    s49 = s12*s12
    s50 = 1.0 + 1.0 + s43 + s49
    s51 = s10*s12
    s52 = 1.0 - s49
    s53 = s10*s10
    s54 = 1.0 + 1.0 + s47 + s53
    s55 = 1.0 + s53
    s56 = 1.0/s38
    s57 = s39*s56
    s58 = s40*s56
    s59 = s39*s57
    s60 = s42 - s59
    s61 = s40*s57 - s39
    s62 = -1.0 + s41 - s59
    s63 = 1.0*(s60 > mask_1 + 1e-12*s42)
    s64 = 1.0 - s63
    s65 = s63/(s60 + s64)
    s66 = s61*s65
    s67 = s44 - s40*s58 - s61*s66
    s68 = s39*s58 - (s39 + s45) - s62*s66
    s69 = 1.0/(1.0 + s49)
    s70 = s51*s69
    s71 = s52*s69
    s72 = s51*s70
    s73 = s55 - s72
    s74 = s51 + s52*s70
    s75 = 1.0 - s53 + s72
    s76 = 1.0*(s73 > mask_7 + 1e-12*s55)
    s77 = 1.0 - s76
    s78 = s76/(s73 + s77)
    s79 = s74*s78
    s80 = 1.0*(s67 > mask_2 + 1e-12*s44)
    s81 = 1.0 - s80
    s82 = s80/(s67 + s81)
    s83 = s68*s82
    s84 = s46*s82
    s85 = s48 - s59 - s62*(s62*s65) - s68*s83
    s86 = s45 + s46*s83
    s87 = -1.0 + s47 + s45*s83
    s88 = 1.0*(s85 > mask_3 + 1e-12*s48)
    s89 = 1.0 - s88
    s90 = s88/(s85 + s89)
    s91 = s86*s90
    s92 = s50 - s52*s71 - s74*s79 - s46*s84 - s86*s91
    s93 = s45*s84 - (s45 + s51 + s51*s71 + s75*s79) + s87*s91
    s94 = 1.0*(s92 > mask_4 + 1e-12*s50)
    s95 = 1.0 - s94
    s96 = s54 - s72 - s75*(s75*s78) - s45*(s45*s82) - s87*(s87*s90) - s93*(s93*(s94/(s92 + s95)))
    s97 = 1.0*(s96 > mask_5 + 1e-12*s54)
    s98 = 1.0/s23
    s99 = s24*s98
    s100 = -s99
    s101 = s25*s98
    s102 = s24*s99
    s103 = s25*s99 - s1*s17
    s104 = s26 - p18 - s102
    s105 = s63/(s64 + s27 - s102)
    s106 = s103*s105
    s107 = s104*s105
    s108 = s24*s101 - (s24 + s29) - s104*s106
    s109 = 1.0/(p22 + s32)
    s110 = s33*s109
    s111 = s34*s109
    s112 = s36*s109
    s113 = s33 + s34*s110
    s114 = p22 - s35 + s36*s110
    s115 = s76/(s77 + p22 + s35 - s33*s110)
    s116 = s113*s115
    s117 = s114*s115
    s118 = s80/(s81 + p20 + s23 + s28 - s25*s101 - s103*s106)
    s119 = s108*s118
    s120 = s30*s118
    s121 = s29*s118
    s122 = s8*s19 + s30*s119
    s123 = s31 - p20 + s29*s119
    s124 = s88/(s89 + p20 + s27 + s31 - s102 - s104*s107 - s108*s119)
    s125 = s122*s124
    s126 = s123*s124
    s127 = s29*s120 - (s29 + s33 + s36*s111 + s114*s116) + s123*s125
    s128 = s94/(s95 + p22 + p20 + s28 + s32 - s34*s111 - s113*s116 - s30*s120 - s122*s125)
    s129 = s127*s128
    s130 = 1.0 - s97 + p22 + p20 + s31 + s35 - s36*s112 - s114*s117 - s29*s121 - s123*s126 - s127*s129
    s131 = s60/s42
    s132 = s67/s44
    s133 = s85/s48
    s134 = s92/s50
    s135 = s96/s54
    s136 = min(min(min(min(min(1.0, mask_1 + s131), mask_2 + s132), mask_3 + s133), mask_4 + s134), mask_5 + s135)
    s137 = s73/s55
    # outputs
    w[39] = s3
    w[40] = s4
    w[41] = s7
    w[42] = s9
    w[43] = s11
    w[44] = s13
    w[45] = s14
    w[46] = s15
    w[0] = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15)
    w[81] = s1
    w[82] = s2
    w[83] = s1
    w[84] = s8
    w[85] = s2
    w[86] = s6
    w[87] = s8
    w[88] = -s12
    w[89] = s6
    w[90] = s10
    w[91] = s12
    w[92] = -s10
    w[56] = s131
    w[57] = s132
    w[58] = s133
    w[59] = s134
    w[60] = s135
    w[62] = s137
    w[5] = s76 + 1.0 + s97 + s94 + s88 + s80 + 1.0 + s63
    w[4] = min(s136, mask_7 + s137)
    w[117] = s100
    w[118] = s101
    w[119] = s100
    w[120] = s106
    w[121] = s107
    w[122] = -s110
    w[123] = s111
    w[124] = s112
    w[125] = s116
    w[126] = s117
    w[127] = s119
    w[128] = s120
    w[129] = -s121
    w[130] = -s125
    w[131] = s126
    w[132] = s129
    w[133] = s98
    w[134] = s105
    w[135] = s109
    w[136] = s115
    w[137] = s118
    w[138] = s124
    w[139] = s128
    w[140] = s97/s130
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 111 operations, 6990 before sharing."""
    # inputs
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    law_lower_0 = w[117]
    law_lower_1 = w[118]
    law_lower_2 = w[119]
    law_lower_3 = w[120]
    law_lower_4 = w[121]
    law_lower_5 = w[122]
    law_lower_6 = w[123]
    law_lower_7 = w[124]
    law_lower_8 = w[125]
    law_lower_9 = w[126]
    law_lower_10 = w[127]
    law_lower_11 = w[128]
    law_lower_12 = w[129]
    law_lower_13 = w[130]
    law_lower_14 = w[131]
    law_lower_15 = w[132]
    law_reciprocal_0 = w[133]
    law_reciprocal_1 = w[134]
    law_reciprocal_2 = w[135]
    law_reciprocal_3 = w[136]
    law_reciprocal_4 = w[137]
    law_reciprocal_5 = w[138]
    law_reciprocal_6 = w[139]
    law_reciprocal_7 = w[140]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    jacobian_8 = w[89]
    jacobian_9 = w[90]
    jacobian_10 = w[91]
    jacobian_11 = w[92]
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
    w[63] = p18*(s14 - s13 - s19)
    w[64] = p18*(s18 + s11 - s10)
    w[65] = p19*(s18*jacobian_1 - s19*jacobian_0 + s15*jacobian_2 + s12*jacobian_4)
    w[66] = p20*(s15 + s8 - s7)
    w[67] = p20*(s12 - s6)
    w[68] = p21*(s15*jacobian_3 + s12*jacobian_5 + s9*jacobian_6 + s6*jacobian_8)
    w[69] = p22*(s9 - s17)
    w[70] = p22*(s6 + s16)
    w[71] = p23*(s9*jacobian_7 + s6*jacobian_9 - s17*jacobian_10 + s16*jacobian_11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(8):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(8):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = 0.0
    last = math.inf
    bits = 2
    for round in range(1):
        geometry(t, y, p, w)
        violation = w[0]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        closed = violation <= tolerance or stalled or round == 0
        if closed:
            measure(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(9, 18):
                y[j] += w[CHANGE - 9 + j]
            break
        for j in range(9):
            y[j] += w[CHANGE + j]
        last = violation
        iw[3] += 1
    measure(t, y, p, w)
    return bits
