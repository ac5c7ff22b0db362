"""Model `n-four-bar-2`: what every method of it shares. Emitted by symgen; do not edit.

digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 1, templates 8f8565515c2742ad
15 coordinates, 15 velocities, 14 constraint rows, 0 parameters,
0 fill-ins in the factor of D D^T

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     vertical0.x [m]
y[1]     vertical0.y [m]
y[2]     vertical0.theta [rad]
y[3]     coupler0.x [m]
y[4]     coupler0.y [m]
y[5]     coupler0.theta [rad]
y[6]     vertical1.x [m]
y[7]     vertical1.y [m]
y[8]     vertical1.theta [rad]
y[9]     coupler1.x [m]
y[10]    coupler1.y [m]
y[11]    coupler1.theta [rad]
y[12]    vertical2.x [m]
y[13]    vertical2.y [m]
y[14]    vertical2.theta [rad]
y[15]    vertical0.vx [m/s]
y[16]    vertical0.vy [m/s]
y[17]    vertical0.omega [rad/s]
y[18]    coupler0.vx [m/s]
y[19]    coupler0.vy [m/s]
y[20]    coupler0.omega [rad/s]
y[21]    vertical1.vx [m/s]
y[22]    vertical1.vy [m/s]
y[23]    vertical1.omega [rad/s]
y[24]    coupler1.vx [m/s]
y[25]    coupler1.vy [m/s]
y[26]    coupler1.omega [rad/s]
y[27]    vertical2.vx [m/s]
y[28]    vertical2.vy [m/s]
y[29]    vertical2.omega [rad/s]
y[30]    work of forces without potential and of drivers [J]
row 0    A0.x [m]
row 1    A0.y [m]
row 2    B0.x [m]
row 3    B0.y [m]
row 4    A1.x [m]
row 5    A1.y [m]
row 6    B1.x [m]
row 7    B1.y [m]
row 8    C1.x [m]
row 9    C1.y [m]
row 10   A2.x [m]
row 11   A2.y [m]
row 12   C2.x [m]
row 13   C2.y [m]

Left out:
- z coordinates, Euler parameters and 3x3 inertia tensors: the mechanism is planar
- the kinematic map N: planar velocities are the rates of the coordinates
- gyroscopic terms: they vanish in the plane
- columns of the ground: the ground does not move
- centre-of-mass offset of vertical0: its centre of mass is the frame's origin
- centre-of-mass offset of coupler0: its centre of mass is the frame's origin
- centre-of-mass offset of vertical1: its centre of mass is the frame's origin
- centre-of-mass offset of coupler1: its centre of mass is the frame's origin
- centre-of-mass offset of vertical2: its centre of mass is the frame's origin
"""

import math

