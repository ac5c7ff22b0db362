"""Method `lagrange` for model `bricard`. Emitted by symgen; do not edit.

Constraints at acceleration level only; violations grow with time.
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates a1bfe8da2fcb1eac
option solver = elimination

Constraints Phi(q, t) = 0, their rates D v = nu and D v' = gamma; M v' = f - D^T lambda; S = D M^-1 D^T.

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and counters iw. Once: `prepare` of the
model, `prepare`, and `accept` with the start. Then `rhs` gives the rate of a state, `confirm` where `rhs` returns 1,
and `accept` corrects and measures the state at the end of each step.

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
"""

import math

from numba import njit

from model import geometry, measure, normalise

MULTIPLIERS = 25  # sections of w
MASK = 55
SAVED = 85
PIVOT = 175
GAUGE = 265
SUSPECTS = 1  # counters in iw
LIGHT = 2


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 2758 operations, 320157586840626705 before sharing."""
    # inputs
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
    mask_15 = w[MASK + 15]  # P3.x
    mask_16 = w[MASK + 16]  # P3.y
    mask_17 = w[MASK + 17]  # P3.z
    mask_28 = w[MASK + 28]  # P5.first
    mask_29 = w[MASK + 29]  # P5.second
    gauge_4 = w[GAUGE + 4]  # rod1.wy
    gauge_11 = w[GAUGE + 11]  # rod2.wz
    gauge_15 = w[GAUGE + 15]  # rod3.wx
    gauge_22 = w[GAUGE + 22]  # rod4.wy
    gauge_27 = w[GAUGE + 27]  # rod5.wx
    gauge_28 = w[GAUGE + 28]  # rod5.wy
    gauge_29 = w[GAUGE + 29]  # rod5.wz
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
    s23 = 0.5*v5
    s24 = 0.5*v4
    s25 = v4*s24 + v5*s23
    s26 = v3*s24
    s27 = v3*s23
    s28 = s14*s25
    s29 = s15*s26
    s30 = s16*s27
    s31 = s17*s25
    s32 = s18*s26
    s33 = s19*s27
    s34 = s20*s25
    s35 = s21*s26
    s36 = s22*s27
    s37 = 0.5*s16
    s38 = 0.5*s19
    s39 = 0.5*s22
    s40 = 0.5*s15
    s41 = 0.5*s18
    s42 = 0.5*s21
    s43 = s30 - (s28 - s29)
    s44 = s33 - (s31 - s32)
    s45 = s36 - (s34 - s35)
    s46 = v3*v4
    s47 = v5*v5
    s48 = s47 + v3*v3
    s49 = v4*v5
    s50 = s14*s46 - s15*s48 + s16*s49
    s51 = s20*s46 - s21*s48 + s22*s49
    s52 = s6 - s4
    s53 = s11 - s10
    s54 = q10*q10
    s55 = q11*q11
    s56 = q12*q12
    s57 = q13*q13
    s58 = s54 + s55
    s59 = s54 - s55
    s60 = s56 + s57
    s61 = s56 - s57
    s62 = 2.0*(q11*q12)
    s63 = 2.0*(q10*q13)
    s64 = 2.0*(q11*q13)
    s65 = 2.0*(q10*q12)
    s66 = 2.0*(q12*q13)
    s67 = 2.0*(q10*q11)
    s68 = s58 - s60
    s69 = s62 - s63
    s70 = s64 + s65
    s71 = s62 + s63
    s72 = s59 + s61
    s73 = s66 - s67
    s74 = s64 - s65
    s75 = s66 + s67
    s76 = s59 - s61
    s77 = 0.5*v11
    s78 = 0.5*v9
    s79 = v10*s78
    s80 = v11*s77 + v9*s78
    s81 = v10*s77
    s82 = s68*s79
    s83 = s69*s80
    s84 = s70*s81
    s85 = s71*s79
    s86 = s72*s80
    s87 = s73*s81
    s88 = s74*s79
    s89 = s75*s80
    s90 = s76*s81
    s91 = 0.5*s70
    s92 = 0.5*s73
    s93 = 0.5*s76
    s94 = 0.5*s68
    s95 = 0.5*s71
    s96 = 0.5*s74
    s97 = s30 + s29 - s28 - (s82 - s83 + s84)
    s98 = s33 + s32 - s31 - (s85 - s86 + s87)
    s99 = s36 + s35 - s34 - (s88 - s89 + s90)
    s100 = v9*v11
    s101 = v10*v11
    s102 = v9*v9
    s103 = s102 + v10*v10
    s104 = v10*s68 - v9*s69
    s105 = v10*s71 - v9*s72
    s106 = v10*s74 - v9*s75
    s107 = s68*s100 + s69*s101 - s70*s103
    s108 = s71*s100 + s72*s101 - s73*s103
    s109 = s74*s100 + s75*s101 - s76*s103
    s110 = s15*s70 + s18*s73 + s21*s76
    s111 = s16*s70
    s112 = s111 + s19*s73 + s22*s76
    s113 = s52*s70 - s17*s73 + s53*s76
    s114 = s63 - s62
    s115 = s15*s68 + s18*s71 + s21*s74
    s116 = s15*s107 + s18*s108 + s21*s109 + s50*s70 + (s17*s46 - s18*s48 + s19*s49)*s73 + s51*s76 + s104*(2.0*(v3*s16 - v5*s14))
    s117 = s21*s75 - (s15*s114 - s18*s72)
    s118 = s47 + v4*v4
    s119 = v3*v5
    s120 = s7 - s5
    s121 = s73*(s13 - s12) - s111 + s76*s120
    s122 = s14*s114 - s17*s72
    s123 = s20*s75
    s124 = s14*s68 + s17*s71 + s20*s74
    s125 = s14*s107 + s17*s108 + s20*s109 + s70*(s15*s46 - s14*s118 + s16*s119) + s73*(s18*s46 - s17*s118 + s19*s119)
    s126 = s125 + s76*(s21*s46 - s20*s118 + s22*s119) + s104*(2.0*(v5*s15 - v4*s16)) + s105*(2.0*(v5*s18 - v4*s19))
    s127 = s126 + s106*(2.0*(v5*s21 - v4*s22))
    s128 = q17*q17
    s129 = q18*q18
    s130 = q19*q19
    s131 = q20*q20
    s132 = s128 - s129
    s133 = s130 - s131
    s134 = 2.0*(q18*q19)
    s135 = 2.0*(q17*q20)
    s136 = 2.0*(q18*q20)
    s137 = 2.0*(q17*q19)
    s138 = 2.0*(q19*q20)
    s139 = 2.0*(q17*q18)
    s140 = s128 + s129 - (s130 + s131)
    s141 = s134 - s135
    s142 = s136 + s137
    s143 = s134 + s135
    s144 = s132 + s133
    s145 = s138 - s139
    s146 = s136 - s137
    s147 = s138 + s139
    s148 = s132 - s133
    s149 = 0.5*v16
    s150 = 0.5*v15
    s151 = v17*s150
    s152 = v17*s149
    s153 = v15*s150 + v16*s149
    s154 = s140*s151 + s141*s152
    s155 = s142*s153
    s156 = s143*s151 + s144*s152
    s157 = s145*s153
    s158 = s146*s151 + s147*s152
    s159 = s148*s153
    s160 = 0.5*s141
    s161 = 0.5*s144
    s162 = 0.5*s147
    s163 = 0.5*s140
    s164 = 0.5*s143
    s165 = 0.5*s146
    s166 = s83 - s82 - s84 - (s155 - s154)
    s167 = s86 - s85 - s87 - (s157 - s156)
    s168 = s89 - s88 - s90 - (s159 - s158)
    s169 = v16*v16
    s170 = s169 + v17*v17
    s171 = v15*v16
    s172 = v15*v17
    s173 = v17*s141 - v16*s142
    s174 = v17*s144 - v16*s145
    s175 = v17*s147 - v16*s148
    s176 = s141*s171 - s140*s170 + s142*s172
    s177 = s144*s171 - s143*s170 + s145*s172
    s178 = s147*s171 - s146*s170 + s148*s172
    s179 = s70*s140 + s73*s143 + s76*s146
    s180 = s71*s143
    s181 = s68*s140 + s180 + s74*s146
    s182 = s139 - s138
    s183 = s133 - s132
    s184 = s73*s182 - s70*s142 + s76*s183
    s185 = s70*s141 + s73*s144 + s76*s147
    s186 = s70*s176 + s73*s177 + s76*s178 + s107*s140 + s108*s143 + s109*s146 + s173*(2.0*s104) + s174*(2.0*s105)
    s187 = s186 + s175*(2.0*s106)
    s188 = s75*s146 - (s114*s140 - s72*s143)
    s189 = v9*v10
    s190 = s102 + v11*v11
    s191 = s140*(s60 - s58) - s180 + s146*(s65 - s64)
    s192 = s72*s182 - s69*s142 + s75*s183
    s193 = s69*s141 + s72*s144 + s75*s147
    s194 = s69*s176 + s72*s177 + s75*s178 + s140*(s68*s189 - s69*s190 + s70*s101) + s143*(s71*s189 - s72*s190 + s73*s101)
    s195 = s194 + s146*(s74*s189 - s75*s190 + s76*s101) + s173*(2.0*(v9*s70 - v11*s68)) + s174*(2.0*(v9*s73 - v11*s71))
    s196 = s195 + s175*(2.0*(v9*s76 - v11*s74))
    s197 = q24*q24
    s198 = q25*q25
    s199 = q26*q26
    s200 = q27*q27
    s201 = s197 + s198
    s202 = s197 - s198
    s203 = s199 + s200
    s204 = s199 - s200
    s205 = 2.0*(q25*q26)
    s206 = 2.0*(q24*q27)
    s207 = 2.0*(q25*q27)
    s208 = 2.0*(q24*q26)
    s209 = 2.0*(q26*q27)
    s210 = 2.0*(q24*q25)
    s211 = s201 - s203
    s212 = s205 - s206
    s213 = s207 + s208
    s214 = s205 + s206
    s215 = s202 + s204
    s216 = s209 - s210
    s217 = s207 - s208
    s218 = s209 + s210
    s219 = s202 - s204
    s220 = 0.5*v23
    s221 = 0.5*v22
    s222 = v22*s221 + v23*s220
    s223 = v21*s221
    s224 = v21*s220
    s225 = s211*s222
    s226 = s212*s223
    s227 = s213*s224
    s228 = s214*s222
    s229 = s215*s223
    s230 = s216*s224
    s231 = s217*s222
    s232 = s218*s223
    s233 = s219*s224
    s234 = 0.5*s213
    s235 = 0.5*s216
    s236 = 0.5*s219
    s237 = 0.5*s212
    s238 = 0.5*s215
    s239 = 0.5*s218
    s240 = v21*v22
    s241 = v23*v23
    s242 = s241 + v21*v21
    s243 = v22*v23
    s244 = v21*s213 - v23*s211
    s245 = v21*s216 - v23*s214
    s246 = v21*s219 - v23*s217
    s247 = s211*s240 - s212*s242 + s213*s243
    s248 = s214*s240 - s215*s242 + s216*s243
    s249 = s217*s240 - s218*s242 + s219*s243
    s250 = s140*s212 + s143*s215 + s146*s218
    s251 = s182*s215 - s142*s212 + s183*s218
    s252 = s144*s215
    s253 = s147*s218
    s254 = s141*s212 + s252 + s253
    s255 = s140*s213 + s143*s216 + s146*s219
    s256 = s203 - s201
    s257 = s208 - s207
    s258 = s140*s256 - s143*s214 + s146*s257
    s259 = s140*s247 + s143*s248 + s146*s249 + s176*s212 + s177*s215 + s178*s218 + s244*(2.0*s173) + s245*(2.0*s174)
    s260 = s259 + s246*(2.0*s175)
    s261 = v16*v17
    s262 = s169 + v15*v15
    s263 = s212*(s135 - s134) - s252 - s253
    s264 = s142*s213 + s145*s216 + s148*s219
    s265 = s142*s256 - s145*s214 + s148*s257
    s266 = s142*s247 + s145*s248 + s148*s249 + s212*(s140*s172 + s141*s261 - s142*s262) + s215*(s143*s172 + s144*s261 - s145*s262)
    s267 = s266 + s218*(s146*s172 + s147*s261 - s148*s262) + s244*(2.0*(v16*s140 - v15*s141)) + s245*(2.0*(v16*s143 - v15*s144))
    s268 = s267 + s246*(2.0*(v16*s146 - v15*s147))
    s269 = q31*q31
    s270 = q32*q32
    s271 = q33*q33
    s272 = q34*q34
    s273 = s269 + s270
    s274 = s269 - s270
    s275 = s271 + s272
    s276 = s271 - s272
    s277 = 2.0*(q32*q33)
    s278 = 2.0*(q31*q34)
    s279 = 2.0*(q32*q34)
    s280 = 2.0*(q31*q33)
    s281 = 2.0*(q33*q34)
    s282 = 2.0*(q31*q32)
    s283 = s273 - s275
    s284 = s277 - s278
    s285 = s279 + s280
    s286 = s277 + s278
    s287 = s274 + s276
    s288 = s281 - s282
    s289 = s279 - s280
    s290 = s281 + s282
    s291 = s274 - s276
    s292 = 0.5*v29
    s293 = 0.5*v27
    s294 = v28*s293
    s295 = v29*s292 + v27*s293
    s296 = v28*s292
    s297 = s283*s294
    s298 = s284*s295
    s299 = s285*s296
    s300 = s286*s294
    s301 = s287*s295
    s302 = s288*s296
    s303 = s289*s294
    s304 = s290*s295
    s305 = s291*s296
    s306 = 0.5*s285
    s307 = 0.5*s288
    s308 = 0.5*s291
    s309 = 0.5*s283
    s310 = 0.5*s286
    s311 = 0.5*s289
    s312 = s225 - s226 - s227 - (s298 - s297 - s299)
    s313 = s228 - s229 - s230 - (s301 - s300 - s302)
    s314 = s231 - s232 - s233 - (s304 - s303 - s305)
    s315 = v27*v29
    s316 = v28*v29
    s317 = v27*v27
    s318 = s317 + v28*v28
    s319 = v28*s283 - v27*s284
    s320 = v28*s286 - v27*s287
    s321 = v28*s289 - v27*s290
    s322 = s283*s315 + s284*s316 - s285*s318
    s323 = s286*s315 + s287*s316 - s288*s318
    s324 = s289*s315 + s290*s316 - s291*s318
    s325 = s212*s285 + s215*s288 + s218*s291
    s326 = s213*s285
    s327 = s326 + s216*s288 + s219*s291
    s328 = s256*s285 - s214*s288 + s257*s291
    s329 = s278 - s277
    s330 = s212*s283 + s215*s286 + s218*s289
    s331 = s212*s322 + s215*s323 + s218*s324 + s247*s285 + s248*s288 + s249*s291 + s319*(2.0*s244) + s320*(2.0*s245)
    s332 = s331 + s321*(2.0*s246)
    s333 = s218*s290 - (s212*s329 - s215*s287)
    s334 = s241 + v22*v22
    s335 = v21*v23
    s336 = s288*(s210 - s209) - s326 + s291*(s204 - s202)
    s337 = s211*s329 - s214*s287
    s338 = s217*s290
    s339 = s211*s283 + s214*s286 + s217*s289
    s340 = s211*s322 + s214*s323 + s217*s324 + s285*(s212*s240 - s211*s334 + s213*s335) + s288*(s215*s240 - s214*s334 + s216*s335)
    s341 = s340 + s291*(s218*s240 - s217*s334 + s219*s335) + s319*(2.0*(v23*s212 - v22*s213)) + s320*(2.0*(v23*s215 - v22*s216))
    s342 = s341 + s321*(2.0*(v23*s218 - v22*s219))
    s343 = s299 + s297 - s298
    s344 = s302 + s300 - s301
    s345 = s305 + s303 - s304
    s346 = s275 - s273
    s347 = v27*v28
    s348 = 0.0825*s101
    s349 = 0.0825*s172
    s350 = 0.0825*s240
    s351 = 0.0825*s316
    s352 = 0.5*v3
    s353 = 0.5*v10
    s354 = 0.5*v17
    s355 = 0.5*v21
    s356 = 0.5*v28
    s357 = 1.0/(s16*s53 + s14*s22)
    s358 = s53*s357
    s359 = s52*s357
    s360 = s120*s357
    s361 = s16*s357
    s362 = s37 + s37
    s363 = s38 + s38
    s364 = s39 + s39
    s365 = s306 + s306
    s366 = s309 + s309
    s367 = s307 + s307
    s368 = s310 + s310
    s369 = s308 + s308
    s370 = s311 + s311
    s371 = s91 + s91
    s372 = s94 + s94
    s373 = s92 + s92
    s374 = s95 + s95
    s375 = s91*s362 + s92*s363 + s93*s364
    s376 = s91*s94 + s92*s95 + s93*s96
    s377 = s93 + s93
    s378 = s96 + s96
    s379 = 1.0/(s117*s124 + s115*(s122 - s123))
    s380 = s124*s379
    s381 = s115*s379
    s382 = (s123 - s122)*s379
    s383 = s117*s379
    s384 = s121*s381
    s385 = s121*s383
    s386 = 0.0016666666666666668*s385
    s387 = (0.08416666666666667 + s91*s91 + s92*s92 + s93*s93)*s384 - s375
    s388 = 0.08416666666666667 + s37*s37 + s38*s38 + s39*s39 + s362*s362 + s363*s363 + s364*s364 + s384*s387 + s385*s386
    s389 = s362 - s371*s384
    s390 = s363 - s373*s384
    s391 = s364 - s377*s384
    s392 = s181*s385 - s188*s384
    s393 = s179*s384
    s394 = s163 + s163
    s395 = s164 + s164
    s396 = s163*s389 + s164*s390 + s165*s391
    s397 = s163*s372 + s164*s374 + s165*s378
    s398 = s160*s163 + s161*s164 + s162*s165
    s399 = 0.08416666666666667 + s163*s163 + s164*s164 + s165*s165
    s400 = s165 + s165
    s401 = s237 + s237
    s402 = s238 + s238
    s403 = s234*s237 + s235*s238 + s236*s239
    s404 = s234*s365 + s235*s367 + s236*s369
    s405 = 0.08416666666666667 + s237*s237 + s238*s238 + s239*s239
    s406 = s237*s365 + s238*s367 + s239*s369
    s407 = s237*s366 + s238*s368 + s239*s370
    s408 = s239 + s239
    s409 = 0.08416666666666667 + s306*s306 + s307*s307 + s308*s308 + s365*s365 + s367*s367 + s369*s369
    s410 = s306*s309 + s307*s310 + s308*s311 + s365*s366 + s367*s368 + s369*s370
    s411 = 0.08416666666666667 + s309*s309 + s310*s310 + s311*s311 + s366*s366 + s368*s368 + s370*s370
    s412 = 1.0/(s185*s192 - s184*s193)
    s413 = s193*s412
    s414 = s185*s412
    s415 = s192*s412
    s416 = s184*s412
    s417 = s392*s413 - s393*s414
    s418 = s393*s416 - s392*s415
    s419 = s191*s414
    s420 = s191*s416
    s421 = 0.0016666666666666668*s418
    s422 = s396 + s399*s417
    s423 = s376*s384 - (s94*s362 + s95*s363 + s96*s364) - s372*s389 - s374*s390 - s378*s391 + s419*s422 - s420*s421
    s424 = s251*s417 + s254*s418
    s425 = s250*s417
    s426 = 0.08416666666666667 + s94*s94 + s95*s95 + s96*s96 + s372*s372 + s374*s374 + s378*s378 + s419*(s399*s419 - s397) + s420*(0.0016666666666666668*s420)
    s427 = s251*s419 - s254*s420
    s428 = s250*s419
    s429 = 1.0/(s258*s264 - s255*s265)
    s430 = s265*s429
    s431 = s258*s429
    s432 = s264*s429
    s433 = s255*s429
    s434 = s424*s430 - s425*s431
    s435 = s425*s433 - s424*s432
    s436 = s427*s430 - s428*s431
    s437 = s428*s433 - s427*s432
    s438 = s263*s431
    s439 = s263*s433
    s440 = 0.0016666666666666668*s434
    s441 = s405*s435
    s442 = 0.0016666666666666668*s436
    s443 = s405*s437
    s444 = s388 - s375*s384 + s389*s389 + s390*s390 + s391*s391 + s417*s422 + s418*s421 + s396*s417 + s434*s440 + s435*s441
    s445 = s406*s435
    s446 = s327*s434 + s328*s435
    s447 = s325*s435
    s448 = s406*s437
    s449 = s327*s436 + s328*s437
    s450 = s325*s437
    s451 = 0.08416666666666667 + s160*s160 + s161*s161 + s162*s162 + s438*(0.0016666666666666668*s438) + s439*(s405*s439)
    s452 = s406*s439
    s453 = s327*s438 - s328*s439
    s454 = s325*s439
    s455 = 1.0/(s333*s339 + s330*(s337 - s338))
    s456 = s339*s455
    s457 = s330*s455
    s458 = (s338 - s337)*s455
    s459 = s333*s455
    s460 = s446*s456 - s447*s457
    s461 = s446*s458 - s447*s459
    s462 = s449*s456 - s450*s457
    s463 = s449*s458 - s450*s459
    s464 = s453*s456 + s454*s457
    s465 = s453*s458 + s454*s459
    s466 = s336*s457
    s467 = s336*s459
    s468 = 0.0016666666666666668*s461
    s469 = s409*s460 - s445
    s470 = 0.0016666666666666668*s463
    s471 = s409*s462 - s448
    s472 = 0.0016666666666666668*s465
    s473 = s452 + s409*s464
    s474 = s160*s389 + s161*s390 + s162*s391 + s398*s417 + s438*s440 - s439*s441 + s464*s469 + s465*s468
    s475 = s410*s460 - s407*s435
    s476 = s284*s460 + s346*s461
    s477 = s285*s460
    s478 = s398*s419 - (s160*s372 + s161*s374 + s162*s378) + s438*s442 - s439*s443 + s464*s471 + s465*s470
    s479 = s410*s462 - s407*s437
    s480 = s284*s462 + s346*s463
    s481 = s285*s462
    s482 = s407*s439 + s410*s464
    s483 = s284*s464 + s346*s465
    s484 = s285*s464
    s485 = 0.08416666666666667 + s234*s234 + s235*s235 + s236*s236 + s466*(s409*s466 - s404) + s467*(0.0016666666666666668*s467)
    s486 = s410*s466 - (s234*s366 + s235*s368 + s236*s370)
    s487 = s284*s466 + s346*s467
    s488 = s285*s466
    s489 = mask_28 + s476*(s476*gauge_4) + s480*(s480*gauge_11) + s483*(s483*gauge_15) + s487*(s487*gauge_22)
    s490 = s346*(s346*gauge_29)
    s491 = s477*(s477*gauge_4) + s481*(s481*gauge_11) + s484*(s484*gauge_15) + s488*(s488*gauge_22) + s490
    s492 = 1.0/s411
    s493 = s475*s492
    s494 = s479*s492
    s495 = s482*s492
    s496 = s486*s492
    s497 = s366*s492
    s498 = s368*s492
    s499 = s370*s492
    s500 = s346*s492
    s501 = s423 - s397*s417 + s436*s440 + s437*s441 + s462*s469 + s463*s468 - s448*s460 - s479*s493
    s502 = s474 + s452*s460 - s482*s493
    s503 = s403*s435 + s466*s469 + s467*s468 - s404*s460 - s486*s493
    s504 = s389 + s394*s417 - s401*s435 + s365*s460 - s366*s493
    s505 = s390 + s395*s417 - s402*s435 + s367*s460 - s368*s493
    s506 = s391 + s400*s417 - s408*s435 + s369*s460 - s370*s493
    s507 = s477 + s346*s493
    s508 = 1.0/(s444 + s460*s469 + s461*s468 - s445*s460 - s475*s493)
    s509 = s501*s508
    s510 = s502*s508
    s511 = s503*s508
    s512 = s504*s508
    s513 = s505*s508
    s514 = s506*s508
    s515 = s476*s508
    s516 = s507*s508
    s517 = s426 - s397*s419 + s436*s442 + s437*s443 + s462*s471 + s463*s470 - s448*s462 - s479*s494 - s501*s509
    s518 = s478 + s452*s462 - s482*s494 - s502*s509
    s519 = s403*s437 + s466*s471 + s467*s470 - s404*s462 - s486*s494 - s503*s509
    s520 = s394*s419 - s372 - s401*s437 + s365*s462 - s366*s494 - s504*s509
    s521 = s395*s419 - s374 - s402*s437 + s367*s462 - s368*s494 - s505*s509
    s522 = s400*s419 - s378 - s408*s437 + s369*s462 - s370*s494 - s506*s509
    s523 = s476*s509 - s480
    s524 = s507*s509 - (s481 + s346*s494)
    s525 = 1.0/s517
    s526 = s518*s525
    s527 = s519*s525
    s528 = s520*s525
    s529 = s521*s525
    s530 = s522*s525
    s531 = s523*s525
    s532 = s524*s525
    s533 = s466*s473 + s467*s472 - s403*s439 - s404*s464 - s486*s495 - s503*s510 - s519*s526
    s534 = s160 + s160 + s401*s439 + s365*s464 - s366*s495 - s504*s510 - s520*s526
    s535 = s161 + s161 + s402*s439 + s367*s464 - s368*s495 - s505*s510 - s521*s526
    s536 = s162 + s162 + s408*s439 + s369*s464 - s370*s495 - s506*s510 - s522*s526
    s537 = s476*s510 - s483 - s523*s526
    s538 = s507*s510 - (s484 + s346*s495) - s524*s526
    s539 = 1.0/(s451 + s464*s473 + s465*s472 + s452*s464 - s482*s495 - s502*s510 - s518*s526)
    s540 = s533*s539
    s541 = s534*s539
    s542 = s535*s539
    s543 = s536*s539
    s544 = s537*s539
    s545 = s538*s539
    s546 = s365*s466 - (s234 + s234) - s366*s496 - s504*s511 - s520*s527 - s534*s540
    s547 = s367*s466 - (s235 + s235) - s368*s496 - s505*s511 - s521*s527 - s535*s540
    s548 = s369*s466 - (s236 + s236) - s370*s496 - s506*s511 - s522*s527 - s536*s540
    s549 = s476*s511 - s487 - s523*s527 - s537*s540
    s550 = s507*s511 - (s488 + s346*s496) - s524*s527 - s538*s540
    s551 = 1.0/(s485 - s404*s466 - s486*s496 - s503*s511 - s519*s527 - s533*s540)
    s552 = s546*s551
    s553 = s547*s551
    s554 = s548*s551
    s555 = s549*s551
    s556 = s550*s551
    s557 = s368*s497 + s505*s512 + s521*s528 + s535*s541 + s547*s552
    s558 = s370*s497 + s506*s512 + s522*s528 + s536*s541 + s548*s552
    s559 = s476*s512 - s523*s528 - s537*s541 - s549*s552
    s560 = s507*s512 - s346*s497 - s524*s528 - s538*s541 - s550*s552
    s561 = s368*s498 + s505*s513 + s521*s529 + s535*s542 + s547*s553
    s562 = s370*s499 + s506*s514 + s522*s530 + s536*s543 + s548*s554
    s563 = s476*s515 + s523*s531 + s537*s544 + s549*s555
    s564 = s346*s500 + s507*s516 + s524*s532 + s538*s545 + s550*s556
    s565 = mask_15 + s366*s497 + s504*s512 + s520*s528 + s534*s541 + s546*s552
    s566 = 1.0/s565
    s567 = s557*s566
    s568 = s558*s566
    s569 = s559*s566
    s570 = s560*s566
    s571 = s558*s567 - (s370*s498 + s506*s513 + s522*s529 + s536*s542 + s548*s553)
    s572 = s476*s513 - s523*s529 - s537*s542 - s549*s553 - s559*s567
    s573 = s507*s513 - s346*s498 - s524*s529 - s538*s542 - s550*s553 - s560*s567
    s574 = mask_16 + s561 - s557*s567
    s575 = 1.0/s574
    s576 = s571*s575
    s577 = s572*s575
    s578 = s573*s575
    s579 = s476*s514 - s523*s530 - s537*s543 - s549*s554 - s559*s568 + s572*s576
    s580 = s507*s514 - s346*s499 - s524*s530 - s538*s543 - s550*s554 - s560*s568 + s573*s576
    s581 = mask_17 - (s558*s568 - s562 + s571*s576)
    s582 = 1.0/s581
    s583 = s579*s582
    s584 = s580*s582
    s585 = s560*s569 - (s507*s515 + s524*s531 + s538*s544 + s550*s555) + s573*s577 + s580*s583
    s586 = mask_28 - (s559*s569 - s563 + s572*s577 + s579*s583)
    s587 = 1.0/s586
    s588 = s585*s587
    s589 = mask_29 - (s560*s570 - s564 + s573*s578 + s580*s584 + s585*s588)
    s590 = s51*s359 - s50*s358
    s591 = s50*s360 + s51*s361
    s592 = s40*s591
    s593 = s41*s591
    s594 = s42*s591
    s595 = s98 - s593
    s596 = s116 + s105*(2.0*(v3*s19 - v5*s17)) + s106*(2.0*(v3*s22 - v5*s20)) - (s113*s591 - s112*s590)
    s597 = s110*s591
    s598 = s597 - s127
    s599 = s592 - s43
    s600 = s593 - s44
    s601 = s594 - s45
    s602 = s312 + s343
    s603 = s344 + -9.81
    s604 = s313 + s344
    s605 = s314 + s345
    s606 = s599 - (s97 - s592)
    s607 = -9.81 - (s595 - s600)
    s608 = s167 - (s600 - s595)
    s609 = s601 - (s99 - s594)
    s610 = 0.0825*s119 - s37*s599 - s38*(-9.81 - (s44 - s593)) - s39*s601 - s362*s606 - s363*s607 - s364*s609
    s611 = s380*s596
    s612 = s611 + s381*s598
    s613 = s382*s596
    s614 = s613 + s383*s598
    s615 = s373*s612
    s616 = s187 - (s188*s612 - s181*s614)
    s617 = s196 + s179*s612
    s618 = s371*s612 - (s166 - s606)
    s619 = -9.81 - (s608 - s615)
    s620 = s610 + s384*(s348 + s91*s606 + s92*s607 + s93*s609) + s387*s612 + s386*s614 - s389*s618 - s390*s619
    s621 = s377*s612 - (s168 - s609)
    s622 = 0.0825*s189 + s94*s606 + s95*s607 + s96*s609 + s376*s612 + s372*s618 + s374*s619 + s378*s621
    s623 = -9.81 + s604
    s624 = s413*s616 - s414*s617
    s625 = s416*s617 - s415*s616
    s626 = 0.0016666666666666668*s625
    s627 = s163*s618 - s349 + s164*s619 + s165*s621 - s399*s624
    s628 = s260 + s251*s624 + s254*s625
    s629 = s268 + s250*s624
    s630 = s430*s628 - s431*s629
    s631 = s433*s629 - s432*s628
    s632 = 0.0016666666666666668*s630
    s633 = s237*s602 - s350 + s238*s623 + s239*s605 - s405*s631
    s634 = 0.0825*s347 + s309*s343 + s310*s603 + s311*s345 + s366*s602 + s368*s623 + s370*s605 - s407*s631
    s635 = s332 + s327*s630 + s328*s631
    s636 = s342 + s325*s631
    s637 = s456*s635 - s457*s636
    s638 = s458*s635 - s459*s636
    s639 = 0.0016666666666666668*s638
    s640 = s406*s631 - (s351 + s306*s343 + s307*s603 + s308*s345 + s365*s602 + s367*s623 + s369*s605) - s409*s637
    s641 = s620 - s391*s621 - (s417*s627 - s418*s626) + s396*s624 - (s435*s633 - s434*s632) - (s460*s640 - s461*s639)
    s642 = s622 - (s419*s627 + s420*s626) - s397*s624 - (s437*s633 - s436*s632) - (s462*s640 - s463*s639)
    s643 = 0.0825*s261 - s160*s618 - s161*s619 - s162*s621 + s398*s624 + s438*s632 + s439*s633 - (s464*s640 - s465*s639)
    s644 = 0.0825*s335 - s234*s602 - s235*s623 - s236*s605 + s403*s631 - (s466*s640 - s467*s639) - s404*s637
    s645 = s634 + s410*s637
    s646 = s604 + s156 - s157 - (s229 - s228 + s230) - (s615 - s608) + s395*s624 - s402*s631 + s367*s637
    s647 = s641 - s445*s637 - s493*s645
    s648 = s602 + s154 - s155 - (s226 - s225 + s227) - s618 + s394*s624 - s401*s631 + s365*s637 - s497*s645
    s649 = s605 + s158 - s159 - (s232 - s231 + s233) - s621 + s400*s624 - s408*s631 + s369*s637 - s499*s645
    s650 = s642 - s448*s637 - s494*s645 - s509*s647
    s651 = s643 + s452*s637 - s495*s645 - s510*s647 - s526*s650
    s652 = s516*s647 - (s283*s347 - s284*(s317 + v29*v29) + s285*s316 + s285*s637 + s500*s645) - s532*s650
    s653 = s644 - s496*s645 - s511*s647 - s527*s650 - s540*s651
    s654 = s648 - s512*s647 - s528*s650 - s541*s651 - s552*s653
    s655 = s646 - s498*s645 - s513*s647 - s529*s650 - s542*s651 - s553*s653 - s567*s654
    s656 = s649 - s514*s647 - s530*s650 - s543*s651 - s554*s653 - s568*s654 + s576*s655
    s657 = s322 - (s284*s637 + s346*s638) + s515*s647 - s531*s650 - s544*s651 - s555*s653 + s569*s654 + s577*s655
    s658 = s657 + s583*s656
    s659 = 1.0/s589*(s652 - s545*s651 - s556*s653 + s570*s654 + s578*s655 + s584*s656 + s588*s658)
    s660 = s587*s658 + s588*s659
    s661 = s582*s656 + s583*s660 + s584*s659
    s662 = s575*s655 + s576*s661 + s577*s660 + s578*s659
    s663 = s567*s662 - s566*s654 + s568*s661 - s569*s660
    s664 = s570*s659
    s665 = s663 - s664
    s666 = s551*s653 - s552*s665 + s553*s662 + s554*s661 + s555*s660 + s556*s659
    s667 = s539*s651 - s540*s666 - s541*s665 + s542*s662 + s543*s661 + s544*s660 + s545*s659
    s668 = s525*s650 - s526*s667 - s527*s666 - s528*s665 + s529*s662 + s530*s661 + s531*s660 + s532*s659
    s669 = s508*s647 - s509*s668 - s510*s667 - s511*s666 - s512*s665 + s513*s662 + s514*s661 - s515*s660
    s670 = s669 - s516*s659
    s671 = s492*s645 - s493*s670 - s494*s668 - s495*s667 - s496*s666 - s497*s665 + s498*s662 + s499*s661
    s672 = s671 + s500*s659
    s673 = s37*s670
    s674 = s592 + s673
    s675 = s43 - s674
    s676 = s38*s670
    s677 = s593 + s676
    s678 = s44 - s677
    s679 = s39*s670
    s680 = s594 + s679
    s681 = s45 - s680
    s682 = s127 + s121*s670 - s597
    s683 = s611 - s381*s682
    s684 = s613 - s383*s682
    s685 = s187 - (s188*s683 - s181*s684)
    s686 = s196 + s179*s683 + s191*s668
    s687 = s413*s685 - s414*s686
    s688 = s416*s686 - s415*s685
    s689 = s260 + s251*s687 + s254*s688
    s690 = s268 + s263*s667 + s250*s687
    s691 = s430*s689 - s431*s690
    s692 = s433*s690 - s432*s689
    s693 = s332 + s327*s691 + s328*s692
    s694 = s342 + s336*s666 + s325*s692
    s695 = s456*s693 - s457*s694
    s696 = s458*s693 - s459*s694
    s697 = s306*s695
    s698 = s309*s672
    s699 = s698 - s697 - s343
    s700 = s307*s695
    s701 = s310*s672
    s702 = s701 - s700 - s344
    s703 = s308*s695
    s704 = s311*s672
    s705 = s704 - s703 - s345
    s706 = s91*s683
    s707 = s94*s668
    s708 = s592 + s673 + s674 - s43 + s706 - s707
    s709 = s97 - s708
    s710 = s92*s683
    s711 = s95*s668
    s712 = s593 + s676 + s677 - s44 + s710 - s711
    s713 = s98 - s712
    s714 = s93*s683
    s715 = s96*s668
    s716 = s594 + s679 + s680 - s45 + s714 - s715
    s717 = s99 - s716
    s718 = s166 - (s706 + s708 - s97 - s707 + s160*s667 - s163*s687)
    s719 = s167 - (s710 + s712 - s98 - s711 + s161*s667 - s164*s687)
    s720 = s168 - (s714 + s716 - s99 - s715 + s162*s667 - s165*s687)
    s721 = s698 + s699 + s237*s692 - s234*s666 - s697 - s312
    s722 = s701 + s702 + s238*s692 - s235*s666 - s700 - s313
    s723 = s704 + s705 + s239*s692 - s236*s666 - s703 - s314
    s724 = s718 + s664 - s663
    s725 = s662 + s719
    s726 = -9.81 - s725
    s727 = s661 + s720
    s728 = s665 + s721
    s729 = s722 - s662 - -9.81
    s730 = s723 - s661
    s731 = s699 + s728
    s732 = s702 + s729 - -9.81
    s733 = s705 + s730
    s734 = s709 + s724
    s735 = s713 + s725 - -9.81
    s736 = -9.81 - s735
    s737 = s717 + s727
    s738 = 0.08416666666666667*s695 - s306*s728 - s307*s729 - s308*s730 - s306*s731 - s307*s732 - s308*s733
    s739 = s351 + s738 - s284*s660 - s285*s659
    s740 = s346*s660 - 0.0016666666666666668*s696
    s741 = s458*s740 - s456*s739
    s742 = s459*s740 - s457*s739
    s743 = s675 + s734
    s744 = -9.81 - (s678 + s735 - -9.81)
    s745 = s681 + s737
    s746 = s327*s741 - 0.0016666666666666668*s691
    s747 = 0.08416666666666667*s692 + s237*s665 - s238*s662 - s239*s661 + s237*s728 + s238*s729 + s239*s730
    s748 = s350 + s747 - s328*s741 + s325*s742
    s749 = s430*s746 + s432*s748
    s750 = s431*s746 + s433*s748
    s751 = 0.08416666666666667*s687 + s163*s724 - s164*s726 + s165*s727 - s163*s665 + s164*s662 + s165*s661
    s752 = s349 + s751 - s251*s749 + s250*s750
    s753 = s254*s749 - 0.0016666666666666668*s688
    s754 = s413*s752 + s415*s753
    s755 = s414*s752 + s416*s753
    s756 = 0.08416666666666667*s683 - s91*s734 + s92*s736 - s93*s737 - s91*s724 + s92*s726 - s93*s727 - s188*s754
    s757 = s348 + s756 - s179*s755
    s758 = 0.0016666666666666668*s684 + s181*s754
    s759 = s380*s757 + s382*s758
    s760 = s381*s757 + s383*s758
    s761 = 0.0016666666666666668*s590 + s112*s759
    s762 = s40*s743 - 0.08416666666666667*s591 - s41*s744 + s42*s745 + s40*s734 - s41*s736 + s42*s737 + s113*s759
    s763 = 0.0825*s46 + s762 - s110*s760
    s764 = ((s489 < 1e-06*(s284*(s284*gauge_27) + s346*(s346*gauge_28))) | (mask_29 + s491 < 1e-06*(s490 + s285*(s285*gauge_27))))
    s765 = (((s764 | (s565 < 1e-06)) | (s574 < 1e-06*max(s561, 1.0))) | (s581 < 1e-06*max(s562, 1.0)))
    # outputs
    ydot[0] = v0  # rate of rod1.x
    ydot[1] = v1  # rate of rod1.y
    ydot[2] = v2  # rate of rod1.z
    ydot[3] = -(q4*s352 + q5*s24 + q6*s23)  # rate of rod1.e0
    ydot[4] = q3*s352 + q5*s23 - q6*s24  # rate of rod1.e1
    ydot[5] = q3*s24 + q6*s352 - q4*s23  # rate of rod1.e2
    ydot[6] = q3*s23 + q4*s24 - q5*s352  # rate of rod1.e3
    ydot[7] = v6  # rate of rod2.x
    ydot[8] = v7  # rate of rod2.y
    ydot[9] = v8  # rate of rod2.z
    ydot[10] = -(q11*s78 + q12*s353 + q13*s77)  # rate of rod2.e0
    ydot[11] = q10*s78 + q12*s77 - q13*s353  # rate of rod2.e1
    ydot[12] = q10*s353 + q13*s78 - q11*s77  # rate of rod2.e2
    ydot[13] = q10*s77 + q11*s353 - q12*s78  # rate of rod2.e3
    ydot[14] = v12  # rate of rod3.x
    ydot[15] = v13  # rate of rod3.y
    ydot[16] = v14  # rate of rod3.z
    ydot[17] = -(q18*s150 + q19*s149 + q20*s354)  # rate of rod3.e0
    ydot[18] = q17*s150 + q19*s354 - q20*s149  # rate of rod3.e1
    ydot[19] = q17*s149 + q20*s150 - q18*s354  # rate of rod3.e2
    ydot[20] = q17*s354 + q18*s149 - q19*s150  # rate of rod3.e3
    ydot[21] = v18  # rate of rod4.x
    ydot[22] = v19  # rate of rod4.y
    ydot[23] = v20  # rate of rod4.z
    ydot[24] = -(q25*s355 + q26*s221 + q27*s220)  # rate of rod4.e0
    ydot[25] = q24*s355 + q26*s220 - q27*s221  # rate of rod4.e1
    ydot[26] = q24*s221 + q27*s355 - q25*s220  # rate of rod4.e2
    ydot[27] = q24*s220 + q25*s221 - q26*s355  # rate of rod4.e3
    ydot[28] = v24  # rate of rod5.x
    ydot[29] = v25  # rate of rod5.y
    ydot[30] = v26  # rate of rod5.z
    ydot[31] = -(q32*s293 + q33*s356 + q34*s292)  # rate of rod5.e0
    ydot[32] = q31*s293 + q33*s292 - q34*s356  # rate of rod5.e1
    ydot[33] = q31*s356 + q34*s293 - q32*s292  # rate of rod5.e2
    ydot[34] = q31*s292 + q32*s356 - q33*s293  # rate of rod5.e3
    ydot[35] = s675  # rate of rod1.vx
    ydot[36] = s678  # rate of rod1.vy
    ydot[37] = s681  # rate of rod1.vz
    ydot[38] = s590  # rate of rod1.wx
    ydot[39] = s670  # rate of rod1.wy
    ydot[40] = -s591  # rate of rod1.wz
    ydot[41] = s709  # rate of rod2.vx
    ydot[42] = s713  # rate of rod2.vy
    ydot[43] = s717  # rate of rod2.vz
    ydot[44] = s683  # rate of rod2.wx
    ydot[45] = s684  # rate of rod2.wy
    ydot[46] = s668  # rate of rod2.wz
    ydot[47] = s718  # rate of rod3.vx
    ydot[48] = s719  # rate of rod3.vy
    ydot[49] = s720  # rate of rod3.vz
    ydot[50] = s667  # rate of rod3.wx
    ydot[51] = s687  # rate of rod3.wy
    ydot[52] = s688  # rate of rod3.wz
    ydot[53] = s721  # rate of rod4.vx
    ydot[54] = s722  # rate of rod4.vy
    ydot[55] = s723  # rate of rod4.vz
    ydot[56] = s691  # rate of rod4.wx
    ydot[57] = s666  # rate of rod4.wy
    ydot[58] = s692  # rate of rod4.wz
    ydot[59] = s699  # rate of rod5.vx
    ydot[60] = s702  # rate of rod5.vy
    ydot[61] = s705  # rate of rod5.vz
    ydot[62] = s695  # rate of rod5.wx
    ydot[63] = s696  # rate of rod5.wy
    ydot[64] = s672  # rate of rod5.wz
    ydot[65] = 0.0  # rate of work
    w[MULTIPLIERS] = -s743  # P0.x
    w[MULTIPLIERS + 1] = s744  # P0.y
    w[MULTIPLIERS + 2] = -s745  # P0.z
    w[MULTIPLIERS + 3] = s358*s761 + s360*s763  # P0.first
    w[MULTIPLIERS + 4] = s359*s761 - s361*s763  # P0.second
    w[MULTIPLIERS + 5] = -s734  # P1.x
    w[MULTIPLIERS + 6] = s736  # P1.y
    w[MULTIPLIERS + 7] = -s737  # P1.z
    w[MULTIPLIERS + 8] = -s759  # P1.first
    w[MULTIPLIERS + 9] = -s760  # P1.second
    w[MULTIPLIERS + 10] = -s724  # P2.x
    w[MULTIPLIERS + 11] = s726  # P2.y
    w[MULTIPLIERS + 12] = -s727  # P2.z
    w[MULTIPLIERS + 13] = -s754  # P2.first
    w[MULTIPLIERS + 14] = -s755  # P2.second
    w[MULTIPLIERS + 15] = s665  # P3.x
    w[MULTIPLIERS + 16] = -s662  # P3.y
    w[MULTIPLIERS + 17] = -s661  # P3.z
    w[MULTIPLIERS + 18] = s749  # P3.first
    w[MULTIPLIERS + 19] = s750  # P3.second
    w[MULTIPLIERS + 20] = s728  # P4.x
    w[MULTIPLIERS + 21] = s729  # P4.y
    w[MULTIPLIERS + 22] = s730  # P4.z
    w[MULTIPLIERS + 23] = s741  # P4.first
    w[MULTIPLIERS + 24] = s742  # P4.second
    w[MULTIPLIERS + 25] = s731  # P5.x
    w[MULTIPLIERS + 26] = s732  # P5.y
    w[MULTIPLIERS + 27] = s733  # P5.z
    w[MULTIPLIERS + 28] = -s660  # P5.first
    w[MULTIPLIERS + 29] = -s659  # P5.second
    return int(((s765 | (s586 < 1e-06*s563)) | (s589 < 1e-06*s564)))


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected but the length of Euler parameters."""
    changed = normalise(y)
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 2 * changed


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(30):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(30):
        w[MASK + i] = w[SAVED + i]
    iw[SUSPECTS] += 1
    if skipped == 0:
        iw[LIGHT] += 1
    return 0
