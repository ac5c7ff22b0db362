"""Method `direct-correction` for model `driven-four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 1, templates 8f8565515c2742ad
option weight = mass
p[17] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import drift, energies

PHI = 35  # sections of w
DRIFT = 53
PIVOT = 62
MASK = 17
RIGHT = 71
CHANGE = 80
SAVED = 26


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
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    mask_0 = w[17]
    mask_1 = w[18]
    mask_2 = w[19]
    mask_3 = w[20]
    mask_4 = w[21]
    mask_5 = w[22]
    mask_6 = w[23]
    mask_7 = w[24]
    mask_8 = w[25]
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
    w[8] = s105
    w[9] = s104
    w[10] = s102
    w[11] = s99
    w[12] = s109
    w[13] = s108
    w[14] = s111
    w[15] = s110
    w[16] = -s103
    return int(((s112 | (s88 < 1e-06*s32)) | (s91 < 1e-06*s36)))


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 348 operations, 224587 before sharing."""
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
    s3 = 4.0*math.cos(q5)
    s4 = -s3
    s5 = 4.0*math.sin(q5)
    s6 = 2.5*math.cos(q8)
    s7 = 2.5*math.sin(q8)
    s8 = s1*p22
    s9 = s0*p22
    s10 = s5*p24
    s11 = s3*p24
    s12 = s7*p26
    s13 = s6*p26
    s14 = s1*s8
    s15 = p21 + s14
    s16 = s0*s8
    s17 = s14 - p21
    s18 = s0*s9
    s19 = p21 + s18
    s20 = s5*s10
    s21 = s3*s10
    s22 = s20 - p23
    s23 = s3*s11
    s24 = s5*s11
    s25 = s7*s12
    s26 = s6*s12
    s27 = p25 - s25
    s28 = s6*s13
    s29 = s7*s13
    s30 = s1*s1
    s31 = 1.0 + s30
    s32 = s0*s1
    s33 = -1.0 + s30
    s34 = s0*s0
    s35 = 1.0 + s34
    s36 = s5*s5
    s37 = 1.0 + s31 + s36
    s38 = s3*s5
    s39 = -1.0 + s36
    s40 = s3*s3
    s41 = 1.0 + s35 + s40
    s42 = s7*s7
    s43 = 1.0 + 1.0 + s36 + s42
    s44 = s6*s7
    s45 = 1.0 - s42
    s46 = s6*s6
    s47 = 1.0 + 1.0 + s40 + s46
    s48 = 1.0 + s46
    s49 = 1.0/(1.0 + s42)
    s50 = s44*s49
    s51 = s45*s49
    s52 = s44*s50
    s53 = s48 - s52
    s54 = s44 + s45*s50
    s55 = 1.0 - s46 + s52
    s56 = 1.0*(s53 > 1e-12*s48)
    s57 = 1.0 - s56
    s58 = s56/(s53 + s57)
    s59 = s54*s58
    s60 = s43 - s45*s51 - s54*s59
    s61 = s38 + s44 + s44*s51 + s55*s59
    s62 = 1.0*(s60 > 1e-12*s43)
    s63 = 1.0 - s62
    s64 = s62/(s60 + s63)
    s65 = s61*s64
    s66 = s39*s64
    s67 = s47 - s52 - s55*(s55*s58) - s61*s65
    s68 = s39*s65 - s38
    s69 = -1.0 + s40 - s38*s65
    s70 = 1.0*(s67 > 1e-12*s47)
    s71 = 1.0 - s70
    s72 = s70/(s67 + s71)
    s73 = s68*s72
    s74 = 1.0/s31
    s75 = s32*s74
    s76 = s1*s74
    s77 = s33*s74
    s78 = s32*s75
    s79 = s35 - s78
    s80 = s1*s75 - s0
    s81 = s33*s75 - s32
    s82 = -1.0 + s34 - s78
    s83 = 1.0*(s79 > 1e-12*s35)
    s84 = 1.0 - s83
    s85 = s83/(s79 + s84)
    s86 = s80*s85
    s87 = s81*s85
    s88 = 1.0 - s1*s76 - s80*s86
    s89 = s1 - s33*s76 - s81*s86
    s90 = s32*s76 - s0 - s82*s86
    s91 = 1.0*(s88 > 1e-12)
    s92 = 1.0 - s91
    s93 = s91/(s88 + s92)
    s94 = s89*s93
    s95 = s37 - s39*s66 - s68*s73 - s33*s77 - s81*s87 - s89*s94
    s96 = s38*s66 - (s32 + s38) - s69*s73 + s32*s77 - s82*s87 - s90*s94
    s97 = 1.0*(s95 > 1e-12*s37)
    s98 = 1.0 - s97
    s99 = s41 - s38*(s38*s64) - s69*(s69*s72) - s78 - s82*(s82*s85) - s90*(s90*s93) - s96*(s96*(s97/(s95 + s98)))
    s100 = 1.0*(s99 > 1e-12*s41)
    s101 = 1.0/(p25 + s25)
    s102 = s26*s101
    s103 = s27*s101
    s104 = s29*s101
    s105 = s26 + s27*s102
    s106 = p25 - s28 + s29*s102
    s107 = s56/(s57 + p25 + s28 - s26*s102)
    s108 = s105*s107
    s109 = s106*s107
    s110 = s21 + s26 + s29*s103 + s106*s108
    s111 = s62/(s63 + p25 + p23 + s20 + s25 - s27*s103 - s105*s108)
    s112 = s110*s111
    s113 = s22*s111
    s114 = s24*s111
    s115 = s22*s112 - s21
    s116 = s23 - p23 - s24*s112
    s117 = s70/(s71 + p25 + p23 + s23 + s28 - s29*s104 - s106*s109 - s110*s112)
    s118 = s115*s117
    s119 = s116*s117
    s120 = 1.0/s15
    s121 = s16*s120
    s122 = -s121
    s123 = s8*s120
    s124 = s17*s120
    s125 = s16*s121
    s126 = s8*s121 - s9
    s127 = s17*s121 - s1*s9
    s128 = s18 - p21 - s125
    s129 = s83/(s84 + s19 - s125)
    s130 = s126*s129
    s131 = s127*s129
    s132 = s128*s129
    s133 = s8 - s17*s123 - s127*s130
    s134 = s16*s123 - s9 - s128*s130
    s135 = s91/(s92 + p22 - s8*s123 - s126*s130)
    s136 = s133*s135
    s137 = s134*s135
    s138 = s24*s113 - (s16 + s21) - s116*s118 + s16*s124 - s128*s131 - s134*s136
    s139 = s97/(s98 + p23 + s15 + s20 - s22*s113 - s115*s118 - s17*s124 - s127*s131 - s133*s136)
    s140 = s138*s139
    s141 = 1.0 - s100 + p23 + s19 + s23 - s24*s114 - s116*s119 - s125 - s128*s132 - s134*s137 - s138*s140
    # outputs
    w[35] = q0 - s0
    w[36] = q1 - s1
    w[37] = q3 - q0 - s3 - s0
    w[38] = q4 - q1 - s5 - s1
    w[39] = q6 - q3 + s6 - s3
    w[40] = q7 - q4 + s7 - s5
    w[41] = q6 - 10.0 - s6
    w[42] = q7 - s7
    w[43] = q2 - (p3 + t*p4)
    w[52] = p4
    w[98] = s1
    w[99] = s2
    w[100] = s1
    w[101] = s5
    w[102] = s2
    w[103] = s4
    w[104] = s5
    w[105] = -s7
    w[106] = s4
    w[107] = s6
    w[108] = s7
    w[109] = -s6
    w[63] = s79/s35
    w[64] = s95/s37
    w[65] = s99/s41
    w[66] = s60/s43
    w[67] = s67/s47
    w[69] = s53/s48
    w[70] = s88
    w[139] = -s102
    w[140] = s103
    w[141] = s104
    w[142] = s108
    w[143] = s109
    w[144] = -s112
    w[145] = s113
    w[146] = -s114
    w[147] = s118
    w[148] = s119
    w[149] = s122
    w[150] = s123
    w[151] = s124
    w[152] = s122
    w[153] = s130
    w[154] = s131
    w[155] = s132
    w[156] = s136
    w[157] = s137
    w[158] = s140
    w[159] = s101
    w[160] = s107
    w[161] = s111
    w[162] = s117
    w[163] = s120
    w[164] = s129
    w[165] = s135
    w[166] = s139
    w[167] = s100/s141
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """change of v (or of q by N) = D^+ times the section `right`: 129 operations, 10073 before sharing."""
    # inputs
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    law_lower_0 = w[139]
    law_lower_1 = w[140]
    law_lower_2 = w[141]
    law_lower_3 = w[142]
    law_lower_4 = w[143]
    law_lower_5 = w[144]
    law_lower_6 = w[145]
    law_lower_7 = w[146]
    law_lower_8 = w[147]
    law_lower_9 = w[148]
    law_lower_10 = w[149]
    law_lower_11 = w[150]
    law_lower_12 = w[151]
    law_lower_13 = w[152]
    law_lower_14 = w[153]
    law_lower_15 = w[154]
    law_lower_16 = w[155]
    law_lower_17 = w[156]
    law_lower_18 = w[157]
    law_lower_19 = w[158]
    law_reciprocal_0 = w[159]
    law_reciprocal_1 = w[160]
    law_reciprocal_2 = w[161]
    law_reciprocal_3 = w[162]
    law_reciprocal_4 = w[163]
    law_reciprocal_5 = w[164]
    law_reciprocal_6 = w[165]
    law_reciprocal_7 = w[166]
    law_reciprocal_8 = w[167]
    right_0 = w[71]
    right_1 = w[72]
    right_2 = w[73]
    right_3 = w[74]
    right_4 = w[75]
    right_5 = w[76]
    right_6 = w[77]
    right_7 = w[78]
    right_8 = w[79]
    jacobian_0 = w[98]
    jacobian_1 = w[99]
    jacobian_2 = w[100]
    jacobian_3 = w[101]
    jacobian_4 = w[102]
    jacobian_5 = w[103]
    jacobian_6 = w[104]
    jacobian_7 = w[105]
    jacobian_8 = w[106]
    jacobian_9 = w[107]
    jacobian_10 = w[108]
    jacobian_11 = w[109]
    # intermediate terms
    s0 = right_7 - law_lower_0*right_6
    s1 = right_4 - law_lower_1*right_6 - law_lower_3*s0
    s2 = right_5 - law_lower_2*right_6 - law_lower_4*s0 - law_lower_5*s1
    s3 = right_1 - law_lower_10*right_0
    s4 = right_8 - law_lower_11*right_0 - law_lower_14*s3
    s5 = right_2 - law_lower_6*s1 - law_lower_8*s2 - law_lower_12*right_0 - law_lower_15*s3 - law_lower_17*s4
    s6 = right_3 - law_lower_7*s1 - law_lower_9*s2 - law_lower_13*right_0 - law_lower_16*s3 - law_lower_18*s4
    s7 = law_reciprocal_8*(s6 - law_lower_19*s5)
    s8 = law_reciprocal_7*s5
    s9 = law_lower_19*s7
    s10 = s8 - s9
    s11 = law_reciprocal_6*s4 - law_lower_17*s10 - law_lower_18*s7
    s12 = law_reciprocal_5*s3 - law_lower_14*s11 - law_lower_15*s10 - law_lower_16*s7
    s13 = law_reciprocal_4*right_0 - law_lower_10*s12 - law_lower_11*s11 - law_lower_12*s10 - law_lower_13*s7
    s14 = law_reciprocal_3*s2 - law_lower_8*s10
    s15 = law_lower_9*s7
    s16 = s14 - s15
    s17 = law_reciprocal_2*s1 - law_lower_5*s16 - law_lower_6*s10
    s18 = law_lower_7*s7
    s19 = s17 - s18
    s20 = law_reciprocal_1*s0 - law_lower_3*s19 - law_lower_4*s16
    s21 = law_reciprocal_0*right_6 - law_lower_0*s20 - law_lower_1*s19 - law_lower_2*s16
    # outputs
    w[80] = p21*(s13 + s9 - s8)
    w[81] = p21*(s12 - s7)
    w[82] = p22*(s11 + s13*jacobian_0 + s12*jacobian_1 + s10*jacobian_2 + s7*jacobian_4)
    w[83] = p23*(s10 + s18 - s17)
    w[84] = p23*(s7 + s15 - s14)
    w[85] = p24*(s10*jacobian_3 + s7*jacobian_5 + s19*jacobian_6 + s16*jacobian_8)
    w[86] = p25*(s19 + s21)
    w[87] = p25*(s16 + s20)
    w[88] = p26*(s19*jacobian_7 + s16*jacobian_9 + s21*jacobian_10 + s20*jacobian_11)
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
def norm(w, first):
    """Euclidean norm of a section of 9 rows."""
    total = 0.0
    for i in range(first, first + 9):
        total += w[i] * w[i]
    return math.sqrt(total)


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    bits = 0
    geometry(t, y, p, w)
    violation = norm(w, PHI)
    tolerance = p[17] * w[6]
    last = math.inf
    for _ in range(12):
        # at the floor of rounding another iteration gains nothing
        if violation <= tolerance or (violation > 0.5 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        for i in range(9):
            w[RIGHT + i] = -w[PHI + i]
        spread(p, w)
        for j in range(9):
            y[j] += w[CHANGE + j]
        iw[3] += 1
        bits |= 2
        geometry(t, y, p, w)
        violation = norm(w, PHI)
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    drift(y, w)
    for i in range(9):
        w[RIGHT + i] = -w[DRIFT + i]
    spread(p, w)
    for j in range(9):
        y[9 + j] += w[CHANGE + j]
    drift(y, w)
    bits |= 2
    energies(t, y, p, w)
    smallest = 1.0
    rank = 0
    for i in range(9):
        pivot = w[PIVOT + i]
        if pivot >= 1e-12:
            rank += 1
        if w[MASK + i] == 0.0 and pivot < smallest:
            smallest = pivot
    w[0] = violation
    w[1] = norm(w, DRIFT)
    w[4] = smallest
    w[5] = rank
    return bits
