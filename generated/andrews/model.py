"""Model `andrews`: what every method of it shares. Emitted by symgen; do not edit.

digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates 774f5f3a0a6c3684
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

w[0:19]  status
w[19:39]  multipliers
w[39:59]  mask
w[59:79]  saved
w[79:99]  residual
w[99:119]  nu
w[119:139]  pivot
w[139:160]  change
w[160:181]  mass
w[181:202]  gauge
w[202:222]  row_weight
w[222:254]  jacobian
w[254:312]  lower
w[312:332]  reciprocal

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
    p[3] = 0.5*p1  # 0.5*spring_stiffness
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 732 operations, 83219471 before sharing."""
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
    mask_1 = w[40]  # O.y
    mask_2 = w[41]  # F.x
    mask_3 = w[42]  # F.y
    mask_4 = w[43]  # E3.x
    mask_5 = w[44]  # E3.y
    mask_6 = w[45]  # E4.x
    mask_7 = w[46]  # E4.y
    mask_8 = w[47]  # E6.x
    mask_9 = w[48]  # E6.y
    mask_11 = w[50]  # B.y
    mask_12 = w[51]  # G.x
    mask_13 = w[52]  # G.y
    mask_14 = w[53]  # H.x
    mask_15 = w[54]  # H.y
    mask_17 = w[56]  # A5.y
    mask_19 = w[58]  # A7.y
    gauge_2 = w[183]  # K1.omega
    gauge_5 = w[186]  # K2.omega
    gauge_8 = w[189]  # K3.omega
    gauge_11 = w[192]  # K4.omega
    gauge_14 = w[195]  # K5.omega
    gauge_17 = w[198]  # K6.omega
    gauge_20 = w[201]  # K7.omega
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
    s81 = s4*gauge_2
    s82 = s2*gauge_2
    s83 = s12*gauge_2
    s84 = s11*gauge_5
    s85 = s8*gauge_5
    s86 = s22*gauge_5
    s87 = s25*gauge_8
    s88 = s17*gauge_5
    s89 = s26*gauge_8
    s90 = s31*gauge_11
    s91 = s29*gauge_11
    s92 = s37*gauge_17
    s93 = s35*gauge_17
    s94 = s43*gauge_8
    s95 = s53*gauge_11
    s96 = s55*gauge_14
    s97 = s56*gauge_14
    s98 = s65*gauge_17
    s99 = s67*gauge_20
    s100 = s68*gauge_20
    s101 = s73*gauge_14
    s102 = s79*gauge_20
    s103 = s2*s81
    s104 = -1.0 + s12*s81
    s105 = s9*s81
    s106 = 1.0 + s2*s82
    s107 = 1.0 + 1.0 + s12*s83 + s11*s84
    s108 = -1.0 + s22*s84
    s109 = s17*s84
    s110 = 1.0 + 1.0 + s9*(s9*gauge_2) + s8*s85
    s111 = 1.0 + s22*s86
    s112 = 1.0 + s111
    s113 = s112 + s25*s87
    s114 = s17*s86
    s115 = 1.0 + s43*s87
    s116 = 1.0 + s17*s88
    s117 = 1.0 + s116
    s118 = s117 + s26*s89
    s119 = s43*s89
    s120 = s112 + s31*s90
    s121 = -1.0 + s53*s90
    s122 = s117 + s29*s91
    s123 = s53*s91
    s124 = s112 + s37*s92
    s125 = -1.0 + s65*s92
    s126 = s117 + s35*s93
    s127 = s65*s93
    s128 = s44*s94
    s129 = 1.0 + s44*(s44*gauge_8)
    s130 = 1.0 + 1.0 + s53*s95 + s55*s96
    s131 = 1.0 + s73*s96
    s132 = 1.0 + 1.0 + s47*(s47*gauge_11) + s56*s97
    s133 = s73*s97
    s134 = 1.0 + 1.0 + s65*s98 + s67*s99
    s135 = 1.0 + s79*s99
    s136 = 1.0 + 1.0 + s60*(s60*gauge_17) + s68*s100
    s137 = s79*s100
    s138 = s74*s101
    s139 = 1.0 + s74*(s74*gauge_14)
    s140 = s80*s102
    s141 = 1.0 + s80*(s80*gauge_20)
    s142 = 1.0/(1.0 + s4*s81)
    s143 = s103*s142
    s144 = s104*s142
    s145 = s105*s142
    s146 = s106 - s103*s143
    s147 = s104*s143 - s12*s82
    s148 = -1.0 + s9*s82 - s105*s143
    s149 = 1.0*(s146 > mask_1 + 1e-12*s106)
    s150 = s149/max(s146, 1e-300)
    s151 = s147*s150
    s152 = s148*s150
    s153 = s107 - s104*s144 - s147*s151
    s154 = s105*s144 - (s9*s83 + s8*s84) - s148*s151
    s155 = 1.0/(1.0 + s43*s94)
    s156 = s128*s155
    s157 = s115*s155
    s158 = s119*s155
    s159 = s129 - s128*s156
    s160 = s115*s156 - s44*s87
    s161 = 1.0 - s44*s89 + s119*s156
    s162 = 1.0*(s159 > mask_11 + 1e-12*s129)
    s163 = s162/max(s159, 1e-300)
    s164 = s160*s163
    s165 = s161*s163
    s166 = 1.0/(1.0 + s73*s101)
    s167 = s138*s166
    s168 = s131*s166
    s169 = s133*s166
    s170 = s139 - s138*s167
    s171 = s74*s96 - s131*s167
    s172 = 1.0 + s74*s97 - s133*s167
    s173 = 1.0*(s170 > mask_17 + 1e-12*s139)
    s174 = s173/max(s170, 1e-300)
    s175 = s171*s174
    s176 = s172*s174
    s177 = s130 - s131*s168 - s171*s175
    s178 = s47*s95 + s56*s96 - s133*s168 - s172*s175
    s179 = 1.0/(1.0 + s79*s102)
    s180 = s140*s179
    s181 = s135*s179
    s182 = s137*s179
    s183 = s141 - s140*s180
    s184 = s135*s180 - s80*s99
    s185 = 1.0 - s80*s100 + s137*s180
    s186 = 1.0*(s183 > mask_19 + 1e-12*s141)
    s187 = s186/max(s183, 1e-300)
    s188 = s184*s187
    s189 = s185*s187
    s190 = s134 - s135*s181 - s184*s188
    s191 = s68*s99 - s60*s98 - s137*s181 - s185*s188
    s192 = 1.0*(s177 > mask_12 + 1e-12*s130)
    s193 = s192/max(s177, 1e-300)
    s194 = s178*s193
    s195 = s121*s193
    s196 = s123*s193
    s197 = s132 - s133*s169 - s172*s176 - s178*s194
    s198 = s47*s90 - s121*s194
    s199 = -1.0 + s47*s91 - s123*s194
    s200 = 1.0*(s197 > mask_13 + 1e-12*s132)
    s201 = s200/max(s197, 1e-300)
    s202 = s198*s201
    s203 = s199*s201
    s204 = 1.0*(s190 > mask_14 + 1e-12*s134)
    s205 = s204/max(s190, 1e-300)
    s206 = s191*s205
    s207 = s125*s205
    s208 = s127*s205
    s209 = s136 - s137*s182 - s185*s189 - s191*s206
    s210 = s60*s92 + s125*s206
    s211 = -1.0 + s60*s93 + s127*s206
    s212 = 1.0*(s209 > mask_15 + 1e-12*s136)
    s213 = s212/max(s209, 1e-300)
    s214 = s210*s213
    s215 = s211*s213
    s216 = 1.0*(s153 > mask_2 + 1e-12*s107)
    s217 = s216/max(s153, 1e-300)
    s218 = s154*s217
    s219 = s108*s217
    s220 = s109*s217
    s221 = -s220
    s222 = s110 - s105*s145 - s148*s152 - s154*s218
    s223 = s22*s85 + s108*s218
    s224 = -1.0 + s17*s85 + s109*s218
    s225 = s108*s219
    s226 = s109*s219
    s227 = s109*s220
    s228 = 1.0*(s222 > mask_3 + 1e-12*s110)
    s229 = s228/max(s222, 1e-300)
    s230 = s223*s229
    s231 = -s230
    s232 = s224*s229
    s233 = s223*s230
    s234 = s113 - s115*s157 - s160*s164 - s225 - s233
    s235 = s224*s230
    s236 = s26*s87 - s114 - s119*s157 - s161*s164 + s226 + s235
    s237 = s111 - s225 - s233
    s238 = s226 - s114 + s235
    s239 = s224*s232
    s240 = s108*s220 - s22*s88 + s223*s232
    s241 = s116 - s227 - s239
    s242 = 1.0*(s234 > mask_4 + 1e-12*s113)
    s243 = s242/max(s234, 1e-300)
    s244 = s236*s243
    s245 = s237*s243
    s246 = s238*s243
    s247 = s118 - s119*s158 - s161*s165 - s227 - s239 - s236*s244
    s248 = s240 - s237*s244
    s249 = s241 - s238*s244
    s250 = s237*s245
    s251 = s238*s245
    s252 = s238*s246
    s253 = 1.0*(s247 > mask_5 + 1e-12*s118)
    s254 = s253/max(s247, 1e-300)
    s255 = s248*s254
    s256 = s249*s254
    s257 = s248*s255
    s258 = s120 - s121*s195 - s198*s202 - s225 - s233 - s250 - s257
    s259 = s249*s255
    s260 = s29*s90 - s114 - s123*s195 - s199*s202 + s226 + s235 - s251 - s259
    s261 = s237 - s250 - s257
    s262 = s238 - s251 - s259
    s263 = s249*s256
    s264 = 1.0*(s258 > mask_6 + 1e-12*s120)
    s265 = s264/max(s258, 1e-300)
    s266 = s260*s265
    s267 = s261*s265
    s268 = s262*s265
    s269 = s122 - s123*s196 - s199*s203 - s227 - s239 - s252 - s263 - s260*s266
    s270 = s240 - s237*s246 - s248*s256 - s261*s266
    s271 = s241 - s252 - s263 - s262*s266
    s272 = 1.0*(s269 > mask_7 + 1e-12*s122)
    s273 = s272/max(s269, 1e-300)
    s274 = s270*s273
    s275 = s271*s273
    s276 = s124 - s125*s207 - s210*s214 - s225 - s233 - s250 - s257 - s261*s267 - s270*s274
    s277 = s127*s207 - (s114 + s35*s92) + s211*s214 + s226 + s235 - s251 - s259 - s262*s267 - s271*s274
    s278 = 1.0*(s276 > mask_8 + 1e-12*s124)
    s279 = s278/max(s276, 1e-300)
    s280 = s277*s279
    s281 = s126 - s127*s208 - s211*s215 - s227 - s239 - s252 - s263 - s262*s268 - s271*s275 - s277*s280
    s282 = 1.0*(s281 > mask_9 + 1e-12*s126)
    s283 = s3*s3 + s5*s5 + s10*s10 + s13*s13 + s19*s19 + s24*s24 + s30*s30 + s32*s32 + s36*s36 + s38*s38
    s284 = s283 + s40*s40 + s42*s42 + s50*s50 + s54*s54 + s62*s62 + s66*s66 + s70*s70 + s72*s72 + s76*s76
    s285 = math.sqrt(s284 + s78*s78)
    s286 = s146/s106
    s287 = s153/s107
    s288 = s222/s110
    s289 = s234/s113
    s290 = s247/s118
    s291 = min(min(min(min(min(1.0, mask_1 + s286), mask_2 + s287), mask_3 + s288), mask_4 + s289), mask_5 + s290)
    s292 = s258/s120
    s293 = s269/s122
    s294 = s276/s124
    s295 = s281/s126
    s296 = s159/s129
    s297 = min(min(min(min(min(s291, mask_6 + s292), mask_7 + s293), mask_8 + s294), mask_9 + s295), mask_11 + s296)
    s298 = s177/s130
    s299 = s197/s132
    s300 = s200 + s192 + s162 + 1.0 + s282 + s278 + s272 + s264 + s253 + s242 + s228 + s216 + 1.0 + s149
    s301 = s190/s134
    s302 = s209/s136
    s303 = s170/s139
    s304 = min(min(min(min(min(s297, mask_12 + s298), mask_13 + s299), mask_14 + s301), mask_15 + s302), mask_17 + s303)
    s305 = s183/s141
    # outputs
    w[79] = s3  # O.x
    w[80] = s5  # O.y
    w[81] = s10  # F.x
    w[82] = s13  # F.y
    w[83] = s19  # E3.x
    w[84] = s24  # E3.y
    w[85] = s30  # E4.x
    w[86] = s32  # E4.y
    w[87] = s36  # E6.x
    w[88] = s38  # E6.y
    w[89] = s40  # B.x
    w[90] = s42  # B.y
    w[91] = s50  # G.x
    w[92] = s54  # G.y
    w[93] = s62  # H.x
    w[94] = s66  # H.y
    w[95] = s70  # A5.x
    w[96] = s72  # A5.y
    w[97] = s76  # A7.x
    w[98] = s78  # A7.y
    w[0] = s285  # position_violation
    w[8] = s285  # position_measure
    w[222] = s4  # D O.x, K1.omega
    w[223] = -s2  # D O.y, K1.omega
    w[224] = s12  # D F.x, K1.omega
    w[225] = -s11  # D F.x, K2.omega
    w[226] = -s9  # D F.y, K1.omega
    w[227] = s8  # D F.y, K2.omega
    w[228] = s23  # D E3.x, K2.omega
    w[229] = s25  # D E3.x, K3.omega
    w[230] = s17  # D E3.y, K2.omega
    w[231] = s26  # D E3.y, K3.omega
    w[232] = s23  # D E4.x, K2.omega
    w[233] = s31  # D E4.x, K4.omega
    w[234] = s17  # D E4.y, K2.omega
    w[235] = s29  # D E4.y, K4.omega
    w[236] = s23  # D E6.x, K2.omega
    w[237] = -s37  # D E6.x, K6.omega
    w[238] = s17  # D E6.y, K2.omega
    w[239] = s35  # D E6.y, K6.omega
    w[240] = s43  # D B.x, K3.omega
    w[241] = -s44  # D B.y, K3.omega
    w[242] = s53  # D G.x, K4.omega
    w[243] = s55  # D G.x, K5.omega
    w[244] = s47  # D G.y, K4.omega
    w[245] = s56  # D G.y, K5.omega
    w[246] = -s65  # D H.x, K6.omega
    w[247] = s67  # D H.x, K7.omega
    w[248] = s60  # D H.y, K6.omega
    w[249] = s68  # D H.y, K7.omega
    w[250] = s73  # D A5.x, K5.omega
    w[251] = s74  # D A5.y, K5.omega
    w[252] = s79  # D A7.x, K7.omega
    w[253] = -s80  # D A7.y, K7.omega
    w[120] = s286  # O.y
    w[121] = s287  # F.x
    w[122] = s288  # F.y
    w[123] = s289  # E3.x
    w[124] = s290  # E3.y
    w[125] = s292  # E4.x
    w[126] = s293  # E4.y
    w[127] = s294  # E6.x
    w[128] = s295  # E6.y
    w[130] = s296  # B.y
    w[131] = s298  # G.x
    w[132] = s299  # G.y
    w[133] = s301  # H.x
    w[134] = s302  # H.y
    w[136] = s303  # A5.y
    w[138] = s305  # A7.y
    w[5] = s186 + 1.0 + s173 + 1.0 + s212 + s204 + s300  # rank
    w[4] = min(s304, mask_19 + s305)  # smallest_pivot
    w[10] = 1.0  # shortest_row
    w[254] = -s143
    w[255] = s144
    w[256] = -s145
    w[257] = s151
    w[258] = s152
    w[259] = -s156
    w[260] = s157
    w[261] = s158
    w[262] = s164
    w[263] = s165
    w[264] = s167
    w[265] = s168
    w[266] = s169
    w[267] = s175
    w[268] = s176
    w[269] = -s180
    w[270] = s181
    w[271] = s182
    w[272] = s188
    w[273] = s189
    w[274] = s194
    w[275] = s195
    w[276] = s196
    w[277] = s202
    w[278] = s203
    w[279] = s206
    w[280] = s207
    w[281] = -s208
    w[282] = -s214
    w[283] = s215
    w[284] = s218
    w[285] = s219
    w[286] = s221
    w[287] = s219
    w[288] = s221
    w[289] = s219
    w[290] = s221
    w[291] = s231
    w[292] = s232
    w[293] = s231
    w[294] = s232
    w[295] = s231
    w[296] = s232
    w[297] = s244
    w[298] = s245
    w[299] = s246
    w[300] = s245
    w[301] = s246
    w[302] = s255
    w[303] = s256
    w[304] = s255
    w[305] = s256
    w[306] = s266
    w[307] = s267
    w[308] = s268
    w[309] = s274
    w[310] = s275
    w[311] = s280
    w[312] = s142
    w[313] = s150
    w[314] = s155
    w[315] = s163
    w[316] = s166
    w[317] = s174
    w[318] = s179
    w[319] = s187
    w[320] = s193
    w[321] = s201
    w[322] = s205
    w[323] = s213
    w[324] = s217
    w[325] = s229
    w[326] = s243
    w[327] = s254
    w[328] = s265
    w[329] = s273
    w[330] = s279
    w[331] = s282/max(s281, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 344 operations, 2294068 before sharing."""
    # inputs
    gauge_2 = w[183]  # K1.omega
    gauge_5 = w[186]  # K2.omega
    gauge_8 = w[189]  # K3.omega
    gauge_11 = w[192]  # K4.omega
    gauge_14 = w[195]  # K5.omega
    gauge_17 = w[198]  # K6.omega
    gauge_20 = w[201]  # K7.omega
    lower_0 = w[254]
    lower_1 = w[255]
    lower_2 = w[256]
    lower_3 = w[257]
    lower_4 = w[258]
    lower_5 = w[259]
    lower_6 = w[260]
    lower_7 = w[261]
    lower_8 = w[262]
    lower_9 = w[263]
    lower_10 = w[264]
    lower_11 = w[265]
    lower_12 = w[266]
    lower_13 = w[267]
    lower_14 = w[268]
    lower_15 = w[269]
    lower_16 = w[270]
    lower_17 = w[271]
    lower_18 = w[272]
    lower_19 = w[273]
    lower_20 = w[274]
    lower_21 = w[275]
    lower_22 = w[276]
    lower_23 = w[277]
    lower_24 = w[278]
    lower_25 = w[279]
    lower_26 = w[280]
    lower_27 = w[281]
    lower_28 = w[282]
    lower_29 = w[283]
    lower_30 = w[284]
    lower_31 = w[285]
    lower_32 = w[286]
    lower_33 = w[287]
    lower_34 = w[288]
    lower_35 = w[289]
    lower_36 = w[290]
    lower_37 = w[291]
    lower_38 = w[292]
    lower_39 = w[293]
    lower_40 = w[294]
    lower_41 = w[295]
    lower_42 = w[296]
    lower_43 = w[297]
    lower_44 = w[298]
    lower_45 = w[299]
    lower_46 = w[300]
    lower_47 = w[301]
    lower_48 = w[302]
    lower_49 = w[303]
    lower_50 = w[304]
    lower_51 = w[305]
    lower_52 = w[306]
    lower_53 = w[307]
    lower_54 = w[308]
    lower_55 = w[309]
    lower_56 = w[310]
    lower_57 = w[311]
    reciprocal_0 = w[312]
    reciprocal_1 = w[313]
    reciprocal_2 = w[314]
    reciprocal_3 = w[315]
    reciprocal_4 = w[316]
    reciprocal_5 = w[317]
    reciprocal_6 = w[318]
    reciprocal_7 = w[319]
    reciprocal_8 = w[320]
    reciprocal_9 = w[321]
    reciprocal_10 = w[322]
    reciprocal_11 = w[323]
    reciprocal_12 = w[324]
    reciprocal_13 = w[325]
    reciprocal_14 = w[326]
    reciprocal_15 = w[327]
    reciprocal_16 = w[328]
    reciprocal_17 = w[329]
    reciprocal_18 = w[330]
    reciprocal_19 = w[331]
    residual_0 = w[79]  # O.x
    residual_1 = w[80]  # O.y
    residual_2 = w[81]  # F.x
    residual_3 = w[82]  # F.y
    residual_4 = w[83]  # E3.x
    residual_5 = w[84]  # E3.y
    residual_6 = w[85]  # E4.x
    residual_7 = w[86]  # E4.y
    residual_8 = w[87]  # E6.x
    residual_9 = w[88]  # E6.y
    residual_10 = w[89]  # B.x
    residual_11 = w[90]  # B.y
    residual_12 = w[91]  # G.x
    residual_13 = w[92]  # G.y
    residual_14 = w[93]  # H.x
    residual_15 = w[94]  # H.y
    residual_16 = w[95]  # A5.x
    residual_17 = w[96]  # A5.y
    residual_18 = w[97]  # A7.x
    residual_19 = w[98]  # A7.y
    jacobian_0 = w[222]  # D O.x, K1.omega
    jacobian_1 = w[223]  # D O.y, K1.omega
    jacobian_2 = w[224]  # D F.x, K1.omega
    jacobian_3 = w[225]  # D F.x, K2.omega
    jacobian_4 = w[226]  # D F.y, K1.omega
    jacobian_5 = w[227]  # D F.y, K2.omega
    jacobian_6 = w[228]  # D E3.x, K2.omega
    jacobian_7 = w[229]  # D E3.x, K3.omega
    jacobian_8 = w[230]  # D E3.y, K2.omega
    jacobian_9 = w[231]  # D E3.y, K3.omega
    jacobian_10 = w[232]  # D E4.x, K2.omega
    jacobian_11 = w[233]  # D E4.x, K4.omega
    jacobian_12 = w[234]  # D E4.y, K2.omega
    jacobian_13 = w[235]  # D E4.y, K4.omega
    jacobian_14 = w[236]  # D E6.x, K2.omega
    jacobian_15 = w[237]  # D E6.x, K6.omega
    jacobian_16 = w[238]  # D E6.y, K2.omega
    jacobian_17 = w[239]  # D E6.y, K6.omega
    jacobian_18 = w[240]  # D B.x, K3.omega
    jacobian_19 = w[241]  # D B.y, K3.omega
    jacobian_20 = w[242]  # D G.x, K4.omega
    jacobian_21 = w[243]  # D G.x, K5.omega
    jacobian_22 = w[244]  # D G.y, K4.omega
    jacobian_23 = w[245]  # D G.y, K5.omega
    jacobian_24 = w[246]  # D H.x, K6.omega
    jacobian_25 = w[247]  # D H.x, K7.omega
    jacobian_26 = w[248]  # D H.y, K6.omega
    jacobian_27 = w[249]  # D H.y, K7.omega
    jacobian_28 = w[250]  # D A5.x, K5.omega
    jacobian_29 = w[251]  # D A5.y, K5.omega
    jacobian_30 = w[252]  # D A7.x, K7.omega
    jacobian_31 = w[253]  # D A7.y, K7.omega
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
    w[139] = s37 - s36 - s58  # K1.vx
    w[140] = s57 + s33 - s32  # K1.vy
    w[141] = gauge_2*(s57*jacobian_1 - s58*jacobian_0 + s38*jacobian_2 + s34*jacobian_4)  # K1.omega
    w[142] = s25 + s38 + s30 - s29 + s20 - s19  # K2.vx
    w[143] = s34 + s27 - s26 + s23 - s22 - s18  # K2.vy
    w[144] = gauge_5*(s59 + s21*jacobian_14 + s18*jacobian_16)  # K2.omega
    w[145] = s31 - s56  # K3.vx
    w[146] = s28 + s55  # K3.vy
    w[147] = gauge_8*(s31*jacobian_7 + s28*jacobian_9 - s56*jacobian_18 + s55*jacobian_19)  # K3.omega
    w[148] = s49 - s48 - s25  # K4.vx
    w[149] = s24 + s46 - s45  # K4.vy
    w[150] = gauge_11*(s24*jacobian_13 - s25*jacobian_11 + s50*jacobian_20 + s47*jacobian_22)  # K4.omega
    w[151] = s50 - s54  # K5.vx
    w[152] = s47 + s53  # K5.vy
    w[153] = gauge_14*(s50*jacobian_21 + s47*jacobian_23 - s54*jacobian_28 + s53*jacobian_29)  # K5.omega
    w[154] = s21 + s43 - s42  # K6.vx
    w[155] = s18 + s40 - s39  # K6.vy
    w[156] = gauge_17*(s21*jacobian_15 + s18*jacobian_17 + s44*jacobian_24 + s41*jacobian_26)  # K6.omega
    w[157] = s44 - s52  # K7.vx
    w[158] = s41 + s51  # K7.vy
    w[159] = gauge_20*(s44*jacobian_25 + s41*jacobian_27 - s52*jacobian_30 + s51*jacobian_31)  # K7.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 197 operations, 590 before sharing."""
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
    p3 = p[3]  # 0.5*spring_stiffness
    jacobian_0 = w[222]  # D O.x, K1.omega
    jacobian_1 = w[223]  # D O.y, K1.omega
    jacobian_2 = w[224]  # D F.x, K1.omega
    jacobian_3 = w[225]  # D F.x, K2.omega
    jacobian_4 = w[226]  # D F.y, K1.omega
    jacobian_5 = w[227]  # D F.y, K2.omega
    jacobian_6 = w[228]  # D E3.x, K2.omega
    jacobian_7 = w[229]  # D E3.x, K3.omega
    jacobian_8 = w[230]  # D E3.y, K2.omega
    jacobian_9 = w[231]  # D E3.y, K3.omega
    jacobian_10 = w[232]  # D E4.x, K2.omega
    jacobian_11 = w[233]  # D E4.x, K4.omega
    jacobian_12 = w[234]  # D E4.y, K2.omega
    jacobian_13 = w[235]  # D E4.y, K4.omega
    jacobian_14 = w[236]  # D E6.x, K2.omega
    jacobian_15 = w[237]  # D E6.x, K6.omega
    jacobian_16 = w[238]  # D E6.y, K2.omega
    jacobian_17 = w[239]  # D E6.y, K6.omega
    jacobian_18 = w[240]  # D B.x, K3.omega
    jacobian_19 = w[241]  # D B.y, K3.omega
    jacobian_20 = w[242]  # D G.x, K4.omega
    jacobian_21 = w[243]  # D G.x, K5.omega
    jacobian_22 = w[244]  # D G.y, K4.omega
    jacobian_23 = w[245]  # D G.y, K5.omega
    jacobian_24 = w[246]  # D H.x, K6.omega
    jacobian_25 = w[247]  # D H.x, K7.omega
    jacobian_26 = w[248]  # D H.y, K6.omega
    jacobian_27 = w[249]  # D H.y, K7.omega
    jacobian_28 = w[250]  # D A5.x, K5.omega
    jacobian_29 = w[251]  # D A5.y, K5.omega
    jacobian_30 = w[252]  # D A7.x, K7.omega
    jacobian_31 = w[253]  # D A7.y, K7.omega
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
    s31 = math.sqrt(s30 + s28*s28)
    # outputs
    w[79] = s9  # O.x
    w[80] = s10  # O.y
    w[81] = s11  # F.x
    w[82] = s12  # F.y
    w[83] = s13  # E3.x
    w[84] = s14  # E3.y
    w[85] = s15  # E4.x
    w[86] = s16  # E4.y
    w[87] = s17  # E6.x
    w[88] = s18  # E6.y
    w[89] = s19  # B.x
    w[90] = s20  # B.y
    w[91] = s21  # G.x
    w[92] = s22  # G.y
    w[93] = s23  # H.x
    w[94] = s24  # H.y
    w[95] = s25  # A5.x
    w[96] = s26  # A5.y
    w[97] = s27  # A7.x
    w[98] = s28  # A7.y
    w[1] = s31  # velocity_violation
    w[9] = s31  # velocity_measure
    w[2] = s8 + 9.56e-06*(v20*v20)  # kinetic
    w[3] = p3*(s4*s4)  # potential
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
    ydot_21 = ydot[21]  # rate of K1.vx
    ydot_22 = ydot[22]  # rate of K1.vy
    ydot_23 = ydot[23]  # rate of K1.omega
    ydot_24 = ydot[24]  # rate of K2.vx
    ydot_25 = ydot[25]  # rate of K2.vy
    ydot_26 = ydot[26]  # rate of K2.omega
    ydot_27 = ydot[27]  # rate of K3.vx
    ydot_28 = ydot[28]  # rate of K3.vy
    ydot_29 = ydot[29]  # rate of K3.omega
    ydot_30 = ydot[30]  # rate of K4.vx
    ydot_31 = ydot[31]  # rate of K4.vy
    ydot_32 = ydot[32]  # rate of K4.omega
    ydot_33 = ydot[33]  # rate of K5.vx
    ydot_34 = ydot[34]  # rate of K5.vy
    ydot_35 = ydot[35]  # rate of K5.omega
    ydot_36 = ydot[36]  # rate of K6.vx
    ydot_37 = ydot[37]  # rate of K6.vy
    ydot_38 = ydot[38]  # rate of K6.omega
    ydot_39 = ydot[39]  # rate of K7.vx
    ydot_40 = ydot[40]  # rate of K7.vy
    ydot_41 = ydot[41]  # rate of K7.omega
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
    out[0] = s0*s3 + ydot_21 + 0.00092*s1*ydot_23  # O.x
    out[1] = s1*s3 + ydot_22 - 0.00092*s0*ydot_23  # O.y
    out[2] = ydot_24 + 0.00608*s1*ydot_23 - ydot_21 - 0.0115*s5*ydot_26 - (s4*s8 - s0*s7)  # F.x
    out[3] = ydot_25 - (ydot_22 + 0.00608*s0*ydot_23) + 0.0115*s4*ydot_26 - (s5*s8 - s1*s7)  # F.y
    out[4] = ydot_27 - s52 + (0.016260000000000004*s9 + s13)*ydot_29 - (s15 + s10*s16 - s18)  # E3.x
    out[5] = s20 - s19 + s9*s16 + ydot_28 + s53 + (0.016260000000000004*s10 - s12)*ydot_29  # E3.y
    out[6] = ydot_30 - s52 + 0.01421*s21*ydot_32 - (s15 + s22*s24)  # E4.x
    out[7] = ydot_31 + s53 + 0.01421*s22*ydot_32 - (s19 - s21*s24)  # E4.y
    out[8] = ydot_36 - s52 - 0.01421*s26*ydot_38 - (s15 + s25*s28)  # E6.x
    out[9] = ydot_37 + s53 + 0.01421*s25*ydot_38 - (s19 + s26*s28)  # E6.y
    out[10] = s18 + s10*s29 + ydot_27 + (s13 - 0.01874*s9)*ydot_29  # B.x
    out[11] = ydot_28 - (s12 + 0.01874*s10)*ydot_29 - (s9*s29 - s20)  # B.y
    out[12] = s54  # G.x
    out[13] = s55  # G.y
    out[14] = s56  # H.x
    out[15] = s57  # H.y
    out[16] = ydot_33 + (s34 + 0.00916*s31)*ydot_35 - (s37 - s30*s50)  # A5.x
    out[17] = s39 + s31*s50 + ydot_34 + (s33 - 0.00916*s30)*ydot_35  # A5.y
    out[18] = s48 + s41*s51 + ydot_39 + (s44 - 0.01228*s40)*ydot_41  # A7.x
    out[19] = ydot_40 - (s43 + 0.01228*s41)*ydot_41 - (s40*s51 - s49)  # A7.y
    out[20] = q2  # O.angle
    out[21] = v2  # rate of O.angle
    out[22] = q5 - q2  # F.angle
    out[23] = v5 - v2  # rate of F.angle
    out[24] = q8 - q5  # E3.angle
    out[25] = v8 - v5  # rate of E3.angle
    out[26] = q11 - q5  # E4.angle
    out[27] = v11 - v5  # rate of E4.angle
    out[28] = q17 - q5  # E6.angle
    out[29] = v17 - v5  # rate of E6.angle
    out[30] = q8  # B.angle
    out[31] = v8  # rate of B.angle
    out[32] = q14 - q11  # G.angle
    out[33] = v14 - v11  # rate of G.angle
    out[34] = q20 - q17  # H.angle
    out[35] = v20 - v17  # rate of H.angle
    out[36] = q14  # A5.angle
    out[37] = v14  # rate of A5.angle
    out[38] = q20  # A7.angle
    out[39] = v20  # rate of A7.angle
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # outputs
    w[160] = 0.04325  # K1.vx
    w[161] = 0.04325  # K1.vy
    w[162] = 2.194e-06  # K1.omega
    w[163] = 0.00365  # K2.vx
    w[164] = 0.00365  # K2.vy
    w[165] = 4.41e-07  # K2.omega
    w[166] = 0.02373  # K3.vx
    w[167] = 0.02373  # K3.vy
    w[168] = 5.255e-06  # K3.omega
    w[169] = 0.00706  # K4.vx
    w[170] = 0.00706  # K4.vy
    w[171] = 5.667e-07  # K4.omega
    w[172] = 0.0705  # K5.vx
    w[173] = 0.0705  # K5.vy
    w[174] = 1.169e-05  # K5.omega
    w[175] = 0.00706  # K6.vx
    w[176] = 0.00706  # K6.vy
    w[177] = 5.667e-07  # K6.omega
    w[178] = 0.05498  # K7.vx
    w[179] = 0.05498  # K7.vy
    w[180] = 1.912e-05  # K7.omega
    return 0
