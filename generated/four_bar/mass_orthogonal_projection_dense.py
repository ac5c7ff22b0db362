"""Method `mass-orthogonal-projection` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = dense
p[15] penalty (default 10000000.0)
p[16] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MULTIPLIERS = 15  # sections of w
MASK = 23
RESIDUAL = 39
CHANGE = 63
DENSE = 126
ROW_LENGTH = 198
ROW_CHOSEN = 206
ROW_CORNER = 214
ROW_FACTOR = 222
BASIS = 230
SMALL = 311
REDUCED = 392
FORCE = 401
WEIGHED = 410
MOVED = 449
FORCE_OF_CONSTRAINTS = 458


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # outputs
    p[17] = -9.81*p0
    p[18] = -9.81*p1
    p[19] = -9.81*p2
    p[20] = 0.3333333333333333*p0
    p[21] = 5.333333333333333*p1
    p[22] = 2.083333333333333*p2
    return 0


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
def aim(t, y, p, w):
    """the section `residual` = what D v' shall be, `force` = f: 27 operations, 54 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    # intermediate terms
    s0 = v2*v2
    s1 = math.cos(q2)*s0
    s2 = math.sin(q2)*s0
    s3 = 4.0*(v5*v5)
    s4 = math.cos(q5)*s3
    s5 = math.sin(q5)*s3
    s6 = 2.5*(v8*v8)
    s7 = math.cos(q8)*s6
    s8 = math.sin(q8)*s6
    # outputs
    w[39] = -s1
    w[40] = -s2
    w[41] = -(s1 + s4)
    w[42] = -(s2 + s5)
    w[43] = s7 - s4
    w[44] = s8 - s5
    w[45] = -s7
    w[46] = -s8
    w[401] = 0.0
    w[402] = p17
    w[403] = 0.0
    w[404] = 0.0
    w[405] = p18
    w[406] = 0.0
    w[407] = 0.0
    w[408] = p19
    w[409] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def weigh(p, w):
    """the section `weighed` = M times `change`: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    change_0 = w[63]
    change_1 = w[64]
    change_2 = w[65]
    change_3 = w[66]
    change_4 = w[67]
    change_5 = w[68]
    change_6 = w[69]
    change_7 = w[70]
    change_8 = w[71]
    # outputs
    w[410] = p0*change_0
    w[411] = p0*change_1
    w[412] = p20*change_2
    w[413] = p1*change_3
    w[414] = p1*change_4
    w[415] = p21*change_5
    w[416] = p2*change_6
    w[417] = p2*change_7
    w[418] = p22*change_8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """q' and power: 0 operations, 0 before sharing."""
    # inputs
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
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
    ydot[18] = 0.0
    return 0


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
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
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
    s117 = 1.0/(p20 + s1*s79 + s0*s80 + s1*s81 + s0*s84 - s82*s96 - s85*s101)
    s118 = s99*s117
    s119 = s104*s117
    s120 = s105*s117
    s121 = p21 + s8*s83 + s5*s86 + s8*s87 + s5*s89 - s83*s98 - s86*s103 - s87*s109 - s89*s114 - s105*s120
    s122 = 1.0/(p22 + s12*s88 + s10*s90 + s12*s91 + s10*s93 - s92*s107 - s94*s112)
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
    w[419] = s96
    w[420] = -s97
    w[421] = -s98
    w[422] = s101
    w[423] = -s102
    w[424] = s103
    w[425] = s107
    w[426] = -s108
    w[427] = s109
    w[428] = s112
    w[429] = -s113
    w[430] = -s114
    w[431] = s118
    w[432] = s119
    w[433] = s120
    w[434] = s123
    w[435] = s124
    w[436] = s125
    w[437] = -s129
    w[438] = s130
    w[439] = s133
    w[440] = s95
    w[441] = s100
    w[442] = s106
    w[443] = s111
    w[444] = s117
    w[445] = s122
    w[446] = s128
    w[447] = s132
    w[448] = 1.0/(s121 - s116*s125 - s127*s130 - s131*s133)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 191 operations, 98013 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p15 = p[15]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
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
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
    moved_0 = w[449]
    moved_1 = w[450]
    moved_2 = w[451]
    moved_3 = w[452]
    moved_4 = w[453]
    moved_5 = w[454]
    moved_6 = w[455]
    moved_7 = w[456]
    moved_8 = w[457]
    force_of_constraints_0 = w[458]
    force_of_constraints_1 = w[459]
    force_of_constraints_2 = w[460]
    force_of_constraints_3 = w[461]
    force_of_constraints_4 = w[462]
    force_of_constraints_5 = w[463]
    force_of_constraints_6 = w[464]
    force_of_constraints_7 = w[465]
    law_lower_0 = w[419]
    law_lower_1 = w[420]
    law_lower_2 = w[421]
    law_lower_3 = w[422]
    law_lower_4 = w[423]
    law_lower_5 = w[424]
    law_lower_6 = w[425]
    law_lower_7 = w[426]
    law_lower_8 = w[427]
    law_lower_9 = w[428]
    law_lower_10 = w[429]
    law_lower_11 = w[430]
    law_lower_12 = w[431]
    law_lower_13 = w[432]
    law_lower_14 = w[433]
    law_lower_15 = w[434]
    law_lower_16 = w[435]
    law_lower_17 = w[436]
    law_lower_18 = w[437]
    law_lower_19 = w[438]
    law_lower_20 = w[439]
    law_reciprocal_0 = w[440]
    law_reciprocal_1 = w[441]
    law_reciprocal_2 = w[442]
    law_reciprocal_3 = w[443]
    law_reciprocal_4 = w[444]
    law_reciprocal_5 = w[445]
    law_reciprocal_6 = w[446]
    law_reciprocal_7 = w[447]
    law_reciprocal_8 = w[448]
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
    s28 = s24*law_lower_0 - (p20*moved_2 + jacobian_0*s16 + jacobian_1*s17 + jacobian_2*s18 + jacobian_4*s19)
    s29 = s24*law_lower_2 - (p21*moved_5 + jacobian_3*s18 + jacobian_5*s19 + jacobian_6*s20 + jacobian_8*s21)
    s30 = s28 + s25*law_lower_3
    s31 = s26*law_lower_6 - (p22*moved_8 + jacobian_7*s20 + jacobian_9*s21 + jacobian_10*s22 + jacobian_11*s23)
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
    w[449] = moved_0 - s45
    w[450] = moved_1 - s44
    w[451] = moved_2 + s41
    w[452] = moved_3 + s39
    w[453] = moved_4 + s38
    w[454] = moved_5 + s37
    w[455] = moved_6 - s43
    w[456] = moved_7 - s42
    w[457] = moved_8 + s40
    w[458] = s8
    w[459] = s9
    w[460] = s10
    w[461] = s11
    w[462] = s12
    w[463] = s13
    w[464] = s14
    w[465] = s15
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def reflect(w, k, section):
    """Apply reflection `k` to the vector of a section of w."""
    total = 0.0
    for j in range(k, 9):
        total += w[DENSE + 9 * k + j] * w[section + j]
    total *= w[ROW_FACTOR + k]
    for j in range(k, 9):
        w[section + j] -= total * w[DENSE + 9 * k + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def factorise(p, w):
    """Q R of D^T by Householder's reflections with pivoting, rows of D scaled to length 1; return the rank.

    Row i of the section `dense` holds, in the order chosen, R above the diagonal and then the reflection.
    """
    for k in range(72):
        w[DENSE + k] = 0.0
    expand(p, w)
    rows = 0
    for i in range(8):
        total = 0.0
        for j in range(9):
            total += w[DENSE + 9 * i + j] ** 2
        w[ROW_LENGTH + i] = math.sqrt(total)
        if w[MASK + i] > 0.0 or total == 0.0:  # permanently redundant rows are left out, here as elsewhere
            continue
        for j in range(9):
            w[DENSE + 9 * rows + j] = w[DENSE + 9 * i + j] / w[ROW_LENGTH + i]
        w[ROW_CHOSEN + rows] = i
        rows += 1
    for k in range(min(rows, 9)):
        largest, best = 0.0, k
        for i in range(k, rows):
            total = 0.0
            for j in range(k, 9):
                total += w[DENSE + 9 * i + j] ** 2
            if total > largest:
                largest, best = total, i
        if largest < 1e-12:
            return k
        for j in range(9):
            a, b = DENSE + 9 * k + j, DENSE + 9 * best + j
            w[a], w[b] = w[b], w[a]
        w[ROW_CHOSEN + k], w[ROW_CHOSEN + best] = w[ROW_CHOSEN + best], w[ROW_CHOSEN + k]
        first = w[DENSE + 9 * k + k]
        corner = -math.copysign(math.sqrt(largest), first)
        w[ROW_CORNER + k] = corner
        w[DENSE + 9 * k + k] = first - corner
        w[ROW_FACTOR + k] = 1.0 / (largest - corner * first)
        for i in range(k + 1, rows):
            reflect(w, k, DENSE + 9 * i)
    return min(rows, 9)


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state: v' = b + Z z with D b = g, D Z = 0 and Z^T M Z z = Z^T (f - M b), from Q R of D^T."""
    geometry(t, y, p, w)
    aim(t, y, p, w)
    rank = factorise(p, w)
    if iw[9] == 0 or rank < iw[10]:
        iw[10] = rank
    iw[9] += 1
    degrees = 9 - rank
    # b = Q (z, 0) with R^T z = g
    for j in range(9):
        w[CHANGE + j] = 0.0
    for i in range(rank):
        row = int(w[ROW_CHOSEN + i])
        total = w[RESIDUAL + row] / w[ROW_LENGTH + row]
        for j in range(i):
            total -= w[DENSE + 9 * i + j] * w[CHANGE + j]
        w[CHANGE + i] = total / w[ROW_CORNER + i]
    for k in range(rank - 1, -1, -1):
        reflect(w, k, CHANGE)
    weigh(p, w)
    for j in range(9):
        ydot[9 + j] = w[CHANGE + j]
        w[FORCE + j] -= w[WEIGHED + j]
    # the columns of Q behind the rank are a basis Z of the tangent space
    for c in range(degrees):
        for j in range(9):
            w[BASIS + 9 * c + j] = 1.0 if j == rank + c else 0.0
        for k in range(rank - 1, -1, -1):
            reflect(w, k, BASIS + 9 * c)
    for c in range(degrees):
        for j in range(9):
            w[CHANGE + j] = w[BASIS + 9 * c + j]
        weigh(p, w)
        for r in range(c, degrees):
            total = 0.0
            for j in range(9):
                total += w[BASIS + 9 * r + j] * w[WEIGHED + j]
            w[SMALL + 9 * r + c] = total
        total = 0.0
        for j in range(9):
            total += w[BASIS + 9 * c + j] * w[FORCE + j]
        w[REDUCED + c] = total
    largest = 0.0
    for c in range(degrees):
        largest = max(largest, w[SMALL + 9 * c + c])
    for c in range(degrees):  # L D L^T in place; a direction without mass gets no acceleration
        pivot = w[SMALL + 9 * c + c]
        if not pivot > 1e-15 * largest:
            w[SMALL + 9 * c + c] = math.inf
            continue
        for r in range(c + 1, degrees):
            factor = w[SMALL + 9 * r + c] / pivot
            for k in range(r, degrees):
                w[SMALL + 9 * k + r] -= factor * w[SMALL + 9 * k + c]
            w[REDUCED + r] -= factor * w[REDUCED + c]
    for c in range(degrees - 1, -1, -1):
        total = w[REDUCED + c]
        for r in range(c + 1, degrees):
            total -= w[SMALL + 9 * r + c] * w[REDUCED + r]
        w[REDUCED + c] = total / w[SMALL + 9 * c + c]
        for j in range(9):
            ydot[9 + j] += w[REDUCED + c] * w[BASIS + 9 * c + j]
            w[CHANGE + j] = w[BASIS + 9 * c + j]
        weigh(p, w)
        for j in range(9):
            w[FORCE + j] -= w[REDUCED + c] * w[WEIGHED + j]
    # D^T lambda = f - M v', which the section `force` holds by now
    for k in range(rank):
        reflect(w, k, FORCE)
    for i in range(8):
        w[MULTIPLIERS + i] = 0.0
    for i in range(rank - 1, -1, -1):
        row = int(w[ROW_CHOSEN + i])
        scaled = w[FORCE + i] / w[ROW_CORNER + i]
        for j in range(i):
            w[FORCE + j] -= w[DENSE + 9 * i + j] * scaled
        w[MULTIPLIERS + row] = scaled / w[ROW_LENGTH + row]
    finish(t, y, p, w, ydot)
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