import numpy as np
from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 355 operations, 6188886 before sharing."""
    # inputs
    q0 = y[0]  # vertical0.x [m]
    q1 = y[1]  # vertical0.y [m]
    q2 = y[2]  # vertical0.theta [rad]
    q3 = y[3]  # coupler0.x [m]
    q4 = y[4]  # coupler0.y [m]
    q5 = y[5]  # coupler0.theta [rad]
    q6 = y[6]  # vertical1.x [m]
    q7 = y[7]  # vertical1.y [m]
    q8 = y[8]  # vertical1.theta [rad]
    q9 = y[9]  # coupler1.x [m]
    q10 = y[10]  # coupler1.y [m]
    q11 = y[11]  # coupler1.theta [rad]
    q12 = y[12]  # vertical2.x [m]
    q13 = y[13]  # vertical2.y [m]
    q14 = y[14]  # vertical2.theta [rad]
    # intermediate terms
    s0 = 0.5*math.cos(q2)
    s1 = -s0
    s2 = 0.5*math.sin(q2)
    s3 = 0.5*math.cos(q5)
    s4 = -s3
    s5 = 0.5*math.sin(q5)
    s6 = 0.5*math.cos(q8)
    s7 = -s6
    s8 = 0.5*math.sin(q8)
    s9 = 0.5*math.cos(q11)
    s10 = -s9
    s11 = 0.5*math.sin(q11)
    s12 = 0.5*math.cos(q14)
    s13 = 0.5*math.sin(q14)
    s14 = s2*s2
    s15 = 1.0 + s14
    s16 = s0*s2
    s17 = -1.0 + s14
    s18 = s0*s0
    s19 = 1.0 + s18
    s20 = s5*s5
    s21 = 1.0 + s15 + s20
    s22 = s3*s5
    s23 = -1.0 + s20
    s24 = s3*s3
    s25 = 1.0 + s19 + s24
    s26 = s8*s8
    s27 = 1.0 + s26
    s28 = s6*s8
    s29 = -1.0 + s26
    s30 = 1.0 - s26
    s31 = s6*s6
    s32 = 1.0 + s31
    s33 = s11*s11
    s34 = 1.0 + s27 + s33
    s35 = s9*s11
    s36 = -1.0 + s33
    s37 = s9*s9
    s38 = 1.0 + s32 + s37
    s39 = s26 + 1.0 + 1.0 + s20
    s40 = s31 + 1.0 + 1.0 + s24
    s41 = s13*s13
    s42 = s12*s13
    s43 = 1.0 - s41
    s44 = s12*s12
    s45 = 1.0 + s44
    s46 = s41 + 1.0 + 1.0 + s33
    s47 = s44 + 1.0 + 1.0 + s37
    s48 = 1.0/s15
    s49 = s16*s48
    s50 = -s49
    s51 = s17*s48
    s52 = s16*s49
    s53 = s19 - s52
    s54 = s17*s49 - s16
    s55 = -1.0 + s18 - s52
    s56 = 1.0*(s53 > 1e-12*s19)
    s57 = s56/(s53 + 1.0 - s56)
    s58 = s54*s57
    s59 = s55*s57
    s60 = s21 - s17*s51 - s54*s58
    s61 = s16*s51 - (s16 + s22) - s55*s58
    s62 = 1.0/(1.0 + s41)
    s63 = s42*s62
    s64 = s43*s62
    s65 = s42*s63
    s66 = s45 - s65
    s67 = s42 + s43*s63
    s68 = 1.0 - s44 + s65
    s69 = 1.0*(s66 > 1e-12*s45)
    s70 = s69/(s66 + 1.0 - s69)
    s71 = s67*s70
    s72 = s68*s70
    s73 = s46 - s43*s64 - s67*s71
    s74 = s35 + s42 + s42*s64 + s68*s71
    s75 = 1.0*(s60 > 1e-12*s21)
    s76 = s75/(s60 + 1.0 - s75)
    s77 = s61*s76
    s78 = s23*s76
    s79 = s22*s76
    s80 = s25 - s52 - s55*s59 - s61*s77
    s81 = s22 + s23*s77
    s82 = -1.0 + s24 + s22*s77
    s83 = 1.0*(s80 > 1e-12*s25)
    s84 = s83/(s80 + 1.0 - s83)
    s85 = s81*s84
    s86 = s82*s84
    s87 = 1.0*(s73 > 1e-12*s46)
    s88 = s87/(s73 + 1.0 - s87)
    s89 = s74*s88
    s90 = s36*s88
    s91 = s35*s88
    s92 = s47 - s65 - s68*s72 - s74*s89
    s93 = s36*s89 - s35
    s94 = -1.0 + s37 - s35*s89
    s95 = 1.0*(s92 > 1e-12*s47)
    s96 = s95/(s92 + 1.0 - s95)
    s97 = s93*s96
    s98 = s94*s96
    s99 = 1.0/s27
    s100 = s28*s99
    s101 = -s100
    s102 = s29*s99
    s103 = s30*s99
    s104 = s28*s100
    s105 = s32 - s104
    s106 = s29*s100 - s28
    s107 = -1.0 + s31 - s104
    s108 = s28 + s30*s100
    s109 = 1.0 - s31 + s104
    s110 = s28*s102
    s111 = 1.0*(s105 > 1e-12*s32)
    s112 = s111/(s105 + 1.0 - s111)
    s113 = s106*s112
    s114 = s107*s112
    s115 = s108*s112
    s116 = s109*s112
    s117 = s34 - s36*s90 - s93*s97 - s29*s102 - s106*s113
    s118 = s35*s90 - (s28 + s35) - s94*s97 + s110 - s107*s113
    s119 = -1.0 - s26 - s30*s102 - s108*s113
    s120 = s28 - s110 - s109*s113
    s121 = 1.0*(s117 > 1e-12*s34)
    s122 = s121/(s117 + 1.0 - s121)
    s123 = s118*s122
    s124 = s119*s122
    s125 = s120*s122
    s126 = s38 - s35*s91 - s94*s98 - s104 - s107*s114 - s118*s123
    s127 = s108 - s108*s114 - s119*s123
    s128 = -1.0 - s31 + s104 - s109*s114 - s120*s123
    s129 = 1.0*(s126 > 1e-12*s38)
    s130 = s129/(s126 + 1.0 - s129)
    s131 = s127*s130
    s132 = s128*s130
    s133 = s39 - s23*s78 - s81*s85 - s30*s103 - s108*s115 - s119*s124 - s127*s131
    s134 = s22*s78 - (s22 + s28) + s82*s85 - s28*s103 - s109*s115 - s120*s124 - s128*s131
    s135 = 1.0*(s133 > 1e-12*s39)
    s136 = s135/(s133 + 1.0 - s135)
    s137 = s134*s136
    s138 = s40 - s22*s79 - s82*s86 - s104 - s109*s116 - s120*s125 - s128*s132 - s134*s137
    s139 = 1.0*(s138 > 1e-12*s40)
    # outputs
    w[50] = q0 - s0
    w[51] = q1 - s2
    w[52] = q3 - q0 - s3 - s0
    w[53] = q4 - q1 - s5 - s2
    w[54] = q6 - 1.0 - s6
    w[55] = q7 - s8
    w[56] = q9 - q6 - s9 - s6
    w[57] = q10 - q7 - s11 - s8
    w[58] = s6 + q6 - q3 - s3
    w[59] = s8 + q7 - q4 - s5
    w[60] = q12 - 2.0 - s12
    w[61] = q13 - s13
    w[62] = s12 + q12 - q9 - s9
    w[63] = s13 + q13 - q10 - s11
    w[150] = s2
    w[151] = s1
    w[152] = s2
    w[153] = s5
    w[154] = s1
    w[155] = s4
    w[156] = s8
    w[157] = s7
    w[158] = s8
    w[159] = s11
    w[160] = s7
    w[161] = s10
    w[162] = s5
    w[163] = -s8
    w[164] = s4
    w[165] = s6
    w[166] = s13
    w[167] = -s12
    w[168] = s11
    w[169] = -s13
    w[170] = s10
    w[171] = s12
    w[93] = s53/s19
    w[94] = s60/s21
    w[95] = s80/s25
    w[97] = s105/s32
    w[98] = s117/s34
    w[99] = s126/s38
    w[100] = s133/s39
    w[101] = s138/s40
    w[103] = s66/s45
    w[104] = s73/s46
    w[105] = s92/s47
    w[172] = s50
    w[173] = s51
    w[174] = s50
    w[175] = s58
    w[176] = s59
    w[177] = -s63
    w[178] = s64
    w[179] = s63
    w[180] = s71
    w[181] = s72
    w[182] = s77
    w[183] = s78
    w[184] = -s79
    w[185] = -s85
    w[186] = s86
    w[187] = -s89
    w[188] = s90
    w[189] = -s91
    w[190] = s97
    w[191] = s98
    w[192] = s101
    w[193] = s102
    w[194] = s101
    w[195] = s103
    w[196] = s100
    w[197] = s113
    w[198] = s114
    w[199] = s115
    w[200] = s116
    w[201] = s123
    w[202] = s124
    w[203] = s125
    w[204] = s131
    w[205] = s132
    w[206] = s137
    w[207] = s48
    w[208] = s57
    w[209] = s62
    w[210] = s70
    w[211] = s76
    w[212] = s84
    w[213] = s88
    w[214] = s96
    w[215] = s99
    w[216] = s112
    w[217] = s122
    w[218] = s130
    w[219] = s136
    w[220] = s139/(s138 + 1.0 - s139)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """change of v (or of q by N) = D^+ times the section `right`: 212 operations, 110301 before sharing."""
    # inputs
    lower_0 = w[172]
    lower_1 = w[173]
    lower_2 = w[174]
    lower_3 = w[175]
    lower_4 = w[176]
    lower_5 = w[177]
    lower_6 = w[178]
    lower_7 = w[179]
    lower_8 = w[180]
    lower_9 = w[181]
    lower_10 = w[182]
    lower_11 = w[183]
    lower_12 = w[184]
    lower_13 = w[185]
    lower_14 = w[186]
    lower_15 = w[187]
    lower_16 = w[188]
    lower_17 = w[189]
    lower_18 = w[190]
    lower_19 = w[191]
    lower_20 = w[192]
    lower_21 = w[193]
    lower_22 = w[194]
    lower_23 = w[195]
    lower_24 = w[196]
    lower_25 = w[197]
    lower_26 = w[198]
    lower_27 = w[199]
    lower_28 = w[200]
    lower_29 = w[201]
    lower_30 = w[202]
    lower_31 = w[203]
    lower_32 = w[204]
    lower_33 = w[205]
    lower_34 = w[206]
    reciprocal_0 = w[207]
    reciprocal_1 = w[208]
    reciprocal_2 = w[209]
    reciprocal_3 = w[210]
    reciprocal_4 = w[211]
    reciprocal_5 = w[212]
    reciprocal_6 = w[213]
    reciprocal_7 = w[214]
    reciprocal_8 = w[215]
    reciprocal_9 = w[216]
    reciprocal_10 = w[217]
    reciprocal_11 = w[218]
    reciprocal_12 = w[219]
    reciprocal_13 = w[220]
    right_0 = w[106]
    right_1 = w[107]
    right_2 = w[108]
    right_3 = w[109]
    right_4 = w[110]
    right_5 = w[111]
    right_6 = w[112]
    right_7 = w[113]
    right_8 = w[114]
    right_9 = w[115]
    right_10 = w[116]
    right_11 = w[117]
    right_12 = w[118]
    right_13 = w[119]
    jacobian_0 = w[150]
    jacobian_1 = w[151]
    jacobian_2 = w[152]
    jacobian_3 = w[153]
    jacobian_4 = w[154]
    jacobian_5 = w[155]
    jacobian_6 = w[156]
    jacobian_7 = w[157]
    jacobian_8 = w[158]
    jacobian_9 = w[159]
    jacobian_10 = w[160]
    jacobian_11 = w[161]
    jacobian_12 = w[162]
    jacobian_13 = w[163]
    jacobian_14 = w[164]
    jacobian_15 = w[165]
    jacobian_16 = w[166]
    jacobian_17 = w[167]
    jacobian_18 = w[168]
    jacobian_19 = w[169]
    jacobian_20 = w[170]
    jacobian_21 = w[171]
    # intermediate terms
    s0 = right_1 - lower_0*right_0
    s1 = right_2 - lower_1*right_0 - lower_3*s0
    s2 = right_11 - lower_5*right_10
    s3 = right_12 - lower_6*right_10 - lower_8*s2
    s4 = right_3 - lower_2*right_0 - lower_4*s0 - lower_10*s1
    s5 = right_13 - lower_7*right_10 - lower_9*s2 - lower_15*s3
    s6 = right_5 - lower_20*right_4
    s7 = right_6 - lower_16*s3 - lower_18*s5 - lower_21*right_4 - lower_25*s6
    s8 = right_7 - lower_17*s3 - lower_19*s5 - lower_22*right_4 - lower_26*s6 - lower_29*s7
    s9 = right_8 - lower_11*s1 - lower_13*s4 - lower_23*right_4 - lower_27*s6 - lower_30*s7 - lower_32*s8
    s10 = right_9 - lower_12*s1 - lower_14*s4 - lower_24*right_4 - lower_28*s6 - lower_31*s7 - lower_33*s8
    s11 = reciprocal_13*(s10 - lower_34*s9)
    s12 = reciprocal_12*s9
    s13 = lower_34*s11
    s14 = s12 - s13
    s15 = reciprocal_11*s8 - lower_32*s14
    s16 = lower_33*s11
    s17 = s15 - s16
    s18 = reciprocal_10*s7 - lower_29*s17 - lower_30*s14
    s19 = lower_31*s11
    s20 = s18 - s19
    s21 = reciprocal_9*s6 - lower_25*s20 - lower_26*s17 - lower_27*s14 - lower_28*s11
    s22 = reciprocal_8*right_4 - lower_20*s21 - lower_21*s20 - lower_22*s17 - lower_23*s14 - lower_24*s11
    s23 = reciprocal_7*s5 - lower_18*s20
    s24 = lower_19*s17
    s25 = s23 - s24
    s26 = reciprocal_6*s3 - lower_15*s25 - lower_16*s20
    s27 = lower_17*s17
    s28 = s26 - s27
    s29 = reciprocal_5*s4 - lower_13*s14
    s30 = lower_14*s11
    s31 = s29 - s30
    s32 = reciprocal_4*s1 - lower_10*s31 - lower_11*s14
    s33 = lower_12*s11
    s34 = s32 - s33
    s35 = reciprocal_3*s2 - lower_8*s28 - lower_9*s25
    s36 = reciprocal_2*right_10 - lower_5*s35 - lower_6*s28 - lower_7*s25
    s37 = reciprocal_1*s0 - lower_3*s34 - lower_4*s31
    s38 = reciprocal_0*right_0 - lower_0*s37 - lower_1*s34 - lower_2*s31
    s39 = s22*jacobian_6 + s21*jacobian_7 + s20*jacobian_8 + s17*jacobian_10 + s14*jacobian_13 + s11*jacobian_15
    # outputs
    w[120] = s38 + s33 - s32
    w[121] = s37 + s30 - s29
    w[122] = s38*jacobian_0 + s37*jacobian_1 + s34*jacobian_2 + s31*jacobian_4
    w[123] = s34 + s13 - s12
    w[124] = s31 - s11
    w[125] = s34*jacobian_3 + s31*jacobian_5 + s14*jacobian_12 + s11*jacobian_14
    w[126] = s14 + s22 + s19 - s18
    w[127] = s11 + s21 + s16 - s15
    w[128] = s39
    w[129] = s20 + s27 - s26
    w[130] = s17 + s24 - s23
    w[131] = s20*jacobian_9 + s17*jacobian_11 + s28*jacobian_18 + s25*jacobian_20
    w[132] = s28 + s36
    w[133] = s25 + s35
    w[134] = s36*jacobian_16 + s35*jacobian_17 + s28*jacobian_19 + s25*jacobian_21
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def drift(y, w):
    """D v - nu with the D and nu that `geometry` left: 52 operations, 52 before sharing."""
    # inputs
    v0 = y[15]  # vertical0.vx [m/s]
    v1 = y[16]  # vertical0.vy [m/s]
    v2 = y[17]  # vertical0.omega [rad/s]
    v3 = y[18]  # coupler0.vx [m/s]
    v4 = y[19]  # coupler0.vy [m/s]
    v5 = y[20]  # coupler0.omega [rad/s]
    v6 = y[21]  # vertical1.vx [m/s]
    v7 = y[22]  # vertical1.vy [m/s]
    v8 = y[23]  # vertical1.omega [rad/s]
    v9 = y[24]  # coupler1.vx [m/s]
    v10 = y[25]  # coupler1.vy [m/s]
    v11 = y[26]  # coupler1.omega [rad/s]
    v12 = y[27]  # vertical2.vx [m/s]
    v13 = y[28]  # vertical2.vy [m/s]
    v14 = y[29]  # vertical2.omega [rad/s]
    jacobian_0 = w[150]
    jacobian_1 = w[151]
    jacobian_2 = w[152]
    jacobian_3 = w[153]
    jacobian_4 = w[154]
    jacobian_5 = w[155]
    jacobian_6 = w[156]
    jacobian_7 = w[157]
    jacobian_8 = w[158]
    jacobian_9 = w[159]
    jacobian_10 = w[160]
    jacobian_11 = w[161]
    jacobian_12 = w[162]
    jacobian_13 = w[163]
    jacobian_14 = w[164]
    jacobian_15 = w[165]
    jacobian_16 = w[166]
    jacobian_17 = w[167]
    jacobian_18 = w[168]
    jacobian_19 = w[169]
    jacobian_20 = w[170]
    jacobian_21 = w[171]
    # outputs
    w[78] = v0 + v2*jacobian_0
    w[79] = v1 + v2*jacobian_1
    w[80] = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    w[81] = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    w[82] = v6 + v8*jacobian_6
    w[83] = v7 + v8*jacobian_7
    w[84] = v9 + v8*jacobian_8 - v6 + v11*jacobian_9
    w[85] = v10 + v8*jacobian_10 - v7 + v11*jacobian_11
    w[86] = v6 + v5*jacobian_12 - v3 + v8*jacobian_13
    w[87] = v7 + v5*jacobian_14 - v4 + v8*jacobian_15
    w[88] = v12 + v14*jacobian_16
    w[89] = v13 + v14*jacobian_17
    w[90] = v12 + v11*jacobian_18 - v9 + v14*jacobian_19
    w[91] = v13 + v11*jacobian_20 - v10 + v14*jacobian_21
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def energies(t, y, p, w):
    """kinetic and potential energy: 53 operations, 53 before sharing."""
    # inputs
    v0 = y[15]  # vertical0.vx [m/s]
    q1 = y[1]  # vertical0.y [m]
    v1 = y[16]  # vertical0.vy [m/s]
    v2 = y[17]  # vertical0.omega [rad/s]
    v3 = y[18]  # coupler0.vx [m/s]
    q4 = y[4]  # coupler0.y [m]
    v4 = y[19]  # coupler0.vy [m/s]
    v5 = y[20]  # coupler0.omega [rad/s]
    v6 = y[21]  # vertical1.vx [m/s]
    q7 = y[7]  # vertical1.y [m]
    v7 = y[22]  # vertical1.vy [m/s]
    v8 = y[23]  # vertical1.omega [rad/s]
    v9 = y[24]  # coupler1.vx [m/s]
    q10 = y[10]  # coupler1.y [m]
    v10 = y[25]  # coupler1.vy [m/s]
    v11 = y[26]  # coupler1.omega [rad/s]
    v12 = y[27]  # vertical2.vx [m/s]
    q13 = y[13]  # vertical2.y [m]
    v13 = y[28]  # vertical2.vy [m/s]
    v14 = y[29]  # vertical2.omega [rad/s]
    # intermediate terms
    s0 = 0.5*(v0*v0) + 0.5*(v1*v1) + 0.041666666666666664*(v2*v2) + 0.5*(v3*v3) + 0.5*(v4*v4) + 0.041666666666666664*(v5*v5)
    s1 = s0 + 0.5*(v6*v6) + 0.5*(v7*v7) + 0.041666666666666664*(v8*v8) + 0.5*(v9*v9) + 0.5*(v10*v10)
    s2 = s1 + 0.041666666666666664*(v11*v11) + 0.5*(v12*v12) + 0.5*(v13*v13) + 0.041666666666666664*(v14*v14)
    # outputs
    w[2] = s2
    w[3] = 9.81*q1 + 9.81*q4 + 9.81*q7 + 9.81*q10 + 9.81*q13
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates: 110 operations, 214 before sharing."""
    # inputs
    q2 = y[2]  # vertical0.theta [rad]
    v2 = y[17]  # vertical0.omega [rad/s]
    q5 = y[5]  # coupler0.theta [rad]
    v5 = y[20]  # coupler0.omega [rad/s]
    q8 = y[8]  # vertical1.theta [rad]
    v8 = y[23]  # vertical1.omega [rad/s]
    q11 = y[11]  # coupler1.theta [rad]
    v11 = y[26]  # coupler1.omega [rad/s]
    q14 = y[14]  # vertical2.theta [rad]
    v14 = y[29]  # vertical2.omega [rad/s]
    ydot_15 = ydot[15]
    ydot_16 = ydot[16]
    ydot_17 = ydot[17]
    ydot_18 = ydot[18]
    ydot_19 = ydot[19]
    ydot_20 = ydot[20]
    ydot_21 = ydot[21]
    ydot_22 = ydot[22]
    ydot_23 = ydot[23]
    ydot_24 = ydot[24]
    ydot_25 = ydot[25]
    ydot_26 = ydot[26]
    ydot_27 = ydot[27]
    ydot_28 = ydot[28]
    ydot_29 = ydot[29]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 0.5*(v2*v2)
    s3 = s0*s2
    s4 = s1*s2
    s5 = math.cos(q5)
    s6 = math.sin(q5)
    s7 = 0.5*(v5*v5)
    s8 = s5*s7
    s9 = s6*s7
    s10 = math.cos(q8)
    s11 = math.sin(q8)
    s12 = 0.5*(v8*v8)
    s13 = s10*s12
    s14 = s11*s12
    s15 = math.cos(q11)
    s16 = math.sin(q11)
    s17 = 0.5*(v11*v11)
    s18 = s15*s17
    s19 = s16*s17
    s20 = math.cos(q14)
    s21 = math.sin(q14)
    s22 = 0.5*(v14*v14)
    s23 = s20*s22
    s24 = s21*s22
    s25 = 0.5*s1*ydot_17
    s26 = 0.5*s0*ydot_17
    s27 = 0.5*s6*ydot_20
    s28 = 0.5*s5*ydot_20
    s29 = 0.5*s11*ydot_23
    s30 = 0.5*s10*ydot_23
    s31 = 0.5*s16*ydot_26
    s32 = 0.5*s15*ydot_26
    s33 = 0.5*s21*ydot_29
    s34 = 0.5*s20*ydot_29
    # outputs
    out[0] = s3 + ydot_15 + s25
    out[1] = s4 + ydot_16 - s26
    out[2] = s3 + s8 + ydot_18 + s25 - ydot_15 + s27
    out[3] = s4 + s9 + ydot_19 - (ydot_16 + s26) - s28
    out[4] = s13 + ydot_21 + s29
    out[5] = s14 + ydot_22 - s30
    out[6] = s13 + s18 + ydot_24 + s29 - ydot_21 + s31
    out[7] = s14 + s19 + ydot_25 - (ydot_22 + s30) - s32
    out[8] = ydot_21 + s27 - ydot_18 - s29 - (s13 - s8)
    out[9] = s30 + ydot_22 - (ydot_19 + s28) - (s14 - s9)
    out[10] = s23 + ydot_27 + s33
    out[11] = s24 + ydot_28 - s34
    out[12] = ydot_27 + s31 - ydot_24 - s33 - (s23 - s18)
    out[13] = s34 + ydot_28 - (ydot_25 + s32) - (s24 - s19)
    out[14] = q2
    out[15] = v2
    out[16] = q5 - q2
    out[17] = v5 - v2
    out[18] = q8
    out[19] = v8
    out[20] = q11 - q8
    out[21] = v11 - v8
    out[22] = q8 - q5
    out[23] = v8 - v5
    out[24] = q14
    out[25] = v14
    out[26] = q14 - q11
    out[27] = v14 - v11
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # outputs
    w[135] = 1.0
    w[136] = 1.0
    w[137] = 0.08333333333333333
    w[138] = 1.0
    w[139] = 1.0
    w[140] = 0.08333333333333333
    w[141] = 1.0
    w[142] = 1.0
    w[143] = 0.08333333333333333
    w[144] = 1.0
    w[145] = 1.0
    w[146] = 0.08333333333333333
    w[147] = 1.0
    w[148] = 1.0
    w[149] = 0.08333333333333333
    return 0
