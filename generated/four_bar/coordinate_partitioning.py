"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[15] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MASK = 23  # sections of w
SAVED = 31
PIVOT = 55
CHANGE = 63
MASS = 72
DEPENDENT = 117
DENSE = 126


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
    p[16] = s0
    p[17] = s1
    p[18] = s2
    p[19] = s3
    p[20] = 1.0/(0.3333333333333333*p0)
    p[21] = s4
    p[22] = 1.0/(5.333333333333333*p1)
    p[23] = s5
    p[24] = 1.0/(2.083333333333333*p2)
    p[25] = s6
    p[26] = s8
    p[27] = s6 - s7
    p[28] = s7 - s8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accelerate(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by coordinate-partitioning; 1 where a pivot of S is suspicious: 288 operations, 1442826 before sharing."""
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
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
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
    s19 = s1*p20
    s20 = s0*p20
    s21 = s8*p22
    s22 = s7*p22
    s23 = s15*p24
    s24 = s14*p24
    s25 = s1*s19
    s26 = p19 + s25
    s27 = s0*s19
    s28 = s25 - p19
    s29 = s0*s20
    s30 = p19 + s29
    s31 = s8*s21
    s32 = p21 + s26 + s31
    s33 = s7*s21
    s34 = s31 - p21
    s35 = s7*s22
    s36 = p21 + s30 + s35
    s37 = s15*s23
    s38 = p23 + p21 + s31 + s37
    s39 = s14*s23
    s40 = p23 - s37
    s41 = s14*s24
    s42 = p23 + p21 + s35 + s41
    s43 = s15*s24
    s44 = p23 + s41
    s45 = 1.0/(mask_0 + s26)
    s46 = s27*s45
    s47 = s28*s45
    s48 = s27*s46
    s49 = s28*s46 - s1*s20
    s50 = s29 - p19 - s48
    s51 = mask_1 + s30 - s48
    s52 = 1.0/s51
    s53 = s49*s52
    s54 = s50*s52
    s55 = s27*s47 - (s27 + s33) - s50*s53
    s56 = 1.0/(mask_6 + p23 + s37)
    s57 = s39*s56
    s58 = s40*s56
    s59 = s43*s56
    s60 = s39 + s40*s57
    s61 = p23 - s41 + s43*s57
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
    s72 = s35 - p21 + s33*s68
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
    s83 = s4 - p25 + s82
    s84 = s3 + s10 - s3*s47 - s53*s83
    s85 = s18 - p26 + s17*s57
    s86 = s4 + s11 + p27 + s82 - s54*s83 - s68*s84
    s87 = s10 - s17 - s17*s58 - s64*s85 - s69*s84 + s75*s86
    s88 = 1.0/s81*(p28 - (s18 - s11) - s17*s59 - s65*s85 + s70*s84 - s76*s86 - s80*s87)
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
    ydot[9] = p19*(s95 - s99)
    ydot[10] = -p19*(p16 + s98 + s93 - s92)
    ydot[11] = p20*(s0*s94 - (s1*s99 - s0*s98 + s1*s95))
    ydot[12] = -p21*(s95 + s90 - s89)
    ydot[13] = -p21*(p17 + s94 - s88)
    ydot[14] = p22*(s7*s88 - (s8*s95 - s7*s94 + s8*s91))
    ydot[15] = -p23*(s91 + s97)
    ydot[16] = -p23*(p18 + s88 + s96)
    ydot[17] = p24*(s14*s96 - (s14*s88 - s15*s91 + s15*s97))
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
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
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
    # outputs
    w[126] = 1.0
    w[128] = jacobian_0
    w[136] = 1.0
    w[137] = jacobian_1
    w[144] = -1.0
    w[146] = jacobian_2
    w[147] = 1.0
    w[149] = jacobian_3
    w[154] = -1.0
    w[155] = jacobian_4
    w[157] = 1.0
    w[158] = jacobian_5
    w[165] = -1.0
    w[167] = jacobian_6
    w[168] = 1.0
    w[170] = jacobian_7
    w[175] = -1.0
    w[176] = jacobian_8
    w[178] = 1.0
    w[179] = jacobian_9
    w[186] = 1.0
    w[188] = jacobian_10
    w[196] = 1.0
    w[197] = jacobian_11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D P D^T: 373 operations, 475926 before sharing."""
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
    dependent_0 = w[117]
    dependent_1 = w[118]
    dependent_2 = w[119]
    dependent_3 = w[120]
    dependent_4 = w[121]
    dependent_5 = w[122]
    dependent_6 = w[123]
    dependent_7 = w[124]
    dependent_8 = w[125]
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
    s16 = s1*s1
    s17 = 1.0 + s16
    s18 = s0*s1
    s19 = -1.0 + s16
    s20 = s0*s0
    s21 = 1.0 + s20
    s22 = s8*s8
    s23 = 1.0 + s17 + s22
    s24 = s5*s8
    s25 = -1.0 + s22
    s26 = s5*s5
    s27 = 1.0 + s21 + s26
    s28 = s12*s12
    s29 = 1.0 + 1.0 + s22 + s28
    s30 = s10*s12
    s31 = 1.0 - s28
    s32 = s10*s10
    s33 = 1.0 + 1.0 + s26 + s32
    s34 = 1.0 + s28
    s35 = 1.0 + s32
    s36 = 1.0/s17
    s37 = s18*s36
    s38 = s19*s36
    s39 = s18*s37
    s40 = s21 - s39
    s41 = s19*s37 - s18
    s42 = -1.0 + s20 - s39
    s43 = 1.0*(s40 > mask_1 + 1e-12*s21)
    s44 = 1.0 - s43
    s45 = s43/(s40 + s44)
    s46 = s41*s45
    s47 = s23 - s19*s38 - s41*s46
    s48 = s18*s38 - (s18 + s24) - s42*s46
    s49 = 1.0/s34
    s50 = s30*s49
    s51 = s31*s49
    s52 = s30*s50
    s53 = s35 - s52
    s54 = s30 + s31*s50
    s55 = 1.0 - s32 + s52
    s56 = 1.0*(s53 > mask_7 + 1e-12*s35)
    s57 = 1.0 - s56
    s58 = s56/(s53 + s57)
    s59 = s54*s58
    s60 = 1.0*(s47 > mask_2 + 1e-12*s23)
    s61 = 1.0 - s60
    s62 = s60/(s47 + s61)
    s63 = s48*s62
    s64 = s25*s62
    s65 = s27 - s39 - s42*(s42*s45) - s48*s63
    s66 = s24 + s25*s63
    s67 = -1.0 + s26 + s24*s63
    s68 = 1.0*(s65 > mask_3 + 1e-12*s27)
    s69 = 1.0 - s68
    s70 = s68/(s65 + s69)
    s71 = s66*s70
    s72 = s29 - s31*s51 - s54*s59 - s25*s64 - s66*s71
    s73 = s24*s64 - (s24 + s30 + s30*s51 + s55*s59) + s67*s71
    s74 = 1.0*(s72 > mask_4 + 1e-12*s29)
    s75 = 1.0 - s74
    s76 = s74/(s72 + s75)
    s77 = s33 - s52 - s55*(s55*s58) - s24*(s24*s62) - s67*(s67*s70) - s73*(s73*s76)
    s78 = 1.0*(s77 > mask_5 + 1e-12*s33)
    s79 = 1.0 - s78
    s80 = s78/(s77 + s79)
    s81 = s1*dependent_2
    s82 = s0*dependent_2
    s83 = s8*dependent_5
    s84 = s5*dependent_5
    s85 = s12*dependent_8
    s86 = s10*dependent_8
    s87 = s1*s81
    s88 = dependent_0 + s87
    s89 = s0*s81
    s90 = s87 - dependent_0
    s91 = s0*s82
    s92 = dependent_1 + s91
    s93 = s8*s83
    s94 = s5*s83
    s95 = s93 - dependent_3
    s96 = s5*s84
    s97 = s12*s85
    s98 = s10*s85
    s99 = dependent_6 - s97
    s100 = s10*s86
    s101 = s12*s86
    s102 = dependent_6 + s97
    s103 = 1.0/s88
    s104 = s89*s103
    s105 = -s104
    s106 = s90*s103
    s107 = s89*s104
    s108 = s92 - s107
    s109 = s90*s104 - s1*s82
    s110 = s91 - dependent_1 - s107
    s111 = s43/(s44 + s108)
    s112 = s109*s111
    s113 = s110*s111
    s114 = dependent_3 + s88 + s93 - s90*s106 - s109*s112
    s115 = s89*s106 - (s89 + s94) - s110*s112
    s116 = 1.0/s102
    s117 = s98*s116
    s118 = s99*s116
    s119 = s101*s116
    s120 = dependent_7 + s100 - s98*s117
    s121 = s98 + s99*s117
    s122 = dependent_7 - s100 + s101*s117
    s123 = s56/(s57 + s120)
    s124 = s121*s123
    s125 = s122*s123
    s126 = s60/(s61 + s114)
    s127 = s115*s126
    s128 = s95*s126
    s129 = s94*s126
    s130 = dependent_4 + s92 + s96 - s107 - s110*s113 - s115*s127
    s131 = s8*s84 + s95*s127
    s132 = s96 - dependent_4 + s94*s127
    s133 = s68/(s69 + s130)
    s134 = s131*s133
    s135 = s132*s133
    s136 = dependent_6 + dependent_3 + s93 + s97 - s99*s118 - s121*s124 - s95*s128 - s131*s134
    s137 = s94*s128 - (s94 + s98 + s101*s118 + s122*s124) + s132*s134
    s138 = s74/(s75 + s136)
    s139 = s137*s138
    s140 = dependent_7 + dependent_4 + s96 + s100 - s101*s119 - s122*s125 - s94*s129 - s132*s135 - s137*s139
    s141 = (s36*s88 + 1.0 - s17*s36)*(s45*s108 + 1.0 - s40*s45)*(s49*s102 + 1.0 - s34*s49)*(s58*s120 + 1.0 - s53*s58)
    s142 = s141*(s62*s114 + 1.0 - s47*s62)*(s70*s130 + 1.0 - s65*s70)*(s76*s136 + 1.0 - s72*s76)*(s80*s140 + 1.0 - s77*s80)
    s143 = s40/s21
    s144 = s47/s23
    s145 = s65/s27
    s146 = s72/s29
    s147 = s77/s33
    s148 = min(min(min(min(min(1.0, mask_1 + s143), mask_2 + s144), mask_3 + s145), mask_4 + s146), mask_5 + s147)
    s149 = s53/s35
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
    w[56] = s143
    w[57] = s144
    w[58] = s145
    w[59] = s146
    w[60] = s147
    w[62] = s149
    w[5] = s56 + 1.0 + s78 + s74 + s68 + s60 + 1.0 + s43
    w[4] = min(s148, mask_7 + s149)
    w[10] = s142
    w[198] = s105
    w[199] = s106
    w[200] = s105
    w[201] = s112
    w[202] = s113
    w[203] = -s117
    w[204] = s118
    w[205] = s119
    w[206] = s124
    w[207] = s125
    w[208] = s127
    w[209] = s128
    w[210] = -s129
    w[211] = -s134
    w[212] = s135
    w[213] = s139
    w[214] = s103
    w[215] = s111
    w[216] = s116
    w[217] = s123
    w[218] = s126
    w[219] = s133
    w[220] = s138
    w[221] = s78/(s79 + s140)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 111 operations, 6990 before sharing."""
    # inputs
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
    dependent_0 = w[117]
    dependent_1 = w[118]
    dependent_2 = w[119]
    dependent_3 = w[120]
    dependent_4 = w[121]
    dependent_5 = w[122]
    dependent_6 = w[123]
    dependent_7 = w[124]
    dependent_8 = w[125]
    law_lower_0 = w[198]
    law_lower_1 = w[199]
    law_lower_2 = w[200]
    law_lower_3 = w[201]
    law_lower_4 = w[202]
    law_lower_5 = w[203]
    law_lower_6 = w[204]
    law_lower_7 = w[205]
    law_lower_8 = w[206]
    law_lower_9 = w[207]
    law_lower_10 = w[208]
    law_lower_11 = w[209]
    law_lower_12 = w[210]
    law_lower_13 = w[211]
    law_lower_14 = w[212]
    law_lower_15 = w[213]
    law_reciprocal_0 = w[214]
    law_reciprocal_1 = w[215]
    law_reciprocal_2 = w[216]
    law_reciprocal_3 = w[217]
    law_reciprocal_4 = w[218]
    law_reciprocal_5 = w[219]
    law_reciprocal_6 = w[220]
    law_reciprocal_7 = w[221]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
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
    w[63] = dependent_0*(s14 - s13 - s19)
    w[64] = dependent_1*(s18 + s11 - s10)
    w[65] = dependent_2*(jacobian_1*s18 - jacobian_0*s19 + jacobian_2*s15 + jacobian_4*s12)
    w[66] = dependent_3*(s15 + s8 - s7)
    w[67] = dependent_4*(s12 - s6)
    w[68] = dependent_5*(jacobian_3*s15 + jacobian_5*s12 + jacobian_6*s9 + jacobian_8*s6)
    w[69] = dependent_6*(s9 - s17)
    w[70] = dependent_7*(s6 + s16)
    w[71] = dependent_8*(jacobian_7*s9 + jacobian_9*s6 - jacobian_10*s17 + jacobian_11*s16)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def reduce(w, step, column):
    """Make a column of the dense D a unit vector with its 1 in row `step` (Gauss, Jordan)."""
    pivot = w[DENSE + 9 * step + column]
    for j in range(9):
        w[DENSE + 9 * step + j] /= pivot
    for i in range(8):
        factor = w[DENSE + 9 * i + column]
        if i != step and factor != 0.0:
            for j in range(9):
                w[DENSE + 9 * i + j] -= factor * w[DENSE + 9 * step + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def choose(p, w, iw):
    """Choose the dependent columns of D: by complete pivoting, then by exchange while that enlarges their determinant."""
    for k in range(72):
        w[DENSE + k] = 0.0
    expand(p, w)
    for j in range(9):
        w[DEPENDENT + j] = 0.0
    for i in range(8):  # rows of unequal size must not decide
        total = 0.0
        for j in range(9):
            total += w[DENSE + 9 * i + j] ** 2
        for j in range(9):
            w[DENSE + 9 * i + j] /= math.sqrt(total)
    rank = 0
    for step in range(8):
        largest, row, column = 0.0, -1, -1
        for i in range(step, 8):
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 9 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 9 * i + j]), i, j
        if largest < 1e-6:  # the square root of the threshold at which D D^T skips a row
            break
        w[DEPENDENT + column] = 1.0
        for j in range(9):
            a, b = DENSE + 9 * step + j, DENSE + 9 * row + j
            w[a], w[b] = w[b], w[a]
        reduce(w, step, column)
        rank += 1
    # what is left in the other columns is how fast dependent coordinates follow independent ones, with the sign changed
    for exchange in range(9):
        largest, row, column = 1.01, -1, -1
        for i in range(rank):
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 9 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 9 * i + j]), i, j
        if row < 0:
            break
        for j in range(9):
            if w[DEPENDENT + j] == 1.0 and w[DENSE + 9 * row + j] != 0.0:
                w[DEPENDENT + j] = 0.0
        w[DEPENDENT + column] = 1.0
        reduce(w, row, column)
    iw[7] += 1
    return 0



@njit(error_model="numpy", fastmath={"contract"})
def close(t, y, p, w, iw):
    """Dependent coordinates from Phi = 0 and dependent velocities from D v = nu, the independent ones kept."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[15] * w[6]
    last = math.inf
    bits = 2
    for round in range(15):
        geometry(t, y, p, w)
        violation = w[0]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        closed = violation <= tolerance or stalled or round == 14
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
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    return bits


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state, whose dependent part is closed first."""
    close(t, y, p, w, iw)
    return accelerate(t, y, p, w, iw, ydot)


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
def release(w):
    """Make all coordinates dependent, weighted by M^-1: near a singular position no partition determines the motion."""
    largest = 0.0
    for j in range(9):
        largest = max(largest, w[MASS + j])
    for j in range(9):
        w[DEPENDENT + j] = 1.0 / max(w[MASS + j], 1e-6 * largest)  # massless bodies give way, within reason
    w[11] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Close an accepted state, choose another partition where this one has become poor, and measure."""
    poor = False
    if iw[5] == 0:
        geometry(t, y, p, w)
        # the root of the smallest pivot is the sine of an angle: it says whether the next step meets a singular position
        sine = math.sqrt(max(w[4], 0.0))
        fall = max(w[13] - sine, 0.0)
        w[13] = sine
        first = iw[7] == 0
        released = w[11] == 0.0 and not first
        if sine - fall < 0.01:
            if not released:
                release(w)
                iw[7] += 1
        else:
            quality = w[10]
            w[11] = max(w[11], quality)
            ahead = quality - max(w[12] - quality, 0.0)
            poor = released or ahead < 0.3 * w[11]
            w[12] = quality
            if first:
                choose(p, w, iw)
                geometry(t, y, p, w)
                w[11] = w[10]
    bits = close(t, y, p, w, iw)
    if poor:  # after closing: the partition that was integrated with is better for it than one from a singular position
        choose(p, w, iw)
        geometry(t, y, p, w)
        w[11] = w[10]
        w[12] = w[10]
    measure(t, y, p, w)
    return bits
