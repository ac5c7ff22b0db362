"""Model `andrews`: what every method of it shares. Emitted by symgen; do not edit.

digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 1, templates 8f8565515c2742ad
21 coordinates, 21 velocities, 20 constraint rows, 3 parameters,
0 fill-ins in the factor of D D^T

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     K1.x [m]
y[1]     K1.y [m]
y[2]     K1.theta [rad]
y[3]     K2.x [m]
y[4]     K2.y [m]
y[5]     K2.theta [rad]
y[6]     K3.x [m]
y[7]     K3.y [m]
y[8]     K3.theta [rad]
y[9]     K4.x [m]
y[10]    K4.y [m]
y[11]    K4.theta [rad]
y[12]    K5.x [m]
y[13]    K5.y [m]
y[14]    K5.theta [rad]
y[15]    K6.x [m]
y[16]    K6.y [m]
y[17]    K6.theta [rad]
y[18]    K7.x [m]
y[19]    K7.y [m]
y[20]    K7.theta [rad]
y[21]    K1.vx [m/s]
y[22]    K1.vy [m/s]
y[23]    K1.omega [rad/s]
y[24]    K2.vx [m/s]
y[25]    K2.vy [m/s]
y[26]    K2.omega [rad/s]
y[27]    K3.vx [m/s]
y[28]    K3.vy [m/s]
y[29]    K3.omega [rad/s]
y[30]    K4.vx [m/s]
y[31]    K4.vy [m/s]
y[32]    K4.omega [rad/s]
y[33]    K5.vx [m/s]
y[34]    K5.vy [m/s]
y[35]    K5.omega [rad/s]
y[36]    K6.vx [m/s]
y[37]    K6.vy [m/s]
y[38]    K6.omega [rad/s]
y[39]    K7.vx [m/s]
y[40]    K7.vy [m/s]
y[41]    K7.omega [rad/s]
y[42]    work of forces without potential and of drivers [J]
p[0]     drive_torque [N m]
p[1]     spring_stiffness [N/m]
p[2]     spring_length [m]
row 0    O.x [m]
row 1    O.y [m]
row 2    F.x [m]
row 3    F.y [m]
row 4    E3.x [m]
row 5    E3.y [m]
row 6    E4.x [m]
row 7    E4.y [m]
row 8    E6.x [m]
row 9    E6.y [m]
row 10   B.x [m]
row 11   B.y [m]
row 12   G.x [m]
row 13   G.y [m]
row 14   H.x [m]
row 15   H.y [m]
row 16   A5.x [m]
row 17   A5.y [m]
row 18   A7.x [m]
row 19   A7.y [m]

Left out:
- z coordinates, Euler parameters and 3x3 inertia tensors: the mechanism is planar
- the kinematic map N: planar velocities are the rates of the coordinates
- gyroscopic terms: they vanish in the plane
- columns of the ground: the ground does not move
- weights and gravity's potential: gravity is zero
"""

import math

