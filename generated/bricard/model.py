"""Model `bricard`: what every method of it shares. Emitted by symgen; do not edit.

digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates a1bfe8da2fcb1eac
35 coordinates, 30 velocities, 30 constraint rows, 0 parameters,
25 of 30 rows eliminated with 5 divisions, together with velocities that they fix

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     rod1.x [m]
y[1]     rod1.y [m]
y[2]     rod1.z [m]
y[3]     rod1.e0 [1]
y[4]     rod1.e1 [1]
y[5]     rod1.e2 [1]
y[6]     rod1.e3 [1]
y[7]     rod2.x [m]
y[8]     rod2.y [m]
y[9]     rod2.z [m]
y[10]    rod2.e0 [1]
y[11]    rod2.e1 [1]
y[12]    rod2.e2 [1]
y[13]    rod2.e3 [1]
y[14]    rod3.x [m]
y[15]    rod3.y [m]
y[16]    rod3.z [m]
y[17]    rod3.e0 [1]
y[18]    rod3.e1 [1]
y[19]    rod3.e2 [1]
y[20]    rod3.e3 [1]
y[21]    rod4.x [m]
y[22]    rod4.y [m]
y[23]    rod4.z [m]
y[24]    rod4.e0 [1]
y[25]    rod4.e1 [1]
y[26]    rod4.e2 [1]
y[27]    rod4.e3 [1]
y[28]    rod5.x [m]
y[29]    rod5.y [m]
y[30]    rod5.z [m]
y[31]    rod5.e0 [1]
y[32]    rod5.e1 [1]
y[33]    rod5.e2 [1]
y[34]    rod5.e3 [1]
y[35]    rod1.vx [m/s]
y[36]    rod1.vy [m/s]
y[37]    rod1.vz [m/s]
y[38]    rod1.wx [rad/s]
y[39]    rod1.wy [rad/s]
y[40]    rod1.wz [rad/s]
y[41]    rod2.vx [m/s]
y[42]    rod2.vy [m/s]
y[43]    rod2.vz [m/s]
y[44]    rod2.wx [rad/s]
y[45]    rod2.wy [rad/s]
y[46]    rod2.wz [rad/s]
y[47]    rod3.vx [m/s]
y[48]    rod3.vy [m/s]
y[49]    rod3.vz [m/s]
y[50]    rod3.wx [rad/s]
y[51]    rod3.wy [rad/s]
y[52]    rod3.wz [rad/s]
y[53]    rod4.vx [m/s]
y[54]    rod4.vy [m/s]
y[55]    rod4.vz [m/s]
y[56]    rod4.wx [rad/s]
y[57]    rod4.wy [rad/s]
y[58]    rod4.wz [rad/s]
y[59]    rod5.vx [m/s]
y[60]    rod5.vy [m/s]
y[61]    rod5.vz [m/s]
y[62]    rod5.wx [rad/s]
y[63]    rod5.wy [rad/s]
y[64]    rod5.wz [rad/s]
y[65]    work of forces without potential and of drivers [J]
row 0    P0.x [m]
row 1    P0.y [m]
row 2    P0.z [m]
row 3    P0.first [rad]
row 4    P0.second [rad]
row 5    P1.x [m]
row 6    P1.y [m]
row 7    P1.z [m]
row 8    P1.first [rad]
row 9    P1.second [rad]
row 10   P2.x [m]
row 11   P2.y [m]
row 12   P2.z [m]
row 13   P2.first [rad]
row 14   P2.second [rad]
row 15   P3.x [m]
row 16   P3.y [m]
row 17   P3.z [m]
row 18   P3.first [rad]
row 19   P3.second [rad]
row 20   P4.x [m]
row 21   P4.y [m]
row 22   P4.z [m]
row 23   P4.first [rad]
row 24   P4.second [rad]
row 25   P5.x [m]
row 26   P5.y [m]
row 27   P5.z [m]
row 28   P5.first [rad]
row 29   P5.second [rad]

w[0:19]     status: single numbers, named in this module where it uses them
w[19:25]    winding: turns of angles that are counted
w[25:55]    multipliers: Lagrange multipliers, one a row
w[55:85]    mask: inf at rows that depend on others, else 0
w[85:115]   saved: `mask` while `confirm` leaves out further rows
w[115:145]  residual: Phi after `geometry`, D v - nu after `measure`
w[145:175]  nu: right-hand side of D v = nu
w[175:205]  pivot: pivots of D G D^T over its diagonal: near 0 a row depends on others
w[205:235]  change: correction of velocities, or of positions, that `spread` leaves
w[235:265]  mass: diagonal of M
w[265:295]  gauge: diagonal of G, the metric in which rank is decided: 1, or 1/l^2 for a rotation of a body of length l
w[295:325]  row_weight: factors that make rows of different units comparable
w[325:425]  jacobian: entries of D that are not constant

Left out:
- columns of the ground: the ground does not move
- centre-of-mass offset of rod1: its centre of mass is the frame's origin
- centre-of-mass offset of rod2: its centre of mass is the frame's origin
- centre-of-mass offset of rod3: its centre of mass is the frame's origin
- centre-of-mass offset of rod4: its centre of mass is the frame's origin
- centre-of-mass offset of rod5: its centre of mass is the frame's origin
"""

import math

from numba import njit

