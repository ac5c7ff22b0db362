"""Method `direct-correction` for model `driven-four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = mass
p[17] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MASK = 24  # sections of w
SAVED = 33
PIVOT = 60
CHANGE = 69


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 18 operations, 35 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    s3 = 1.0/p0
    s4 = 1.0/(0.3333333333333333*p0)
    s5 = 1.0/p1
    s6 = 1.0/p2
    s7 = s0*s3
    s8 = s1*s5
    s9 = s2*s6
    # outputs
    p[18] = s0
    p[19] = s1
    p[20] = s2
    p[21] = s3
    p[22] = s4
    p[23] = s5
    p[24] = 1.0/(5.333333333333333*p1)
    p[25] = s6
    p[26] = 1.0/(2.083333333333333*p2)
    p[27] = s7
    p[28] = s9
    p[29] = s7 - s8
    p[30] = s8 - s9
    p[31] = 1e-06*s4
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 335 operations, 2491705 before sharing."""
    # inputs
    p4 = p[4]  # crank_speed [rad/s]
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
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    mask_0 = w[24]
    mask_1 = w[25]
    mask_2 = w[26]
    mask_3 = w[27]
    mask_4 = w[28]
    mask_5 = w[29]
    mask_6 = w[30]
    mask_7 = w[31]
    mask_8 = w[32]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    p29 = p[29]
    p30 = p[30]
    p31 = p[31]
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
    s19 = s1*p22
    s20 = s0*p22
    s21 = s8*p24
    s22 = s7*p24
    s23 = s15*p26
    s24 = s14*p26
    s25 = s1*s19
    s26 = p21 + s25
    s27 = s0*s19
    s28 = s25 - p21
    s29 = s0*s20
    s30 = p21 + s29
    s31 = s8*s21
    s32 = p23 + s26 + s31
    s33 = s7*s21
    s34 = s31 - p23
    s35 = s7*s22
    s36 = p23 + s30 + s35
    s37 = s8*s22
    s38 = s15*s23
    s39 = p25 + p23 + s31 + s38
    s40 = s14*s23
    s41 = p25 - s38
    s42 = s14*s24
    s43 = p25 + p23 + s35 + s42
    s44 = s15*s24
    s45 = p25 + s42
    s46 = 1.0/(mask_6 + p25 + s38)
    s47 = s40*s46
    s48 = s41*s46
    s49 = s44*s46
    s50 = s40 + s41*s47
    s51 = p25 - s42 + s44*s47
    s52 = mask_7 + s45 - s40*s47
    s53 = 1.0/s52
    s54 = s50*s53
    s55 = s51*s53
    s56 = s33 + s40 + s44*s48 + s51*s54
    s57 = mask_4 + s39 - s41*s48 - s50*s54
    s58 = 1.0/s57
    s59 = s56*s58
    s60 = s34*s58
    s61 = s37*s58
    s62 = s34*s59 - s33
    s63 = s35 - p23 - s37*s59
    s64 = mask_5 + s43 - s44*s49 - s51*s55 - s56*s59
    s65 = 1.0/s64
    s66 = s62*s65
    s67 = s63*s65
    s68 = 1.0/(mask_0 + s26)
    s69 = s27*s68
    s70 = s19*s68
    s71 = s28*s68
    s72 = s27*s69
    s73 = s19*s69 - s20
    s74 = s28*s69 - s1*s20
    s75 = s29 - p21 - s72
    s76 = mask_1 + s30 - s72
    s77 = 1.0/s76
    s78 = s73*s77
    s79 = s74*s77
    s80 = s75*s77
    s81 = s19 - s28*s70 - s74*s78
    s82 = s27*s70 - s20 - s75*s78
    s83 = mask_8 + p22 - s19*s70 - s73*s78
    s84 = 1.0/s83
    s85 = s81*s84
    s86 = s82*s84
    s87 = s37*s60 - (s27 + s33) - s63*s66 + s27*s71 - s75*s79 - s82*s85
    s88 = mask_2 + s32 - s34*s60 - s62*s66 - s28*s71 - s74*s79 - s81*s85
    s89 = 1.0/s88
    s90 = s87*s89
    s91 = mask_3 + s36 - s37*s61 - s63*s67 - s72 - s75*s80 - s82*s86 - s87*s90
    s92 = s18 - p28 + s17*s47
    s93 = s10 - s17 - s17*s48 - s54*s92
    s94 = p30 - (s18 - s11) - s17*s49 - s55*s92 + s59*s93
    s95 = s3*s69
    s96 = s4 - p27 + s95
    s97 = s3*s70 + s78*s96
    s98 = s3 + s10 - s60*s93 - s66*s94 - s3*s71 - s79*s96 + s85*s97
    s99 = 1.0/s91*(s4 + s11 + p29 + s61*s93 - s67*s94 + s95 - s80*s96 + s86*s97 - s90*s98)
    s100 = s89*s98
    s101 = s90*s99
    s102 = s100 - s101
    s103 = s84*s97 + s85*s102 + s86*s99
    s104 = s77*s96 + s78*s103 - s79*s102 - s80*s99
    s105 = s3*s68 + s69*s104 + s70*s103 - s71*s102 + s69*s99
    s106 = s65*s94 - s66*s102
    s107 = s67*s99
    s108 = s106 - s107
    s109 = s58*s93 + s59*s108 - s60*s102 + s61*s99
    s110 = s53*s92 - s54*s109 - s55*s108
    s111 = s17*s46 + s47*s110 - s48*s109 - s49*s108
    s112 = (((((s52 < 1e-06*s45) | (s57 < 1e-06*s39)) | (s64 < 1e-06*s43)) | (s76 < 1e-06*s30)) | (s83 < p31))
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
    ydot[9] = -p21*(s105 + s101 - s100)
    ydot[10] = -p21*(p18 + s104 - s99)
    ydot[11] = p22*(s103 - (s1*s105 - s0*s104 + s1*s102 - s0*s99))
    ydot[12] = p23*(s109 - s102)
    ydot[13] = -p23*(p19 + s99 + s107 - s106)
    ydot[14] = p24*(s7*s108 - (s8*s102 - s7*s99 + s8*s109))
    ydot[15] = -p25*(s109 + s111)
    ydot[16] = -p25*(p20 + s108 + s110)
    ydot[17] = p26*(s14*s110 - (s14*s108 - s15*s109 + s15*s111))
    ydot[18] = p4*s103
    w[15] = s105
    w[16] = s104
    w[17] = s102
    w[18] = s99
    w[19] = s109
    w[20] = s108
    w[21] = s111
    w[22] = s110
    w[23] = -s103
    return int(((s112 | (s88 < 1e-06*s32)) | (s91 < 1e-06*s36)))


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 395 operations, 321435 before sharing."""
    # inputs
    p3 = p[3]  # crank_start [rad]
    p4 = p[4]  # crank_speed [rad/s]
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    mask_1 = w[25]
    mask_2 = w[26]
    mask_3 = w[27]
    mask_4 = w[28]
    mask_5 = w[29]
    mask_7 = w[31]
    mask_8 = w[32]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
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
    s16 = q2 - (p3 + t*p4)
    s17 = s1*p22
    s18 = s0*p22
    s19 = s8*p24
    s20 = s5*p24
    s21 = s12*p26
    s22 = s10*p26
    s23 = s1*s17
    s24 = p21 + s23
    s25 = s0*s17
    s26 = s23 - p21
    s27 = s0*s18
    s28 = p21 + s27
    s29 = s8*s19
    s30 = s5*s19
    s31 = s29 - p23
    s32 = s5*s20
    s33 = s8*s20
    s34 = s12*s21
    s35 = s10*s21
    s36 = p25 - s34
    s37 = s10*s22
    s38 = s12*s22
    s39 = s1*s1
    s40 = 1.0 + s39
    s41 = s0*s1
    s42 = -1.0 + s39
    s43 = s0*s0
    s44 = 1.0 + s43
    s45 = s8*s8
    s46 = 1.0 + s40 + s45
    s47 = s5*s8
    s48 = -1.0 + s45
    s49 = s5*s5
    s50 = 1.0 + s44 + s49
    s51 = s12*s12
    s52 = 1.0 + 1.0 + s45 + s51
    s53 = s10*s12
    s54 = 1.0 - s51
    s55 = s10*s10
    s56 = 1.0 + 1.0 + s49 + s55
    s57 = 1.0 + s55
    s58 = 1.0/(1.0 + s51)
    s59 = s53*s58
    s60 = s54*s58
    s61 = s53*s59
    s62 = s57 - s61
    s63 = s53 + s54*s59
    s64 = 1.0 - s55 + s61
    s65 = 1.0*(s62 > mask_7 + 1e-12*s57)
    s66 = 1.0 - s65
    s67 = s65/(s62 + s66)
    s68 = s63*s67
    s69 = s52 - s54*s60 - s63*s68
    s70 = s47 + s53 + s53*s60 + s64*s68
    s71 = 1.0*(s69 > mask_4 + 1e-12*s52)
    s72 = 1.0 - s71
    s73 = s71/(s69 + s72)
    s74 = s70*s73
    s75 = s48*s73
    s76 = s56 - s61 - s64*(s64*s67) - s70*s74
    s77 = s48*s74 - s47
    s78 = -1.0 + s49 - s47*s74
    s79 = 1.0*(s76 > mask_5 + 1e-12*s56)
    s80 = 1.0 - s79
    s81 = s79/(s76 + s80)
    s82 = s77*s81
    s83 = 1.0/s40
    s84 = s41*s83
    s85 = s1*s83
    s86 = s42*s83
    s87 = s41*s84
    s88 = s44 - s87
    s89 = s1*s84 - s0
    s90 = s42*s84 - s41
    s91 = -1.0 + s43 - s87
    s92 = 1.0*(s88 > mask_1 + 1e-12*s44)
    s93 = 1.0 - s92
    s94 = s92/(s88 + s93)
    s95 = s89*s94
    s96 = s90*s94
    s97 = 1.0 - s1*s85 - s89*s95
    s98 = s1 - s42*s85 - s90*s95
    s99 = s41*s85 - s0 - s91*s95
    s100 = 1.0*(s97 > mask_8 + 1e-12)
    s101 = 1.0 - s100
    s102 = s100/(s97 + s101)
    s103 = s98*s102
    s104 = s46 - s48*s75 - s77*s82 - s42*s86 - s90*s96 - s98*s103
    s105 = s47*s75 - (s41 + s47) - s78*s82 + s41*s86 - s91*s96 - s99*s103
    s106 = 1.0*(s104 > mask_2 + 1e-12*s46)
    s107 = 1.0 - s106
    s108 = s50 - s47*(s47*s73) - s78*(s78*s81) - s87 - s91*(s91*s94) - s99*(s99*s102) - s105*(s105*(s106/(s104 + s107)))
    s109 = 1.0*(s108 > mask_3 + 1e-12*s50)
    s110 = 1.0/(p25 + s34)
    s111 = s35*s110
    s112 = s36*s110
    s113 = s38*s110
    s114 = s35 + s36*s111
    s115 = p25 - s37 + s38*s111
    s116 = s65/(s66 + p25 + s37 - s35*s111)
    s117 = s114*s116
    s118 = s115*s116
    s119 = s30 + s35 + s38*s112 + s115*s117
    s120 = s71/(s72 + p25 + p23 + s29 + s34 - s36*s112 - s114*s117)
    s121 = s119*s120
    s122 = s31*s120
    s123 = s33*s120
    s124 = s31*s121 - s30
    s125 = s32 - p23 - s33*s121
    s126 = s79/(s80 + p25 + p23 + s32 + s37 - s38*s113 - s115*s118 - s119*s121)
    s127 = s124*s126
    s128 = s125*s126
    s129 = 1.0/s24
    s130 = s25*s129
    s131 = -s130
    s132 = s17*s129
    s133 = s26*s129
    s134 = s25*s130
    s135 = s17*s130 - s18
    s136 = s26*s130 - s1*s18
    s137 = s27 - p21 - s134
    s138 = s92/(s93 + s28 - s134)
    s139 = s135*s138
    s140 = s136*s138
    s141 = s137*s138
    s142 = s17 - s26*s132 - s136*s139
    s143 = s25*s132 - s18 - s137*s139
    s144 = s100/(s101 + p22 - s17*s132 - s135*s139)
    s145 = s142*s144
    s146 = s143*s144
    s147 = s33*s122 - (s25 + s30) - s125*s127 + s25*s133 - s137*s140 - s143*s145
    s148 = s106/(s107 + p23 + s24 + s29 - s31*s122 - s124*s127 - s26*s133 - s136*s140 - s142*s145)
    s149 = s147*s148
    s150 = 1.0 - s109 + p23 + s28 + s32 - s33*s123 - s125*s128 - s134 - s137*s141 - s143*s146 - s147*s149
    s151 = s88/s44
    s152 = s104/s46
    s153 = s108/s50
    s154 = s69/s52
    s155 = s76/s56
    s156 = min(min(min(min(min(1.0, mask_1 + s151), mask_2 + s152), mask_3 + s153), mask_4 + s154), mask_5 + s155)
    s157 = s62/s57
    # outputs
    w[42] = s3
    w[43] = s4
    w[44] = s7
    w[45] = s9
    w[46] = s11
    w[47] = s13
    w[48] = s14
    w[49] = s15
    w[50] = s16
    w[0] = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15 + s16*s16)
    w[59] = p4
    w[87] = s1
    w[88] = s2
    w[89] = s1
    w[90] = s8
    w[91] = s2
    w[92] = s6
    w[93] = s8
    w[94] = -s12
    w[95] = s6
    w[96] = s10
    w[97] = s12
    w[98] = -s10
    w[61] = s151
    w[62] = s152
    w[63] = s153
    w[64] = s154
    w[65] = s155
    w[67] = s157
    w[68] = s97
    w[5] = s100 + s65 + 1.0 + s79 + s71 + s109 + s106 + 1.0 + s92
    w[4] = min(min(s156, mask_7 + s157), mask_8 + s97)
    w[128] = -s111
    w[129] = s112
    w[130] = s113
    w[131] = s117
    w[132] = s118
    w[133] = -s121
    w[134] = s122
    w[135] = -s123
    w[136] = s127
    w[137] = s128
    w[138] = s131
    w[139] = s132
    w[140] = s133
    w[141] = s131
    w[142] = s139
    w[143] = s140
    w[144] = s141
    w[145] = s145
    w[146] = s146
    w[147] = s149
    w[148] = s110
    w[149] = s116
    w[150] = s120
    w[151] = s126
    w[152] = s129
    w[153] = s138
    w[154] = s144
    w[155] = s148
    w[156] = s109/s150
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 129 operations, 10073 before sharing."""
    # inputs
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
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
    law_lower_12 = w[140]
    law_lower_13 = w[141]
    law_lower_14 = w[142]
    law_lower_15 = w[143]
    law_lower_16 = w[144]
    law_lower_17 = w[145]
    law_lower_18 = w[146]
    law_lower_19 = w[147]
    law_reciprocal_0 = w[148]
    law_reciprocal_1 = w[149]
    law_reciprocal_2 = w[150]
    law_reciprocal_3 = w[151]
    law_reciprocal_4 = w[152]
    law_reciprocal_5 = w[153]
    law_reciprocal_6 = w[154]
    law_reciprocal_7 = w[155]
    law_reciprocal_8 = w[156]
    residual_0 = w[42]
    residual_1 = w[43]
    residual_2 = w[44]
    residual_3 = w[45]
    residual_4 = w[46]
    residual_5 = w[47]
    residual_6 = w[48]
    residual_7 = w[49]
    residual_8 = w[50]
    jacobian_0 = w[87]
    jacobian_1 = w[88]
    jacobian_2 = w[89]
    jacobian_3 = w[90]
    jacobian_4 = w[91]
    jacobian_5 = w[92]
    jacobian_6 = w[93]
    jacobian_7 = w[94]
    jacobian_8 = w[95]
    jacobian_9 = w[96]
    jacobian_10 = w[97]
    jacobian_11 = w[98]
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
    w[69] = p21*(s9 - s8 - s13)
    w[70] = p21*(s12 - s7)
    w[71] = p22*(s11 + s12*jacobian_1 - s13*jacobian_0 + s10*jacobian_2 + s7*jacobian_4)
    w[72] = p23*(s10 + s18 - s17)
    w[73] = p23*(s7 + s15 - s14)
    w[74] = p24*(s10*jacobian_3 + s7*jacobian_5 + s19*jacobian_6 + s16*jacobian_8)
    w[75] = p25*(s19 - s21)
    w[76] = p25*(s16 + s20)
    w[77] = p26*(s19*jacobian_7 + s16*jacobian_9 - s21*jacobian_10 + s20*jacobian_11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(9):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(9):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[17] * w[6]
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
    measure(t, y, p, w)
    return bits