import numpy as np
from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 1 operations, 1 before sharing."""
    # inputs
    p1 = p[1]  # spring_stiffness [N/m]
    # outputs
    p[3] = 0.5*p1
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 612 operations, 277946092 before sharing."""
    # inputs
    q0 = y[0]  # K1.x [m]
    q1 = y[1]  # K1.y [m]
    q2 = y[2]  # K1.theta [rad]
    q3 = y[3]  # K2.x [m]
    q4 = y[4]  # K2.y [m]
    q5 = y[5]  # K2.theta [rad]
    q6 = y[6]  # K3.x [m]
    q7 = y[7]  # K3.y [m]
    q8 = y[8]  # K3.theta [rad]
    q9 = y[9]  # K4.x [m]
    q10 = y[10]  # K4.y [m]
    q11 = y[11]  # K4.theta [rad]
    q12 = y[12]  # K5.x [m]
    q13 = y[13]  # K5.y [m]
    q14 = y[14]  # K5.theta [rad]
    q15 = y[15]  # K6.x [m]
    q16 = y[16]  # K6.y [m]
    q17 = y[17]  # K6.theta [rad]
    q18 = y[18]  # K7.x [m]
    q19 = y[19]  # K7.y [m]
    q20 = y[20]  # K7.theta [rad]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 0.00092*s0
    s3 = 0.00092*s1
    s4 = math.cos(q5)
    s5 = math.sin(q5)
    s6 = 0.0115*s4
    s7 = 0.00608*s0
    s8 = 0.0115*s5
    s9 = 0.00608*s1
    s10 = math.cos(q8)
    s11 = math.sin(q8)
    s12 = 0.01043*s10
    s13 = 0.0165*s4
    s14 = 0.016260000000000004*s11
    s15 = 0.016260000000000004*s10
    s16 = 0.01043*s11
    s17 = 0.0165*s5
    s18 = -s17
    s19 = s15 + s16
    s20 = s14 - s12
    s21 = math.cos(q11)
    s22 = math.sin(q11)
    s23 = 0.01421*s22
    s24 = 0.01421*s21
    s25 = math.cos(q17)
    s26 = math.sin(q17)
    s27 = 0.01421*s25
    s28 = 0.01421*s26
    s29 = 0.01874*s11
    s30 = 0.01874*s10
    s31 = s16 - s30
    s32 = s12 + s29
    s33 = math.cos(q14)
    s34 = math.sin(q14)
    s35 = 0.00579*s22
    s36 = 0.03084*s33
    s37 = 0.02308*s34
    s38 = 0.02308*s33
    s39 = 0.03084*s34
    s40 = 0.00579*s21
    s41 = s38 - s39
    s42 = s36 + s37
    s43 = math.cos(q20)
    s44 = math.sin(q20)
    s45 = 0.00449*s43
    s46 = 0.00579*s25
    s47 = 0.02772*s44
    s48 = 0.02772*s43
    s49 = 0.00449*s44
    s50 = 0.00579*s26
    s51 = s48 + s49
    s52 = s47 - s45
    s53 = 0.00916*s33
    s54 = 0.00916*s34
    s55 = s38 + s54
    s56 = s37 - s53
    s57 = 0.01228*s44
    s58 = 0.01228*s43
    s59 = s49 - s58
    s60 = s45 + s57
    s61 = s2*s3
    s62 = -1.0 + s3*s9
    s63 = s3*s7
    s64 = 1.0 + s2*s2
    s65 = 1.0 + 1.0 + s9*s9 + s8*s8
    s66 = -1.0 + s8*s17
    s67 = s8*s13
    s68 = 1.0 + 1.0 + s7*s7 + s6*s6
    s69 = 1.0 + s17*s17
    s70 = 1.0 + s69
    s71 = s70 + s19*s19
    s72 = s13*s17
    s73 = 1.0 + s19*s31
    s74 = 1.0 + s13*s13
    s75 = 1.0 + s74
    s76 = s75 + s20*s20
    s77 = s20*s31
    s78 = s70 + s24*s24
    s79 = -1.0 + s24*s40
    s80 = s75 + s23*s23
    s81 = s23*s40
    s82 = s70 + s28*s28
    s83 = -1.0 + s28*s50
    s84 = s75 + s27*s27
    s85 = s27*s50
    s86 = s31*s32
    s87 = 1.0 + s32*s32
    s88 = 1.0 + 1.0 + s40*s40 + s41*s41
    s89 = 1.0 + s41*s55
    s90 = 1.0 + 1.0 + s35*s35 + s42*s42
    s91 = s42*s55
    s92 = 1.0 + 1.0 + s50*s50 + s51*s51
    s93 = 1.0 + s51*s59
    s94 = 1.0 + 1.0 + s46*s46 + s52*s52
    s95 = s52*s59
    s96 = s55*s56
    s97 = 1.0 + s56*s56
    s98 = s59*s60
    s99 = 1.0 + s60*s60
    s100 = 1.0/(1.0 + s3*s3)
    s101 = s61*s100
    s102 = s62*s100
    s103 = s63*s100
    s104 = s64 - s61*s101
    s105 = s62*s101 - s2*s9
    s106 = -1.0 + s2*s7 - s63*s101
    s107 = 1.0*(s104 > 1e-12*s64)
    s108 = s107/(s104 + 1.0 - s107)
    s109 = s105*s108
    s110 = s106*s108
    s111 = s65 - s62*s102 - s105*s109
    s112 = s63*s102 - (s7*s9 + s6*s8) - s106*s109
    s113 = 1.0/(1.0 + s31*s31)
    s114 = s86*s113
    s115 = s73*s113
    s116 = s77*s113
    s117 = s87 - s86*s114
    s118 = s73*s114 - s19*s32
    s119 = 1.0 - s20*s32 + s77*s114
    s120 = 1.0*(s117 > 1e-12*s87)
    s121 = s120/(s117 + 1.0 - s120)
    s122 = s118*s121
    s123 = s119*s121
    s124 = 1.0/(1.0 + s55*s55)
    s125 = s96*s124
    s126 = s89*s124
    s127 = s91*s124
    s128 = s97 - s96*s125
    s129 = s41*s56 - s89*s125
    s130 = 1.0 + s42*s56 - s91*s125
    s131 = 1.0*(s128 > 1e-12*s97)
    s132 = s131/(s128 + 1.0 - s131)
    s133 = s129*s132
    s134 = s130*s132
    s135 = s88 - s89*s126 - s129*s133
    s136 = s35*s40 + s41*s42 - s91*s126 - s130*s133
    s137 = 1.0/(1.0 + s59*s59)
    s138 = s98*s137
    s139 = s93*s137
    s140 = s95*s137
    s141 = s99 - s98*s138
    s142 = s93*s138 - s51*s60
    s143 = 1.0 - s52*s60 + s95*s138
    s144 = 1.0*(s141 > 1e-12*s99)
    s145 = s144/(s141 + 1.0 - s144)
    s146 = s142*s145
    s147 = s143*s145
    s148 = s92 - s93*s139 - s142*s146
    s149 = s51*s52 - s46*s50 - s95*s139 - s143*s146
    s150 = 1.0*(s135 > 1e-12*s88)
    s151 = s150/(s135 + 1.0 - s150)
    s152 = s136*s151
    s153 = s79*s151
    s154 = s81*s151
    s155 = s90 - s91*s127 - s130*s134 - s136*s152
    s156 = s24*s35 - s79*s152
    s157 = -1.0 + s23*s35 - s81*s152
    s158 = 1.0*(s155 > 1e-12*s90)
    s159 = s158/(s155 + 1.0 - s158)
    s160 = s156*s159
    s161 = s157*s159
    s162 = 1.0*(s148 > 1e-12*s92)
    s163 = s162/(s148 + 1.0 - s162)
    s164 = s149*s163
    s165 = s83*s163
    s166 = s85*s163
    s167 = s94 - s95*s140 - s143*s147 - s149*s164
    s168 = s28*s46 + s83*s164
    s169 = -1.0 + s27*s46 + s85*s164
    s170 = 1.0*(s167 > 1e-12*s94)
    s171 = s170/(s167 + 1.0 - s170)
    s172 = s168*s171
    s173 = s169*s171
    s174 = 1.0*(s111 > 1e-12*s65)
    s175 = s174/(s111 + 1.0 - s174)
    s176 = s112*s175
    s177 = s66*s175
    s178 = s67*s175
    s179 = -s178
    s180 = s68 - s63*s103 - s106*s110 - s112*s176
    s181 = s6*s17 + s66*s176
    s182 = -1.0 + s6*s13 + s67*s176
    s183 = s66*s177
    s184 = s67*s177
    s185 = s67*s178
    s186 = 1.0*(s180 > 1e-12*s68)
    s187 = s186/(s180 + 1.0 - s186)
    s188 = s181*s187
    s189 = -s188
    s190 = s182*s187
    s191 = s181*s188
    s192 = s71 - s73*s115 - s118*s122 - s183 - s191
    s193 = s182*s188
    s194 = s19*s20 - s72 - s77*s115 - s119*s122 + s184 + s193
    s195 = s69 - s183 - s191
    s196 = s184 - s72 + s193
    s197 = s182*s190
    s198 = s66*s178 - s72 + s181*s190
    s199 = s74 - s185 - s197
    s200 = 1.0*(s192 > 1e-12*s71)
    s201 = s200/(s192 + 1.0 - s200)
    s202 = s194*s201
    s203 = s195*s201
    s204 = s196*s201
    s205 = s76 - s77*s116 - s119*s123 - s185 - s197 - s194*s202
    s206 = s198 - s195*s202
    s207 = s199 - s196*s202
    s208 = s195*s203
    s209 = s196*s203
    s210 = s196*s204
    s211 = 1.0*(s205 > 1e-12*s76)
    s212 = s211/(s205 + 1.0 - s211)
    s213 = s206*s212
    s214 = s207*s212
    s215 = s206*s213
    s216 = s78 - s79*s153 - s156*s160 - s183 - s191 - s208 - s215
    s217 = s207*s213
    s218 = s23*s24 - s72 - s81*s153 - s157*s160 + s184 + s193 - s209 - s217
    s219 = s195 - s208 - s215
    s220 = s196 - s209 - s217
    s221 = s207*s214
    s222 = 1.0*(s216 > 1e-12*s78)
    s223 = s222/(s216 + 1.0 - s222)
    s224 = s218*s223
    s225 = s219*s223
    s226 = s220*s223
    s227 = s80 - s81*s154 - s157*s161 - s185 - s197 - s210 - s221 - s218*s224
    s228 = s198 - s195*s204 - s206*s214 - s219*s224
    s229 = s199 - s210 - s221 - s220*s224
    s230 = 1.0*(s227 > 1e-12*s80)
    s231 = s230/(s227 + 1.0 - s230)
    s232 = s228*s231
    s233 = s229*s231
    s234 = s82 - s83*s165 - s168*s172 - s183 - s191 - s208 - s215 - s219*s225 - s228*s232
    s235 = s85*s165 - (s72 + s27*s28) + s169*s172 + s184 + s193 - s209 - s217 - s220*s225 - s229*s232
    s236 = 1.0*(s234 > 1e-12*s82)
    s237 = s236/(s234 + 1.0 - s236)
    s238 = s235*s237
    s239 = s84 - s85*s166 - s169*s173 - s185 - s197 - s210 - s221 - s220*s226 - s229*s233 - s235*s238
    s240 = 1.0*(s239 > 1e-12*s84)
    # outputs
    w[68] = q0 - s2
    w[69] = q1 - s3
    w[70] = q3 - q0 + s6 - s7
    w[71] = q4 - q1 + s8 - s9
    w[72] = q6 - q3 - s12 + s13 + s14
    w[73] = q7 - q4 - s15 - s16 + s17
    w[74] = s13 + q9 - q3 + s23
    w[75] = s17 + q10 - q4 - s24
    w[76] = s13 + q15 - q3 + s27
    w[77] = s17 + q16 - q4 + s28
    w[78] = q6 - -0.03635 - s12 - s29
    w[79] = q7 - 0.03273 + s30 - s16
    w[80] = q12 - q9 + s35 + s36 + s37
    w[81] = q13 - q10 - s38 + s39 - s40
    w[82] = q18 - q15 - s45 + s46 + s47
    w[83] = q19 - q16 - s48 - s49 + s50
    w[84] = s37 + q12 - -0.06934 - s53
    w[85] = q13 - -0.00227 - s38 - s54
    w[86] = q18 - -0.06934 - s45 - s57
    w[87] = q19 - -0.00227 + s58 - s49
    w[210] = s3
    w[211] = -s2
    w[212] = s9
    w[213] = -s8
    w[214] = -s7
    w[215] = s6
    w[216] = s18
    w[217] = s19
    w[218] = s13
    w[219] = s20
    w[220] = s18
    w[221] = s24
    w[222] = s13
    w[223] = s23
    w[224] = s18
    w[225] = -s28
    w[226] = s13
    w[227] = s27
    w[228] = s31
    w[229] = -s32
    w[230] = s40
    w[231] = s41
    w[232] = s35
    w[233] = s42
    w[234] = -s50
    w[235] = s51
    w[236] = s46
    w[237] = s52
    w[238] = s55
    w[239] = s56
    w[240] = s59
    w[241] = -s60
    w[129] = s104/s64
    w[130] = s111/s65
    w[131] = s180/s68
    w[132] = s192/s71
    w[133] = s205/s76
    w[134] = s216/s78
    w[135] = s227/s80
    w[136] = s234/s82
    w[137] = s239/s84
    w[139] = s117/s87
    w[140] = s135/s88
    w[141] = s155/s90
    w[142] = s148/s92
    w[143] = s167/s94
    w[145] = s128/s97
    w[147] = s141/s99
    w[242] = -s101
    w[243] = s102
    w[244] = -s103
    w[245] = s109
    w[246] = s110
    w[247] = -s114
    w[248] = s115
    w[249] = s116
    w[250] = s122
    w[251] = s123
    w[252] = s125
    w[253] = s126
    w[254] = s127
    w[255] = s133
    w[256] = s134
    w[257] = -s138
    w[258] = s139
    w[259] = s140
    w[260] = s146
    w[261] = s147
    w[262] = s152
    w[263] = s153
    w[264] = s154
    w[265] = s160
    w[266] = s161
    w[267] = s164
    w[268] = s165
    w[269] = -s166
    w[270] = -s172
    w[271] = s173
    w[272] = s176
    w[273] = s177
    w[274] = s179
    w[275] = s177
    w[276] = s179
    w[277] = s177
    w[278] = s179
    w[279] = s189
    w[280] = s190
    w[281] = s189
    w[282] = s190
    w[283] = s189
    w[284] = s190
    w[285] = s202
    w[286] = s203
    w[287] = s204
    w[288] = s203
    w[289] = s204
    w[290] = s213
    w[291] = s214
    w[292] = s213
    w[293] = s214
    w[294] = s224
    w[295] = s225
    w[296] = s226
    w[297] = s232
    w[298] = s233
    w[299] = s238
    w[300] = s100
    w[301] = s108
    w[302] = s113
    w[303] = s121
    w[304] = s124
    w[305] = s132
    w[306] = s137
    w[307] = s145
    w[308] = s151
    w[309] = s159
    w[310] = s163
    w[311] = s171
    w[312] = s175
    w[313] = s187
    w[314] = s201
    w[315] = s212
    w[316] = s223
    w[317] = s231
    w[318] = s237
    w[319] = s240/(s239 + 1.0 - s240)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """change of v (or of q by N) = D^+ times the section `right`: 338 operations, 2294061 before sharing."""
    # inputs
    lower_0 = w[242]
    lower_1 = w[243]
    lower_2 = w[244]
    lower_3 = w[245]
    lower_4 = w[246]
    lower_5 = w[247]
    lower_6 = w[248]
    lower_7 = w[249]
    lower_8 = w[250]
    lower_9 = w[251]
    lower_10 = w[252]
    lower_11 = w[253]
    lower_12 = w[254]
    lower_13 = w[255]
    lower_14 = w[256]
    lower_15 = w[257]
    lower_16 = w[258]
    lower_17 = w[259]
    lower_18 = w[260]
    lower_19 = w[261]
    lower_20 = w[262]
    lower_21 = w[263]
    lower_22 = w[264]
    lower_23 = w[265]
    lower_24 = w[266]
    lower_25 = w[267]
    lower_26 = w[268]
    lower_27 = w[269]
    lower_28 = w[270]
    lower_29 = w[271]
    lower_30 = w[272]
    lower_31 = w[273]
    lower_32 = w[274]
    lower_33 = w[275]
    lower_34 = w[276]
    lower_35 = w[277]
    lower_36 = w[278]
    lower_37 = w[279]
    lower_38 = w[280]
    lower_39 = w[281]
    lower_40 = w[282]
    lower_41 = w[283]
    lower_42 = w[284]
    lower_43 = w[285]
    lower_44 = w[286]
    lower_45 = w[287]
    lower_46 = w[288]
    lower_47 = w[289]
    lower_48 = w[290]
    lower_49 = w[291]
    lower_50 = w[292]
    lower_51 = w[293]
    lower_52 = w[294]
    lower_53 = w[295]
    lower_54 = w[296]
    lower_55 = w[297]
    lower_56 = w[298]
    lower_57 = w[299]
    reciprocal_0 = w[300]
    reciprocal_1 = w[301]
    reciprocal_2 = w[302]
    reciprocal_3 = w[303]
    reciprocal_4 = w[304]
    reciprocal_5 = w[305]
    reciprocal_6 = w[306]
    reciprocal_7 = w[307]
    reciprocal_8 = w[308]
    reciprocal_9 = w[309]
    reciprocal_10 = w[310]
    reciprocal_11 = w[311]
    reciprocal_12 = w[312]
    reciprocal_13 = w[313]
    reciprocal_14 = w[314]
    reciprocal_15 = w[315]
    reciprocal_16 = w[316]
    reciprocal_17 = w[317]
    reciprocal_18 = w[318]
    reciprocal_19 = w[319]
    right_0 = w[148]
    right_1 = w[149]
    right_2 = w[150]
    right_3 = w[151]
    right_4 = w[152]
    right_5 = w[153]
    right_6 = w[154]
    right_7 = w[155]
    right_8 = w[156]
    right_9 = w[157]
    right_10 = w[158]
    right_11 = w[159]
    right_12 = w[160]
    right_13 = w[161]
    right_14 = w[162]
    right_15 = w[163]
    right_16 = w[164]
    right_17 = w[165]
    right_18 = w[166]
    right_19 = w[167]
    jacobian_0 = w[210]
    jacobian_1 = w[211]
    jacobian_2 = w[212]
    jacobian_3 = w[213]
    jacobian_4 = w[214]
    jacobian_5 = w[215]
    jacobian_6 = w[216]
    jacobian_7 = w[217]
    jacobian_8 = w[218]
    jacobian_9 = w[219]
    jacobian_10 = w[220]
    jacobian_11 = w[221]
    jacobian_12 = w[222]
    jacobian_13 = w[223]
    jacobian_14 = w[224]
    jacobian_15 = w[225]
    jacobian_16 = w[226]
    jacobian_17 = w[227]
    jacobian_18 = w[228]
    jacobian_19 = w[229]
    jacobian_20 = w[230]
    jacobian_21 = w[231]
    jacobian_22 = w[232]
    jacobian_23 = w[233]
    jacobian_24 = w[234]
    jacobian_25 = w[235]
    jacobian_26 = w[236]
    jacobian_27 = w[237]
    jacobian_28 = w[238]
    jacobian_29 = w[239]
    jacobian_30 = w[240]
    jacobian_31 = w[241]
    # intermediate terms
    s0 = right_1 - lower_0*right_0
    s1 = right_2 - lower_1*right_0 - lower_3*s0
    s2 = right_11 - lower_5*right_10
    s3 = right_17 - lower_10*right_16
    s4 = right_12 - lower_11*right_16 - lower_13*s3
    s5 = right_19 - lower_15*right_18
    s6 = right_14 - lower_16*right_18 - lower_18*s5
    s7 = right_13 - lower_12*right_16 - lower_14*s3 - lower_20*s4
    s8 = right_15 - lower_17*right_18 - lower_19*s5 - lower_25*s6
    s9 = right_3 - lower_2*right_0 - lower_4*s0 - lower_30*s1
    s10 = right_4 - lower_6*right_10 - lower_8*s2 - lower_31*s1 - lower_37*s9
    s11 = right_5 - lower_7*right_10 - lower_9*s2 - lower_32*s1 - lower_38*s9 - lower_43*s10
    s12 = right_6 - lower_21*s4 - lower_23*s7 - lower_33*s1 - lower_39*s9 - lower_44*s10 - lower_48*s11
    s13 = right_7 - lower_22*s4 - lower_24*s7 - lower_34*s1 - lower_40*s9 - lower_45*s10 - lower_49*s11
    s14 = right_8 - lower_26*s6 - lower_28*s8 - lower_35*s1 - lower_41*s9 - lower_46*s10 - lower_50*s11
    s15 = right_9 - lower_27*s6 - lower_29*s8 - lower_36*s1 - lower_42*s9 - lower_47*s10 - lower_51*s11
    s16 = s13 - lower_52*s12
    s17 = s14 - lower_53*s12 - lower_55*s16
    s18 = reciprocal_19*(s15 - lower_54*s12 - lower_56*s16 - lower_57*s17)
    s19 = reciprocal_18*s17
    s20 = lower_57*s18
    s21 = s19 - s20
    s22 = reciprocal_17*s16 - lower_55*s21
    s23 = lower_56*s18
    s24 = s22 - s23
    s25 = reciprocal_16*s12 - lower_52*s24 - lower_53*s21
    s26 = lower_54*s18
    s27 = s25 - s26
    s28 = reciprocal_15*s11 - lower_48*s27 - lower_49*s24 - lower_50*s21
    s29 = lower_51*s18
    s30 = s28 - s29
    s31 = reciprocal_14*s10 - lower_43*s30 - lower_44*s27 - lower_45*s24 - lower_46*s21
    s32 = lower_47*s18
    s33 = s31 - s32
    s34 = reciprocal_13*s9 - lower_37*s33 - lower_38*s30 - lower_39*s27 - lower_40*s24 - lower_41*s21
    s35 = lower_42*s18
    s36 = s34 - s35
    s37 = reciprocal_12*s1 - lower_30*s36 - lower_31*s33 - lower_32*s30 - lower_33*s27 - lower_34*s24
    s38 = s37 - lower_35*s21
    s39 = lower_36*s18
    s40 = s38 - s39
    s41 = reciprocal_11*s8 - lower_28*s21
    s42 = lower_29*s18
    s43 = s41 - s42
    s44 = reciprocal_10*s6 - lower_25*s43 - lower_26*s21
    s45 = lower_27*s18
    s46 = s44 - s45
    s47 = reciprocal_9*s7 - lower_23*s27
    s48 = lower_24*s24
    s49 = s47 - s48
    s50 = reciprocal_8*s4 - lower_20*s49 - lower_21*s27
    s51 = lower_22*s24
    s52 = s50 - s51
    s53 = reciprocal_7*s5 - lower_18*s46 - lower_19*s43
    s54 = reciprocal_6*right_18 - lower_15*s53 - lower_16*s46 - lower_17*s43
    s55 = reciprocal_5*s3 - lower_13*s52 - lower_14*s49
    s56 = reciprocal_4*right_16 - lower_10*s55 - lower_11*s52 - lower_12*s49
    s57 = reciprocal_3*s2 - lower_8*s33 - lower_9*s30
    s58 = reciprocal_2*right_10 - lower_5*s57 - lower_6*s33 - lower_7*s30
    s59 = reciprocal_1*s0 - lower_3*s40 - lower_4*s36
    s60 = reciprocal_0*right_0 - lower_0*s59 - lower_1*s40 - lower_2*s36
    s61 = s40*jacobian_3 + s36*jacobian_5 + s33*jacobian_6 + s30*jacobian_8 + s27*jacobian_10 + s24*jacobian_12
    # outputs
    w[168] = s60 + s39 - s38
    w[169] = s59 + s35 - s34
    w[170] = s60*jacobian_0 + s59*jacobian_1 + s40*jacobian_2 + s36*jacobian_4
    w[171] = s40 + s32 - s31 + s26 - s25 + s20 - s19
    w[172] = s36 + s29 - s28 + s23 - s22 - s18
    w[173] = s61 + s21*jacobian_14 + s18*jacobian_16
    w[174] = s33 + s58
    w[175] = s30 + s57
    w[176] = s33*jacobian_7 + s30*jacobian_9 + s58*jacobian_18 + s57*jacobian_19
    w[177] = s27 + s51 - s50
    w[178] = s24 + s48 - s47
    w[179] = s27*jacobian_11 + s24*jacobian_13 + s52*jacobian_20 + s49*jacobian_22
    w[180] = s52 + s56
    w[181] = s49 + s55
    w[182] = s52*jacobian_21 + s49*jacobian_23 + s56*jacobian_28 + s55*jacobian_29
    w[183] = s21 + s45 - s44
    w[184] = s18 + s42 - s41
    w[185] = s21*jacobian_15 + s18*jacobian_17 + s46*jacobian_24 + s43*jacobian_26
    w[186] = s46 + s54
    w[187] = s43 + s53
    w[188] = s46*jacobian_25 + s43*jacobian_27 + s54*jacobian_30 + s53*jacobian_31
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def drift(y, w):
    """D v - nu with the D and nu that `geometry` left: 76 operations, 76 before sharing."""
    # inputs
    v0 = y[21]  # K1.vx [m/s]
    v1 = y[22]  # K1.vy [m/s]
    v2 = y[23]  # K1.omega [rad/s]
    v3 = y[24]  # K2.vx [m/s]
    v4 = y[25]  # K2.vy [m/s]
    v5 = y[26]  # K2.omega [rad/s]
    v6 = y[27]  # K3.vx [m/s]
    v7 = y[28]  # K3.vy [m/s]
    v8 = y[29]  # K3.omega [rad/s]
    v9 = y[30]  # K4.vx [m/s]
    v10 = y[31]  # K4.vy [m/s]
    v11 = y[32]  # K4.omega [rad/s]
    v12 = y[33]  # K5.vx [m/s]
    v13 = y[34]  # K5.vy [m/s]
    v14 = y[35]  # K5.omega [rad/s]
    v15 = y[36]  # K6.vx [m/s]
    v16 = y[37]  # K6.vy [m/s]
    v17 = y[38]  # K6.omega [rad/s]
    v18 = y[39]  # K7.vx [m/s]
    v19 = y[40]  # K7.vy [m/s]
    v20 = y[41]  # K7.omega [rad/s]
    jacobian_0 = w[210]
    jacobian_1 = w[211]
    jacobian_2 = w[212]
    jacobian_3 = w[213]
    jacobian_4 = w[214]
    jacobian_5 = w[215]
    jacobian_6 = w[216]
    jacobian_7 = w[217]
    jacobian_8 = w[218]
    jacobian_9 = w[219]
    jacobian_10 = w[220]
    jacobian_11 = w[221]
    jacobian_12 = w[222]
    jacobian_13 = w[223]
    jacobian_14 = w[224]
    jacobian_15 = w[225]
    jacobian_16 = w[226]
    jacobian_17 = w[227]
    jacobian_18 = w[228]
    jacobian_19 = w[229]
    jacobian_20 = w[230]
    jacobian_21 = w[231]
    jacobian_22 = w[232]
    jacobian_23 = w[233]
    jacobian_24 = w[234]
    jacobian_25 = w[235]
    jacobian_26 = w[236]
    jacobian_27 = w[237]
    jacobian_28 = w[238]
    jacobian_29 = w[239]
    jacobian_30 = w[240]
    jacobian_31 = w[241]
    # outputs
    w[108] = v0 + v2*jacobian_0
    w[109] = v1 + v2*jacobian_1
    w[110] = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    w[111] = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    w[112] = v6 + v5*jacobian_6 - v3 + v8*jacobian_7
    w[113] = v7 + v5*jacobian_8 - v4 + v8*jacobian_9
    w[114] = v9 + v5*jacobian_10 - v3 + v11*jacobian_11
    w[115] = v10 + v5*jacobian_12 - v4 + v11*jacobian_13
    w[116] = v15 + v5*jacobian_14 - v3 + v17*jacobian_15
    w[117] = v16 + v5*jacobian_16 - v4 + v17*jacobian_17
    w[118] = v6 + v8*jacobian_18
    w[119] = v7 + v8*jacobian_19
    w[120] = v12 + v11*jacobian_20 - v9 + v14*jacobian_21
    w[121] = v13 + v11*jacobian_22 - v10 + v14*jacobian_23
    w[122] = v18 + v17*jacobian_24 - v15 + v20*jacobian_25
    w[123] = v19 + v17*jacobian_26 - v16 + v20*jacobian_27
    w[124] = v12 + v14*jacobian_28
    w[125] = v13 + v14*jacobian_29
    w[126] = v18 + v20*jacobian_30
    w[127] = v19 + v20*jacobian_31
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def energies(t, y, p, w):
    """kinetic and potential energy: 81 operations, 130 before sharing."""
    # inputs
    p2 = p[2]  # spring_length [m]
    v0 = y[21]  # K1.vx [m/s]
    v1 = y[22]  # K1.vy [m/s]
    v2 = y[23]  # K1.omega [rad/s]
    v3 = y[24]  # K2.vx [m/s]
    v4 = y[25]  # K2.vy [m/s]
    v5 = y[26]  # K2.omega [rad/s]
    q6 = y[6]  # K3.x [m]
    v6 = y[27]  # K3.vx [m/s]
    q7 = y[7]  # K3.y [m]
    v7 = y[28]  # K3.vy [m/s]
    q8 = y[8]  # K3.theta [rad]
    v8 = y[29]  # K3.omega [rad/s]
    v9 = y[30]  # K4.vx [m/s]
    v10 = y[31]  # K4.vy [m/s]
    v11 = y[32]  # K4.omega [rad/s]
    v12 = y[33]  # K5.vx [m/s]
    v13 = y[34]  # K5.vy [m/s]
    v14 = y[35]  # K5.omega [rad/s]
    v15 = y[36]  # K6.vx [m/s]
    v16 = y[37]  # K6.vy [m/s]
    v17 = y[38]  # K6.omega [rad/s]
    v18 = y[39]  # K7.vx [m/s]
    v19 = y[40]  # K7.vy [m/s]
    v20 = y[41]  # K7.omega [rad/s]
    p3 = p[3]
    # intermediate terms
    s0 = math.cos(q8)
    s1 = math.sin(q8)
    s2 = q7 + 0.0007400000000000011*s0 + 0.00957*s1 - 0.072
    s3 = q6 + 0.00957*s0 - 0.0007400000000000011*s1 - 0.014
    s4 = math.sqrt(s2*s2 + s3*s3) - p2
    s5 = 0.021625*(v0*v0) + 0.021625*(v1*v1) + 1.097e-06*(v2*v2) + 0.001825*(v3*v3) + 0.001825*(v4*v4)
    s6 = s5 + 2.205e-07*(v5*v5) + 0.011865*(v6*v6) + 0.011865*(v7*v7) + 2.6275e-06*(v8*v8) + 0.00353*(v9*v9)
    s7 = s6 + 0.00353*(v10*v10) + 2.8335e-07*(v11*v11) + 0.03525*(v12*v12) + 0.03525*(v13*v13) + 5.845e-06*(v14*v14)
    s8 = s7 + 0.00353*(v15*v15) + 0.00353*(v16*v16) + 2.8335e-07*(v17*v17) + 0.02749*(v18*v18) + 0.02749*(v19*v19)
    # outputs
    w[2] = s8 + 9.56e-06*(v20*v20)
    w[3] = p3*(s4*s4)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates: 242 operations, 408 before sharing."""
    # inputs
    q2 = y[2]  # K1.theta [rad]
    v2 = y[23]  # K1.omega [rad/s]
    q5 = y[5]  # K2.theta [rad]
    v5 = y[26]  # K2.omega [rad/s]
    q8 = y[8]  # K3.theta [rad]
    v8 = y[29]  # K3.omega [rad/s]
    q11 = y[11]  # K4.theta [rad]
    v11 = y[32]  # K4.omega [rad/s]
    q14 = y[14]  # K5.theta [rad]
    v14 = y[35]  # K5.omega [rad/s]
    q17 = y[17]  # K6.theta [rad]
    v17 = y[38]  # K6.omega [rad/s]
    q20 = y[20]  # K7.theta [rad]
    v20 = y[41]  # K7.omega [rad/s]
    ydot_21 = ydot[21]
    ydot_22 = ydot[22]
    ydot_23 = ydot[23]
    ydot_24 = ydot[24]
    ydot_25 = ydot[25]
    ydot_26 = ydot[26]
    ydot_27 = ydot[27]
    ydot_28 = ydot[28]
    ydot_29 = ydot[29]
    ydot_30 = ydot[30]
    ydot_31 = ydot[31]
    ydot_32 = ydot[32]
    ydot_33 = ydot[33]
    ydot_34 = ydot[34]
    ydot_35 = ydot[35]
    ydot_36 = ydot[36]
    ydot_37 = ydot[37]
    ydot_38 = ydot[38]
    ydot_39 = ydot[39]
    ydot_40 = ydot[40]
    ydot_41 = ydot[41]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = 0.00092*s2
    s4 = math.cos(q5)
    s5 = math.sin(q5)
    s6 = v5*v5
    s7 = 0.00608*s2
    s8 = 0.0115*s6
    s9 = math.cos(q8)
    s10 = math.sin(q8)
    s11 = v8*v8
    s12 = 0.01043*s9
    s13 = 0.01043*s10
    s14 = 0.0165*s6
    s15 = s4*s14
    s16 = 0.016260000000000004*s11
    s17 = 0.01043*s11
    s18 = s9*s17
    s19 = s5*s14
    s20 = s10*s17
    s21 = math.cos(q11)
    s22 = math.sin(q11)
    s23 = v11*v11
    s24 = 0.01421*s23
    s25 = math.cos(q17)
    s26 = math.sin(q17)
    s27 = v17*v17
    s28 = 0.01421*s27
    s29 = 0.01874*s11
    s30 = math.cos(q14)
    s31 = math.sin(q14)
    s32 = v14*v14
    s33 = 0.02308*s31
    s34 = 0.02308*s30
    s35 = 0.00579*s23
    s36 = 0.02308*s32
    s37 = s31*s36
    s38 = 0.03084*s32
    s39 = s30*s36
    s40 = math.cos(q20)
    s41 = math.sin(q20)
    s42 = v20*v20
    s43 = 0.00449*s40
    s44 = 0.00449*s41
    s45 = 0.00579*s27
    s46 = 0.02772*s42
    s47 = 0.00449*s42
    s48 = s40*s47
    s49 = s41*s47
    s50 = 0.00916*s32
    s51 = 0.01228*s42
    s52 = ydot_24 + 0.0165*s5*ydot_26
    s53 = 0.0165*s4*ydot_26 - ydot_25
    s54 = ydot_33 + 0.00579*s21*ydot_32 - ydot_30 + (s34 - 0.03084*s31)*ydot_35 - (s22*s35 + s37 + s30*s38)
    s55 = s21*s35 - s31*s38 + s39 + ydot_34 + 0.00579*s22*ydot_32 - ydot_31 + (0.03084*s30 + s33)*ydot_35
    s56 = ydot_39 - (ydot_36 + 0.00579*s26*ydot_38) + (0.02772*s40 + s44)*ydot_41 - (s25*s45 + s41*s46 - s48)
    s57 = s49 - s26*s45 + s40*s46 + ydot_40 + 0.00579*s25*ydot_38 - ydot_37 + (0.02772*s41 - s43)*ydot_41
    # outputs
    out[0] = s0*s3 + ydot_21 + 0.00092*s1*ydot_23
    out[1] = s1*s3 + ydot_22 - 0.00092*s0*ydot_23
    out[2] = ydot_24 + 0.00608*s1*ydot_23 - ydot_21 - 0.0115*s5*ydot_26 - (s4*s8 - s0*s7)
    out[3] = ydot_25 - (ydot_22 + 0.00608*s0*ydot_23) + 0.0115*s4*ydot_26 - (s5*s8 - s1*s7)
    out[4] = ydot_27 - s52 + (0.016260000000000004*s9 + s13)*ydot_29 - (s15 + s10*s16 - s18)
    out[5] = s20 - s19 + s9*s16 + ydot_28 + s53 + (0.016260000000000004*s10 - s12)*ydot_29
    out[6] = ydot_30 - s52 + 0.01421*s21*ydot_32 - (s15 + s22*s24)
    out[7] = ydot_31 + s53 + 0.01421*s22*ydot_32 - (s19 - s21*s24)
    out[8] = ydot_36 - s52 - 0.01421*s26*ydot_38 - (s15 + s25*s28)
    out[9] = ydot_37 + s53 + 0.01421*s25*ydot_38 - (s19 + s26*s28)
    out[10] = s18 + s10*s29 + ydot_27 + (s13 - 0.01874*s9)*ydot_29
    out[11] = ydot_28 - (s12 + 0.01874*s10)*ydot_29 - (s9*s29 - s20)
    out[12] = s54
    out[13] = s55
    out[14] = s56
    out[15] = s57
    out[16] = ydot_33 + (s34 + 0.00916*s31)*ydot_35 - (s37 - s30*s50)
    out[17] = s39 + s31*s50 + ydot_34 + (s33 - 0.00916*s30)*ydot_35
    out[18] = s48 + s41*s51 + ydot_39 + (s44 - 0.01228*s40)*ydot_41
    out[19] = ydot_40 - (s43 + 0.01228*s41)*ydot_41 - (s40*s51 - s49)
    out[20] = q2
    out[21] = v2
    out[22] = q5 - q2
    out[23] = v5 - v2
    out[24] = q8 - q5
    out[25] = v8 - v5
    out[26] = q11 - q5
    out[27] = v11 - v5
    out[28] = q17 - q5
    out[29] = v17 - v5
    out[30] = q8
    out[31] = v8
    out[32] = q14 - q11
    out[33] = v14 - v11
    out[34] = q20 - q17
    out[35] = v20 - v17
    out[36] = q14
    out[37] = v14
    out[38] = q20
    out[39] = v20
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # outputs
    w[189] = 0.04325
    w[190] = 0.04325
    w[191] = 2.194e-06
    w[192] = 0.00365
    w[193] = 0.00365
    w[194] = 4.41e-07
    w[195] = 0.02373
    w[196] = 0.02373
    w[197] = 5.255e-06
    w[198] = 0.00706
    w[199] = 0.00706
    w[200] = 5.667e-07
    w[201] = 0.0705
    w[202] = 0.0705
    w[203] = 1.169e-05
    w[204] = 0.00706
    w[205] = 0.00706
    w[206] = 5.667e-07
    w[207] = 0.05498
    w[208] = 0.05498
    w[209] = 1.912e-05
    return 0