WINDING = 19  # sections of w
MASK = 55
RESIDUAL = 115
PIVOT = 175
CHANGE = 205
GAUGE = 265
ROW_WEIGHT = 295
JACOBIAN = 325
POSITION_VIOLATION = 0  # numbers in w
VELOCITY_VIOLATION = 1
KINETIC = 2
POTENTIAL = 3
SMALLEST_PIVOT = 4
RANK = 5
LENGTH_SCALE = 6
POSITION_MEASURE = 8
VELOCITY_MEASURE = 9
SHORTEST_ROW = 10


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 0 operations."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 1683 operations."""
    # inputs
    q0 = y[0]  # rod1.x [m]
    q1 = y[1]  # rod1.y [m]
    q2 = y[2]  # rod1.z [m]
    q3 = y[3]  # rod1.e0 [1]
    q4 = y[4]  # rod1.e1 [1]
    q5 = y[5]  # rod1.e2 [1]
    q6 = y[6]  # rod1.e3 [1]
    q7 = y[7]  # rod2.x [m]
    q8 = y[8]  # rod2.y [m]
    q9 = y[9]  # rod2.z [m]
    q10 = y[10]  # rod2.e0 [1]
    q11 = y[11]  # rod2.e1 [1]
    q12 = y[12]  # rod2.e2 [1]
    q13 = y[13]  # rod2.e3 [1]
    q14 = y[14]  # rod3.x [m]
    q15 = y[15]  # rod3.y [m]
    q16 = y[16]  # rod3.z [m]
    q17 = y[17]  # rod3.e0 [1]
    q18 = y[18]  # rod3.e1 [1]
    q19 = y[19]  # rod3.e2 [1]
    q20 = y[20]  # rod3.e3 [1]
    q21 = y[21]  # rod4.x [m]
    q22 = y[22]  # rod4.y [m]
    q23 = y[23]  # rod4.z [m]
    q24 = y[24]  # rod4.e0 [1]
    q25 = y[25]  # rod4.e1 [1]
    q26 = y[26]  # rod4.e2 [1]
    q27 = y[27]  # rod4.e3 [1]
    q28 = y[28]  # rod5.x [m]
    q29 = y[29]  # rod5.y [m]
    q30 = y[30]  # rod5.z [m]
    q31 = y[31]  # rod5.e0 [1]
    q32 = y[32]  # rod5.e1 [1]
    q33 = y[33]  # rod5.e2 [1]
    q34 = y[34]  # rod5.e3 [1]
    mask_15 = w[MASK + 15]  # P3.x
    mask_16 = w[MASK + 16]  # P3.y
    mask_17 = w[MASK + 17]  # P3.z
    mask_28 = w[MASK + 28]  # P5.first
    mask_29 = w[MASK + 29]  # P5.second
    gauge_3 = w[GAUGE + 3]  # rod1.wx
    gauge_4 = w[GAUGE + 4]  # rod1.wy
    gauge_5 = w[GAUGE + 5]  # rod1.wz
    gauge_9 = w[GAUGE + 9]  # rod2.wx
    gauge_10 = w[GAUGE + 10]  # rod2.wy
    gauge_11 = w[GAUGE + 11]  # rod2.wz
    gauge_15 = w[GAUGE + 15]  # rod3.wx
    gauge_16 = w[GAUGE + 16]  # rod3.wy
    gauge_17 = w[GAUGE + 17]  # rod3.wz
    gauge_21 = w[GAUGE + 21]  # rod4.wx
    gauge_22 = w[GAUGE + 22]  # rod4.wy
    gauge_23 = w[GAUGE + 23]  # rod4.wz
    gauge_27 = w[GAUGE + 27]  # rod5.wx
    gauge_28 = w[GAUGE + 28]  # rod5.wy
    gauge_29 = w[GAUGE + 29]  # rod5.wz
    status_6 = w[LENGTH_SCALE]  # length_scale
    row_weight_3 = w[ROW_WEIGHT + 3]  # P0.first
    row_weight_4 = w[ROW_WEIGHT + 4]  # P0.second
    row_weight_8 = w[ROW_WEIGHT + 8]  # P1.first
    row_weight_9 = w[ROW_WEIGHT + 9]  # P1.second
    row_weight_13 = w[ROW_WEIGHT + 13]  # P2.first
    row_weight_14 = w[ROW_WEIGHT + 14]  # P2.second
    row_weight_18 = w[ROW_WEIGHT + 18]  # P3.first
    row_weight_19 = w[ROW_WEIGHT + 19]  # P3.second
    row_weight_23 = w[ROW_WEIGHT + 23]  # P4.first
    row_weight_24 = w[ROW_WEIGHT + 24]  # P4.second
    row_weight_28 = w[ROW_WEIGHT + 28]  # P5.first
    row_weight_29 = w[ROW_WEIGHT + 29]  # P5.second
    # intermediate terms
    s0 = q3*q3
    s1 = q4*q4
    s2 = q5*q5
    s3 = q6*q6
    s4 = s0 + s1
    s5 = s0 - s1
    s6 = s2 + s3
    s7 = s2 - s3
    s8 = 2.0*(q4*q5)
    s9 = 2.0*(q3*q6)
    s10 = 2.0*(q4*q6)
    s11 = 2.0*(q3*q5)
    s12 = 2.0*(q5*q6)
    s13 = 2.0*(q3*q4)
    s14 = s4 - s6
    s15 = s8 - s9
    s16 = s10 + s11
    s17 = s8 + s9
    s18 = s5 + s7
    s19 = s12 - s13
    s20 = s10 - s11
    s21 = s12 + s13
    s22 = s5 - s7
    s23 = 0.5*s14
    s24 = q0 - s23
    s25 = 0.5*s17
    s26 = q1 - s25
    s27 = 0.5*s20
    s28 = q2 - s27
    s29 = 0.5*s16
    s30 = 0.5*s19
    s31 = 0.5*s22
    s32 = -0.5*s15
    s33 = -0.5*s18
    s34 = -0.5*s21
    s35 = s11 - s10
    s36 = s9 - s8
    s37 = q10*q10
    s38 = q11*q11
    s39 = q12*q12
    s40 = q13*q13
    s41 = s37 + s38
    s42 = s37 - s38
    s43 = s39 + s40
    s44 = s39 - s40
    s45 = 2.0*(q11*q12)
    s46 = 2.0*(q10*q13)
    s47 = 2.0*(q11*q13)
    s48 = 2.0*(q10*q12)
    s49 = 2.0*(q12*q13)
    s50 = 2.0*(q10*q11)
    s51 = s41 - s43
    s52 = s45 - s46
    s53 = s47 + s48
    s54 = s45 + s46
    s55 = s42 + s44
    s56 = s49 - s50
    s57 = s47 - s48
    s58 = s49 + s50
    s59 = s42 - s44
    s60 = 0.5*s52
    s61 = 0.5*s55
    s62 = 0.5*s58
    s63 = q7 + s60 - (q0 + s23)
    s64 = q8 + s61 - (q1 + s25)
    s65 = q9 + s62 - (q2 + s27)
    s66 = 0.5*s53
    s67 = 0.5*s56
    s68 = 0.5*s59
    s69 = 0.5*s51
    s70 = -s69
    s71 = 0.5*s54
    s72 = -s71
    s73 = 0.5*s57
    s74 = -s73
    s75 = s15*s53 + s18*s56 + s21*s59
    s76 = s16*s53
    s77 = s76 + s19*s56 + s22*s59
    s78 = s17*s56
    s79 = (s6 - s4)*s53 - s78 + s35*s59
    s80 = s46 - s45
    s81 = s15*s51 + s18*s54 + s21*s57
    s82 = s21*s58 - (s15*s80 - s18*s55)
    s83 = s78 + s14*s53 + s20*s59
    s84 = s56*(s13 - s12) - s76 + s59*(s7 - s5)
    s85 = s14*s80 - s17*s55 - s20*s58
    s86 = s14*s51 + s17*s54 + s20*s57
    s87 = q17*q17
    s88 = q18*q18
    s89 = q19*q19
    s90 = q20*q20
    s91 = s87 - s88
    s92 = s89 - s90
    s93 = 2.0*(q18*q19)
    s94 = 2.0*(q17*q20)
    s95 = 2.0*(q18*q20)
    s96 = 2.0*(q17*q19)
    s97 = 2.0*(q19*q20)
    s98 = 2.0*(q17*q18)
    s99 = s87 + s88 - (s89 + s90)
    s100 = s93 - s94
    s101 = s95 + s96
    s102 = s93 + s94
    s103 = s91 + s92
    s104 = s97 - s98
    s105 = s95 - s96
    s106 = s97 + s98
    s107 = s91 - s92
    s108 = 0.5*s101
    s109 = 0.5*s104
    s110 = 0.5*s107
    s111 = q14 - s108 - (q7 - s60)
    s112 = q15 - s109 - (q8 - s61)
    s113 = q16 - s110 - (q9 - s62)
    s114 = 0.5*s100
    s115 = 0.5*s103
    s116 = 0.5*s106
    s117 = 0.5*s99
    s118 = -s117
    s119 = 0.5*s102
    s120 = -s119
    s121 = 0.5*s105
    s122 = -s121
    s123 = s53*s99 + s56*s102 + s59*s105
    s124 = s55*s102
    s125 = s58*s105
    s126 = s54*s102
    s127 = s51*s99 + s126 + s57*s105
    s128 = s98 - s97
    s129 = s92 - s91
    s130 = s56*s128 - s53*s101 + s59*s129
    s131 = s53*s100 + s56*s103 + s59*s106
    s132 = s125 - (s80*s99 - s124)
    s133 = s125 + s124 + s52*s99
    s134 = s99*(s43 - s41) - s126 + s105*(s48 - s47)
    s135 = s55*s128 - s52*s101 + s58*s129
    s136 = s52*s100 + s55*s103 + s58*s106
    s137 = q24*q24
    s138 = q25*q25
    s139 = q26*q26
    s140 = q27*q27
    s141 = s137 + s138
    s142 = s137 - s138
    s143 = s139 + s140
    s144 = s139 - s140
    s145 = 2.0*(q25*q26)
    s146 = 2.0*(q24*q27)
    s147 = 2.0*(q25*q27)
    s148 = 2.0*(q24*q26)
    s149 = 2.0*(q26*q27)
    s150 = 2.0*(q24*q25)
    s151 = s141 - s143
    s152 = s145 - s146
    s153 = s147 + s148
    s154 = s145 + s146
    s155 = s142 + s144
    s156 = s149 - s150
    s157 = s147 - s148
    s158 = s149 + s150
    s159 = s142 - s144
    s160 = 0.5*s151
    s161 = 0.5*s154
    s162 = 0.5*s157
    s163 = q21 + s160 - (q14 + s108)
    s164 = q22 + s161 - (q15 + s109)
    s165 = q23 + s162 - (q16 + s110)
    s166 = 0.5*s153
    s167 = -s166
    s168 = 0.5*s156
    s169 = -s168
    s170 = 0.5*s159
    s171 = -s170
    s172 = 0.5*s152
    s173 = 0.5*s155
    s174 = 0.5*s158
    s175 = s99*s152 + s102*s155 + s105*s158
    s176 = s101*s152
    s177 = s128*s155 - s176 + s129*s158
    s178 = s103*s155
    s179 = s106*s158
    s180 = s100*s152 + s178 + s179
    s181 = s99*s153 + s102*s156 + s105*s159
    s182 = s143 - s141
    s183 = s148 - s147
    s184 = s99*s182 - s102*s154 + s105*s183
    s185 = s176 + s104*s155 + s107*s158
    s186 = s152*(s94 - s93) - s178 - s179
    s187 = s101*s153 + s104*s156 + s107*s159
    s188 = s101*s182 - s104*s154 + s107*s183
    s189 = q31*q31
    s190 = q32*q32
    s191 = q33*q33
    s192 = q34*q34
    s193 = s189 + s190
    s194 = s189 - s190
    s195 = s191 + s192
    s196 = s191 - s192
    s197 = 2.0*(q32*q33)
    s198 = 2.0*(q31*q34)
    s199 = 2.0*(q32*q34)
    s200 = 2.0*(q31*q33)
    s201 = 2.0*(q33*q34)
    s202 = 2.0*(q31*q32)
    s203 = s193 - s195
    s204 = s197 - s198
    s205 = s199 + s200
    s206 = s197 + s198
    s207 = s194 + s196
    s208 = s201 - s202
    s209 = s199 - s200
    s210 = s201 + s202
    s211 = s194 - s196
    s212 = 0.5*s204
    s213 = 0.5*s207
    s214 = 0.5*s210
    s215 = q28 - s212 - (q21 - s160)
    s216 = q29 - s213 - (q22 - s161)
    s217 = q30 - s214 - (q23 - s162)
    s218 = 0.5*s205
    s219 = -s218
    s220 = 0.5*s208
    s221 = -s220
    s222 = 0.5*s211
    s223 = -s222
    s224 = 0.5*s203
    s225 = 0.5*s206
    s226 = 0.5*s209
    s227 = s152*s205 + s155*s208 + s158*s211
    s228 = s153*s205
    s229 = s228 + s156*s208 + s159*s211
    s230 = s154*s208
    s231 = s182*s205 - s230 + s183*s211
    s232 = s198 - s197
    s233 = s152*s203 + s155*s206 + s158*s209
    s234 = s158*s210 - (s152*s232 - s155*s207)
    s235 = s230 + s151*s205 + s157*s211
    s236 = s208*(s150 - s149) - s228 + s211*(s144 - s142)
    s237 = s151*s232 - s154*s207
    s238 = s157*s210
    s239 = s237 - s238
    s240 = s151*s203 + s154*s206 + s157*s209
    s241 = q28 + s212
    s242 = q29 + s213
    s243 = 1.0 - (q30 + s214)
    s244 = s195 - s193
    s245 = 1.0 + s117*(s117*gauge_16) + 1.0 + s114*(s114*gauge_15) + s166*(s166*gauge_22) + s172*(s172*gauge_23)
    s246 = 1.0 + s119*(s119*gauge_16) + 1.0 + s115*(s115*gauge_15) + s168*(s168*gauge_22) + s173*(s173*gauge_23)
    s247 = 1.0 + s121*(s121*gauge_16) + 1.0 + s116*(s116*gauge_15) + s170*(s170*gauge_22) + s174*(s174*gauge_23)
    s248 = s204*(s204*gauge_27) + s244*(s244*gauge_28)
    s249 = s205*(s205*gauge_27) + s244*(s244*gauge_29)
    s250 = 1.0/gauge_17
    s251 = 1.0/gauge_21
    s252 = 1.0/gauge_28
    s253 = s29 + s29
    s254 = s30 + s30
    s255 = s31 + s31
    s256 = s218 + s218
    s257 = s224 + s224
    s258 = s220 + s220
    s259 = s225 + s225
    s260 = s222 + s222
    s261 = s226 + s226
    s262 = s69 + s69
    s263 = s71 + s71
    s264 = s66*s253 + s67*s254 + s68*s255
    s265 = s73 + s73
    s266 = 1.0/(s82*s86 + s81*s85)
    s267 = s84*(s81*s266)
    s268 = s84*(s82*s266)
    s269 = 1.0/gauge_4 + s29*s29 + s30*s30 + s31*s31 + s253*s253 + s254*s254 + s255*s255 + s267*((1.0/gauge_9 + s66*s66 + s67*s67 + s68*s68)*s267 - s264) + s268*(1.0/gauge_10*s268)
    s270 = s253 - (s66 + s66)*s267
    s271 = s254 - (s67 + s67)*s267
    s272 = s255 - (s68 + s68)*s267
    s273 = s127*s268 - s132*s267
    s274 = s123*s267
    s275 = s117 + s117
    s276 = (s66*s69 + s67*s71 + s68*s73)*s267 - (s69*s253 + s71*s254 + s73*s255) - s262*s270 - s263*s271
    s277 = s119 + s119
    s278 = s117*s270 + s119*s271 + s121*s272
    s279 = s117*s262 + s119*s263 + s121*s265
    s280 = s114*s117 + s115*s119 + s116*s121
    s281 = 1.0/gauge_16 + s117*s117 + s119*s119 + s121*s121
    s282 = s121 + s121
    s283 = s172 + s172
    s284 = s173 + s173
    s285 = s166*s172 + s168*s173 + s170*s174
    s286 = s166*s256 + s168*s258 + s170*s260
    s287 = 1.0/gauge_23 + s172*s172 + s173*s173 + s174*s174
    s288 = s172*s256 + s173*s258 + s174*s260
    s289 = s172*s257 + s173*s259 + s174*s261
    s290 = s174 + s174
    s291 = 1.0/gauge_27 + s218*s218 + s220*s220 + s222*s222 + s256*s256 + s258*s258 + s260*s260
    s292 = s218*s224 + s220*s225 + s222*s226 + s256*s257 + s258*s259 + s260*s261
    s293 = 1.0/(s131*s135 - s130*s136)
    s294 = s131*s293
    s295 = s130*s293
    s296 = s273*(s136*s293) - s274*s294
    s297 = s274*s295 - s273*(s135*s293)
    s298 = s134*s294
    s299 = s134*s295
    s300 = s250*s297
    s301 = s278 + s281*s296
    s302 = s177*s296 + s180*s297
    s303 = s175*s296
    s304 = 1.0/gauge_11 + s69*s69 + s71*s71 + s73*s73 + s262*s262 + s263*s263 + s265*s265 + s298*(s281*s298 - s279) + s299*(s250*s299)
    s305 = s177*s298 - s180*s299
    s306 = s175*s298
    s307 = 1.0/(s184*s187 - s181*s188)
    s308 = s188*s307
    s309 = s184*s307
    s310 = s187*s307
    s311 = s181*s307
    s312 = s302*s308 - s303*s309
    s313 = s303*s311 - s302*s310
    s314 = s305*s308 - s306*s309
    s315 = s306*s311 - s305*s310
    s316 = s186*s309
    s317 = s186*s311
    s318 = s251*s312
    s319 = s287*s313
    s320 = s251*s314
    s321 = s287*s315
    s322 = s269 - s264*s267 + s270*s270 + s271*s271 + s272*s272 + s296*s301 + s297*s300 + s278*s296 + s312*s318 + s313*s319
    s323 = s288*s313
    s324 = s229*s312 + s231*s313
    s325 = s227*s313
    s326 = s288*s315
    s327 = s229*s314 + s231*s315
    s328 = s227*s315
    s329 = s288*s317
    s330 = s229*s316 - s231*s317
    s331 = s227*s317
    s332 = 1.0/(s234*s240 + s233*s239)
    s333 = s240*s332
    s334 = s233*s332
    s335 = (s238 - s237)*s332
    s336 = s234*s332
    s337 = s324*s333 - s325*s334
    s338 = s324*s335 - s325*s336
    s339 = s327*s333 - s328*s334
    s340 = s327*s335 - s328*s336
    s341 = s330*s333 + s331*s334
    s342 = s330*s335 + s331*s336
    s343 = s236*s334
    s344 = s236*s336
    s345 = s252*s338
    s346 = s291*s337 - s323
    s347 = s252*s340
    s348 = s291*s339 - s326
    s349 = s252*s342
    s350 = s329 + s291*s341
    s351 = s276 - s265*s272 + s298*s301 - s299*s300 - s279*s296 + s314*s318 + s315*s319 + s339*s346 + s340*s345
    s352 = s114*s270 + s115*s271 + s116*s272 + s280*s296 + s316*s318 - s317*s319 + s341*s346 + s342*s345
    s353 = s292*s337 - s289*s313
    s354 = s204*s337 + s244*s338
    s355 = s280*s298 - (s114*s262 + s115*s263 + s116*s265) + s316*s320 - s317*s321 + s341*s348 + s342*s347
    s356 = s292*s339 - s289*s315
    s357 = 1.0/gauge_15 + s114*s114 + s115*s115 + s116*s116 + s316*(s251*s316) + s317*(s287*s317) + s341*s350 + s342*s349
    s358 = s289*s317 + s292*s341
    s359 = 1.0/gauge_22 + s166*s166 + s168*s168 + s170*s170 + s343*(s291*s343 - s286) + s344*(s252*s344)
    s360 = s292*s343 - (s166*s257 + s168*s259 + s170*s261)
    s361 = 1.0/(1.0/gauge_29 + s224*s224 + s225*s225 + s226*s226 + s257*s257 + s259*s259 + s261*s261)
    s362 = s353*s361
    s363 = s356*s361
    s364 = s358*s361
    s365 = s360*s361
    s366 = s257*s361
    s367 = s259*s361
    s368 = s261*s361
    s369 = s351 - s326*s337 - s356*s362
    s370 = s352 + s329*s337 - s358*s362
    s371 = s285*s313 + s343*s346 + s344*s345 - s286*s337 - s360*s362
    s372 = s270 + s275*s296 - s283*s313 + s256*s337 - s257*s362
    s373 = s271 + s277*s296 - s284*s313 + s258*s337 - s259*s362
    s374 = s272 + s282*s296 - s290*s313 + s260*s337 - s261*s362
    s375 = s205*s337 + s244*s362
    s376 = 1.0/(s322 + s337*s346 + s338*s345 - s323*s337 - s353*s362)
    s377 = s369*s376
    s378 = s370*s376
    s379 = s371*s376
    s380 = s372*s376
    s381 = s373*s376
    s382 = s374*s376
    s383 = s354*s376
    s384 = s304 - s279*s298 + s314*s320 + s315*s321 + s339*s348 + s340*s347 - s326*s339 - s356*s363 - s369*s377
    s385 = s355 + s329*s339 - s358*s363 - s370*s377
    s386 = s285*s315 + s343*s348 + s344*s347 - s286*s339 - s360*s363 - s371*s377
    s387 = s275*s298 - s262 - s283*s315 + s256*s339 - s257*s363 - s372*s377
    s388 = s277*s298 - s263 - s284*s315 + s258*s339 - s259*s363 - s373*s377
    s389 = s282*s298 - s265 - s290*s315 + s260*s339 - s261*s363 - s374*s377
    s390 = s354*s377 - (s204*s339 + s244*s340)
    s391 = s375*s377 - (s205*s339 + s244*s363)
    s392 = 1.0/s384
    s393 = s385*s392
    s394 = s386*s392
    s395 = s387*s392
    s396 = s388*s392
    s397 = s389*s392
    s398 = s390*s392
    s399 = s343*s350 + s344*s349 - s285*s317 - s286*s341 - s360*s364 - s371*s378 - s386*s393
    s400 = s114 + s114 + s283*s317 + s256*s341 - s257*s364 - s372*s378 - s387*s393
    s401 = s115 + s115 + s284*s317 + s258*s341 - s259*s364 - s373*s378 - s388*s393
    s402 = s116 + s116 + s290*s317 + s260*s341 - s261*s364 - s374*s378 - s389*s393
    s403 = s354*s378 - (s204*s341 + s244*s342) - s390*s393
    s404 = s375*s378 - (s205*s341 + s244*s364) - s391*s393
    s405 = 1.0/(s357 + s329*s341 - s358*s364 - s370*s378 - s385*s393)
    s406 = s399*s405
    s407 = s400*s405
    s408 = s401*s405
    s409 = s402*s405
    s410 = s403*s405
    s411 = s256*s343 - (s166 + s166) - s257*s365 - s372*s379 - s387*s394 - s400*s406
    s412 = s258*s343 - (s168 + s168) - s259*s365 - s373*s379 - s388*s394 - s401*s406
    s413 = s260*s343 - (s170 + s170) - s261*s365 - s374*s379 - s389*s394 - s402*s406
    s414 = s354*s379 - (s204*s343 + s244*s344) - s390*s394 - s403*s406
    s415 = s375*s379 - (s205*s343 + s244*s365) - s391*s394 - s404*s406
    s416 = 1.0/(s359 - s286*s343 - s360*s365 - s371*s379 - s386*s394 - s399*s406)
    s417 = s411*s416
    s418 = s412*s416
    s419 = s413*s416
    s420 = s414*s416
    s421 = s257*s366 + s372*s380 + s387*s395 + s400*s407 + s411*s417
    s422 = s259*s366 + s373*s380 + s388*s395 + s401*s407 + s412*s417
    s423 = s261*s366 + s374*s380 + s389*s395 + s402*s407 + s413*s417
    s424 = s354*s380 - s390*s395 - s403*s407 - s414*s417
    s425 = s375*s380 - s244*s366 - s391*s395 - s404*s407 - s415*s417
    s426 = s244*(s244*s361) + s375*(s375*s376) + s391*(s391*s392) + s404*(s404*s405) + s415*(s415*s416)
    s427 = 1.0*(s421 > mask_15 + 1e-12*s245)
    s428 = s427/max(s421, 1e-300)
    s429 = s422*s428
    s430 = s423*s428
    s431 = s424*s428
    s432 = s423*s429 - (s261*s367 + s374*s381 + s389*s396 + s402*s408 + s413*s418)
    s433 = s354*s381 - s390*s396 - s403*s408 - s414*s418 - s424*s429
    s434 = s375*s381 - s244*s367 - s391*s396 - s404*s408 - s415*s418 - s425*s429
    s435 = s259*s367 + s373*s381 + s388*s396 + s401*s408 + s412*s418 - s422*s429
    s436 = 1.0*(s435 > mask_16 + 1e-12*s246)
    s437 = s436/max(s435, 1e-300)
    s438 = s432*s437
    s439 = s433*s437
    s440 = s423*s430 - (s261*s368 + s374*s382 + s389*s397 + s402*s409 + s413*s419) + s432*s438
    s441 = s354*s382 - s390*s397 - s403*s409 - s414*s419 - s424*s430 + s433*s438
    s442 = s375*s382 - s244*s368 - s391*s397 - s404*s409 - s415*s419 - s425*s430 + s434*s438
    s443 = -s440
    s444 = 1.0*(s443 > mask_17 + 1e-12*s247)
    s445 = s444/max(s443, 1e-300)
    s446 = s441*s445
    s447 = s424*s431 - (s354*s383 + s390*s398 + s403*s410 + s414*s420) + s433*s439 + s441*s446
    s448 = s425*s431 - (s375*s383 + s391*s398 + s404*s410 + s415*s420) + s434*s439 + s442*s446
    s449 = -s447
    s450 = 1.0*(s449 > mask_28 + 1e-12*s248)
    s451 = s425*(s425*s428) - s426 + s434*(s434*s437) + s442*(s442*s445) + s448*(s448*(s450/max(s449, 1e-300)))
    s452 = s36*status_6
    s453 = s21*status_6
    s454 = s75*status_6
    s455 = s83*status_6
    s456 = s123*status_6
    s457 = s133*status_6
    s458 = s175*status_6
    s459 = s185*status_6
    s460 = s227*status_6
    s461 = s235*status_6
    s462 = s205*status_6
    s463 = s204*status_6
    s464 = s24*s24 + s26*s26 + s28*s28
    s465 = s63*s63
    s466 = s64*s64
    s467 = s65*s65
    s468 = s111*s111
    s469 = s112*s112
    s470 = s113*s113
    s471 = s464 + s36*s36 + s21*s21 + s465 + s466 + s467 + s75*s75 + s83*s83 + s468 + s469 + s470 + s123*s123
    s472 = s163*s163
    s473 = s164*s164
    s474 = s165*s165
    s475 = s215*s215
    s476 = s216*s216
    s477 = s217*s217
    s478 = s471 + s133*s133 + s472 + s473 + s474 + s175*s175 + s185*s185 + s475 + s476 + s477 + s227*s227
    s479 = s241*s241
    s480 = s242*s242
    s481 = s243*s243
    s482 = s470 + s469 + s468 + s467 + s466 + s465 + s464 + s452*s452 + s453*s453 + s454*s454 + s455*s455
    s483 = s477 + s476 + s475 + s474 + s473 + s472 + s482 + s456*s456 + s457*s457 + s458*s458 + s459*s459
    s484 = s421/s245
    s485 = s435/s246
    s486 = s440/s247
    s487 = s447/s248
    s488 = s450 + 1.0 + 1.0 + 1.0 + 1.0 + 1.0 + 1.0 + 1.0 + 1.0 + 1.0 + 1.0 + s444 + s436 + s427 + 15.0
    s489 = s451/s249
    s490 = min(min(min(min(min(1.0, mask_15 + s484), mask_16 + s485), mask_17 - s486), mask_28 - s487), mask_29 - s489)
    s491 = min(min(1.0, (s16*(s16*gauge_3) + s14*(s14*gauge_5))*row_weight_3), (s22*(s22*gauge_3) + s35*(s35*gauge_5))*row_weight_4)
    s492 = (s77*(s77*gauge_3) + s79*(s79*gauge_5) + s82*(s82*gauge_9) + s81*(s81*gauge_10))*row_weight_8
    s493 = (s84*(s84*gauge_4) + s75*(s75*gauge_5) + s85*(s85*gauge_9) + s86*(s86*gauge_10))*row_weight_9
    s494 = (s132*(s132*gauge_9) + s127*(s127*gauge_10) + s130*(s130*gauge_16) + s131*(s131*gauge_17))*row_weight_13
    s495 = (s123*(s123*gauge_9) + s134*(s134*gauge_11) + s135*(s135*gauge_16) + s136*(s136*gauge_17))*row_weight_14
    s496 = (s177*(s177*gauge_16) + s180*(s180*gauge_17) + s181*(s181*gauge_21) + s184*(s184*gauge_23))*row_weight_18
    s497 = (s186*(s186*gauge_15) + s175*(s175*gauge_16) + s187*(s187*gauge_21) + s188*(s188*gauge_23))*row_weight_19
    s498 = (s229*(s229*gauge_21) + s231*(s231*gauge_23) + s234*(s234*gauge_27) + s233*(s233*gauge_28))*row_weight_23
    s499 = (s236*(s236*gauge_22) + s227*(s227*gauge_23) + s239*(s239*gauge_27) + s240*(s240*gauge_28))*row_weight_24
    s500 = min(min(min(min(min(min(min(min(s491, s492), s493), s494), s495), s496), s497), s498), s499)
    # outputs
    w[RESIDUAL] = s24  # P0.x
    w[RESIDUAL + 1] = s26  # P0.y
    w[RESIDUAL + 2] = s28  # P0.z
    w[RESIDUAL + 3] = s36  # P0.first
    w[RESIDUAL + 4] = s21  # P0.second
    w[RESIDUAL + 5] = s63  # P1.x
    w[RESIDUAL + 6] = s64  # P1.y
    w[RESIDUAL + 7] = s65  # P1.z
    w[RESIDUAL + 8] = -s75  # P1.first
    w[RESIDUAL + 9] = s83  # P1.second
    w[RESIDUAL + 10] = s111  # P2.x
    w[RESIDUAL + 11] = s112  # P2.y
    w[RESIDUAL + 12] = s113  # P2.z
    w[RESIDUAL + 13] = -s123  # P2.first
    w[RESIDUAL + 14] = s133  # P2.second
    w[RESIDUAL + 15] = s163  # P3.x
    w[RESIDUAL + 16] = s164  # P3.y
    w[RESIDUAL + 17] = s165  # P3.z
    w[RESIDUAL + 18] = -s175  # P3.first
    w[RESIDUAL + 19] = s185  # P3.second
    w[RESIDUAL + 20] = s215  # P4.x
    w[RESIDUAL + 21] = s216  # P4.y
    w[RESIDUAL + 22] = s217  # P4.z
    w[RESIDUAL + 23] = -s227  # P4.first
    w[RESIDUAL + 24] = s235  # P4.second
    w[RESIDUAL + 25] = -s241  # P5.x
    w[RESIDUAL + 26] = -s242  # P5.y
    w[RESIDUAL + 27] = s243  # P5.z
    w[RESIDUAL + 28] = -s205  # P5.first
    w[RESIDUAL + 29] = s204  # P5.second
    w[POSITION_VIOLATION] = math.sqrt(s478 + s235*s235 + s479 + s480 + s481 + s205*s205 + s204*s204)  # position_violation
    w[POSITION_MEASURE] = math.sqrt(s481 + s480 + s479 + s483 + s460*s460 + s461*s461 + s462*s462 + s463*s463)  # position_measure
    w[JACOBIAN] = s29  # D P0.x, rod1.wy
    w[JACOBIAN + 1] = s32  # D P0.x, rod1.wz
    w[JACOBIAN + 2] = s30  # D P0.y, rod1.wy
    w[JACOBIAN + 3] = s33  # D P0.y, rod1.wz
    w[JACOBIAN + 4] = s31  # D P0.z, rod1.wy
    w[JACOBIAN + 5] = s34  # D P0.z, rod1.wz
    w[JACOBIAN + 6] = -s16  # D P0.first, rod1.wx
    w[JACOBIAN + 7] = s14  # D P0.first, rod1.wz
    w[JACOBIAN + 8] = s22  # D P0.second, rod1.wx
    w[JACOBIAN + 9] = s35  # D P0.second, rod1.wz
    w[JACOBIAN + 10] = s29  # D P1.x, rod1.wy
    w[JACOBIAN + 11] = s32  # D P1.x, rod1.wz
    w[JACOBIAN + 12] = s66  # D P1.x, rod2.wx
    w[JACOBIAN + 13] = s70  # D P1.x, rod2.wz
    w[JACOBIAN + 14] = s30  # D P1.y, rod1.wy
    w[JACOBIAN + 15] = s33  # D P1.y, rod1.wz
    w[JACOBIAN + 16] = s67  # D P1.y, rod2.wx
    w[JACOBIAN + 17] = s72  # D P1.y, rod2.wz
    w[JACOBIAN + 18] = s31  # D P1.z, rod1.wy
    w[JACOBIAN + 19] = s34  # D P1.z, rod1.wz
    w[JACOBIAN + 20] = s68  # D P1.z, rod2.wx
    w[JACOBIAN + 21] = s74  # D P1.z, rod2.wz
    w[JACOBIAN + 22] = -s77  # D P1.first, rod1.wx
    w[JACOBIAN + 23] = -s79  # D P1.first, rod1.wz
    w[JACOBIAN + 24] = s82  # D P1.first, rod2.wx
    w[JACOBIAN + 25] = -s81  # D P1.first, rod2.wy
    w[JACOBIAN + 26] = s84  # D P1.second, rod1.wy
    w[JACOBIAN + 27] = s75  # D P1.second, rod1.wz
    w[JACOBIAN + 28] = s85  # D P1.second, rod2.wx
    w[JACOBIAN + 29] = s86  # D P1.second, rod2.wy
    w[JACOBIAN + 30] = s66  # D P2.x, rod2.wx
    w[JACOBIAN + 31] = s70  # D P2.x, rod2.wz
    w[JACOBIAN + 32] = s114  # D P2.x, rod3.wx
    w[JACOBIAN + 33] = s118  # D P2.x, rod3.wy
    w[JACOBIAN + 34] = s67  # D P2.y, rod2.wx
    w[JACOBIAN + 35] = s72  # D P2.y, rod2.wz
    w[JACOBIAN + 36] = s115  # D P2.y, rod3.wx
    w[JACOBIAN + 37] = s120  # D P2.y, rod3.wy
    w[JACOBIAN + 38] = s68  # D P2.z, rod2.wx
    w[JACOBIAN + 39] = s74  # D P2.z, rod2.wz
    w[JACOBIAN + 40] = s116  # D P2.z, rod3.wx
    w[JACOBIAN + 41] = s122  # D P2.z, rod3.wy
    w[JACOBIAN + 42] = s132  # D P2.first, rod2.wx
    w[JACOBIAN + 43] = -s127  # D P2.first, rod2.wy
    w[JACOBIAN + 44] = -s130  # D P2.first, rod3.wy
    w[JACOBIAN + 45] = -s131  # D P2.first, rod3.wz
    w[JACOBIAN + 46] = s123  # D P2.second, rod2.wx
    w[JACOBIAN + 47] = s134  # D P2.second, rod2.wz
    w[JACOBIAN + 48] = s135  # D P2.second, rod3.wy
    w[JACOBIAN + 49] = s136  # D P2.second, rod3.wz
    w[JACOBIAN + 50] = s114  # D P3.x, rod3.wx
    w[JACOBIAN + 51] = s118  # D P3.x, rod3.wy
    w[JACOBIAN + 52] = s167  # D P3.x, rod4.wy
    w[JACOBIAN + 53] = s172  # D P3.x, rod4.wz
    w[JACOBIAN + 54] = s115  # D P3.y, rod3.wx
    w[JACOBIAN + 55] = s120  # D P3.y, rod3.wy
    w[JACOBIAN + 56] = s169  # D P3.y, rod4.wy
    w[JACOBIAN + 57] = s173  # D P3.y, rod4.wz
    w[JACOBIAN + 58] = s116  # D P3.z, rod3.wx
    w[JACOBIAN + 59] = s122  # D P3.z, rod3.wy
    w[JACOBIAN + 60] = s171  # D P3.z, rod4.wy
    w[JACOBIAN + 61] = s174  # D P3.z, rod4.wz
    w[JACOBIAN + 62] = -s177  # D P3.first, rod3.wy
    w[JACOBIAN + 63] = -s180  # D P3.first, rod3.wz
    w[JACOBIAN + 64] = -s181  # D P3.first, rod4.wx
    w[JACOBIAN + 65] = -s184  # D P3.first, rod4.wz
    w[JACOBIAN + 66] = s186  # D P3.second, rod3.wx
    w[JACOBIAN + 67] = s175  # D P3.second, rod3.wy
    w[JACOBIAN + 68] = s187  # D P3.second, rod4.wx
    w[JACOBIAN + 69] = s188  # D P3.second, rod4.wz
    w[JACOBIAN + 70] = s167  # D P4.x, rod4.wy
    w[JACOBIAN + 71] = s172  # D P4.x, rod4.wz
    w[JACOBIAN + 72] = s219  # D P4.x, rod5.wx
    w[JACOBIAN + 73] = s224  # D P4.x, rod5.wz
    w[JACOBIAN + 74] = s169  # D P4.y, rod4.wy
    w[JACOBIAN + 75] = s173  # D P4.y, rod4.wz
    w[JACOBIAN + 76] = s221  # D P4.y, rod5.wx
    w[JACOBIAN + 77] = s225  # D P4.y, rod5.wz
    w[JACOBIAN + 78] = s171  # D P4.z, rod4.wy
    w[JACOBIAN + 79] = s174  # D P4.z, rod4.wz
    w[JACOBIAN + 80] = s223  # D P4.z, rod5.wx
    w[JACOBIAN + 81] = s226  # D P4.z, rod5.wz
    w[JACOBIAN + 82] = -s229  # D P4.first, rod4.wx
    w[JACOBIAN + 83] = -s231  # D P4.first, rod4.wz
    w[JACOBIAN + 84] = s234  # D P4.first, rod5.wx
    w[JACOBIAN + 85] = -s233  # D P4.first, rod5.wy
    w[JACOBIAN + 86] = s236  # D P4.second, rod4.wy
    w[JACOBIAN + 87] = s227  # D P4.second, rod4.wz
    w[JACOBIAN + 88] = s239  # D P4.second, rod5.wx
    w[JACOBIAN + 89] = s240  # D P4.second, rod5.wy
    w[JACOBIAN + 90] = s219  # D P5.x, rod5.wx
    w[JACOBIAN + 91] = s224  # D P5.x, rod5.wz
    w[JACOBIAN + 92] = s221  # D P5.y, rod5.wx
    w[JACOBIAN + 93] = s225  # D P5.y, rod5.wz
    w[JACOBIAN + 94] = s223  # D P5.z, rod5.wx
    w[JACOBIAN + 95] = s226  # D P5.z, rod5.wz
    w[JACOBIAN + 96] = s204  # D P5.first, rod5.wx
    w[JACOBIAN + 97] = s244  # D P5.first, rod5.wy
    w[JACOBIAN + 98] = s205  # D P5.second, rod5.wx
    w[JACOBIAN + 99] = s244  # D P5.second, rod5.wz
    w[PIVOT + 15] = s484  # P3.x
    w[PIVOT + 16] = s485  # P3.y
    w[PIVOT + 17] = -s486  # P3.z
    w[PIVOT + 28] = -s487  # P5.first
    w[PIVOT + 29] = -s489  # P5.second
    w[RANK] = 1.0*(-s451 > mask_29 + 1e-12*s249) + s488  # rank
    w[SMALLEST_PIVOT] = s490  # smallest_pivot
    w[SHORTEST_ROW] = min(min(s500, s248*row_weight_28), s249*row_weight_29)  # shortest_row
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 637 operations."""
    # inputs
    q1 = y[1]  # rod1.y [m]
    q3 = y[3]  # rod1.e0 [1]
    q4 = y[4]  # rod1.e1 [1]
    q5 = y[5]  # rod1.e2 [1]
    q6 = y[6]  # rod1.e3 [1]
    v0 = y[35]  # rod1.vx [m/s]
    v1 = y[36]  # rod1.vy [m/s]
    v2 = y[37]  # rod1.vz [m/s]
    v3 = y[38]  # rod1.wx [rad/s]
    v4 = y[39]  # rod1.wy [rad/s]
    v5 = y[40]  # rod1.wz [rad/s]
    q8 = y[8]  # rod2.y [m]
    q10 = y[10]  # rod2.e0 [1]
    q11 = y[11]  # rod2.e1 [1]
    q12 = y[12]  # rod2.e2 [1]
    q13 = y[13]  # rod2.e3 [1]
    v6 = y[41]  # rod2.vx [m/s]
    v7 = y[42]  # rod2.vy [m/s]
    v8 = y[43]  # rod2.vz [m/s]
    v9 = y[44]  # rod2.wx [rad/s]
    v10 = y[45]  # rod2.wy [rad/s]
    v11 = y[46]  # rod2.wz [rad/s]
    q15 = y[15]  # rod3.y [m]
    q17 = y[17]  # rod3.e0 [1]
    q18 = y[18]  # rod3.e1 [1]
    q19 = y[19]  # rod3.e2 [1]
    q20 = y[20]  # rod3.e3 [1]
    v12 = y[47]  # rod3.vx [m/s]
    v13 = y[48]  # rod3.vy [m/s]
    v14 = y[49]  # rod3.vz [m/s]
    v15 = y[50]  # rod3.wx [rad/s]
    v16 = y[51]  # rod3.wy [rad/s]
    v17 = y[52]  # rod3.wz [rad/s]
    q22 = y[22]  # rod4.y [m]
    q24 = y[24]  # rod4.e0 [1]
    q25 = y[25]  # rod4.e1 [1]
    q26 = y[26]  # rod4.e2 [1]
    q27 = y[27]  # rod4.e3 [1]
    v18 = y[53]  # rod4.vx [m/s]
    v19 = y[54]  # rod4.vy [m/s]
    v20 = y[55]  # rod4.vz [m/s]
    v21 = y[56]  # rod4.wx [rad/s]
    v22 = y[57]  # rod4.wy [rad/s]
    v23 = y[58]  # rod4.wz [rad/s]
    q29 = y[29]  # rod5.y [m]
    q31 = y[31]  # rod5.e0 [1]
    q32 = y[32]  # rod5.e1 [1]
    q33 = y[33]  # rod5.e2 [1]
    q34 = y[34]  # rod5.e3 [1]
    v24 = y[59]  # rod5.vx [m/s]
    v25 = y[60]  # rod5.vy [m/s]
    v26 = y[61]  # rod5.vz [m/s]
    v27 = y[62]  # rod5.wx [rad/s]
    v28 = y[63]  # rod5.wy [rad/s]
    v29 = y[64]  # rod5.wz [rad/s]
    winding_0 = w[WINDING]
    winding_1 = w[WINDING + 1]
    winding_2 = w[WINDING + 2]
    winding_3 = w[WINDING + 3]
    winding_4 = w[WINDING + 4]
    winding_5 = w[WINDING + 5]
    status_6 = w[LENGTH_SCALE]  # length_scale
    jacobian_0 = w[JACOBIAN]  # D P0.x, rod1.wy
    jacobian_1 = w[JACOBIAN + 1]  # D P0.x, rod1.wz
    jacobian_2 = w[JACOBIAN + 2]  # D P0.y, rod1.wy
    jacobian_3 = w[JACOBIAN + 3]  # D P0.y, rod1.wz
    jacobian_4 = w[JACOBIAN + 4]  # D P0.z, rod1.wy
    jacobian_5 = w[JACOBIAN + 5]  # D P0.z, rod1.wz
    jacobian_6 = w[JACOBIAN + 6]  # D P0.first, rod1.wx
    jacobian_7 = w[JACOBIAN + 7]  # D P0.first, rod1.wz
    jacobian_8 = w[JACOBIAN + 8]  # D P0.second, rod1.wx
    jacobian_9 = w[JACOBIAN + 9]  # D P0.second, rod1.wz
    jacobian_10 = w[JACOBIAN + 10]  # D P1.x, rod1.wy
    jacobian_11 = w[JACOBIAN + 11]  # D P1.x, rod1.wz
    jacobian_12 = w[JACOBIAN + 12]  # D P1.x, rod2.wx
    jacobian_13 = w[JACOBIAN + 13]  # D P1.x, rod2.wz
    jacobian_14 = w[JACOBIAN + 14]  # D P1.y, rod1.wy
    jacobian_15 = w[JACOBIAN + 15]  # D P1.y, rod1.wz
    jacobian_16 = w[JACOBIAN + 16]  # D P1.y, rod2.wx
    jacobian_17 = w[JACOBIAN + 17]  # D P1.y, rod2.wz
    jacobian_18 = w[JACOBIAN + 18]  # D P1.z, rod1.wy
    jacobian_19 = w[JACOBIAN + 19]  # D P1.z, rod1.wz
    jacobian_20 = w[JACOBIAN + 20]  # D P1.z, rod2.wx
    jacobian_21 = w[JACOBIAN + 21]  # D P1.z, rod2.wz
    jacobian_22 = w[JACOBIAN + 22]  # D P1.first, rod1.wx
    jacobian_23 = w[JACOBIAN + 23]  # D P1.first, rod1.wz
    jacobian_24 = w[JACOBIAN + 24]  # D P1.first, rod2.wx
    jacobian_25 = w[JACOBIAN + 25]  # D P1.first, rod2.wy
    jacobian_26 = w[JACOBIAN + 26]  # D P1.second, rod1.wy
    jacobian_27 = w[JACOBIAN + 27]  # D P1.second, rod1.wz
    jacobian_28 = w[JACOBIAN + 28]  # D P1.second, rod2.wx
    jacobian_29 = w[JACOBIAN + 29]  # D P1.second, rod2.wy
    jacobian_30 = w[JACOBIAN + 30]  # D P2.x, rod2.wx
    jacobian_31 = w[JACOBIAN + 31]  # D P2.x, rod2.wz
    jacobian_32 = w[JACOBIAN + 32]  # D P2.x, rod3.wx
    jacobian_33 = w[JACOBIAN + 33]  # D P2.x, rod3.wy
    jacobian_34 = w[JACOBIAN + 34]  # D P2.y, rod2.wx
    jacobian_35 = w[JACOBIAN + 35]  # D P2.y, rod2.wz
    jacobian_36 = w[JACOBIAN + 36]  # D P2.y, rod3.wx
    jacobian_37 = w[JACOBIAN + 37]  # D P2.y, rod3.wy
    jacobian_38 = w[JACOBIAN + 38]  # D P2.z, rod2.wx
    jacobian_39 = w[JACOBIAN + 39]  # D P2.z, rod2.wz
    jacobian_40 = w[JACOBIAN + 40]  # D P2.z, rod3.wx
    jacobian_41 = w[JACOBIAN + 41]  # D P2.z, rod3.wy
    jacobian_42 = w[JACOBIAN + 42]  # D P2.first, rod2.wx
    jacobian_43 = w[JACOBIAN + 43]  # D P2.first, rod2.wy
    jacobian_44 = w[JACOBIAN + 44]  # D P2.first, rod3.wy
    jacobian_45 = w[JACOBIAN + 45]  # D P2.first, rod3.wz
    jacobian_46 = w[JACOBIAN + 46]  # D P2.second, rod2.wx
    jacobian_47 = w[JACOBIAN + 47]  # D P2.second, rod2.wz
    jacobian_48 = w[JACOBIAN + 48]  # D P2.second, rod3.wy
    jacobian_49 = w[JACOBIAN + 49]  # D P2.second, rod3.wz
    jacobian_50 = w[JACOBIAN + 50]  # D P3.x, rod3.wx
    jacobian_51 = w[JACOBIAN + 51]  # D P3.x, rod3.wy
    jacobian_52 = w[JACOBIAN + 52]  # D P3.x, rod4.wy
    jacobian_53 = w[JACOBIAN + 53]  # D P3.x, rod4.wz
    jacobian_54 = w[JACOBIAN + 54]  # D P3.y, rod3.wx
    jacobian_55 = w[JACOBIAN + 55]  # D P3.y, rod3.wy
    jacobian_56 = w[JACOBIAN + 56]  # D P3.y, rod4.wy
    jacobian_57 = w[JACOBIAN + 57]  # D P3.y, rod4.wz
    jacobian_58 = w[JACOBIAN + 58]  # D P3.z, rod3.wx
    jacobian_59 = w[JACOBIAN + 59]  # D P3.z, rod3.wy
    jacobian_60 = w[JACOBIAN + 60]  # D P3.z, rod4.wy
    jacobian_61 = w[JACOBIAN + 61]  # D P3.z, rod4.wz
    jacobian_62 = w[JACOBIAN + 62]  # D P3.first, rod3.wy
    jacobian_63 = w[JACOBIAN + 63]  # D P3.first, rod3.wz
    jacobian_64 = w[JACOBIAN + 64]  # D P3.first, rod4.wx
    jacobian_65 = w[JACOBIAN + 65]  # D P3.first, rod4.wz
    jacobian_66 = w[JACOBIAN + 66]  # D P3.second, rod3.wx
    jacobian_67 = w[JACOBIAN + 67]  # D P3.second, rod3.wy
    jacobian_68 = w[JACOBIAN + 68]  # D P3.second, rod4.wx
    jacobian_69 = w[JACOBIAN + 69]  # D P3.second, rod4.wz
    jacobian_70 = w[JACOBIAN + 70]  # D P4.x, rod4.wy
    jacobian_71 = w[JACOBIAN + 71]  # D P4.x, rod4.wz
    jacobian_72 = w[JACOBIAN + 72]  # D P4.x, rod5.wx
    jacobian_73 = w[JACOBIAN + 73]  # D P4.x, rod5.wz
    jacobian_74 = w[JACOBIAN + 74]  # D P4.y, rod4.wy
    jacobian_75 = w[JACOBIAN + 75]  # D P4.y, rod4.wz
    jacobian_76 = w[JACOBIAN + 76]  # D P4.y, rod5.wx
    jacobian_77 = w[JACOBIAN + 77]  # D P4.y, rod5.wz
    jacobian_78 = w[JACOBIAN + 78]  # D P4.z, rod4.wy
    jacobian_79 = w[JACOBIAN + 79]  # D P4.z, rod4.wz
    jacobian_80 = w[JACOBIAN + 80]  # D P4.z, rod5.wx
    jacobian_81 = w[JACOBIAN + 81]  # D P4.z, rod5.wz
    jacobian_82 = w[JACOBIAN + 82]  # D P4.first, rod4.wx
    jacobian_83 = w[JACOBIAN + 83]  # D P4.first, rod4.wz
    jacobian_84 = w[JACOBIAN + 84]  # D P4.first, rod5.wx
    jacobian_85 = w[JACOBIAN + 85]  # D P4.first, rod5.wy
    jacobian_86 = w[JACOBIAN + 86]  # D P4.second, rod4.wy
    jacobian_87 = w[JACOBIAN + 87]  # D P4.second, rod4.wz
    jacobian_88 = w[JACOBIAN + 88]  # D P4.second, rod5.wx
    jacobian_89 = w[JACOBIAN + 89]  # D P4.second, rod5.wy
    jacobian_90 = w[JACOBIAN + 90]  # D P5.x, rod5.wx
    jacobian_91 = w[JACOBIAN + 91]  # D P5.x, rod5.wz
    jacobian_92 = w[JACOBIAN + 92]  # D P5.y, rod5.wx
    jacobian_93 = w[JACOBIAN + 93]  # D P5.y, rod5.wz
    jacobian_94 = w[JACOBIAN + 94]  # D P5.z, rod5.wx
    jacobian_95 = w[JACOBIAN + 95]  # D P5.z, rod5.wz
    jacobian_96 = w[JACOBIAN + 96]  # D P5.first, rod5.wx
    jacobian_97 = w[JACOBIAN + 97]  # D P5.first, rod5.wy
    jacobian_98 = w[JACOBIAN + 98]  # D P5.second, rod5.wx
    jacobian_99 = w[JACOBIAN + 99]  # D P5.second, rod5.wz
    # intermediate terms
    s0 = q3*q3
    s1 = q4*q4
    s2 = q5*q5
    s3 = q6*q6
    s4 = s0 - s1
    s5 = s2 - s3
    s6 = 2.0*(q4*q5)
    s7 = 2.0*(q3*q6)
    s8 = 2.0*(q4*q6)
    s9 = 2.0*(q3*q5)
    s10 = q10*q10
    s11 = q11*q11
    s12 = q12*q12
    s13 = q13*q13
    s14 = s10 - s11
    s15 = s12 - s13
    s16 = 2.0*(q11*q12)
    s17 = 2.0*(q10*q13)
    s18 = 2.0*(q11*q13)
    s19 = 2.0*(q10*q12)
    s20 = 2.0*(q12*q13)
    s21 = 2.0*(q10*q11)
    s22 = s10 + s11 - (s12 + s13)
    s23 = s16 + s17
    s24 = s18 - s19
    s25 = q17*q17
    s26 = q18*q18
    s27 = q19*q19
    s28 = q20*q20
    s29 = s25 - s26
    s30 = s27 - s28
    s31 = 2.0*(q18*q19)
    s32 = 2.0*(q17*q20)
    s33 = 2.0*(q18*q20)
    s34 = 2.0*(q17*q19)
    s35 = 2.0*(q19*q20)
    s36 = 2.0*(q17*q18)
    s37 = s31 - s32
    s38 = s29 + s30
    s39 = s35 + s36
    s40 = q24*q24
    s41 = q25*q25
    s42 = q26*q26
    s43 = q27*q27
    s44 = s40 - s41
    s45 = s42 - s43
    s46 = 2.0*(q25*q26)
    s47 = 2.0*(q24*q27)
    s48 = 2.0*(q25*q27)
    s49 = 2.0*(q24*q26)
    s50 = 2.0*(q26*q27)
    s51 = 2.0*(q24*q25)
    s52 = s48 + s49
    s53 = s50 - s51
    s54 = s44 - s45
    s55 = q31*q31
    s56 = q32*q32
    s57 = q33*q33
    s58 = q34*q34
    s59 = s55 + s56 - (s57 + s58)
    s60 = 2.0*(q32*q33) + 2.0*(q31*q34)
    s61 = 2.0*(q32*q34) - 2.0*(q31*q33)
    s62 = 0.5*(v3*(0.0016666666666666668*v3) + v4*(0.08416666666666667*v4) + v5*(0.08416666666666667*v5))
    s63 = v9*(0.08416666666666667*v9) + v10*(0.0016666666666666668*v10) + v11*(0.08416666666666667*v11)
    s64 = s62 + 0.5*(v0*v0) + 0.5*(v1*v1) + 0.5*(v2*v2) + 0.5*s63 + 0.5*(v6*v6) + 0.5*(v7*v7) + 0.5*(v8*v8)
    s65 = v15*(0.08416666666666667*v15) + v16*(0.08416666666666667*v16) + v17*(0.0016666666666666668*v17)
    s66 = v21*(0.0016666666666666668*v21) + v22*(0.08416666666666667*v22) + v23*(0.08416666666666667*v23)
    s67 = s64 + 0.5*s65 + 0.5*(v12*v12) + 0.5*(v13*v13) + 0.5*(v14*v14) + 0.5*s66 + 0.5*(v18*v18) + 0.5*(v19*v19)
    s68 = v27*(0.08416666666666667*v27) + v28*(0.0016666666666666668*v28) + v29*(0.08416666666666667*v29)
    s69 = math.atan2(s8 + s9, s4 - s5)
    s70 = math.atan2((s6 - s7)*s22 + (s4 + s5)*s23 + (2.0*(q5*q6) + 2.0*(q3*q4))*s24, (s0 + s1 - (s2 + s3))*s22 + (s6 + s7)*s23 + (s8 - s9)*s24)
    s71 = math.atan2((s18 + s19)*s37 + (s20 - s21)*s38 + (s14 - s15)*s39, (s16 - s17)*s37 + (s14 + s15)*s38 + (s20 + s21)*s39)
    s72 = math.atan2((s25 + s26 - (s27 + s28))*s52 + (s31 + s32)*s53 + (s33 - s34)*s54, (s33 + s34)*s52 + (s35 - s36)*s53 + (s29 - s30)*s54)
    s73 = math.atan2((s46 - s47)*s59 + (s44 + s45)*s60 + (s50 + s51)*s61, (s40 + s41 - (s42 + s43))*s59 + (s46 + s47)*s60 + (s48 - s49)*s61)
    s74 = math.atan2(2.0*(q33*q34) - 2.0*(q31*q32), s55 - s56 + s57 - s58)
    s75 = v0 + v4*jacobian_0 + v5*jacobian_1
    s76 = v1 + v4*jacobian_2 + v5*jacobian_3
    s77 = v2 + v4*jacobian_4 + v5*jacobian_5
    s78 = v3*jacobian_6 + v5*jacobian_7
    s79 = v3*jacobian_8 + v5*jacobian_9
    s80 = v6 + v4*jacobian_10 - v0 + v5*jacobian_11 + v9*jacobian_12 + v11*jacobian_13
    s81 = v7 + v4*jacobian_14 - v1 + v5*jacobian_15 + v9*jacobian_16 + v11*jacobian_17
    s82 = v8 + v4*jacobian_18 - v2 + v5*jacobian_19 + v9*jacobian_20 + v11*jacobian_21
    s83 = v3*jacobian_22 + v5*jacobian_23 + v9*jacobian_24 + v10*jacobian_25
    s84 = v4*jacobian_26 + v5*jacobian_27 + v9*jacobian_28 + v10*jacobian_29
    s85 = v12 + v9*jacobian_30 - v6 + v11*jacobian_31 + v15*jacobian_32 + v16*jacobian_33
    s86 = v13 + v9*jacobian_34 - v7 + v11*jacobian_35 + v15*jacobian_36 + v16*jacobian_37
    s87 = v14 + v9*jacobian_38 - v8 + v11*jacobian_39 + v15*jacobian_40 + v16*jacobian_41
    s88 = v9*jacobian_42 + v10*jacobian_43 + v16*jacobian_44 + v17*jacobian_45
    s89 = v9*jacobian_46 + v11*jacobian_47 + v16*jacobian_48 + v17*jacobian_49
    s90 = v18 + v15*jacobian_50 - v12 + v16*jacobian_51 + v22*jacobian_52 + v23*jacobian_53
    s91 = v19 + v15*jacobian_54 - v13 + v16*jacobian_55 + v22*jacobian_56 + v23*jacobian_57
    s92 = v20 + v15*jacobian_58 - v14 + v16*jacobian_59 + v22*jacobian_60 + v23*jacobian_61
    s93 = v16*jacobian_62 + v17*jacobian_63 + v21*jacobian_64 + v23*jacobian_65
    s94 = v15*jacobian_66 + v16*jacobian_67 + v21*jacobian_68 + v23*jacobian_69
    s95 = v24 + v22*jacobian_70 - v18 + v23*jacobian_71 + v27*jacobian_72 + v29*jacobian_73
    s96 = v25 + v22*jacobian_74 - v19 + v23*jacobian_75 + v27*jacobian_76 + v29*jacobian_77
    s97 = v26 + v22*jacobian_78 - v20 + v23*jacobian_79 + v27*jacobian_80 + v29*jacobian_81
    s98 = v21*jacobian_82 + v23*jacobian_83 + v27*jacobian_84 + v28*jacobian_85
    s99 = v22*jacobian_86 + v23*jacobian_87 + v27*jacobian_88 + v28*jacobian_89
    s100 = v27*jacobian_90 - v24 + v29*jacobian_91
    s101 = v27*jacobian_92 - v25 + v29*jacobian_93
    s102 = v27*jacobian_94 - v26 + v29*jacobian_95
    s103 = v27*jacobian_96 + v28*jacobian_97
    s104 = v27*jacobian_98 + v29*jacobian_99
    s105 = status_6*s78
    s106 = status_6*s79
    s107 = status_6*s83
    s108 = status_6*s84
    s109 = status_6*s88
    s110 = status_6*s89
    s111 = status_6*s93
    s112 = status_6*s94
    s113 = status_6*s98
    s114 = status_6*s99
    s115 = status_6*s103
    s116 = status_6*s104
    s117 = s75*s75 + s76*s76 + s77*s77
    s118 = s80*s80
    s119 = s81*s81
    s120 = s82*s82
    s121 = s85*s85
    s122 = s86*s86
    s123 = s87*s87
    s124 = s117 + s78*s78 + s79*s79 + s118 + s119 + s120 + s83*s83 + s84*s84 + s121 + s122 + s123 + s88*s88
    s125 = s90*s90
    s126 = s91*s91
    s127 = s92*s92
    s128 = s95*s95
    s129 = s96*s96
    s130 = s97*s97
    s131 = s124 + s89*s89 + s125 + s126 + s127 + s93*s93 + s94*s94 + s128 + s129 + s130 + s98*s98 + s99*s99
    s132 = s100*s100
    s133 = s101*s101
    s134 = s102*s102
    s135 = s123 + s122 + s121 + s120 + s119 + s118 + s117 + s105*s105 + s106*s106 + s107*s107 + s108*s108
    s136 = s130 + s129 + s128 + s127 + s126 + s125 + s135 + s109*s109 + s110*s110 + s111*s111 + s112*s112
    # outputs
    w[RESIDUAL] = s75  # P0.x
    w[RESIDUAL + 1] = s76  # P0.y
    w[RESIDUAL + 2] = s77  # P0.z
    w[RESIDUAL + 3] = s78  # P0.first
    w[RESIDUAL + 4] = s79  # P0.second
    w[RESIDUAL + 5] = s80  # P1.x
    w[RESIDUAL + 6] = s81  # P1.y
    w[RESIDUAL + 7] = s82  # P1.z
    w[RESIDUAL + 8] = s83  # P1.first
    w[RESIDUAL + 9] = s84  # P1.second
    w[RESIDUAL + 10] = s85  # P2.x
    w[RESIDUAL + 11] = s86  # P2.y
    w[RESIDUAL + 12] = s87  # P2.z
    w[RESIDUAL + 13] = s88  # P2.first
    w[RESIDUAL + 14] = s89  # P2.second
    w[RESIDUAL + 15] = s90  # P3.x
    w[RESIDUAL + 16] = s91  # P3.y
    w[RESIDUAL + 17] = s92  # P3.z
    w[RESIDUAL + 18] = s93  # P3.first
    w[RESIDUAL + 19] = s94  # P3.second
    w[RESIDUAL + 20] = s95  # P4.x
    w[RESIDUAL + 21] = s96  # P4.y
    w[RESIDUAL + 22] = s97  # P4.z
    w[RESIDUAL + 23] = s98  # P4.first
    w[RESIDUAL + 24] = s99  # P4.second
    w[RESIDUAL + 25] = s100  # P5.x
    w[RESIDUAL + 26] = s101  # P5.y
    w[RESIDUAL + 27] = s102  # P5.z
    w[RESIDUAL + 28] = s103  # P5.first
    w[RESIDUAL + 29] = s104  # P5.second
    w[VELOCITY_VIOLATION] = math.sqrt(s131 + s132 + s133 + s134 + s103*s103 + s104*s104)  # velocity_violation
    w[VELOCITY_MEASURE] = math.sqrt(s134 + s133 + s132 + s136 + s113*s113 + s114*s114 + s115*s115 + s116*s116)  # velocity_measure
    w[KINETIC] = s67 + 0.5*(v20*v20) + 0.5*s68 + 0.5*(v24*v24) + 0.5*(v25*v25) + 0.5*(v26*v26)  # kinetic
    w[POTENTIAL] = 9.81*q1 + 9.81*q8 + 9.81*q15 + 9.81*q22 + 9.81*q29  # potential
    w[WINDING] = s69 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s69))
    w[WINDING + 1] = s70 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_1 - s70))
    w[WINDING + 2] = s71 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_2 - s71))
    w[WINDING + 3] = s72 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_3 - s72))
    w[WINDING + 4] = s73 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_4 - s73))
    w[WINDING + 5] = s74 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_5 - s74))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def move(y, w):
    """q + N times `change`, Euler parameters of length 1: 215 operations."""
    # inputs
    q0 = y[0]  # rod1.x [m]
    q1 = y[1]  # rod1.y [m]
    q2 = y[2]  # rod1.z [m]
    q3 = y[3]  # rod1.e0 [1]
    q4 = y[4]  # rod1.e1 [1]
    q5 = y[5]  # rod1.e2 [1]
    q6 = y[6]  # rod1.e3 [1]
    q7 = y[7]  # rod2.x [m]
    q8 = y[8]  # rod2.y [m]
    q9 = y[9]  # rod2.z [m]
    q10 = y[10]  # rod2.e0 [1]
    q11 = y[11]  # rod2.e1 [1]
    q12 = y[12]  # rod2.e2 [1]
    q13 = y[13]  # rod2.e3 [1]
    q14 = y[14]  # rod3.x [m]
    q15 = y[15]  # rod3.y [m]
    q16 = y[16]  # rod3.z [m]
    q17 = y[17]  # rod3.e0 [1]
    q18 = y[18]  # rod3.e1 [1]
    q19 = y[19]  # rod3.e2 [1]
    q20 = y[20]  # rod3.e3 [1]
    q21 = y[21]  # rod4.x [m]
    q22 = y[22]  # rod4.y [m]
    q23 = y[23]  # rod4.z [m]
    q24 = y[24]  # rod4.e0 [1]
    q25 = y[25]  # rod4.e1 [1]
    q26 = y[26]  # rod4.e2 [1]
    q27 = y[27]  # rod4.e3 [1]
    q28 = y[28]  # rod5.x [m]
    q29 = y[29]  # rod5.y [m]
    q30 = y[30]  # rod5.z [m]
    q31 = y[31]  # rod5.e0 [1]
    q32 = y[32]  # rod5.e1 [1]
    q33 = y[33]  # rod5.e2 [1]
    q34 = y[34]  # rod5.e3 [1]
    change_0 = w[CHANGE]  # rod1.vx
    change_1 = w[CHANGE + 1]  # rod1.vy
    change_2 = w[CHANGE + 2]  # rod1.vz
    change_3 = w[CHANGE + 3]  # rod1.wx
    change_4 = w[CHANGE + 4]  # rod1.wy
    change_5 = w[CHANGE + 5]  # rod1.wz
    change_6 = w[CHANGE + 6]  # rod2.vx
    change_7 = w[CHANGE + 7]  # rod2.vy
    change_8 = w[CHANGE + 8]  # rod2.vz
    change_9 = w[CHANGE + 9]  # rod2.wx
    change_10 = w[CHANGE + 10]  # rod2.wy
    change_11 = w[CHANGE + 11]  # rod2.wz
    change_12 = w[CHANGE + 12]  # rod3.vx
    change_13 = w[CHANGE + 13]  # rod3.vy
    change_14 = w[CHANGE + 14]  # rod3.vz
    change_15 = w[CHANGE + 15]  # rod3.wx
    change_16 = w[CHANGE + 16]  # rod3.wy
    change_17 = w[CHANGE + 17]  # rod3.wz
    change_18 = w[CHANGE + 18]  # rod4.vx
    change_19 = w[CHANGE + 19]  # rod4.vy
    change_20 = w[CHANGE + 20]  # rod4.vz
    change_21 = w[CHANGE + 21]  # rod4.wx
    change_22 = w[CHANGE + 22]  # rod4.wy
    change_23 = w[CHANGE + 23]  # rod4.wz
    change_24 = w[CHANGE + 24]  # rod5.vx
    change_25 = w[CHANGE + 25]  # rod5.vy
    change_26 = w[CHANGE + 26]  # rod5.vz
    change_27 = w[CHANGE + 27]  # rod5.wx
    change_28 = w[CHANGE + 28]  # rod5.wy
    change_29 = w[CHANGE + 29]  # rod5.wz
    # intermediate terms
    s0 = 0.5*change_3
    s1 = 0.5*change_4
    s2 = 0.5*change_5
    s3 = q3 - (q4*s0 + q5*s1 + q6*s2)
    s4 = q4 + q3*s0 + q5*s2 - q6*s1
    s5 = q5 + q3*s1 + q6*s0 - q4*s2
    s6 = q6 + q3*s2 + q4*s1 - q5*s0
    s7 = 1.0/math.sqrt(s3*s3 + s4*s4 + s5*s5 + s6*s6)
    s8 = 0.5*change_9
    s9 = 0.5*change_10
    s10 = 0.5*change_11
    s11 = q10 - (q11*s8 + q12*s9 + q13*s10)
    s12 = q11 + q10*s8 + q12*s10 - q13*s9
    s13 = q12 + q10*s9 + q13*s8 - q11*s10
    s14 = q13 + q10*s10 + q11*s9 - q12*s8
    s15 = 1.0/math.sqrt(s11*s11 + s12*s12 + s13*s13 + s14*s14)
    s16 = 0.5*change_15
    s17 = 0.5*change_16
    s18 = 0.5*change_17
    s19 = q17 - (q18*s16 + q19*s17 + q20*s18)
    s20 = q18 + q17*s16 + q19*s18 - q20*s17
    s21 = q19 + q17*s17 + q20*s16 - q18*s18
    s22 = q20 + q17*s18 + q18*s17 - q19*s16
    s23 = 1.0/math.sqrt(s19*s19 + s20*s20 + s21*s21 + s22*s22)
    s24 = 0.5*change_21
    s25 = 0.5*change_22
    s26 = 0.5*change_23
    s27 = q24 - (q25*s24 + q26*s25 + q27*s26)
    s28 = q25 + q24*s24 + q26*s26 - q27*s25
    s29 = q26 + q24*s25 + q27*s24 - q25*s26
    s30 = q27 + q24*s26 + q25*s25 - q26*s24
    s31 = 1.0/math.sqrt(s27*s27 + s28*s28 + s29*s29 + s30*s30)
    s32 = 0.5*change_27
    s33 = 0.5*change_28
    s34 = 0.5*change_29
    s35 = q31 - (q32*s32 + q33*s33 + q34*s34)
    s36 = q32 + q31*s32 + q33*s34 - q34*s33
    s37 = q33 + q31*s33 + q34*s32 - q32*s34
    s38 = q34 + q31*s34 + q32*s33 - q33*s32
    s39 = 1.0/math.sqrt(s35*s35 + s36*s36 + s37*s37 + s38*s38)
    # outputs
    y[0] = q0 + change_0
    y[1] = q1 + change_1
    y[2] = q2 + change_2
    y[3] = s3*s7
    y[4] = s4*s7
    y[5] = s5*s7
    y[6] = s6*s7
    y[7] = q7 + change_6
    y[8] = q8 + change_7
    y[9] = q9 + change_8
    y[10] = s11*s15
    y[11] = s12*s15
    y[12] = s13*s15
    y[13] = s14*s15
    y[14] = q14 + change_12
    y[15] = q15 + change_13
    y[16] = q16 + change_14
    y[17] = s19*s23
    y[18] = s20*s23
    y[19] = s21*s23
    y[20] = s22*s23
    y[21] = q21 + change_18
    y[22] = q22 + change_19
    y[23] = q23 + change_20
    y[24] = s27*s31
    y[25] = s28*s31
    y[26] = s29*s31
    y[27] = s30*s31
    y[28] = q28 + change_24
    y[29] = q29 + change_25
    y[30] = q30 + change_26
    y[31] = s35*s39
    y[32] = s36*s39
    y[33] = s37*s39
    y[34] = s38*s39
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def normalise(y):
    """Euler parameters of length 1; 1 where they were not: 80 operations."""
    # inputs
    q3 = y[3]  # rod1.e0 [1]
    q4 = y[4]  # rod1.e1 [1]
    q5 = y[5]  # rod1.e2 [1]
    q6 = y[6]  # rod1.e3 [1]
    q10 = y[10]  # rod2.e0 [1]
    q11 = y[11]  # rod2.e1 [1]
    q12 = y[12]  # rod2.e2 [1]
    q13 = y[13]  # rod2.e3 [1]
    q17 = y[17]  # rod3.e0 [1]
    q18 = y[18]  # rod3.e1 [1]
    q19 = y[19]  # rod3.e2 [1]
    q20 = y[20]  # rod3.e3 [1]
    q24 = y[24]  # rod4.e0 [1]
    q25 = y[25]  # rod4.e1 [1]
    q26 = y[26]  # rod4.e2 [1]
    q27 = y[27]  # rod4.e3 [1]
    q31 = y[31]  # rod5.e0 [1]
    q32 = y[32]  # rod5.e1 [1]
    q33 = y[33]  # rod5.e2 [1]
    q34 = y[34]  # rod5.e3 [1]
    # intermediate terms
    s0 = q6*q6 + q5*q5 + q3*q3 + q4*q4
    s1 = 1.0/math.sqrt(s0)
    s2 = q13*q13 + q12*q12 + q10*q10 + q11*q11
    s3 = 1.0/math.sqrt(s2)
    s4 = q20*q20 + q19*q19 + q17*q17 + q18*q18
    s5 = 1.0/math.sqrt(s4)
    s6 = q27*q27 + q26*q26 + q24*q24 + q25*q25
    s7 = 1.0/math.sqrt(s6)
    s8 = q34*q34 + q33*q33 + q31*q31 + q32*q32
    s9 = 1.0/math.sqrt(s8)
    s10 = max(max(max(max(abs(s0 - 1.0), abs(s2 - 1.0)), abs(s4 - 1.0)), abs(s6 - 1.0)), abs(s8 - 1.0))
    # outputs
    y[3] = q3*s1
    y[4] = q4*s1
    y[5] = q5*s1
    y[6] = q6*s1
    y[10] = q10*s3
    y[11] = q11*s3
    y[12] = q12*s3
    y[13] = q13*s3
    y[17] = q17*s5
    y[18] = q18*s5
    y[19] = q19*s5
    y[20] = q20*s5
    y[24] = q24*s7
    y[25] = q25*s7
    y[26] = q26*s7
    y[27] = q27*s7
    y[31] = q31*s9
    y[32] = q32*s9
    y[33] = q33*s9
    y[34] = q34*s9
    return int((1e-13 < s10))
