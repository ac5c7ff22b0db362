"""Model `n-four-bar-2`: what every method of it shares. Emitted by symgen; do not edit.

digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 2, templates 06e8f0c6b361de81
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

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 429 operations, 8869759 before sharing."""
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
    mask_1 = w[30]
    mask_2 = w[31]
    mask_3 = w[32]
    mask_5 = w[34]
    mask_6 = w[35]
    mask_7 = w[36]
    mask_8 = w[37]
    mask_9 = w[38]
    mask_11 = w[40]
    mask_12 = w[41]
    mask_13 = w[42]
    # intermediate terms
    s0 = 0.5*math.cos(q2)
    s1 = -s0
    s2 = q0 - s0
    s3 = 0.5*math.sin(q2)
    s4 = q1 - s3
    s5 = 0.5*math.cos(q5)
    s6 = -s5
    s7 = q3 - q0 - s5 - s0
    s8 = 0.5*math.sin(q5)
    s9 = q4 - q1 - s8 - s3
    s10 = 0.5*math.cos(q8)
    s11 = -s10
    s12 = q6 - 1.0 - s10
    s13 = 0.5*math.sin(q8)
    s14 = q7 - s13
    s15 = 0.5*math.cos(q11)
    s16 = -s15
    s17 = q9 - q6 - s15 - s10
    s18 = 0.5*math.sin(q11)
    s19 = q10 - q7 - s18 - s13
    s20 = s10 + q6 - q3 - s5
    s21 = s13 + q7 - q4 - s8
    s22 = 0.5*math.cos(q14)
    s23 = q12 - 2.0 - s22
    s24 = 0.5*math.sin(q14)
    s25 = q13 - s24
    s26 = s22 + q12 - q9 - s15
    s27 = s24 + q13 - q10 - s18
    s28 = s3*s3
    s29 = 1.0 + s28
    s30 = s0*s3
    s31 = -1.0 + s28
    s32 = s0*s0
    s33 = 1.0 + s32
    s34 = s8*s8
    s35 = 1.0 + s29 + s34
    s36 = s5*s8
    s37 = -1.0 + s34
    s38 = s5*s5
    s39 = 1.0 + s33 + s38
    s40 = s13*s13
    s41 = 1.0 + s40
    s42 = s10*s13
    s43 = -1.0 + s40
    s44 = 1.0 - s40
    s45 = s10*s10
    s46 = 1.0 + s45
    s47 = s18*s18
    s48 = 1.0 + s41 + s47
    s49 = s15*s18
    s50 = -1.0 + s47
    s51 = s15*s15
    s52 = 1.0 + s46 + s51
    s53 = s40 + 1.0 + 1.0 + s34
    s54 = s45 + 1.0 + 1.0 + s38
    s55 = s24*s24
    s56 = s22*s24
    s57 = 1.0 - s55
    s58 = s22*s22
    s59 = 1.0 + s58
    s60 = s55 + 1.0 + 1.0 + s47
    s61 = s58 + 1.0 + 1.0 + s51
    s62 = 1.0/s29
    s63 = s30*s62
    s64 = -s63
    s65 = s31*s62
    s66 = s30*s63
    s67 = s33 - s66
    s68 = s31*s63 - s30
    s69 = -1.0 + s32 - s66
    s70 = 1.0*(s67 > mask_1 + 1e-12*s33)
    s71 = s70/(s67 + 1.0 - s70)
    s72 = s68*s71
    s73 = s69*s71
    s74 = s35 - s31*s65 - s68*s72
    s75 = s30*s65 - (s30 + s36) - s69*s72
    s76 = 1.0/(1.0 + s55)
    s77 = s56*s76
    s78 = s57*s76
    s79 = s56*s77
    s80 = s59 - s79
    s81 = s56 + s57*s77
    s82 = 1.0 - s58 + s79
    s83 = 1.0*(s80 > mask_11 + 1e-12*s59)
    s84 = s83/(s80 + 1.0 - s83)
    s85 = s81*s84
    s86 = s82*s84
    s87 = s60 - s57*s78 - s81*s85
    s88 = s49 + s56 + s56*s78 + s82*s85
    s89 = 1.0*(s74 > mask_2 + 1e-12*s35)
    s90 = s89/(s74 + 1.0 - s89)
    s91 = s75*s90
    s92 = s37*s90
    s93 = s36*s90
    s94 = s39 - s66 - s69*s73 - s75*s91
    s95 = s36 + s37*s91
    s96 = -1.0 + s38 + s36*s91
    s97 = 1.0*(s94 > mask_3 + 1e-12*s39)
    s98 = s97/(s94 + 1.0 - s97)
    s99 = s95*s98
    s100 = s96*s98
    s101 = 1.0*(s87 > mask_12 + 1e-12*s60)
    s102 = s101/(s87 + 1.0 - s101)
    s103 = s88*s102
    s104 = s50*s102
    s105 = s49*s102
    s106 = s61 - s79 - s82*s86 - s88*s103
    s107 = s50*s103 - s49
    s108 = -1.0 + s51 - s49*s103
    s109 = 1.0*(s106 > mask_13 + 1e-12*s61)
    s110 = s109/(s106 + 1.0 - s109)
    s111 = s107*s110
    s112 = s108*s110
    s113 = 1.0/s41
    s114 = s42*s113
    s115 = -s114
    s116 = s43*s113
    s117 = s44*s113
    s118 = s42*s114
    s119 = s46 - s118
    s120 = s43*s114 - s42
    s121 = -1.0 + s45 - s118
    s122 = s42 + s44*s114
    s123 = 1.0 - s45 + s118
    s124 = s42*s116
    s125 = 1.0*(s119 > mask_5 + 1e-12*s46)
    s126 = s125/(s119 + 1.0 - s125)
    s127 = s120*s126
    s128 = s121*s126
    s129 = s122*s126
    s130 = s123*s126
    s131 = s48 - s50*s104 - s107*s111 - s43*s116 - s120*s127
    s132 = s49*s104 - (s42 + s49) - s108*s111 + s124 - s121*s127
    s133 = -1.0 - s40 - s44*s116 - s122*s127
    s134 = s42 - s124 - s123*s127
    s135 = 1.0*(s131 > mask_6 + 1e-12*s48)
    s136 = s135/(s131 + 1.0 - s135)
    s137 = s132*s136
    s138 = s133*s136
    s139 = s134*s136
    s140 = s52 - s49*s105 - s108*s112 - s118 - s121*s128 - s132*s137
    s141 = s122 - s122*s128 - s133*s137
    s142 = -1.0 - s45 + s118 - s123*s128 - s134*s137
    s143 = 1.0*(s140 > mask_7 + 1e-12*s52)
    s144 = s143/(s140 + 1.0 - s143)
    s145 = s141*s144
    s146 = s142*s144
    s147 = s53 - s37*s92 - s95*s99 - s44*s117 - s122*s129 - s133*s138 - s141*s145
    s148 = s36*s92 - (s36 + s42) + s96*s99 - s42*s117 - s123*s129 - s134*s138 - s142*s145
    s149 = 1.0*(s147 > mask_8 + 1e-12*s53)
    s150 = s149/(s147 + 1.0 - s149)
    s151 = s148*s150
    s152 = s54 - s36*s93 - s96*s100 - s118 - s123*s130 - s134*s139 - s142*s146 - s148*s151
    s153 = 1.0*(s152 > mask_9 + 1e-12*s54)
    s154 = s2*s2 + s4*s4 + s7*s7 + s9*s9 + s12*s12 + s14*s14 + s17*s17 + s19*s19 + s20*s20 + s21*s21 + s23*s23
    s155 = s67/s33
    s156 = s74/s35
    s157 = s94/s39
    s158 = s119/s46
    s159 = s131/s48
    s160 = min(min(min(min(min(1.0, mask_1 + s155), mask_2 + s156), mask_3 + s157), mask_5 + s158), mask_6 + s159)
    s161 = s140/s52
    s162 = s147/s53
    s163 = s152/s54
    s164 = s80/s59
    s165 = s87/s60
    s166 = min(min(min(min(min(s160, mask_7 + s161), mask_8 + s162), mask_9 + s163), mask_11 + s164), mask_12 + s165)
    s167 = s106/s61
    # outputs
    w[57] = s2
    w[58] = s4
    w[59] = s7
    w[60] = s9
    w[61] = s12
    w[62] = s14
    w[63] = s17
    w[64] = s19
    w[65] = s20
    w[66] = s21
    w[67] = s23
    w[68] = s25
    w[69] = s26
    w[70] = s27
    w[0] = math.sqrt(s154 + s25*s25 + s26*s26 + s27*s27)
    w[129] = s3
    w[130] = s1
    w[131] = s3
    w[132] = s8
    w[133] = s1
    w[134] = s6
    w[135] = s13
    w[136] = s11
    w[137] = s13
    w[138] = s18
    w[139] = s11
    w[140] = s16
    w[141] = s8
    w[142] = -s13
    w[143] = s6
    w[144] = s10
    w[145] = s24
    w[146] = -s22
    w[147] = s18
    w[148] = -s24
    w[149] = s16
    w[150] = s22
    w[86] = s155
    w[87] = s156
    w[88] = s157
    w[90] = s158
    w[91] = s159
    w[92] = s161
    w[93] = s162
    w[94] = s163
    w[96] = s164
    w[97] = s165
    w[98] = s167
    w[5] = s109 + s101 + s83 + 1.0 + s153 + s149 + s143 + s135 + s125 + 1.0 + s97 + s89 + 1.0 + s70
    w[4] = min(s166, mask_13 + s167)
    w[151] = s64
    w[152] = s65
    w[153] = s64
    w[154] = s72
    w[155] = s73
    w[156] = -s77
    w[157] = s78
    w[158] = s77
    w[159] = s85
    w[160] = s86
    w[161] = s91
    w[162] = s92
    w[163] = -s93
    w[164] = -s99
    w[165] = s100
    w[166] = -s103
    w[167] = s104
    w[168] = -s105
    w[169] = s111
    w[170] = s112
    w[171] = s115
    w[172] = s116
    w[173] = s115
    w[174] = s117
    w[175] = s114
    w[176] = s127
    w[177] = s128
    w[178] = s129
    w[179] = s130
    w[180] = s137
    w[181] = s138
    w[182] = s139
    w[183] = s145
    w[184] = s146
    w[185] = s151
    w[186] = s62
    w[187] = s71
    w[188] = s76
    w[189] = s84
    w[190] = s90
    w[191] = s98
    w[192] = s102
    w[193] = s110
    w[194] = s113
    w[195] = s126
    w[196] = s136
    w[197] = s144
    w[198] = s150
    w[199] = s153/(s152 + 1.0 - s153)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 212 operations, 110301 before sharing."""
    # inputs
    lower_0 = w[151]
    lower_1 = w[152]
    lower_2 = w[153]
    lower_3 = w[154]
    lower_4 = w[155]
    lower_5 = w[156]
    lower_6 = w[157]
    lower_7 = w[158]
    lower_8 = w[159]
    lower_9 = w[160]
    lower_10 = w[161]
    lower_11 = w[162]
    lower_12 = w[163]
    lower_13 = w[164]
    lower_14 = w[165]
    lower_15 = w[166]
    lower_16 = w[167]
    lower_17 = w[168]
    lower_18 = w[169]
    lower_19 = w[170]
    lower_20 = w[171]
    lower_21 = w[172]
    lower_22 = w[173]
    lower_23 = w[174]
    lower_24 = w[175]
    lower_25 = w[176]
    lower_26 = w[177]
    lower_27 = w[178]
    lower_28 = w[179]
    lower_29 = w[180]
    lower_30 = w[181]
    lower_31 = w[182]
    lower_32 = w[183]
    lower_33 = w[184]
    lower_34 = w[185]
    reciprocal_0 = w[186]
    reciprocal_1 = w[187]
    reciprocal_2 = w[188]
    reciprocal_3 = w[189]
    reciprocal_4 = w[190]
    reciprocal_5 = w[191]
    reciprocal_6 = w[192]
    reciprocal_7 = w[193]
    reciprocal_8 = w[194]
    reciprocal_9 = w[195]
    reciprocal_10 = w[196]
    reciprocal_11 = w[197]
    reciprocal_12 = w[198]
    reciprocal_13 = w[199]
    residual_0 = w[57]
    residual_1 = w[58]
    residual_2 = w[59]
    residual_3 = w[60]
    residual_4 = w[61]
    residual_5 = w[62]
    residual_6 = w[63]
    residual_7 = w[64]
    residual_8 = w[65]
    residual_9 = w[66]
    residual_10 = w[67]
    residual_11 = w[68]
    residual_12 = w[69]
    residual_13 = w[70]
    jacobian_0 = w[129]
    jacobian_1 = w[130]
    jacobian_2 = w[131]
    jacobian_3 = w[132]
    jacobian_4 = w[133]
    jacobian_5 = w[134]
    jacobian_6 = w[135]
    jacobian_7 = w[136]
    jacobian_8 = w[137]
    jacobian_9 = w[138]
    jacobian_10 = w[139]
    jacobian_11 = w[140]
    jacobian_12 = w[141]
    jacobian_13 = w[142]
    jacobian_14 = w[143]
    jacobian_15 = w[144]
    jacobian_16 = w[145]
    jacobian_17 = w[146]
    jacobian_18 = w[147]
    jacobian_19 = w[148]
    jacobian_20 = w[149]
    jacobian_21 = w[150]
    # intermediate terms
    s0 = lower_0*residual_0 - residual_1
    s1 = lower_1*residual_0 - residual_2 - lower_3*s0
    s2 = lower_5*residual_10 - residual_11
    s3 = lower_6*residual_10 - residual_12 - lower_8*s2
    s4 = lower_2*residual_0 - residual_3 - lower_4*s0 - lower_10*s1
    s5 = lower_7*residual_10 - residual_13 - lower_9*s2 - lower_15*s3
    s6 = lower_20*residual_4 - residual_5
    s7 = lower_21*residual_4 - (residual_6 + lower_16*s3 + lower_18*s5) - lower_25*s6
    s8 = lower_22*residual_4 - (residual_7 + lower_17*s3 + lower_19*s5) - lower_26*s6 - lower_29*s7
    s9 = lower_23*residual_4 - (residual_8 + lower_11*s1 + lower_13*s4) - lower_27*s6 - lower_30*s7 - lower_32*s8
    s10 = lower_24*residual_4 - (residual_9 + lower_12*s1 + lower_14*s4) - lower_28*s6 - lower_31*s7 - lower_33*s8
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
    s22 = reciprocal_8*residual_4 + lower_20*s21 + lower_21*s20 + lower_22*s17 + lower_23*s14 + lower_24*s11
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
    s36 = reciprocal_2*residual_10 + lower_5*s35 + lower_6*s28 + lower_7*s25
    s37 = reciprocal_1*s0 - lower_3*s34 - lower_4*s31
    s38 = reciprocal_0*residual_0 + lower_0*s37 + lower_1*s34 + lower_2*s31
    s39 = s21*jacobian_7 - s22*jacobian_6 + s20*jacobian_8 + s17*jacobian_10 + s14*jacobian_13 + s11*jacobian_15
    # outputs
    w[99] = s33 - s32 - s38
    w[100] = s37 + s30 - s29
    w[101] = s37*jacobian_1 - s38*jacobian_0 + s34*jacobian_2 + s31*jacobian_4
    w[102] = s34 + s13 - s12
    w[103] = s31 - s11
    w[104] = s34*jacobian_3 + s31*jacobian_5 + s14*jacobian_12 + s11*jacobian_14
    w[105] = s14 + s19 - s18 - s22
    w[106] = s11 + s21 + s16 - s15
    w[107] = s39
    w[108] = s20 + s27 - s26
    w[109] = s17 + s24 - s23
    w[110] = s20*jacobian_9 + s17*jacobian_11 + s28*jacobian_18 + s25*jacobian_20
    w[111] = s28 - s36
    w[112] = s25 + s35
    w[113] = s35*jacobian_17 - s36*jacobian_16 + s28*jacobian_19 + s25*jacobian_21
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 133 operations, 237 before sharing."""
    # inputs
    q1 = y[1]  # vertical0.y [m]
    v0 = y[15]  # vertical0.vx [m/s]
    v1 = y[16]  # vertical0.vy [m/s]
    v2 = y[17]  # vertical0.omega [rad/s]
    q4 = y[4]  # coupler0.y [m]
    v3 = y[18]  # coupler0.vx [m/s]
    v4 = y[19]  # coupler0.vy [m/s]
    v5 = y[20]  # coupler0.omega [rad/s]
    q7 = y[7]  # vertical1.y [m]
    v6 = y[21]  # vertical1.vx [m/s]
    v7 = y[22]  # vertical1.vy [m/s]
    v8 = y[23]  # vertical1.omega [rad/s]
    q10 = y[10]  # coupler1.y [m]
    v9 = y[24]  # coupler1.vx [m/s]
    v10 = y[25]  # coupler1.vy [m/s]
    v11 = y[26]  # coupler1.omega [rad/s]
    q13 = y[13]  # vertical2.y [m]
    v12 = y[27]  # vertical2.vx [m/s]
    v13 = y[28]  # vertical2.vy [m/s]
    v14 = y[29]  # vertical2.omega [rad/s]
    jacobian_0 = w[129]
    jacobian_1 = w[130]
    jacobian_2 = w[131]
    jacobian_3 = w[132]
    jacobian_4 = w[133]
    jacobian_5 = w[134]
    jacobian_6 = w[135]
    jacobian_7 = w[136]
    jacobian_8 = w[137]
    jacobian_9 = w[138]
    jacobian_10 = w[139]
    jacobian_11 = w[140]
    jacobian_12 = w[141]
    jacobian_13 = w[142]
    jacobian_14 = w[143]
    jacobian_15 = w[144]
    jacobian_16 = w[145]
    jacobian_17 = w[146]
    jacobian_18 = w[147]
    jacobian_19 = w[148]
    jacobian_20 = w[149]
    jacobian_21 = w[150]
    # intermediate terms
    s0 = 0.5*(v0*v0) + 0.5*(v1*v1) + 0.041666666666666664*(v2*v2) + 0.5*(v3*v3) + 0.5*(v4*v4) + 0.041666666666666664*(v5*v5)
    s1 = s0 + 0.5*(v6*v6) + 0.5*(v7*v7) + 0.041666666666666664*(v8*v8) + 0.5*(v9*v9) + 0.5*(v10*v10)
    s2 = s1 + 0.041666666666666664*(v11*v11) + 0.5*(v12*v12) + 0.5*(v13*v13) + 0.041666666666666664*(v14*v14)
    s3 = v0 + v2*jacobian_0
    s4 = v1 + v2*jacobian_1
    s5 = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    s6 = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    s7 = v6 + v8*jacobian_6
    s8 = v7 + v8*jacobian_7
    s9 = v9 + v8*jacobian_8 - v6 + v11*jacobian_9
    s10 = v10 + v8*jacobian_10 - v7 + v11*jacobian_11
    s11 = v6 + v5*jacobian_12 - v3 + v8*jacobian_13
    s12 = v7 + v5*jacobian_14 - v4 + v8*jacobian_15
    s13 = v12 + v14*jacobian_16
    s14 = v13 + v14*jacobian_17
    s15 = v12 + v11*jacobian_18 - v9 + v14*jacobian_19
    s16 = v13 + v11*jacobian_20 - v10 + v14*jacobian_21
    s17 = s3*s3 + s4*s4 + s5*s5 + s6*s6 + s7*s7 + s8*s8 + s9*s9 + s10*s10 + s11*s11 + s12*s12 + s13*s13
    # outputs
    w[57] = s3
    w[58] = s4
    w[59] = s5
    w[60] = s6
    w[61] = s7
    w[62] = s8
    w[63] = s9
    w[64] = s10
    w[65] = s11
    w[66] = s12
    w[67] = s13
    w[68] = s14
    w[69] = s15
    w[70] = s16
    w[1] = math.sqrt(s17 + s14*s14 + s15*s15 + s16*s16)
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
    w[114] = 1.0
    w[115] = 1.0
    w[116] = 0.08333333333333333
    w[117] = 1.0
    w[118] = 1.0
    w[119] = 0.08333333333333333
    w[120] = 1.0
    w[121] = 1.0
    w[122] = 0.08333333333333333
    w[123] = 1.0
    w[124] = 1.0
    w[125] = 0.08333333333333333
    w[126] = 1.0
    w[127] = 1.0
    w[128] = 0.08333333333333333
    return 0
