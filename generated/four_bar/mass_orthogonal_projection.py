"""Method `mass-orthogonal-projection` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[15] penalty (default 10000000.0)
p[16] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MASK = 23  # sections of w
SAVED = 31
RESIDUAL = 39
PIVOT = 55
CHANGE = 63
MOVED = 147
FORCE_OF_CONSTRAINTS = 156


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 17 operations, 35 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 0.3333333333333333*p0
    s1 = 9.81*p0
    s2 = 5.333333333333333*p1
    s3 = 9.81*p1
    s4 = 2.083333333333333*p2
    s5 = 9.81*p2
    s6 = 1.0/p0
    s7 = 1.0/p1
    s8 = 1.0/p2
    s9 = s1*s6
    s10 = s3*s7
    s11 = s5*s8
    # outputs
    p[17] = s1
    p[18] = s3
    p[19] = s5
    p[20] = s6
    p[21] = 1.0/s0
    p[22] = s7
    p[23] = 1.0/s2
    p[24] = s8
    p[25] = 1.0/s4
    p[26] = s9
    p[27] = s11
    p[28] = s9 - s10
    p[29] = s10 - s11
    p[30] = s0
    p[31] = s2
    p[32] = s4
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by mass-orthogonal-projection; 1 where a pivot of S is suspicious: 288 operations, 1442826 before sharing."""
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
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    p29 = p[29]
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
    s19 = s1*p21
    s20 = s0*p21
    s21 = s8*p23
    s22 = s7*p23
    s23 = s15*p25
    s24 = s14*p25
    s25 = s1*s19
    s26 = p20 + s25
    s27 = s0*s19
    s28 = s25 - p20
    s29 = s0*s20
    s30 = p20 + s29
    s31 = s8*s21
    s32 = p22 + s26 + s31
    s33 = s7*s21
    s34 = s31 - p22
    s35 = s7*s22
    s36 = p22 + s30 + s35
    s37 = s15*s23
    s38 = p24 + p22 + s31 + s37
    s39 = s14*s23
    s40 = p24 - s37
    s41 = s14*s24
    s42 = p24 + p22 + s35 + s41
    s43 = s15*s24
    s44 = p24 + s41
    s45 = 1.0/(mask_0 + s26)
    s46 = s27*s45
    s47 = s28*s45
    s48 = s27*s46
    s49 = s28*s46 - s1*s20
    s50 = s29 - p20 - s48
    s51 = mask_1 + s30 - s48
    s52 = 1.0/s51
    s53 = s49*s52
    s54 = s50*s52
    s55 = s27*s47 - (s27 + s33) - s50*s53
    s56 = 1.0/(mask_6 + p24 + s37)
    s57 = s39*s56
    s58 = s40*s56
    s59 = s43*s56
    s60 = s39 + s40*s57
    s61 = p24 - s41 + s43*s57
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
    s72 = s35 - p22 + s33*s68
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
    s83 = s4 - p26 + s82
    s84 = s3 + s10 - s3*s47 - s53*s83
    s85 = s18 - p27 + s17*s57
    s86 = s4 + s11 + p28 + s82 - s54*s83 - s68*s84
    s87 = s10 - s17 - s17*s58 - s64*s85 - s69*s84 + s75*s86
    s88 = 1.0/s81*(p29 - (s18 - s11) - s17*s59 - s65*s85 + s70*s84 - s76*s86 - s80*s87)
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
    ydot[9] = p20*(s95 - s99)
    ydot[10] = -p20*(p17 + s98 + s93 - s92)
    ydot[11] = p21*(s0*s94 - (s1*s99 - s0*s98 + s1*s95))
    ydot[12] = -p22*(s95 + s90 - s89)
    ydot[13] = -p22*(p18 + s94 - s88)
    ydot[14] = p23*(s7*s88 - (s8*s95 - s7*s94 + s8*s91))
    ydot[15] = -p24*(s91 + s97)
    ydot[16] = -p24*(p19 + s88 + s96)
    ydot[17] = p25*(s14*s96 - (s14*s88 - s15*s91 + s15*s97))
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
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of M + a D^T D: 396 operations, 108909 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    p30 = p[30]
    p31 = p[31]
    p32 = p[32]
    p15 = p[15]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
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
    s16 = p15*(1.0*(1.0 > mask_0))
    s17 = p15*(1.0*(1.0 > mask_1))
    s18 = p15*(1.0*(1.0 > mask_2))
    s19 = p15*(1.0*(1.0 > mask_3))
    s20 = p15*(1.0*(1.0 > mask_4))
    s21 = p15*(1.0*(1.0 > mask_5))
    s22 = p15*(1.0*(1.0 > mask_6))
    s23 = p15*(1.0*(1.0 > mask_7))
    s24 = s1*s1
    s25 = 1.0 + s24
    s26 = s0*s1
    s27 = -1.0 + s24
    s28 = s0*s0
    s29 = 1.0 + s28
    s30 = s8*s8
    s31 = 1.0 + s25 + s30
    s32 = s5*s8
    s33 = -1.0 + s30
    s34 = s5*s5
    s35 = 1.0 + s29 + s34
    s36 = s12*s12
    s37 = 1.0 + 1.0 + s30 + s36
    s38 = s10*s12
    s39 = 1.0 - s36
    s40 = s10*s10
    s41 = 1.0 + 1.0 + s34 + s40
    s42 = 1.0 + s40
    s43 = 1.0/s25
    s44 = s26*s43
    s45 = s27*s43
    s46 = s26*s44
    s47 = s29 - s46
    s48 = s27*s44 - s26
    s49 = -1.0 + s28 - s46
    s50 = 1.0*(s47 > mask_1 + 1e-12*s29)
    s51 = s50/(s47 + 1.0 - s50)
    s52 = s48*s51
    s53 = s31 - s27*s45 - s48*s52
    s54 = s26*s45 - (s26 + s32) - s49*s52
    s55 = 1.0/(1.0 + s36)
    s56 = s38*s55
    s57 = s39*s55
    s58 = s38*s56
    s59 = s42 - s58
    s60 = s38 + s39*s56
    s61 = 1.0 - s40 + s58
    s62 = 1.0*(s59 > mask_7 + 1e-12*s42)
    s63 = s62/(s59 + 1.0 - s62)
    s64 = s60*s63
    s65 = 1.0*(s53 > mask_2 + 1e-12*s31)
    s66 = s65/(s53 + 1.0 - s65)
    s67 = s54*s66
    s68 = s33*s66
    s69 = s35 - s46 - s49*(s49*s51) - s54*s67
    s70 = s32 + s33*s67
    s71 = -1.0 + s34 + s32*s67
    s72 = 1.0*(s69 > mask_3 + 1e-12*s35)
    s73 = s72/(s69 + 1.0 - s72)
    s74 = s70*s73
    s75 = s37 - s39*s57 - s60*s64 - s33*s68 - s70*s74
    s76 = s32*s68 - (s32 + s38 + s38*s57 + s61*s64) + s71*s74
    s77 = 1.0*(s75 > mask_4 + 1e-12*s37)
    s78 = s41 - s58 - s61*(s61*s63) - s32*(s32*s66) - s71*(s71*s73) - s76*(s76*(s77/(s75 + 1.0 - s77)))
    s79 = s1*s16
    s80 = s0*s17
    s81 = s1*s18
    s82 = s79 - s81
    s83 = s8*s18
    s84 = s0*s19
    s85 = s84 - s80
    s86 = s5*s19
    s87 = s8*s20
    s88 = s12*s20
    s89 = s5*s21
    s90 = s10*s21
    s91 = s12*s22
    s92 = s91 - s88
    s93 = s10*s23
    s94 = s90 - s93
    s95 = 1.0/(s18 + p0 + s16)
    s96 = s82*s95
    s97 = s18*s95
    s98 = s83*s95
    s99 = s81 + s18*s96
    s100 = 1.0/(s19 + p0 + s17)
    s101 = s85*s100
    s102 = s19*s100
    s103 = s86*s100
    s104 = s19*s101 - s84
    s105 = s8*s81 + s5*s84 + s83*s96 - s86*s101
    s106 = 1.0/(s22 + p2 + s20)
    s107 = s92*s106
    s108 = s20*s106
    s109 = s87*s106
    s110 = s88 + s20*s107
    s111 = 1.0/(s23 + p2 + s21)
    s112 = s94*s111
    s113 = s21*s111
    s114 = s89*s111
    s115 = s21*s112 - s90
    s116 = s89*s112 - (s12*s87 + s10*s89 + s87*s107)
    s117 = 1.0/(p30 + s1*s79 + s0*s80 + s1*s81 + s0*s84 - s82*s96 - s85*s101)
    s118 = s99*s117
    s119 = s104*s117
    s120 = s105*s117
    s121 = p31 + s8*s83 + s5*s86 + s8*s87 + s5*s89 - s83*s98 - s86*s103 - s87*s109 - s89*s114 - s105*s120
    s122 = 1.0/(p32 + s12*s88 + s10*s90 + s12*s91 + s10*s93 - s92*s107 - s94*s112)
    s123 = s110*s122
    s124 = s115*s122
    s125 = s116*s122
    s126 = s104*s118 + s115*s123
    s127 = s83 - s87 - s83*s97 + s87*s108 - s105*s118 - s116*s123
    s128 = 1.0/(s20 + p1 + s18 - s18*s97 - s20*s108 - s99*s118 - s110*s123)
    s129 = s126*s128
    s130 = s127*s128
    s131 = s89 - s86 + s86*s102 - s89*s113 - s105*s119 - s116*s124 + s127*s129
    s132 = 1.0/(s21 + p1 + s19 - s19*s102 - s21*s113 - s104*s119 - s115*s124 - s126*s129)
    s133 = s131*s132
    s134 = s47/s29
    s135 = s53/s31
    s136 = s69/s35
    s137 = s75/s37
    s138 = s78/s41
    s139 = min(min(min(min(min(1.0, mask_1 + s134), mask_2 + s135), mask_3 + s136), mask_4 + s137), mask_5 + s138)
    s140 = s59/s42
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
    w[56] = s134
    w[57] = s135
    w[58] = s136
    w[59] = s137
    w[60] = s138
    w[62] = s140
    w[5] = s62 + 1.0 + 1.0*(s78 > mask_5 + 1e-12*s41) + s77 + s72 + s65 + 1.0 + s50
    w[4] = min(s139, mask_7 + s140)
    w[117] = s96
    w[118] = -s97
    w[119] = -s98
    w[120] = s101
    w[121] = -s102
    w[122] = s103
    w[123] = s107
    w[124] = -s108
    w[125] = s109
    w[126] = s112
    w[127] = -s113
    w[128] = -s114
    w[129] = s118
    w[130] = s119
    w[131] = s120
    w[132] = s123
    w[133] = s124
    w[134] = s125
    w[135] = -s129
    w[136] = s130
    w[137] = s133
    w[138] = s95
    w[139] = s100
    w[140] = s106
    w[141] = s111
    w[142] = s117
    w[143] = s122
    w[144] = s128
    w[145] = s132
    w[146] = 1.0/(s121 - s116*s125 - s127*s130 - s131*s133)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 191 operations, 98013 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p30 = p[30]
    p31 = p[31]
    p32 = p[32]
    p15 = p[15]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
    moved_0 = w[147]
    moved_1 = w[148]
    moved_2 = w[149]
    moved_3 = w[150]
    moved_4 = w[151]
    moved_5 = w[152]
    moved_6 = w[153]
    moved_7 = w[154]
    moved_8 = w[155]
    force_of_constraints_0 = w[156]
    force_of_constraints_1 = w[157]
    force_of_constraints_2 = w[158]
    force_of_constraints_3 = w[159]
    force_of_constraints_4 = w[160]
    force_of_constraints_5 = w[161]
    force_of_constraints_6 = w[162]
    force_of_constraints_7 = w[163]
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
    law_lower_16 = w[133]
    law_lower_17 = w[134]
    law_lower_18 = w[135]
    law_lower_19 = w[136]
    law_lower_20 = w[137]
    law_reciprocal_0 = w[138]
    law_reciprocal_1 = w[139]
    law_reciprocal_2 = w[140]
    law_reciprocal_3 = w[141]
    law_reciprocal_4 = w[142]
    law_reciprocal_5 = w[143]
    law_reciprocal_6 = w[144]
    law_reciprocal_7 = w[145]
    law_reciprocal_8 = w[146]
    # intermediate terms
    s0 = p15*(1.0*(1.0 > mask_0))*residual_0
    s1 = p15*(1.0*(1.0 > mask_1))*residual_1
    s2 = p15*(1.0*(1.0 > mask_2))*residual_2
    s3 = p15*(1.0*(1.0 > mask_3))*residual_3
    s4 = p15*(1.0*(1.0 > mask_4))*residual_4
    s5 = p15*(1.0*(1.0 > mask_5))*residual_5
    s6 = p15*(1.0*(1.0 > mask_6))*residual_6
    s7 = p15*(1.0*(1.0 > mask_7))*residual_7
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
    s28 = s24*law_lower_0 - (p30*moved_2 + s16*jacobian_0 + s17*jacobian_1 + s18*jacobian_2 + s19*jacobian_4)
    s29 = s24*law_lower_2 - (p31*moved_5 + s18*jacobian_3 + s19*jacobian_5 + s20*jacobian_6 + s21*jacobian_8)
    s30 = s28 + s25*law_lower_3
    s31 = s26*law_lower_6 - (p32*moved_8 + s20*jacobian_7 + s21*jacobian_9 + s22*jacobian_10 + s23*jacobian_11)
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
    w[63] = -s45
    w[64] = -s44
    w[65] = s41
    w[66] = s39
    w[67] = s38
    w[68] = s37
    w[69] = -s43
    w[70] = -s42
    w[71] = s40
    w[147] = moved_0 - s45
    w[148] = moved_1 - s44
    w[149] = moved_2 + s41
    w[150] = moved_3 + s39
    w[151] = moved_4 + s38
    w[152] = moved_5 + s37
    w[153] = moved_6 - s43
    w[154] = moved_7 - s42
    w[155] = moved_8 + s40
    w[156] = s8
    w[157] = s9
    w[158] = s10
    w[159] = s11
    w[160] = s12
    w[161] = s13
    w[162] = s14
    w[163] = s15
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
    """Correct an accepted state by mass-orthogonal projections and measure it; bits as for other corrections."""
    bits = 2
    tolerance = p[16] * w[6]
    last = math.inf
    for j in range(9):
        w[MOVED + j] = 0.0
    for round in range(20):
        geometry(t, y, p, w)
        violation = w[0]
        if round == 0:
            for i in range(8):
                w[FORCE_OF_CONSTRAINTS + i] = -p[15] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or (violation > 0.9 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        spread(p, w)
        for j in range(9):
            y[j] += w[CHANGE + j]
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    tolerance = p[16] * w[7]
    last = math.inf
    for j in range(9):
        w[MOVED + j] = 0.0
    for round in range(20):
        measure(t, y, p, w)
        violation = w[1]
        if round == 0:
            for i in range(8):
                w[FORCE_OF_CONSTRAINTS + i] = -p[15] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or violation > 0.9 * last:
            break
        last = violation
        spread(p, w)
        for j in range(9):
            y[9 + j] += w[CHANGE + j]
        iw[3] += 1
    return bits
