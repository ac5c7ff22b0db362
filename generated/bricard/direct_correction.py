"""Method `direct-correction` for model `bricard`. Emitted by symgen; do not edit.

Positions and velocities are projected after each step with the pseudoinverse of D.
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
Yu, Chen, Comput. Mech. 26 (2000) 52-57
digest fd3274b7e385658e1bb048363112e7da7c265e25ce2beed16a493807bb5250bb, format 3, templates a1bfe8da2fcb1eac
option solver = elimination
option weight = identity
option when = step
p[0] tolerance (default 1e-13)

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

from model import geometry, measure, move, normalise

MULTIPLIERS = 25  # sections of w
MASK = 55
SAVED = 85
RESIDUAL = 115
PIVOT = 175
CHANGE = 205
GAUGE = 265
JACOBIAN = 325
SMALLEST_PIVOT = 4  # numbers in w
LENGTH_SCALE = 6
POSITION_MEASURE = 8
SUSPECTS = 1  # counters in iw
LIGHT = 2
ITERATIONS = 3
FAILURES = 4
TOLERANCE = 0  # parameters of the method in p


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 0 operations."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 2758 operations."""
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
def spread(p, w):
    """The correction -D^+ times the section `residual`, of v, or of q by N: 1498 operations."""
    # inputs
    mask_15 = w[MASK + 15]  # P3.x
    mask_16 = w[MASK + 16]  # P3.y
    mask_17 = w[MASK + 17]  # P3.z
    mask_28 = w[MASK + 28]  # P5.first
    mask_29 = w[MASK + 29]  # P5.second
    residual_0 = w[RESIDUAL]  # P0.x
    residual_1 = w[RESIDUAL + 1]  # P0.y
    residual_2 = w[RESIDUAL + 2]  # P0.z
    residual_3 = w[RESIDUAL + 3]  # P0.first
    residual_4 = w[RESIDUAL + 4]  # P0.second
    residual_5 = w[RESIDUAL + 5]  # P1.x
    residual_6 = w[RESIDUAL + 6]  # P1.y
    residual_7 = w[RESIDUAL + 7]  # P1.z
    residual_8 = w[RESIDUAL + 8]  # P1.first
    residual_9 = w[RESIDUAL + 9]  # P1.second
    residual_10 = w[RESIDUAL + 10]  # P2.x
    residual_11 = w[RESIDUAL + 11]  # P2.y
    residual_12 = w[RESIDUAL + 12]  # P2.z
    residual_13 = w[RESIDUAL + 13]  # P2.first
    residual_14 = w[RESIDUAL + 14]  # P2.second
    residual_15 = w[RESIDUAL + 15]  # P3.x
    residual_16 = w[RESIDUAL + 16]  # P3.y
    residual_17 = w[RESIDUAL + 17]  # P3.z
    residual_18 = w[RESIDUAL + 18]  # P3.first
    residual_19 = w[RESIDUAL + 19]  # P3.second
    residual_20 = w[RESIDUAL + 20]  # P4.x
    residual_21 = w[RESIDUAL + 21]  # P4.y
    residual_22 = w[RESIDUAL + 22]  # P4.z
    residual_23 = w[RESIDUAL + 23]  # P4.first
    residual_24 = w[RESIDUAL + 24]  # P4.second
    residual_25 = w[RESIDUAL + 25]  # P5.x
    residual_26 = w[RESIDUAL + 26]  # P5.y
    residual_27 = w[RESIDUAL + 27]  # P5.z
    residual_28 = w[RESIDUAL + 28]  # P5.first
    residual_29 = w[RESIDUAL + 29]  # P5.second
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
    pivot_15 = w[PIVOT + 15]  # P3.x
    pivot_16 = w[PIVOT + 16]  # P3.y
    pivot_17 = w[PIVOT + 17]  # P3.z
    pivot_28 = w[PIVOT + 28]  # P5.first
    pivot_29 = w[PIVOT + 29]  # P5.second
    # intermediate terms
    s0 = 1.0/(jacobian_6*jacobian_9 - jacobian_7*jacobian_8)
    s1 = jacobian_0 + jacobian_10
    s2 = jacobian_2 + jacobian_14
    s3 = jacobian_4 + jacobian_18
    s4 = jacobian_72 + jacobian_90
    s5 = jacobian_73 + jacobian_91
    s6 = jacobian_76 + jacobian_92
    s7 = jacobian_77 + jacobian_93
    s8 = jacobian_80 + jacobian_94
    s9 = jacobian_81 + jacobian_95
    s10 = jacobian_12 + jacobian_30
    s11 = jacobian_13 + jacobian_31
    s12 = 1.0 + jacobian_0*jacobian_0 + jacobian_2*jacobian_2 + jacobian_4*jacobian_4 + s1*s1 + s2*s2
    s13 = jacobian_16 + jacobian_34
    s14 = jacobian_17 + jacobian_35
    s15 = jacobian_12*s1 + jacobian_16*s2 + jacobian_20*s3
    s16 = jacobian_12*jacobian_13 + jacobian_16*jacobian_17 + jacobian_20*jacobian_21
    s17 = jacobian_20 + jacobian_38
    s18 = jacobian_21 + jacobian_39
    s19 = 1.0/(jacobian_24*jacobian_29 - jacobian_25*jacobian_28)
    s20 = jacobian_25*s19
    s21 = jacobian_24*s19
    s22 = jacobian_26*s20
    s23 = jacobian_26*s21
    s24 = s15 + (1.0 + jacobian_12*jacobian_12 + jacobian_16*jacobian_16 + jacobian_20*jacobian_20)*s22
    s25 = s1 + s10*s22
    s26 = s2 + s13*s22
    s27 = s3 + s17*s22
    s28 = jacobian_42*s22 - jacobian_43*s23
    s29 = jacobian_46*s22
    s30 = 1.0 + jacobian_13*jacobian_13 + jacobian_17*jacobian_17 + jacobian_21*jacobian_21 + s11*s11
    s31 = jacobian_33 + jacobian_51
    s32 = jacobian_37 + jacobian_55
    s33 = jacobian_33*s25 + jacobian_37*s26 + jacobian_41*s27
    s34 = jacobian_33*s11 + jacobian_37*s14 + jacobian_41*s18
    s35 = jacobian_32*jacobian_33 + jacobian_36*jacobian_37 + jacobian_40*jacobian_41
    s36 = 1.0 + jacobian_33*jacobian_33 + jacobian_37*jacobian_37 + jacobian_41*jacobian_41
    s37 = jacobian_41 + jacobian_59
    s38 = jacobian_53 + jacobian_71
    s39 = jacobian_57 + jacobian_75
    s40 = 1.0 + jacobian_90*jacobian_90 + jacobian_92*jacobian_92 + jacobian_94*jacobian_94 + s4*s4 + s6*s6
    s41 = jacobian_90*jacobian_91 + jacobian_92*jacobian_93 + jacobian_94*jacobian_95 + s4*s5 + s6*s7
    s42 = 1.0 + jacobian_91*jacobian_91 + jacobian_93*jacobian_93 + jacobian_95*jacobian_95 + s5*s5 + s7*s7
    s43 = jacobian_70*jacobian_71 + jacobian_74*jacobian_75 + jacobian_78*jacobian_79
    s44 = jacobian_70*s4 + jacobian_74*s6 + jacobian_78*s8
    s45 = 1.0 + jacobian_71*jacobian_71 + jacobian_75*jacobian_75 + jacobian_79*jacobian_79
    s46 = jacobian_71*s4 + jacobian_75*s6 + jacobian_79*s8
    s47 = jacobian_71*s5 + jacobian_75*s7 + jacobian_79*s9
    s48 = jacobian_61 + jacobian_79
    s49 = s40 + s8*s8
    s50 = s41 + s8*s9
    s51 = 1.0/(jacobian_44*jacobian_49 - jacobian_45*jacobian_48)
    s52 = jacobian_49*s51
    s53 = jacobian_45*s51
    s54 = jacobian_48*s51
    s55 = jacobian_44*s51
    s56 = s28*s52 - s29*s53
    s57 = s29*s55 - s28*s54
    s58 = jacobian_47*s53
    s59 = jacobian_47*s55
    s60 = s36*s56 - s33
    s61 = s12 + s3*s3 + s22*s24 + s23*s23 + s15*s22 + s25*s25 + s26*s26 + s27*s27 + s56*s60 + s57*s57
    s62 = jacobian_13*s1 + jacobian_17*s2 + jacobian_21*s3 + s16*s22 + s11*s25 + s14*s26 + s18*s27 + s57*s59 - s58*s60
    s63 = jacobian_62*s56 + jacobian_63*s57
    s64 = jacobian_67*s56
    s65 = jacobian_62*s58 - jacobian_63*s59
    s66 = jacobian_67*s58
    s67 = 1.0/(jacobian_64*jacobian_69 - jacobian_65*jacobian_68)
    s68 = jacobian_69*s67
    s69 = jacobian_65*s67
    s70 = jacobian_68*s67
    s71 = jacobian_64*s67
    s72 = s64*s69 - s63*s68
    s73 = s63*s70 - s64*s71
    s74 = s65*s68 - s66*s69
    s75 = s66*s71 - s65*s70
    s76 = jacobian_66*s69
    s77 = jacobian_66*s71
    s78 = s45*s73
    s79 = s45*s75
    s80 = s46*s73
    s81 = jacobian_82*s72 + jacobian_83*s73
    s82 = jacobian_87*s73
    s83 = s46*s75
    s84 = jacobian_82*s74 + jacobian_83*s75
    s85 = jacobian_87*s75
    s86 = 1.0 + jacobian_32*jacobian_32 + jacobian_36*jacobian_36 + jacobian_40*jacobian_40 + s76*s76 + s77*(s45*s77)
    s87 = s46*s77
    s88 = jacobian_82*s76 - jacobian_83*s77
    s89 = jacobian_87*s77
    s90 = 1.0/(jacobian_84*jacobian_89 - jacobian_85*jacobian_88)
    s91 = jacobian_89*s90
    s92 = jacobian_85*s90
    s93 = jacobian_88*s90
    s94 = jacobian_84*s90
    s95 = s82*s92 - s81*s91
    s96 = s81*s93 - s82*s94
    s97 = s85*s92 - s84*s91
    s98 = s84*s93 - s85*s94
    s99 = s88*s91 + s89*s92
    s100 = s88*s93 + s89*s94
    s101 = jacobian_86*s92
    s102 = jacobian_86*s94
    s103 = s80 + s49*s95
    s104 = s83 + s49*s97
    s105 = s87 + s49*s99
    s106 = jacobian_32*s25 + jacobian_36*s26 + jacobian_40*s27 - s35*s56 + s77*s78 - s72*s76 + s99*s103 - s96*s100
    s107 = s47*s73 + s50*s95
    s108 = jacobian_96*s95 + jacobian_97*s96
    s109 = s30 + s14*s14 + s18*s18 + s58*(s34 + s36*s58) + s59*s59 + s34*s58 + s74*s74 + s75*s79 + s97*s104 + s98*s98
    s110 = jacobian_32*s11 + jacobian_36*s14 + jacobian_40*s18 + s35*s58 + s77*s79 - s74*s76 + s99*s104 - s98*s100
    s111 = s47*s75 + s50*s97
    s112 = s47*s77 + s50*s99
    s113 = 1.0 + jacobian_70*jacobian_70 + jacobian_74*jacobian_74 + jacobian_78*jacobian_78 + s101*(s44 + s49*s101) + s102*s102
    s114 = jacobian_70*s5 + jacobian_74*s7 + jacobian_78*s9 + s50*s101
    s115 = 1.0/(s42 + s9*s9)
    s116 = s107*s115
    s117 = s111*s115
    s118 = s112*s115
    s119 = s114*s115
    s120 = s5*s115
    s121 = s7*s115
    s122 = s9*s115
    s123 = jacobian_99*s115
    s124 = s62 - s34*s56 + s72*s74 + s75*s78 + s97*s103 + s96*s98 + s83*s95 - s111*s116
    s125 = s106 + s87*s95 - s112*s116
    s126 = s96*s102 - s101*s103 - s43*s73 - s44*s95 + s114*s116
    s127 = s25 - s31*s56 - s38*s73 - s4*s95 + s5*s116
    s128 = s26 - s32*s56 - s39*s73 - s6*s95 + s7*s116
    s129 = s27 - s37*s56 - s48*s73 - s8*s95 + s9*s116
    s130 = jacobian_99*s116 - jacobian_98*s95
    s131 = 1.0/(s61 - s33*s56 + s72*s72 + s73*s78 + s95*s103 + s96*s96 + s80*s95 - s107*s116)
    s132 = s124*s131
    s133 = s125*s131
    s134 = s126*s131
    s135 = s127*s131
    s136 = s128*s131
    s137 = s129*s131
    s138 = s108*s131
    s139 = s130*s131
    s140 = s110 + s87*s97 - s112*s117 - s125*s132
    s141 = s98*s102 - s101*s104 - s43*s75 - s44*s97 + s114*s117 - s126*s132
    s142 = s11 + s31*s58 - s38*s75 - s4*s97 + s5*s117 - s127*s132
    s143 = s14 + s32*s58 - s39*s75 - s6*s97 + s7*s117 - s128*s132
    s144 = s18 + s37*s58 - s48*s75 - s8*s97 + s9*s117 - s129*s132
    s145 = s108*s132 - (jacobian_96*s97 + jacobian_97*s98)
    s146 = jacobian_99*s117 - jacobian_98*s97 - s130*s132
    s147 = 1.0/(s109 + s83*s97 - s111*s117 - s124*s132)
    s148 = s140*s147
    s149 = s141*s147
    s150 = s142*s147
    s151 = s143*s147
    s152 = s144*s147
    s153 = s145*s147
    s154 = s146*s147
    s155 = s114*s118 - (s43*s77 + s101*s105 + s100*s102 + s44*s99) - s126*s133 - s141*s148
    s156 = jacobian_32 + jacobian_50 - s38*s77 - s4*s99 + s5*s118 - s127*s133 - s142*s148
    s157 = jacobian_36 + jacobian_54 - s39*s77 - s6*s99 + s7*s118 - s128*s133 - s143*s148
    s158 = jacobian_40 + jacobian_58 - s48*s77 - s8*s99 + s9*s118 - s129*s133 - s144*s148
    s159 = jacobian_97*s100 - jacobian_96*s99 + s108*s133 - s145*s148
    s160 = jacobian_99*s118 - jacobian_98*s99 - s130*s133 - s146*s148
    s161 = 1.0/(s86 + s99*s105 + s100*s100 + s87*s99 - s112*s118 - s125*s133 - s140*s148)
    s162 = s155*s161
    s163 = s156*s161
    s164 = s157*s161
    s165 = s158*s161
    s166 = s159*s161
    s167 = s160*s161
    s168 = jacobian_52 + jacobian_70 + s4*s101 - s5*s119 - s127*s134 - s142*s149 - s156*s162
    s169 = jacobian_56 + jacobian_74 + s6*s101 - s7*s119 - s128*s134 - s143*s149 - s157*s162
    s170 = jacobian_60 + jacobian_78 + s8*s101 - s9*s119 - s129*s134 - s144*s149 - s158*s162
    s171 = jacobian_96*s101 - jacobian_97*s102 + s108*s134 - s145*s149 - s159*s162
    s172 = jacobian_98*s101 - jacobian_99*s119 - s130*s134 - s146*s149 - s160*s162
    s173 = 1.0/(s113 + s44*s101 - s114*s119 - s126*s134 - s141*s149 - s155*s162)
    s174 = s168*s173
    s175 = s169*s173
    s176 = s170*s173
    s177 = s171*s173
    s178 = s172*s173
    s179 = s7*s120 + s128*s135 + s143*s150 + s157*s163 + s169*s174
    s180 = s9*s120 + s129*s135 + s144*s150 + s158*s163 + s170*s174
    s181 = s108*s135 - s145*s150 - s159*s163 - s171*s174
    s182 = jacobian_99*s120 + s130*s135 + s146*s150 + s160*s163 + s172*s174
    s183 = 1.0*(pivot_15 > mask_15 + 1e-12)/max(s5*s120 + s127*s135 + s142*s150 + s156*s163 + s168*s174, 1e-300)
    s184 = s179*s183
    s185 = s180*s183
    s186 = s181*s183
    s187 = s182*s183
    s188 = s180*s184 - (s9*s121 + s129*s136 + s144*s151 + s158*s164 + s170*s175)
    s189 = s108*s136 - s145*s151 - s159*s164 - s171*s175 - s181*s184
    s190 = s182*s184 - (jacobian_99*s121 + s130*s136 + s146*s151 + s160*s164 + s172*s175)
    s191 = 1.0*(pivot_16 > mask_16 + 1e-12)/max(s7*s121 + s128*s136 + s143*s151 + s157*s164 + s169*s175 - s179*s184, 1e-300)
    s192 = s188*s191
    s193 = s189*s191
    s194 = s190*s191
    s195 = s108*s137 - s145*s152 - s159*s165 - s171*s176 - s181*s185 + s189*s192
    s196 = s182*s185 - (jacobian_99*s122 + s130*s137 + s146*s152 + s160*s165 + s172*s176) + s190*s192
    s197 = max(-(s180*s185 - (s9*s122 + s129*s137 + s144*s152 + s158*s165 + s170*s176) + s188*s192), 1e-300)
    s198 = 1.0*(pivot_17 > mask_17 + 1e-12)/s197
    s199 = s195*s198
    s200 = s196*s198
    s201 = s130*s138 - s146*s153 - s160*s166 - s172*s177 - s182*s186 + s190*s193 + s196*s199
    s202 = s182*s187 - (jacobian_99*s123 + s130*s139 + s146*s154 + s160*s167 + s172*s178) + s190*s194 + s196*s200
    s203 = max(-(s181*s186 - (s108*s138 + s145*s153 + s159*s166 + s171*s177) + s189*s193 + s195*s199), 1e-300)
    s204 = 1.0*(pivot_28 > mask_28 + 1e-12)/s203
    s205 = s201*s204
    s206 = residual_4*(jacobian_7*s0) - residual_3*(jacobian_9*s0)
    s207 = residual_3*(jacobian_8*s0) - residual_4*(jacobian_6*s0)
    s208 = jacobian_1*s207
    s209 = residual_0 + s208
    s210 = jacobian_3*s207
    s211 = residual_1 + s210
    s212 = jacobian_5*s207
    s213 = residual_2 + s212
    s214 = jacobian_11*s207
    s215 = jacobian_15*s207
    s216 = jacobian_19*s207
    s217 = residual_8 + jacobian_22*s206 + jacobian_23*s207
    s218 = jacobian_27*s207
    s219 = residual_9 + s218
    s220 = s209 + residual_5 + s214
    s221 = s211 + residual_6 + s215
    s222 = s213 + residual_7 + s216
    s223 = residual_20 + residual_25
    s224 = residual_21 + residual_26
    s225 = residual_22 + residual_27
    s226 = jacobian_29*s19*s217
    s227 = s20*s219 - s226
    s228 = jacobian_28*s19*s217
    s229 = s228 - s21*s219
    s230 = jacobian_0*s209 + jacobian_2*s211 + jacobian_4*s213 + s1*s220 + s2*s221 + s3*s222 + s22*(jacobian_12*s220 + jacobian_16*s221 + jacobian_20*s222)
    s231 = residual_10 + s220 + s10*s227
    s232 = residual_11 + s221 + s13*s227
    s233 = residual_12 + s222 + s17*s227
    s234 = residual_13 + jacobian_42*s227 + jacobian_43*s229
    s235 = residual_14 + jacobian_46*s227
    s236 = jacobian_13*s220 + jacobian_17*s221 + jacobian_21*s222 + s16*s227 + s11*s231 + s14*s232 + s18*s233
    s237 = residual_25*jacobian_90 + residual_26*jacobian_92 + residual_27*jacobian_94 + s4*s223 + s6*s224
    s238 = residual_25*jacobian_91 + residual_26*jacobian_93 + residual_27*jacobian_95 + s5*s223 + s7*s224
    s239 = s53*s235 - s52*s234
    s240 = s54*s234
    s241 = s55*s235
    s242 = jacobian_33*s231 + jacobian_37*s232 + jacobian_41*s233 + s36*s239
    s243 = s241 - s240
    s244 = s23*s229 - s24*s227 - s230 - s25*s231 - s26*s232 - s27*s233 - (s57*s243 - s56*s242) - s33*s239
    s245 = residual_18 + jacobian_62*s239 + jacobian_63*(s240 - s241)
    s246 = residual_19 + jacobian_67*s239
    s247 = s68*s245
    s248 = s69*s246
    s249 = s70*s245 - s71*s246
    s250 = s247 - s248
    s251 = jacobian_71*s223 + jacobian_75*s224 + jacobian_79*s225 + s45*s249
    s252 = residual_23 + jacobian_82*(s248 - s247) + jacobian_83*s249
    s253 = residual_24 + jacobian_87*s249
    s254 = s92*s253 - s91*s252
    s255 = s93*s252
    s256 = s94*s253
    s257 = s237 + s8*s225 + s46*s249 + s49*s254
    s258 = s256 - s255
    s259 = s76*s250 + s77*s251 - (jacobian_32*s231 + jacobian_36*s232 + jacobian_40*s233 + s35*s239) + s99*s257 + s100*s258
    s260 = s83*s254 - (s236 + s58*s242 + s59*s243 + s34*s239 + s74*s250 - s75*s251 + s98*s258 - s97*s257)
    s261 = jacobian_70*s223 + jacobian_74*s224 + jacobian_78*s225 + s43*s249 + s101*s257 + s102*s258 + s44*s254
    s262 = s238 + s9*s225 + s47*s249 + s50*s254
    s263 = s244 - (s72*s250 - s73*s251) - (s96*s258 - s95*s257) + s80*s254 - s116*s262
    s264 = s260 - s117*s262 - s132*s263
    s265 = s259 + s87*s254 - s118*s262 - s133*s263 - s148*s264
    s266 = s120*s262 - (s223 + residual_15 + s231 + s31*s239 + s38*s249 + s4*s254) - s135*s263 - s150*s264
    s267 = s121*s262 - (s224 + residual_16 + s232 + s32*s239 + s39*s249 + s6*s254) - s136*s263 - s151*s264
    s268 = s122*s262 - (s225 + residual_17 + s233 + s37*s239 + s48*s249 + s8*s254) - s137*s263 - s152*s264
    s269 = s119*s262 - s261 - s134*s263 - s149*s264 - s162*s265
    s270 = s138*s263 - (residual_28 + jacobian_96*s254 + jacobian_97*(s255 - s256)) - s153*s264 - s166*s265
    s271 = s266 - s163*s265 - s174*s269
    s272 = s123*s262 - (residual_29 + jacobian_98*s254) - s139*s263 - s154*s264 - s167*s265 - s178*s269
    s273 = s267 - s164*s265 - s175*s269 - s184*s271
    s274 = s268 - s165*s265 - s176*s269 - s185*s271 + s192*s273
    s275 = s270 - s177*s269 + s186*s271 + s193*s273 + s199*s274
    s276 = 1.0*(pivot_29 > mask_29 + 1e-12)/max(-(s202 + s201*s205), 1e-300)*(s272 - s187*s271 + s194*s273 + s200*s274 + s205*s275)
    s277 = s204*s275 + s205*s276
    s278 = s198*s274 + s199*s277 + s200*s276
    s279 = s191*s273 + s192*s278 + s193*s277 + s194*s276
    s280 = s184*s279 - s183*s271 + s185*s278 - s186*s277 + s187*s276
    s281 = s173*s269 - s174*s280 + s175*s279 + s176*s278 + s177*s277 + s178*s276
    s282 = s161*s265 - s162*s281 - s163*s280 + s164*s279 + s165*s278 + s166*s277 + s167*s276
    s283 = s147*s264 - s148*s282 - s149*s281 - s150*s280 + s151*s279 + s152*s278 + s153*s277 + s154*s276
    s284 = s131*s263 - s132*s283 - s133*s282 - s134*s281 - s135*s280 + s136*s279 + s137*s278 - s138*s277
    s285 = s284 + s139*s276
    s286 = s116*s285 - s115*s262 + s117*s283 + s118*s282 - s119*s281 - s120*s280 + s121*s279 + s122*s278
    s287 = s286 + s123*s276
    s288 = residual_0 + s208 + jacobian_0*s285
    s289 = residual_1 + s210 + jacobian_2*s285
    s290 = residual_2 + s212 + jacobian_4*s285
    s291 = residual_9 + s218 + jacobian_26*s285
    s292 = s20*s291 - s226
    s293 = s228 - s21*s291
    s294 = residual_13 + jacobian_42*s292 + jacobian_43*s293
    s295 = residual_14 + jacobian_46*s292 + jacobian_47*s283
    s296 = s53*s295 - s52*s294
    s297 = s54*s294 - s55*s295
    s298 = residual_18 + jacobian_62*s296 + jacobian_63*s297
    s299 = residual_19 + jacobian_66*s282 + jacobian_67*s296
    s300 = s69*s299 - s68*s298
    s301 = s70*s298 - s71*s299
    s302 = residual_23 + jacobian_82*s300 + jacobian_83*s301
    s303 = residual_24 + jacobian_86*s281 + jacobian_87*s301
    s304 = s92*s303 - s91*s302
    s305 = residual_25 + jacobian_90*s304 + jacobian_91*s287
    s306 = residual_26 + jacobian_92*s304 + jacobian_93*s287
    s307 = residual_27 + jacobian_94*s304 + jacobian_95*s287
    s308 = residual_5 + s214 + s288 + jacobian_10*s285 + jacobian_12*s292 + jacobian_13*s283
    s309 = residual_6 + s215 + s289 + jacobian_14*s285 + jacobian_16*s292 + jacobian_17*s283
    s310 = residual_7 + s216 + s290 + jacobian_18*s285 + jacobian_20*s292 + jacobian_21*s283
    s311 = residual_10 + s308 + jacobian_30*s292 + jacobian_31*s283 + jacobian_32*s282 + jacobian_33*s296
    s312 = residual_11 + s309 + jacobian_34*s292 + jacobian_35*s283 + jacobian_36*s282 + jacobian_37*s296
    s313 = residual_12 + s310 + jacobian_38*s292 + jacobian_39*s283 + jacobian_40*s282 + jacobian_41*s296
    s314 = residual_20 + s305 + jacobian_70*s281 + jacobian_71*s301 + jacobian_72*s304 + jacobian_73*s287
    s315 = residual_21 + s306 + jacobian_74*s281 + jacobian_75*s301 + jacobian_76*s304 + jacobian_77*s287
    s316 = residual_22 + s307 + jacobian_78*s281 + jacobian_79*s301 + jacobian_80*s304 + jacobian_81*s287
    # outputs
    w[CHANGE] = -s288  # rod1.vx
    w[CHANGE + 1] = -s289  # rod1.vy
    w[CHANGE + 2] = -s290  # rod1.vz
    w[CHANGE + 3] = s206  # rod1.wx
    w[CHANGE + 4] = s285  # rod1.wy
    w[CHANGE + 5] = s207  # rod1.wz
    w[CHANGE + 6] = -s308  # rod2.vx
    w[CHANGE + 7] = -s309  # rod2.vy
    w[CHANGE + 8] = -s310  # rod2.vz
    w[CHANGE + 9] = s292  # rod2.wx
    w[CHANGE + 10] = s293  # rod2.wy
    w[CHANGE + 11] = s283  # rod2.wz
    w[CHANGE + 12] = -s311  # rod3.vx
    w[CHANGE + 13] = -s312  # rod3.vy
    w[CHANGE + 14] = -s313  # rod3.vz
    w[CHANGE + 15] = s282  # rod3.wx
    w[CHANGE + 16] = s296  # rod3.wy
    w[CHANGE + 17] = s297  # rod3.wz
    w[CHANGE + 18] = s314  # rod4.vx
    w[CHANGE + 19] = s315  # rod4.vy
    w[CHANGE + 20] = s316  # rod4.vz
    w[CHANGE + 21] = s300  # rod4.wx
    w[CHANGE + 22] = s281  # rod4.wy
    w[CHANGE + 23] = s301  # rod4.wz
    w[CHANGE + 24] = s305  # rod5.vx
    w[CHANGE + 25] = s306  # rod5.vy
    w[CHANGE + 26] = s307  # rod5.vz
    w[CHANGE + 27] = s304  # rod5.wx
    w[CHANGE + 28] = s93*s302 - s94*s303  # rod5.wy
    w[CHANGE + 29] = s287  # rod5.wz
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def drift(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left: 200 operations."""
    # inputs
    v0 = y[35]  # rod1.vx [m/s]
    v1 = y[36]  # rod1.vy [m/s]
    v2 = y[37]  # rod1.vz [m/s]
    v3 = y[38]  # rod1.wx [rad/s]
    v4 = y[39]  # rod1.wy [rad/s]
    v5 = y[40]  # rod1.wz [rad/s]
    v6 = y[41]  # rod2.vx [m/s]
    v7 = y[42]  # rod2.vy [m/s]
    v8 = y[43]  # rod2.vz [m/s]
    v9 = y[44]  # rod2.wx [rad/s]
    v10 = y[45]  # rod2.wy [rad/s]
    v11 = y[46]  # rod2.wz [rad/s]
    v12 = y[47]  # rod3.vx [m/s]
    v13 = y[48]  # rod3.vy [m/s]
    v14 = y[49]  # rod3.vz [m/s]
    v15 = y[50]  # rod3.wx [rad/s]
    v16 = y[51]  # rod3.wy [rad/s]
    v17 = y[52]  # rod3.wz [rad/s]
    v18 = y[53]  # rod4.vx [m/s]
    v19 = y[54]  # rod4.vy [m/s]
    v20 = y[55]  # rod4.vz [m/s]
    v21 = y[56]  # rod4.wx [rad/s]
    v22 = y[57]  # rod4.wy [rad/s]
    v23 = y[58]  # rod4.wz [rad/s]
    v24 = y[59]  # rod5.vx [m/s]
    v25 = y[60]  # rod5.vy [m/s]
    v26 = y[61]  # rod5.vz [m/s]
    v27 = y[62]  # rod5.wx [rad/s]
    v28 = y[63]  # rod5.wy [rad/s]
    v29 = y[64]  # rod5.wz [rad/s]
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
    # outputs
    w[RESIDUAL] = v0 + v4*jacobian_0 + v5*jacobian_1  # P0.x
    w[RESIDUAL + 1] = v1 + v4*jacobian_2 + v5*jacobian_3  # P0.y
    w[RESIDUAL + 2] = v2 + v4*jacobian_4 + v5*jacobian_5  # P0.z
    w[RESIDUAL + 3] = v3*jacobian_6 + v5*jacobian_7  # P0.first
    w[RESIDUAL + 4] = v3*jacobian_8 + v5*jacobian_9  # P0.second
    w[RESIDUAL + 5] = v6 + v4*jacobian_10 - v0 + v5*jacobian_11 + v9*jacobian_12 + v11*jacobian_13  # P1.x
    w[RESIDUAL + 6] = v7 + v4*jacobian_14 - v1 + v5*jacobian_15 + v9*jacobian_16 + v11*jacobian_17  # P1.y
    w[RESIDUAL + 7] = v8 + v4*jacobian_18 - v2 + v5*jacobian_19 + v9*jacobian_20 + v11*jacobian_21  # P1.z
    w[RESIDUAL + 8] = v3*jacobian_22 + v5*jacobian_23 + v9*jacobian_24 + v10*jacobian_25  # P1.first
    w[RESIDUAL + 9] = v4*jacobian_26 + v5*jacobian_27 + v9*jacobian_28 + v10*jacobian_29  # P1.second
    w[RESIDUAL + 10] = v12 + v9*jacobian_30 - v6 + v11*jacobian_31 + v15*jacobian_32 + v16*jacobian_33  # P2.x
    w[RESIDUAL + 11] = v13 + v9*jacobian_34 - v7 + v11*jacobian_35 + v15*jacobian_36 + v16*jacobian_37  # P2.y
    w[RESIDUAL + 12] = v14 + v9*jacobian_38 - v8 + v11*jacobian_39 + v15*jacobian_40 + v16*jacobian_41  # P2.z
    w[RESIDUAL + 13] = v9*jacobian_42 + v10*jacobian_43 + v16*jacobian_44 + v17*jacobian_45  # P2.first
    w[RESIDUAL + 14] = v9*jacobian_46 + v11*jacobian_47 + v16*jacobian_48 + v17*jacobian_49  # P2.second
    w[RESIDUAL + 15] = v18 + v15*jacobian_50 - v12 + v16*jacobian_51 + v22*jacobian_52 + v23*jacobian_53  # P3.x
    w[RESIDUAL + 16] = v19 + v15*jacobian_54 - v13 + v16*jacobian_55 + v22*jacobian_56 + v23*jacobian_57  # P3.y
    w[RESIDUAL + 17] = v20 + v15*jacobian_58 - v14 + v16*jacobian_59 + v22*jacobian_60 + v23*jacobian_61  # P3.z
    w[RESIDUAL + 18] = v16*jacobian_62 + v17*jacobian_63 + v21*jacobian_64 + v23*jacobian_65  # P3.first
    w[RESIDUAL + 19] = v15*jacobian_66 + v16*jacobian_67 + v21*jacobian_68 + v23*jacobian_69  # P3.second
    w[RESIDUAL + 20] = v24 + v22*jacobian_70 - v18 + v23*jacobian_71 + v27*jacobian_72 + v29*jacobian_73  # P4.x
    w[RESIDUAL + 21] = v25 + v22*jacobian_74 - v19 + v23*jacobian_75 + v27*jacobian_76 + v29*jacobian_77  # P4.y
    w[RESIDUAL + 22] = v26 + v22*jacobian_78 - v20 + v23*jacobian_79 + v27*jacobian_80 + v29*jacobian_81  # P4.z
    w[RESIDUAL + 23] = v21*jacobian_82 + v23*jacobian_83 + v27*jacobian_84 + v28*jacobian_85  # P4.first
    w[RESIDUAL + 24] = v22*jacobian_86 + v23*jacobian_87 + v27*jacobian_88 + v28*jacobian_89  # P4.second
    w[RESIDUAL + 25] = v27*jacobian_90 - v24 + v29*jacobian_91  # P5.x
    w[RESIDUAL + 26] = v27*jacobian_92 - v25 + v29*jacobian_93  # P5.y
    w[RESIDUAL + 27] = v27*jacobian_94 - v26 + v29*jacobian_95  # P5.z
    w[RESIDUAL + 28] = v27*jacobian_96 + v28*jacobian_97  # P5.first
    w[RESIDUAL + 29] = v27*jacobian_98 + v29*jacobian_99  # P5.second
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[TOLERANCE] * w[LENGTH_SCALE]
    last = math.inf
    bits = 2
    normalise(y)
    for round in range(15):
        geometry(t, y, p, w)
        violation = w[POSITION_MEASURE]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        # near a singular position what is left of a violation opens another way: no more than rounding may be left
        near = w[SMALLEST_PIVOT] < 1e-4
        closed = violation <= (0.01 * tolerance if near else tolerance) or stalled or round == 14
        if closed:
            drift(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(35, 65):
                y[j] += w[CHANGE - 35 + j]
            break
        move(y, w)
        last = violation
        iw[ITERATIONS] += 1
    if not violation <= 1e4 * tolerance:
        iw[FAILURES] += 1
        bits |= 1
    measure(t, y, p, w)
    return bits


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
