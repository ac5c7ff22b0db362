"""Model `n-four-bar-2`: what every method of it shares. Emitted by symgen; do not edit.

digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 3, templates 774f5f3a0a6c3684
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

w[0:19]  status
w[19:33]  multipliers
w[33:47]  mask
w[47:61]  saved
w[61:75]  residual
w[75:89]  nu
w[89:103]  pivot
w[103:118]  change
w[118:133]  mass
w[133:148]  gauge
w[148:162]  row_weight
w[162:184]  jacobian
w[184:219]  lower
w[219:233]  reciprocal

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
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 433 operations, 2464900 before sharing."""
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
    mask_1 = w[34]  # A0.y
    mask_2 = w[35]  # B0.x
    mask_3 = w[36]  # B0.y
    mask_5 = w[38]  # A1.y
    mask_6 = w[39]  # B1.x
    mask_7 = w[40]  # B1.y
    mask_8 = w[41]  # C1.x
    mask_9 = w[42]  # C1.y
    mask_11 = w[44]  # A2.y
    mask_12 = w[45]  # C2.x
    mask_13 = w[46]  # C2.y
    gauge_2 = w[135]  # vertical0.omega
    gauge_5 = w[138]  # coupler0.omega
    gauge_8 = w[141]  # vertical1.omega
    gauge_11 = w[144]  # coupler1.omega
    gauge_14 = w[147]  # vertical2.omega
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
    s28 = s3*gauge_2
    s29 = s0*gauge_2
    s30 = s8*gauge_5
    s31 = s5*gauge_5
    s32 = s13*gauge_8
    s33 = s10*gauge_8
    s34 = s18*gauge_11
    s35 = s15*gauge_11
    s36 = s24*gauge_14
    s37 = s22*gauge_14
    s38 = s3*s28
    s39 = 1.0 + s38
    s40 = s0*s28
    s41 = -1.0 + s38
    s42 = s0*s29
    s43 = 1.0 + s42
    s44 = s8*s30
    s45 = 1.0 + s39 + s44
    s46 = s5*s30
    s47 = -1.0 + s44
    s48 = s5*s31
    s49 = 1.0 + s43 + s48
    s50 = s13*s32
    s51 = 1.0 + s50
    s52 = s10*s32
    s53 = -1.0 + s50
    s54 = 1.0 - s50
    s55 = s10*s33
    s56 = 1.0 + s55
    s57 = s13*s33
    s58 = s18*s34
    s59 = 1.0 + s51 + s58
    s60 = s15*s34
    s61 = -1.0 + s58
    s62 = s15*s35
    s63 = 1.0 + s56 + s62
    s64 = s18*s35
    s65 = s50 + 1.0 + 1.0 + s44
    s66 = s55 + 1.0 + 1.0 + s48
    s67 = s24*s36
    s68 = s22*s36
    s69 = 1.0 - s67
    s70 = s22*s37
    s71 = 1.0 + s70
    s72 = s67 + 1.0 + 1.0 + s58
    s73 = s70 + 1.0 + 1.0 + s62
    s74 = 1.0/s39
    s75 = s40*s74
    s76 = -s75
    s77 = s41*s74
    s78 = s40*s75
    s79 = s43 - s78
    s80 = s41*s75 - s3*s29
    s81 = -1.0 + s42 - s78
    s82 = 1.0*(s79 > mask_1 + 1e-12*s43)
    s83 = s82/max(s79, 1e-300)
    s84 = s80*s83
    s85 = s81*s83
    s86 = s45 - s41*s77 - s80*s84
    s87 = s40*s77 - (s40 + s46) - s81*s84
    s88 = 1.0/(1.0 + s67)
    s89 = s68*s88
    s90 = s69*s88
    s91 = s68*s89
    s92 = s71 - s91
    s93 = s24*s37 + s69*s89
    s94 = 1.0 - s70 + s91
    s95 = 1.0*(s92 > mask_11 + 1e-12*s71)
    s96 = s95/max(s92, 1e-300)
    s97 = s93*s96
    s98 = s94*s96
    s99 = s72 - s69*s90 - s93*s97
    s100 = s60 + s68 + s68*s90 + s94*s97
    s101 = 1.0*(s86 > mask_2 + 1e-12*s45)
    s102 = s101/max(s86, 1e-300)
    s103 = s87*s102
    s104 = s47*s102
    s105 = s46*s102
    s106 = s49 - s78 - s81*s85 - s87*s103
    s107 = s8*s31 + s47*s103
    s108 = -1.0 + s48 + s46*s103
    s109 = 1.0*(s106 > mask_3 + 1e-12*s49)
    s110 = s109/max(s106, 1e-300)
    s111 = s107*s110
    s112 = s108*s110
    s113 = 1.0*(s99 > mask_12 + 1e-12*s72)
    s114 = s113/max(s99, 1e-300)
    s115 = s100*s114
    s116 = s61*s114
    s117 = s64*s114
    s118 = s73 - s91 - s94*s98 - s100*s115
    s119 = s61*s115 - s60
    s120 = -1.0 + s62 - s64*s115
    s121 = 1.0*(s118 > mask_13 + 1e-12*s73)
    s122 = s121/max(s118, 1e-300)
    s123 = s119*s122
    s124 = s120*s122
    s125 = 1.0/s51
    s126 = s52*s125
    s127 = -s126
    s128 = s53*s125
    s129 = s54*s125
    s130 = s52*s126
    s131 = s56 - s130
    s132 = s53*s126 - s57
    s133 = -1.0 + s55 - s130
    s134 = s57 + s54*s126
    s135 = 1.0 - s55 + s130
    s136 = s52*s128
    s137 = 1.0*(s131 > mask_5 + 1e-12*s56)
    s138 = s137/max(s131, 1e-300)
    s139 = s132*s138
    s140 = s133*s138
    s141 = s134*s138
    s142 = s135*s138
    s143 = s59 - s61*s116 - s119*s123 - s53*s128 - s132*s139
    s144 = s64*s116 - (s52 + s60) - s120*s123 + s136 - s133*s139
    s145 = -1.0 - s50 - s54*s128 - s134*s139
    s146 = s52 - s136 - s135*s139
    s147 = 1.0*(s143 > mask_6 + 1e-12*s59)
    s148 = s147/max(s143, 1e-300)
    s149 = s144*s148
    s150 = s145*s148
    s151 = s146*s148
    s152 = s63 - s64*s117 - s120*s124 - s130 - s133*s140 - s144*s149
    s153 = s134 - s134*s140 - s145*s149
    s154 = -1.0 - s55 + s130 - s135*s140 - s146*s149
    s155 = 1.0*(s152 > mask_7 + 1e-12*s63)
    s156 = s155/max(s152, 1e-300)
    s157 = s153*s156
    s158 = s154*s156
    s159 = s65 - s47*s104 - s107*s111 - s54*s129 - s134*s141 - s145*s150 - s153*s157
    s160 = s46*s104 - (s46 + s52) + s108*s111 - s52*s129 - s135*s141 - s146*s150 - s154*s157
    s161 = 1.0*(s159 > mask_8 + 1e-12*s65)
    s162 = s161/max(s159, 1e-300)
    s163 = s160*s162
    s164 = s66 - s46*s105 - s108*s112 - s130 - s135*s142 - s146*s151 - s154*s158 - s160*s163
    s165 = 1.0*(s164 > mask_9 + 1e-12*s66)
    s166 = s2*s2 + s4*s4 + s7*s7 + s9*s9 + s12*s12 + s14*s14 + s17*s17 + s19*s19 + s20*s20 + s21*s21 + s23*s23
    s167 = math.sqrt(s166 + s25*s25 + s26*s26 + s27*s27)
    s168 = s79/s43
    s169 = s86/s45
    s170 = s106/s49
    s171 = s131/s56
    s172 = s143/s59
    s173 = min(min(min(min(min(1.0, mask_1 + s168), mask_2 + s169), mask_3 + s170), mask_5 + s171), mask_6 + s172)
    s174 = s152/s63
    s175 = s159/s65
    s176 = s164/s66
    s177 = s92/s71
    s178 = s99/s72
    s179 = min(min(min(min(min(s173, mask_7 + s174), mask_8 + s175), mask_9 + s176), mask_11 + s177), mask_12 + s178)
    s180 = s118/s73
    # outputs
    w[61] = s2  # A0.x
    w[62] = s4  # A0.y
    w[63] = s7  # B0.x
    w[64] = s9  # B0.y
    w[65] = s12  # A1.x
    w[66] = s14  # A1.y
    w[67] = s17  # B1.x
    w[68] = s19  # B1.y
    w[69] = s20  # C1.x
    w[70] = s21  # C1.y
    w[71] = s23  # A2.x
    w[72] = s25  # A2.y
    w[73] = s26  # C2.x
    w[74] = s27  # C2.y
    w[0] = s167  # position_violation
    w[8] = s167  # position_measure
    w[162] = s3  # D A0.x, vertical0.omega
    w[163] = s1  # D A0.y, vertical0.omega
    w[164] = s3  # D B0.x, vertical0.omega
    w[165] = s8  # D B0.x, coupler0.omega
    w[166] = s1  # D B0.y, vertical0.omega
    w[167] = s6  # D B0.y, coupler0.omega
    w[168] = s13  # D A1.x, vertical1.omega
    w[169] = s11  # D A1.y, vertical1.omega
    w[170] = s13  # D B1.x, vertical1.omega
    w[171] = s18  # D B1.x, coupler1.omega
    w[172] = s11  # D B1.y, vertical1.omega
    w[173] = s16  # D B1.y, coupler1.omega
    w[174] = s8  # D C1.x, coupler0.omega
    w[175] = -s13  # D C1.x, vertical1.omega
    w[176] = s6  # D C1.y, coupler0.omega
    w[177] = s10  # D C1.y, vertical1.omega
    w[178] = s24  # D A2.x, vertical2.omega
    w[179] = -s22  # D A2.y, vertical2.omega
    w[180] = s18  # D C2.x, coupler1.omega
    w[181] = -s24  # D C2.x, vertical2.omega
    w[182] = s16  # D C2.y, coupler1.omega
    w[183] = s22  # D C2.y, vertical2.omega
    w[90] = s168  # A0.y
    w[91] = s169  # B0.x
    w[92] = s170  # B0.y
    w[94] = s171  # A1.y
    w[95] = s172  # B1.x
    w[96] = s174  # B1.y
    w[97] = s175  # C1.x
    w[98] = s176  # C1.y
    w[100] = s177  # A2.y
    w[101] = s178  # C2.x
    w[102] = s180  # C2.y
    w[5] = s121 + s113 + s95 + 1.0 + s165 + s161 + s155 + s147 + s137 + 1.0 + s109 + s101 + 1.0 + s82  # rank
    w[4] = min(s179, mask_13 + s180)  # smallest_pivot
    w[10] = 1.0  # shortest_row
    w[184] = s76
    w[185] = s77
    w[186] = s76
    w[187] = s84
    w[188] = s85
    w[189] = -s89
    w[190] = s90
    w[191] = s89
    w[192] = s97
    w[193] = s98
    w[194] = s103
    w[195] = s104
    w[196] = -s105
    w[197] = -s111
    w[198] = s112
    w[199] = -s115
    w[200] = s116
    w[201] = -s117
    w[202] = s123
    w[203] = s124
    w[204] = s127
    w[205] = s128
    w[206] = s127
    w[207] = s129
    w[208] = s126
    w[209] = s139
    w[210] = s140
    w[211] = s141
    w[212] = s142
    w[213] = s149
    w[214] = s150
    w[215] = s151
    w[216] = s157
    w[217] = s158
    w[218] = s163
    w[219] = s74
    w[220] = s83
    w[221] = s88
    w[222] = s96
    w[223] = s102
    w[224] = s110
    w[225] = s114
    w[226] = s122
    w[227] = s125
    w[228] = s138
    w[229] = s148
    w[230] = s156
    w[231] = s162
    w[232] = s165/max(s164, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 217 operations, 110306 before sharing."""
    # inputs
    gauge_2 = w[135]  # vertical0.omega
    gauge_5 = w[138]  # coupler0.omega
    gauge_8 = w[141]  # vertical1.omega
    gauge_11 = w[144]  # coupler1.omega
    gauge_14 = w[147]  # vertical2.omega
    lower_0 = w[184]
    lower_1 = w[185]
    lower_2 = w[186]
    lower_3 = w[187]
    lower_4 = w[188]
    lower_5 = w[189]
    lower_6 = w[190]
    lower_7 = w[191]
    lower_8 = w[192]
    lower_9 = w[193]
    lower_10 = w[194]
    lower_11 = w[195]
    lower_12 = w[196]
    lower_13 = w[197]
    lower_14 = w[198]
    lower_15 = w[199]
    lower_16 = w[200]
    lower_17 = w[201]
    lower_18 = w[202]
    lower_19 = w[203]
    lower_20 = w[204]
    lower_21 = w[205]
    lower_22 = w[206]
    lower_23 = w[207]
    lower_24 = w[208]
    lower_25 = w[209]
    lower_26 = w[210]
    lower_27 = w[211]
    lower_28 = w[212]
    lower_29 = w[213]
    lower_30 = w[214]
    lower_31 = w[215]
    lower_32 = w[216]
    lower_33 = w[217]
    lower_34 = w[218]
    reciprocal_0 = w[219]
    reciprocal_1 = w[220]
    reciprocal_2 = w[221]
    reciprocal_3 = w[222]
    reciprocal_4 = w[223]
    reciprocal_5 = w[224]
    reciprocal_6 = w[225]
    reciprocal_7 = w[226]
    reciprocal_8 = w[227]
    reciprocal_9 = w[228]
    reciprocal_10 = w[229]
    reciprocal_11 = w[230]
    reciprocal_12 = w[231]
    reciprocal_13 = w[232]
    residual_0 = w[61]  # A0.x
    residual_1 = w[62]  # A0.y
    residual_2 = w[63]  # B0.x
    residual_3 = w[64]  # B0.y
    residual_4 = w[65]  # A1.x
    residual_5 = w[66]  # A1.y
    residual_6 = w[67]  # B1.x
    residual_7 = w[68]  # B1.y
    residual_8 = w[69]  # C1.x
    residual_9 = w[70]  # C1.y
    residual_10 = w[71]  # A2.x
    residual_11 = w[72]  # A2.y
    residual_12 = w[73]  # C2.x
    residual_13 = w[74]  # C2.y
    jacobian_0 = w[162]  # D A0.x, vertical0.omega
    jacobian_1 = w[163]  # D A0.y, vertical0.omega
    jacobian_2 = w[164]  # D B0.x, vertical0.omega
    jacobian_3 = w[165]  # D B0.x, coupler0.omega
    jacobian_4 = w[166]  # D B0.y, vertical0.omega
    jacobian_5 = w[167]  # D B0.y, coupler0.omega
    jacobian_6 = w[168]  # D A1.x, vertical1.omega
    jacobian_7 = w[169]  # D A1.y, vertical1.omega
    jacobian_8 = w[170]  # D B1.x, vertical1.omega
    jacobian_9 = w[171]  # D B1.x, coupler1.omega
    jacobian_10 = w[172]  # D B1.y, vertical1.omega
    jacobian_11 = w[173]  # D B1.y, coupler1.omega
    jacobian_12 = w[174]  # D C1.x, coupler0.omega
    jacobian_13 = w[175]  # D C1.x, vertical1.omega
    jacobian_14 = w[176]  # D C1.y, coupler0.omega
    jacobian_15 = w[177]  # D C1.y, vertical1.omega
    jacobian_16 = w[178]  # D A2.x, vertical2.omega
    jacobian_17 = w[179]  # D A2.y, vertical2.omega
    jacobian_18 = w[180]  # D C2.x, coupler1.omega
    jacobian_19 = w[181]  # D C2.x, vertical2.omega
    jacobian_20 = w[182]  # D C2.y, coupler1.omega
    jacobian_21 = w[183]  # D C2.y, vertical2.omega
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
    w[103] = s33 - s32 - s38  # vertical0.vx
    w[104] = s37 + s30 - s29  # vertical0.vy
    w[105] = gauge_2*(s37*jacobian_1 - s38*jacobian_0 + s34*jacobian_2 + s31*jacobian_4)  # vertical0.omega
    w[106] = s34 + s13 - s12  # coupler0.vx
    w[107] = s31 - s11  # coupler0.vy
    w[108] = gauge_5*(s34*jacobian_3 + s31*jacobian_5 + s14*jacobian_12 + s11*jacobian_14)  # coupler0.omega
    w[109] = s14 + s19 - s18 - s22  # vertical1.vx
    w[110] = s11 + s21 + s16 - s15  # vertical1.vy
    w[111] = gauge_8*s39  # vertical1.omega
    w[112] = s20 + s27 - s26  # coupler1.vx
    w[113] = s17 + s24 - s23  # coupler1.vy
    w[114] = gauge_11*(s20*jacobian_9 + s17*jacobian_11 + s28*jacobian_18 + s25*jacobian_20)  # coupler1.omega
    w[115] = s28 - s36  # vertical2.vx
    w[116] = s25 + s35  # vertical2.vy
    w[117] = gauge_14*(s35*jacobian_17 - s36*jacobian_16 + s28*jacobian_19 + s25*jacobian_21)  # vertical2.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 133 operations, 369 before sharing."""
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
    jacobian_0 = w[162]  # D A0.x, vertical0.omega
    jacobian_1 = w[163]  # D A0.y, vertical0.omega
    jacobian_2 = w[164]  # D B0.x, vertical0.omega
    jacobian_3 = w[165]  # D B0.x, coupler0.omega
    jacobian_4 = w[166]  # D B0.y, vertical0.omega
    jacobian_5 = w[167]  # D B0.y, coupler0.omega
    jacobian_6 = w[168]  # D A1.x, vertical1.omega
    jacobian_7 = w[169]  # D A1.y, vertical1.omega
    jacobian_8 = w[170]  # D B1.x, vertical1.omega
    jacobian_9 = w[171]  # D B1.x, coupler1.omega
    jacobian_10 = w[172]  # D B1.y, vertical1.omega
    jacobian_11 = w[173]  # D B1.y, coupler1.omega
    jacobian_12 = w[174]  # D C1.x, coupler0.omega
    jacobian_13 = w[175]  # D C1.x, vertical1.omega
    jacobian_14 = w[176]  # D C1.y, coupler0.omega
    jacobian_15 = w[177]  # D C1.y, vertical1.omega
    jacobian_16 = w[178]  # D A2.x, vertical2.omega
    jacobian_17 = w[179]  # D A2.y, vertical2.omega
    jacobian_18 = w[180]  # D C2.x, coupler1.omega
    jacobian_19 = w[181]  # D C2.x, vertical2.omega
    jacobian_20 = w[182]  # D C2.y, coupler1.omega
    jacobian_21 = w[183]  # D C2.y, vertical2.omega
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
    s18 = math.sqrt(s17 + s14*s14 + s15*s15 + s16*s16)
    # outputs
    w[61] = s3  # A0.x
    w[62] = s4  # A0.y
    w[63] = s5  # B0.x
    w[64] = s6  # B0.y
    w[65] = s7  # A1.x
    w[66] = s8  # A1.y
    w[67] = s9  # B1.x
    w[68] = s10  # B1.y
    w[69] = s11  # C1.x
    w[70] = s12  # C1.y
    w[71] = s13  # A2.x
    w[72] = s14  # A2.y
    w[73] = s15  # C2.x
    w[74] = s16  # C2.y
    w[1] = s18  # velocity_violation
    w[9] = s18  # velocity_measure
    w[2] = s2  # kinetic
    w[3] = 9.81*q1 + 9.81*q4 + 9.81*q7 + 9.81*q10 + 9.81*q13  # potential
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
    ydot_15 = ydot[15]  # rate of vertical0.vx
    ydot_16 = ydot[16]  # rate of vertical0.vy
    ydot_17 = ydot[17]  # rate of vertical0.omega
    ydot_18 = ydot[18]  # rate of coupler0.vx
    ydot_19 = ydot[19]  # rate of coupler0.vy
    ydot_20 = ydot[20]  # rate of coupler0.omega
    ydot_21 = ydot[21]  # rate of vertical1.vx
    ydot_22 = ydot[22]  # rate of vertical1.vy
    ydot_23 = ydot[23]  # rate of vertical1.omega
    ydot_24 = ydot[24]  # rate of coupler1.vx
    ydot_25 = ydot[25]  # rate of coupler1.vy
    ydot_26 = ydot[26]  # rate of coupler1.omega
    ydot_27 = ydot[27]  # rate of vertical2.vx
    ydot_28 = ydot[28]  # rate of vertical2.vy
    ydot_29 = ydot[29]  # rate of vertical2.omega
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
    out[0] = s3 + ydot_15 + s25  # A0.x
    out[1] = s4 + ydot_16 - s26  # A0.y
    out[2] = s3 + s8 + ydot_18 + s25 - ydot_15 + s27  # B0.x
    out[3] = s4 + s9 + ydot_19 - (ydot_16 + s26) - s28  # B0.y
    out[4] = s13 + ydot_21 + s29  # A1.x
    out[5] = s14 + ydot_22 - s30  # A1.y
    out[6] = s13 + s18 + ydot_24 + s29 - ydot_21 + s31  # B1.x
    out[7] = s14 + s19 + ydot_25 - (ydot_22 + s30) - s32  # B1.y
    out[8] = ydot_21 + s27 - ydot_18 - s29 - (s13 - s8)  # C1.x
    out[9] = s30 + ydot_22 - (ydot_19 + s28) - (s14 - s9)  # C1.y
    out[10] = s23 + ydot_27 + s33  # A2.x
    out[11] = s24 + ydot_28 - s34  # A2.y
    out[12] = ydot_27 + s31 - ydot_24 - s33 - (s23 - s18)  # C2.x
    out[13] = s34 + ydot_28 - (ydot_25 + s32) - (s24 - s19)  # C2.y
    out[14] = q2  # A0.angle
    out[15] = v2  # rate of A0.angle
    out[16] = q5 - q2  # B0.angle
    out[17] = v5 - v2  # rate of B0.angle
    out[18] = q8  # A1.angle
    out[19] = v8  # rate of A1.angle
    out[20] = q11 - q8  # B1.angle
    out[21] = v11 - v8  # rate of B1.angle
    out[22] = q8 - q5  # C1.angle
    out[23] = v8 - v5  # rate of C1.angle
    out[24] = q14  # A2.angle
    out[25] = v14  # rate of A2.angle
    out[26] = q14 - q11  # C2.angle
    out[27] = v14 - v11  # rate of C2.angle
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # outputs
    w[118] = 1.0  # vertical0.vx
    w[119] = 1.0  # vertical0.vy
    w[120] = 0.08333333333333333  # vertical0.omega
    w[121] = 1.0  # coupler0.vx
    w[122] = 1.0  # coupler0.vy
    w[123] = 0.08333333333333333  # coupler0.omega
    w[124] = 1.0  # vertical1.vx
    w[125] = 1.0  # vertical1.vy
    w[126] = 0.08333333333333333  # vertical1.omega
    w[127] = 1.0  # coupler1.vx
    w[128] = 1.0  # coupler1.vy
    w[129] = 0.08333333333333333  # coupler1.omega
    w[130] = 1.0  # vertical2.vx
    w[131] = 1.0  # vertical2.vy
    w[132] = 0.08333333333333333  # vertical2.omega
    return 0
