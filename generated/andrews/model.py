"""Model `andrews`: what every method of it shares. Emitted by symgen; do not edit.

digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 2, templates 06e8f0c6b361de81
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
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 719 operations, 398542119 before sharing."""
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
    mask_1 = w[36]
    mask_2 = w[37]
    mask_3 = w[38]
    mask_4 = w[39]
    mask_5 = w[40]
    mask_6 = w[41]
    mask_7 = w[42]
    mask_8 = w[43]
    mask_9 = w[44]
    mask_11 = w[46]
    mask_12 = w[47]
    mask_13 = w[48]
    mask_14 = w[49]
    mask_15 = w[50]
    mask_17 = w[52]
    mask_19 = w[54]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 0.00092*s0
    s3 = q0 - s2
    s4 = 0.00092*s1
    s5 = q1 - s4
    s6 = math.cos(q5)
    s7 = math.sin(q5)
    s8 = 0.0115*s6
    s9 = 0.00608*s0
    s10 = q3 - q0 + s8 - s9
    s11 = 0.0115*s7
    s12 = 0.00608*s1
    s13 = q4 - q1 + s11 - s12
    s14 = math.cos(q8)
    s15 = math.sin(q8)
    s16 = 0.01043*s14
    s17 = 0.0165*s6
    s18 = 0.016260000000000004*s15
    s19 = q6 - q3 - s16 + s17 + s18
    s20 = 0.016260000000000004*s14
    s21 = 0.01043*s15
    s22 = 0.0165*s7
    s23 = -s22
    s24 = q7 - q4 - s20 - s21 + s22
    s25 = s20 + s21
    s26 = s18 - s16
    s27 = math.cos(q11)
    s28 = math.sin(q11)
    s29 = 0.01421*s28
    s30 = s17 + q9 - q3 + s29
    s31 = 0.01421*s27
    s32 = s22 + q10 - q4 - s31
    s33 = math.cos(q17)
    s34 = math.sin(q17)
    s35 = 0.01421*s33
    s36 = s17 + q15 - q3 + s35
    s37 = 0.01421*s34
    s38 = s22 + q16 - q4 + s37
    s39 = 0.01874*s15
    s40 = q6 - -0.03635 - s16 - s39
    s41 = 0.01874*s14
    s42 = q7 - 0.03273 + s41 - s21
    s43 = s21 - s41
    s44 = s16 + s39
    s45 = math.cos(q14)
    s46 = math.sin(q14)
    s47 = 0.00579*s28
    s48 = 0.03084*s45
    s49 = 0.02308*s46
    s50 = q12 - q9 + s47 + s48 + s49
    s51 = 0.02308*s45
    s52 = 0.03084*s46
    s53 = 0.00579*s27
    s54 = q13 - q10 - s51 + s52 - s53
    s55 = s51 - s52
    s56 = s48 + s49
    s57 = math.cos(q20)
    s58 = math.sin(q20)
    s59 = 0.00449*s57
    s60 = 0.00579*s33
    s61 = 0.02772*s58
    s62 = q18 - q15 - s59 + s60 + s61
    s63 = 0.02772*s57
    s64 = 0.00449*s58
    s65 = 0.00579*s34
    s66 = q19 - q16 - s63 - s64 + s65
    s67 = s63 + s64
    s68 = s61 - s59
    s69 = 0.00916*s45
    s70 = s49 + q12 - -0.06934 - s69
    s71 = 0.00916*s46
    s72 = q13 - -0.00227 - s51 - s71
    s73 = s51 + s71
    s74 = s49 - s69
    s75 = 0.01228*s58
    s76 = q18 - -0.06934 - s59 - s75
    s77 = 0.01228*s57
    s78 = q19 - -0.00227 + s77 - s64
    s79 = s64 - s77
    s80 = s59 + s75
    s81 = s2*s4
    s82 = -1.0 + s4*s12
    s83 = s4*s9
    s84 = 1.0 + s2*s2
    s85 = 1.0 + 1.0 + s12*s12 + s11*s11
    s86 = -1.0 + s11*s22
    s87 = s11*s17
    s88 = 1.0 + 1.0 + s9*s9 + s8*s8
    s89 = 1.0 + s22*s22
    s90 = 1.0 + s89
    s91 = s90 + s25*s25
    s92 = s17*s22
    s93 = 1.0 + s25*s43
    s94 = 1.0 + s17*s17
    s95 = 1.0 + s94
    s96 = s95 + s26*s26
    s97 = s26*s43
    s98 = s90 + s31*s31
    s99 = -1.0 + s31*s53
    s100 = s95 + s29*s29
    s101 = s29*s53
    s102 = s90 + s37*s37
    s103 = -1.0 + s37*s65
    s104 = s95 + s35*s35
    s105 = s35*s65
    s106 = s43*s44
    s107 = 1.0 + s44*s44
    s108 = 1.0 + 1.0 + s53*s53 + s55*s55
    s109 = 1.0 + s55*s73
    s110 = 1.0 + 1.0 + s47*s47 + s56*s56
    s111 = s56*s73
    s112 = 1.0 + 1.0 + s65*s65 + s67*s67
    s113 = 1.0 + s67*s79
    s114 = 1.0 + 1.0 + s60*s60 + s68*s68
    s115 = s68*s79
    s116 = s73*s74
    s117 = 1.0 + s74*s74
    s118 = s79*s80
    s119 = 1.0 + s80*s80
    s120 = 1.0/(1.0 + s4*s4)
    s121 = s81*s120
    s122 = s82*s120
    s123 = s83*s120
    s124 = s84 - s81*s121
    s125 = s82*s121 - s2*s12
    s126 = -1.0 + s2*s9 - s83*s121
    s127 = 1.0*(s124 > mask_1 + 1e-12*s84)
    s128 = s127/(s124 + 1.0 - s127)
    s129 = s125*s128
    s130 = s126*s128
    s131 = s85 - s82*s122 - s125*s129
    s132 = s83*s122 - (s9*s12 + s8*s11) - s126*s129
    s133 = 1.0/(1.0 + s43*s43)
    s134 = s106*s133
    s135 = s93*s133
    s136 = s97*s133
    s137 = s107 - s106*s134
    s138 = s93*s134 - s25*s44
    s139 = 1.0 - s26*s44 + s97*s134
    s140 = 1.0*(s137 > mask_11 + 1e-12*s107)
    s141 = s140/(s137 + 1.0 - s140)
    s142 = s138*s141
    s143 = s139*s141
    s144 = 1.0/(1.0 + s73*s73)
    s145 = s116*s144
    s146 = s109*s144
    s147 = s111*s144
    s148 = s117 - s116*s145
    s149 = s55*s74 - s109*s145
    s150 = 1.0 + s56*s74 - s111*s145
    s151 = 1.0*(s148 > mask_17 + 1e-12*s117)
    s152 = s151/(s148 + 1.0 - s151)
    s153 = s149*s152
    s154 = s150*s152
    s155 = s108 - s109*s146 - s149*s153
    s156 = s47*s53 + s55*s56 - s111*s146 - s150*s153
    s157 = 1.0/(1.0 + s79*s79)
    s158 = s118*s157
    s159 = s113*s157
    s160 = s115*s157
    s161 = s119 - s118*s158
    s162 = s113*s158 - s67*s80
    s163 = 1.0 - s68*s80 + s115*s158
    s164 = 1.0*(s161 > mask_19 + 1e-12*s119)
    s165 = s164/(s161 + 1.0 - s164)
    s166 = s162*s165
    s167 = s163*s165
    s168 = s112 - s113*s159 - s162*s166
    s169 = s67*s68 - s60*s65 - s115*s159 - s163*s166
    s170 = 1.0*(s155 > mask_12 + 1e-12*s108)
    s171 = s170/(s155 + 1.0 - s170)
    s172 = s156*s171
    s173 = s99*s171
    s174 = s101*s171
    s175 = s110 - s111*s147 - s150*s154 - s156*s172
    s176 = s31*s47 - s99*s172
    s177 = -1.0 + s29*s47 - s101*s172
    s178 = 1.0*(s175 > mask_13 + 1e-12*s110)
    s179 = s178/(s175 + 1.0 - s178)
    s180 = s176*s179
    s181 = s177*s179
    s182 = 1.0*(s168 > mask_14 + 1e-12*s112)
    s183 = s182/(s168 + 1.0 - s182)
    s184 = s169*s183
    s185 = s103*s183
    s186 = s105*s183
    s187 = s114 - s115*s160 - s163*s167 - s169*s184
    s188 = s37*s60 + s103*s184
    s189 = -1.0 + s35*s60 + s105*s184
    s190 = 1.0*(s187 > mask_15 + 1e-12*s114)
    s191 = s190/(s187 + 1.0 - s190)
    s192 = s188*s191
    s193 = s189*s191
    s194 = 1.0*(s131 > mask_2 + 1e-12*s85)
    s195 = s194/(s131 + 1.0 - s194)
    s196 = s132*s195
    s197 = s86*s195
    s198 = s87*s195
    s199 = -s198
    s200 = s88 - s83*s123 - s126*s130 - s132*s196
    s201 = s8*s22 + s86*s196
    s202 = -1.0 + s8*s17 + s87*s196
    s203 = s86*s197
    s204 = s87*s197
    s205 = s87*s198
    s206 = 1.0*(s200 > mask_3 + 1e-12*s88)
    s207 = s206/(s200 + 1.0 - s206)
    s208 = s201*s207
    s209 = -s208
    s210 = s202*s207
    s211 = s201*s208
    s212 = s91 - s93*s135 - s138*s142 - s203 - s211
    s213 = s202*s208
    s214 = s25*s26 - s92 - s97*s135 - s139*s142 + s204 + s213
    s215 = s89 - s203 - s211
    s216 = s204 - s92 + s213
    s217 = s202*s210
    s218 = s86*s198 - s92 + s201*s210
    s219 = s94 - s205 - s217
    s220 = 1.0*(s212 > mask_4 + 1e-12*s91)
    s221 = s220/(s212 + 1.0 - s220)
    s222 = s214*s221
    s223 = s215*s221
    s224 = s216*s221
    s225 = s96 - s97*s136 - s139*s143 - s205 - s217 - s214*s222
    s226 = s218 - s215*s222
    s227 = s219 - s216*s222
    s228 = s215*s223
    s229 = s216*s223
    s230 = s216*s224
    s231 = 1.0*(s225 > mask_5 + 1e-12*s96)
    s232 = s231/(s225 + 1.0 - s231)
    s233 = s226*s232
    s234 = s227*s232
    s235 = s226*s233
    s236 = s98 - s99*s173 - s176*s180 - s203 - s211 - s228 - s235
    s237 = s227*s233
    s238 = s29*s31 - s92 - s101*s173 - s177*s180 + s204 + s213 - s229 - s237
    s239 = s215 - s228 - s235
    s240 = s216 - s229 - s237
    s241 = s227*s234
    s242 = 1.0*(s236 > mask_6 + 1e-12*s98)
    s243 = s242/(s236 + 1.0 - s242)
    s244 = s238*s243
    s245 = s239*s243
    s246 = s240*s243
    s247 = s100 - s101*s174 - s177*s181 - s205 - s217 - s230 - s241 - s238*s244
    s248 = s218 - s215*s224 - s226*s234 - s239*s244
    s249 = s219 - s230 - s241 - s240*s244
    s250 = 1.0*(s247 > mask_7 + 1e-12*s100)
    s251 = s250/(s247 + 1.0 - s250)
    s252 = s248*s251
    s253 = s249*s251
    s254 = s102 - s103*s185 - s188*s192 - s203 - s211 - s228 - s235 - s239*s245 - s248*s252
    s255 = s105*s185 - (s92 + s35*s37) + s189*s192 + s204 + s213 - s229 - s237 - s240*s245 - s249*s252
    s256 = 1.0*(s254 > mask_8 + 1e-12*s102)
    s257 = s256/(s254 + 1.0 - s256)
    s258 = s255*s257
    s259 = s104 - s105*s186 - s189*s193 - s205 - s217 - s230 - s241 - s240*s246 - s249*s253 - s255*s258
    s260 = 1.0*(s259 > mask_9 + 1e-12*s104)
    s261 = s3*s3 + s5*s5 + s10*s10 + s13*s13 + s19*s19 + s24*s24 + s30*s30 + s32*s32 + s36*s36 + s38*s38
    s262 = s261 + s40*s40 + s42*s42 + s50*s50 + s54*s54 + s62*s62 + s66*s66 + s70*s70 + s72*s72 + s76*s76
    s263 = s124/s84
    s264 = s131/s85
    s265 = s200/s88
    s266 = s212/s91
    s267 = s225/s96
    s268 = min(min(min(min(min(1.0, mask_1 + s263), mask_2 + s264), mask_3 + s265), mask_4 + s266), mask_5 + s267)
    s269 = s236/s98
    s270 = s247/s100
    s271 = s254/s102
    s272 = s259/s104
    s273 = s137/s107
    s274 = min(min(min(min(min(s268, mask_6 + s269), mask_7 + s270), mask_8 + s271), mask_9 + s272), mask_11 + s273)
    s275 = s155/s108
    s276 = s175/s110
    s277 = s178 + s170 + s140 + 1.0 + s260 + s256 + s250 + s242 + s231 + s220 + s206 + s194 + 1.0 + s127
    s278 = s168/s112
    s279 = s187/s114
    s280 = s148/s117
    s281 = min(min(min(min(min(s274, mask_12 + s275), mask_13 + s276), mask_14 + s278), mask_15 + s279), mask_17 + s280)
    s282 = s161/s119
    # outputs
    w[75] = s3
    w[76] = s5
    w[77] = s10
    w[78] = s13
    w[79] = s19
    w[80] = s24
    w[81] = s30
    w[82] = s32
    w[83] = s36
    w[84] = s38
    w[85] = s40
    w[86] = s42
    w[87] = s50
    w[88] = s54
    w[89] = s62
    w[90] = s66
    w[91] = s70
    w[92] = s72
    w[93] = s76
    w[94] = s78
    w[0] = math.sqrt(s262 + s78*s78)
    w[177] = s4
    w[178] = -s2
    w[179] = s12
    w[180] = -s11
    w[181] = -s9
    w[182] = s8
    w[183] = s23
    w[184] = s25
    w[185] = s17
    w[186] = s26
    w[187] = s23
    w[188] = s31
    w[189] = s17
    w[190] = s29
    w[191] = s23
    w[192] = -s37
    w[193] = s17
    w[194] = s35
    w[195] = s43
    w[196] = -s44
    w[197] = s53
    w[198] = s55
    w[199] = s47
    w[200] = s56
    w[201] = -s65
    w[202] = s67
    w[203] = s60
    w[204] = s68
    w[205] = s73
    w[206] = s74
    w[207] = s79
    w[208] = -s80
    w[116] = s263
    w[117] = s264
    w[118] = s265
    w[119] = s266
    w[120] = s267
    w[121] = s269
    w[122] = s270
    w[123] = s271
    w[124] = s272
    w[126] = s273
    w[127] = s275
    w[128] = s276
    w[129] = s278
    w[130] = s279
    w[132] = s280
    w[134] = s282
    w[5] = s164 + 1.0 + s151 + 1.0 + s190 + s182 + s277
    w[4] = min(s281, mask_19 + s282)
    w[209] = -s121
    w[210] = s122
    w[211] = -s123
    w[212] = s129
    w[213] = s130
    w[214] = -s134
    w[215] = s135
    w[216] = s136
    w[217] = s142
    w[218] = s143
    w[219] = s145
    w[220] = s146
    w[221] = s147
    w[222] = s153
    w[223] = s154
    w[224] = -s158
    w[225] = s159
    w[226] = s160
    w[227] = s166
    w[228] = s167
    w[229] = s172
    w[230] = s173
    w[231] = s174
    w[232] = s180
    w[233] = s181
    w[234] = s184
    w[235] = s185
    w[236] = -s186
    w[237] = -s192
    w[238] = s193
    w[239] = s196
    w[240] = s197
    w[241] = s199
    w[242] = s197
    w[243] = s199
    w[244] = s197
    w[245] = s199
    w[246] = s209
    w[247] = s210
    w[248] = s209
    w[249] = s210
    w[250] = s209
    w[251] = s210
    w[252] = s222
    w[253] = s223
    w[254] = s224
    w[255] = s223
    w[256] = s224
    w[257] = s233
    w[258] = s234
    w[259] = s233
    w[260] = s234
    w[261] = s244
    w[262] = s245
    w[263] = s246
    w[264] = s252
    w[265] = s253
    w[266] = s258
    w[267] = s120
    w[268] = s128
    w[269] = s133
    w[270] = s141
    w[271] = s144
    w[272] = s152
    w[273] = s157
    w[274] = s165
    w[275] = s171
    w[276] = s179
    w[277] = s183
    w[278] = s191
    w[279] = s195
    w[280] = s207
    w[281] = s221
    w[282] = s232
    w[283] = s243
    w[284] = s251
    w[285] = s257
    w[286] = s260/(s259 + 1.0 - s260)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 337 operations, 2294061 before sharing."""
    # inputs
    lower_0 = w[209]
    lower_1 = w[210]
    lower_2 = w[211]
    lower_3 = w[212]
    lower_4 = w[213]
    lower_5 = w[214]
    lower_6 = w[215]
    lower_7 = w[216]
    lower_8 = w[217]
    lower_9 = w[218]
    lower_10 = w[219]
    lower_11 = w[220]
    lower_12 = w[221]
    lower_13 = w[222]
    lower_14 = w[223]
    lower_15 = w[224]
    lower_16 = w[225]
    lower_17 = w[226]
    lower_18 = w[227]
    lower_19 = w[228]
    lower_20 = w[229]
    lower_21 = w[230]
    lower_22 = w[231]
    lower_23 = w[232]
    lower_24 = w[233]
    lower_25 = w[234]
    lower_26 = w[235]
    lower_27 = w[236]
    lower_28 = w[237]
    lower_29 = w[238]
    lower_30 = w[239]
    lower_31 = w[240]
    lower_32 = w[241]
    lower_33 = w[242]
    lower_34 = w[243]
    lower_35 = w[244]
    lower_36 = w[245]
    lower_37 = w[246]
    lower_38 = w[247]
    lower_39 = w[248]
    lower_40 = w[249]
    lower_41 = w[250]
    lower_42 = w[251]
    lower_43 = w[252]
    lower_44 = w[253]
    lower_45 = w[254]
    lower_46 = w[255]
    lower_47 = w[256]
    lower_48 = w[257]
    lower_49 = w[258]
    lower_50 = w[259]
    lower_51 = w[260]
    lower_52 = w[261]
    lower_53 = w[262]
    lower_54 = w[263]
    lower_55 = w[264]
    lower_56 = w[265]
    lower_57 = w[266]
    reciprocal_0 = w[267]
    reciprocal_1 = w[268]
    reciprocal_2 = w[269]
    reciprocal_3 = w[270]
    reciprocal_4 = w[271]
    reciprocal_5 = w[272]
    reciprocal_6 = w[273]
    reciprocal_7 = w[274]
    reciprocal_8 = w[275]
    reciprocal_9 = w[276]
    reciprocal_10 = w[277]
    reciprocal_11 = w[278]
    reciprocal_12 = w[279]
    reciprocal_13 = w[280]
    reciprocal_14 = w[281]
    reciprocal_15 = w[282]
    reciprocal_16 = w[283]
    reciprocal_17 = w[284]
    reciprocal_18 = w[285]
    reciprocal_19 = w[286]
    residual_0 = w[75]
    residual_1 = w[76]
    residual_2 = w[77]
    residual_3 = w[78]
    residual_4 = w[79]
    residual_5 = w[80]
    residual_6 = w[81]
    residual_7 = w[82]
    residual_8 = w[83]
    residual_9 = w[84]
    residual_10 = w[85]
    residual_11 = w[86]
    residual_12 = w[87]
    residual_13 = w[88]
    residual_14 = w[89]
    residual_15 = w[90]
    residual_16 = w[91]
    residual_17 = w[92]
    residual_18 = w[93]
    residual_19 = w[94]
    jacobian_0 = w[177]
    jacobian_1 = w[178]
    jacobian_2 = w[179]
    jacobian_3 = w[180]
    jacobian_4 = w[181]
    jacobian_5 = w[182]
    jacobian_6 = w[183]
    jacobian_7 = w[184]
    jacobian_8 = w[185]
    jacobian_9 = w[186]
    jacobian_10 = w[187]
    jacobian_11 = w[188]
    jacobian_12 = w[189]
    jacobian_13 = w[190]
    jacobian_14 = w[191]
    jacobian_15 = w[192]
    jacobian_16 = w[193]
    jacobian_17 = w[194]
    jacobian_18 = w[195]
    jacobian_19 = w[196]
    jacobian_20 = w[197]
    jacobian_21 = w[198]
    jacobian_22 = w[199]
    jacobian_23 = w[200]
    jacobian_24 = w[201]
    jacobian_25 = w[202]
    jacobian_26 = w[203]
    jacobian_27 = w[204]
    jacobian_28 = w[205]
    jacobian_29 = w[206]
    jacobian_30 = w[207]
    jacobian_31 = w[208]
    # intermediate terms
    s0 = lower_0*residual_0 - residual_1
    s1 = lower_1*residual_0 - residual_2 - lower_3*s0
    s2 = lower_5*residual_10 - residual_11
    s3 = lower_10*residual_16 - residual_17
    s4 = lower_11*residual_16 - residual_12 - lower_13*s3
    s5 = lower_15*residual_18 - residual_19
    s6 = lower_16*residual_18 - residual_14 - lower_18*s5
    s7 = lower_12*residual_16 - residual_13 - lower_14*s3 - lower_20*s4
    s8 = lower_17*residual_18 - residual_15 - lower_19*s5 - lower_25*s6
    s9 = lower_2*residual_0 - residual_3 - lower_4*s0 - lower_30*s1
    s10 = lower_6*residual_10 - residual_4 - lower_8*s2 - lower_31*s1 - lower_37*s9
    s11 = lower_7*residual_10 - residual_5 - lower_9*s2 - lower_32*s1 - lower_38*s9 - lower_43*s10
    s12 = residual_6 + lower_21*s4 + lower_23*s7 + lower_33*s1 + lower_39*s9 + lower_44*s10 + lower_48*s11
    s13 = residual_7 + lower_22*s4 + lower_24*s7 + lower_34*s1 + lower_40*s9 + lower_45*s10 + lower_49*s11
    s14 = residual_8 + lower_26*s6 + lower_28*s8 + lower_35*s1 + lower_41*s9 + lower_46*s10 + lower_50*s11
    s15 = residual_9 + lower_27*s6 + lower_29*s8 + lower_36*s1 + lower_42*s9 + lower_47*s10 + lower_51*s11
    s16 = lower_52*s12 - s13
    s17 = lower_53*s12 - s14 - lower_55*s16
    s18 = reciprocal_19*(lower_54*s12 - s15 - lower_56*s16 - lower_57*s17)
    s19 = reciprocal_18*s17
    s20 = lower_57*s18
    s21 = s19 - s20
    s22 = reciprocal_17*s16 - lower_55*s21
    s23 = lower_56*s18
    s24 = s22 - s23
    s25 = reciprocal_16*s12 + lower_52*s24 + lower_53*s21 + lower_54*s18
    s26 = reciprocal_15*s11 + lower_48*s25 - lower_49*s24 - lower_50*s21
    s27 = lower_51*s18
    s28 = s26 - s27
    s29 = reciprocal_14*s10 - lower_43*s28 + lower_44*s25 - lower_45*s24 - lower_46*s21
    s30 = lower_47*s18
    s31 = s29 - s30
    s32 = reciprocal_13*s9 - lower_37*s31 - lower_38*s28 + lower_39*s25 - lower_40*s24 - lower_41*s21
    s33 = lower_42*s18
    s34 = s32 - s33
    s35 = reciprocal_12*s1 - lower_30*s34 - lower_31*s31 - lower_32*s28 + lower_33*s25 - lower_34*s24
    s36 = s35 - lower_35*s21
    s37 = lower_36*s18
    s38 = s36 - s37
    s39 = reciprocal_11*s8 - lower_28*s21
    s40 = lower_29*s18
    s41 = s39 - s40
    s42 = reciprocal_10*s6 - lower_25*s41 - lower_26*s21
    s43 = lower_27*s18
    s44 = s42 - s43
    s45 = reciprocal_9*s7 + lower_23*s25
    s46 = lower_24*s24
    s47 = s45 - s46
    s48 = reciprocal_8*s4 - lower_20*s47 + lower_21*s25
    s49 = lower_22*s24
    s50 = s48 - s49
    s51 = reciprocal_7*s5 - lower_18*s44 - lower_19*s41
    s52 = reciprocal_6*residual_18 + lower_15*s51 + lower_16*s44 + lower_17*s41
    s53 = reciprocal_5*s3 - lower_13*s50 - lower_14*s47
    s54 = reciprocal_4*residual_16 + lower_10*s53 + lower_11*s50 + lower_12*s47
    s55 = reciprocal_3*s2 - lower_8*s31 - lower_9*s28
    s56 = reciprocal_2*residual_10 + lower_5*s55 + lower_6*s31 + lower_7*s28
    s57 = reciprocal_1*s0 - lower_3*s38 - lower_4*s34
    s58 = reciprocal_0*residual_0 + lower_0*s57 + lower_1*s38 + lower_2*s34
    s59 = s38*jacobian_3 + s34*jacobian_5 + s31*jacobian_6 + s28*jacobian_8 - s25*jacobian_10 + s24*jacobian_12
    # outputs
    w[135] = s37 - s36 - s58
    w[136] = s57 + s33 - s32
    w[137] = s57*jacobian_1 - s58*jacobian_0 + s38*jacobian_2 + s34*jacobian_4
    w[138] = s25 + s38 + s30 - s29 + s20 - s19
    w[139] = s34 + s27 - s26 + s23 - s22 - s18
    w[140] = s59 + s21*jacobian_14 + s18*jacobian_16
    w[141] = s31 - s56
    w[142] = s28 + s55
    w[143] = s31*jacobian_7 + s28*jacobian_9 - s56*jacobian_18 + s55*jacobian_19
    w[144] = s49 - s48 - s25
    w[145] = s24 + s46 - s45
    w[146] = s24*jacobian_13 - s25*jacobian_11 + s50*jacobian_20 + s47*jacobian_22
    w[147] = s50 - s54
    w[148] = s47 + s53
    w[149] = s50*jacobian_21 + s47*jacobian_23 - s54*jacobian_28 + s53*jacobian_29
    w[150] = s21 + s43 - s42
    w[151] = s18 + s40 - s39
    w[152] = s21*jacobian_15 + s18*jacobian_17 + s44*jacobian_24 + s41*jacobian_26
    w[153] = s44 - s52
    w[154] = s41 + s51
    w[155] = s44*jacobian_25 + s41*jacobian_27 - s52*jacobian_30 + s51*jacobian_31
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 197 operations, 398 before sharing."""
    # inputs
    p2 = p[2]  # spring_length [m]
    v0 = y[21]  # K1.vx [m/s]
    v1 = y[22]  # K1.vy [m/s]
    v2 = y[23]  # K1.omega [rad/s]
    v3 = y[24]  # K2.vx [m/s]
    v4 = y[25]  # K2.vy [m/s]
    v5 = y[26]  # K2.omega [rad/s]
    q6 = y[6]  # K3.x [m]
    q7 = y[7]  # K3.y [m]
    q8 = y[8]  # K3.theta [rad]
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
    p3 = p[3]
    jacobian_0 = w[177]
    jacobian_1 = w[178]
    jacobian_2 = w[179]
    jacobian_3 = w[180]
    jacobian_4 = w[181]
    jacobian_5 = w[182]
    jacobian_6 = w[183]
    jacobian_7 = w[184]
    jacobian_8 = w[185]
    jacobian_9 = w[186]
    jacobian_10 = w[187]
    jacobian_11 = w[188]
    jacobian_12 = w[189]
    jacobian_13 = w[190]
    jacobian_14 = w[191]
    jacobian_15 = w[192]
    jacobian_16 = w[193]
    jacobian_17 = w[194]
    jacobian_18 = w[195]
    jacobian_19 = w[196]
    jacobian_20 = w[197]
    jacobian_21 = w[198]
    jacobian_22 = w[199]
    jacobian_23 = w[200]
    jacobian_24 = w[201]
    jacobian_25 = w[202]
    jacobian_26 = w[203]
    jacobian_27 = w[204]
    jacobian_28 = w[205]
    jacobian_29 = w[206]
    jacobian_30 = w[207]
    jacobian_31 = w[208]
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
    s9 = v0 + v2*jacobian_0
    s10 = v1 + v2*jacobian_1
    s11 = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    s12 = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    s13 = v6 + v5*jacobian_6 - v3 + v8*jacobian_7
    s14 = v7 + v5*jacobian_8 - v4 + v8*jacobian_9
    s15 = v9 + v5*jacobian_10 - v3 + v11*jacobian_11
    s16 = v10 + v5*jacobian_12 - v4 + v11*jacobian_13
    s17 = v15 + v5*jacobian_14 - v3 + v17*jacobian_15
    s18 = v16 + v5*jacobian_16 - v4 + v17*jacobian_17
    s19 = v6 + v8*jacobian_18
    s20 = v7 + v8*jacobian_19
    s21 = v12 + v11*jacobian_20 - v9 + v14*jacobian_21
    s22 = v13 + v11*jacobian_22 - v10 + v14*jacobian_23
    s23 = v18 + v17*jacobian_24 - v15 + v20*jacobian_25
    s24 = v19 + v17*jacobian_26 - v16 + v20*jacobian_27
    s25 = v12 + v14*jacobian_28
    s26 = v13 + v14*jacobian_29
    s27 = v18 + v20*jacobian_30
    s28 = v19 + v20*jacobian_31
    s29 = s9*s9 + s10*s10 + s11*s11 + s12*s12 + s13*s13 + s14*s14 + s15*s15 + s16*s16 + s17*s17 + s18*s18
    s30 = s29 + s19*s19 + s20*s20 + s21*s21 + s22*s22 + s23*s23 + s24*s24 + s25*s25 + s26*s26 + s27*s27
    # outputs
    w[75] = s9
    w[76] = s10
    w[77] = s11
    w[78] = s12
    w[79] = s13
    w[80] = s14
    w[81] = s15
    w[82] = s16
    w[83] = s17
    w[84] = s18
    w[85] = s19
    w[86] = s20
    w[87] = s21
    w[88] = s22
    w[89] = s23
    w[90] = s24
    w[91] = s25
    w[92] = s26
    w[93] = s27
    w[94] = s28
    w[1] = math.sqrt(s30 + s28*s28)
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
    w[156] = 0.04325
    w[157] = 0.04325
    w[158] = 2.194e-06
    w[159] = 0.00365
    w[160] = 0.00365
    w[161] = 4.41e-07
    w[162] = 0.02373
    w[163] = 0.02373
    w[164] = 5.255e-06
    w[165] = 0.00706
    w[166] = 0.00706
    w[167] = 5.667e-07
    w[168] = 0.0705
    w[169] = 0.0705
    w[170] = 1.169e-05
    w[171] = 0.00706
    w[172] = 0.00706
    w[173] = 5.667e-07
    w[174] = 0.05498
    w[175] = 0.05498
    w[176] = 1.912e-05
    return 0
