"""Method `lagrange` for model `spatial-slider-crank`. Emitted by symgen; do not edit.

Constraints at acceleration level only; violations grow with time.
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest c2100cf33b5a79dfbf6312decf2b60a90e5d16c871d4de291fc3b6621fc4eecf, format 3, templates a1bfe8da2fcb1eac
option solver = elimination

Constraints Phi(q, t) = 0, their rates D v = nu and D v' = gamma; M v' = f - D^T lambda; S = D M^-1 D^T.

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and counters iw. Once: `prepare` of the
model, `prepare`, and `accept` with the start. Then `rhs` gives the rate of a state, `confirm` where `rhs` returns 1,
and `accept` corrects and measures the state at the end of each step.

y[0]     crank.x [m]
y[1]     crank.y [m]
y[2]     crank.z [m]
y[3]     crank.e0 [1]
y[4]     crank.e1 [1]
y[5]     crank.e2 [1]
y[6]     crank.e3 [1]
y[7]     rod.x [m]
y[8]     rod.y [m]
y[9]     rod.z [m]
y[10]    rod.e0 [1]
y[11]    rod.e1 [1]
y[12]    rod.e2 [1]
y[13]    rod.e3 [1]
y[14]    slider.x [m]
y[15]    slider.y [m]
y[16]    slider.z [m]
y[17]    slider.e0 [1]
y[18]    slider.e1 [1]
y[19]    slider.e2 [1]
y[20]    slider.e3 [1]
y[21]    crank.vx [m/s]
y[22]    crank.vy [m/s]
y[23]    crank.vz [m/s]
y[24]    crank.wx [rad/s]
y[25]    crank.wy [rad/s]
y[26]    crank.wz [rad/s]
y[27]    rod.vx [m/s]
y[28]    rod.vy [m/s]
y[29]    rod.vz [m/s]
y[30]    rod.wx [rad/s]
y[31]    rod.wy [rad/s]
y[32]    rod.wz [rad/s]
y[33]    slider.vx [m/s]
y[34]    slider.vy [m/s]
y[35]    slider.vz [m/s]
y[36]    slider.wx [rad/s]
y[37]    slider.wy [rad/s]
y[38]    slider.wz [rad/s]
y[39]    work of forces without potential and of drivers [J]
row 0    A.x [m]
row 1    A.y [m]
row 2    A.z [m]
row 3    A.first [rad]
row 4    A.second [rad]
row 5    B.x [m]
row 6    B.y [m]
row 7    B.z [m]
row 8    C.x [m]
row 9    C.y [m]
row 10   C.z [m]
row 11   C.cross [rad]
row 12   guide.across1 [m]
row 13   guide.across2 [m]
row 14   guide.first [rad]
row 15   guide.second [rad]
row 16   guide.angle [rad]

w[0:19]     status: single numbers, named in this module where it uses them
w[19:22]    winding: turns of angles that are counted
w[22:39]    multipliers: Lagrange multipliers, one a row
w[39:56]    mask: inf at rows that depend on others, else 0
w[56:73]    saved: `mask` while `confirm` leaves out further rows
w[73:90]    residual: Phi after `geometry`, D v - nu after `measure`
w[90:107]   nu: right-hand side of D v = nu
w[107:124]  pivot: pivots of D G D^T over its diagonal: near 0 a row depends on others
w[124:142]  change: correction of velocities, or of positions, that `spread` leaves
w[142:160]  mass: diagonal of M
w[160:178]  gauge: diagonal of G, the metric in which rank is decided: 1, or 1/l^2 for a rotation of a body of length l
w[178:195]  row_weight: factors that make rows of different units comparable
w[195:233]  jacobian: entries of D that are not constant
"""

import math

from numba import njit

from model import geometry, measure, normalise

MULTIPLIERS = 22  # sections of w
MASK = 39
SAVED = 56
PIVOT = 107
GAUGE = 160
SUSPECTS = 1  # counters in iw
LIGHT = 2


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 0 operations."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a loop or a pivot of S is suspicious: 730 operations."""
    # inputs
    q3 = y[3]  # crank.e0 [1]
    q4 = y[4]  # crank.e1 [1]
    q5 = y[5]  # crank.e2 [1]
    q6 = y[6]  # crank.e3 [1]
    v0 = y[21]  # crank.vx [m/s]
    v1 = y[22]  # crank.vy [m/s]
    v2 = y[23]  # crank.vz [m/s]
    v3 = y[24]  # crank.wx [rad/s]
    v4 = y[25]  # crank.wy [rad/s]
    v5 = y[26]  # crank.wz [rad/s]
    q10 = y[10]  # rod.e0 [1]
    q11 = y[11]  # rod.e1 [1]
    q12 = y[12]  # rod.e2 [1]
    q13 = y[13]  # rod.e3 [1]
    v6 = y[27]  # rod.vx [m/s]
    v7 = y[28]  # rod.vy [m/s]
    v8 = y[29]  # rod.vz [m/s]
    v9 = y[30]  # rod.wx [rad/s]
    v10 = y[31]  # rod.wy [rad/s]
    v11 = y[32]  # rod.wz [rad/s]
    q17 = y[17]  # slider.e0 [1]
    q18 = y[18]  # slider.e1 [1]
    q19 = y[19]  # slider.e2 [1]
    q20 = y[20]  # slider.e3 [1]
    v12 = y[33]  # slider.vx [m/s]
    v13 = y[34]  # slider.vy [m/s]
    v14 = y[35]  # slider.vz [m/s]
    v15 = y[36]  # slider.wx [rad/s]
    v16 = y[37]  # slider.wy [rad/s]
    v17 = y[38]  # slider.wz [rad/s]
    mask_6 = w[MASK + 6]  # B.y
    mask_7 = w[MASK + 7]  # B.z
    mask_11 = w[MASK + 11]  # C.cross
    mask_16 = w[MASK + 16]  # guide.angle
    gauge_3 = w[GAUGE + 3]  # crank.wx
    gauge_9 = w[GAUGE + 9]  # rod.wx
    gauge_10 = w[GAUGE + 10]  # rod.wy
    gauge_11 = w[GAUGE + 11]  # rod.wz
    gauge_15 = w[GAUGE + 15]  # slider.wx
    gauge_16 = w[GAUGE + 16]  # slider.wy
    gauge_17 = w[GAUGE + 17]  # slider.wz
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
    s10 = 2.0*(q5*q6)
    s11 = 2.0*(q3*q4)
    s12 = s0 + s1 - (s2 + s3)
    s13 = s6 - s7
    s14 = s6 + s7
    s15 = s4 + s5
    s16 = s10 - s11
    s17 = s8 - s9
    s18 = s10 + s11
    s19 = s4 - s5
    s20 = 0.04*v4
    s21 = 0.04*v3
    s22 = v5*s21
    s23 = v5*s20
    s24 = v3*s21 + v4*s20
    s25 = 0.04*s13
    s26 = 0.04*s15
    s27 = 0.04*s18
    s28 = 0.04*s12
    s29 = 0.04*s14
    s30 = 0.04*s17
    s31 = s12*s22 + s13*s23 - (s8 + s9)*s24
    s32 = s14*s22 + s15*s23 - s16*s24
    s33 = s17*s22 + s18*s23 - s19*s24
    s34 = v4*v4 + v5*v5
    s35 = v3*v4
    s36 = v3*v5
    s37 = s15*s35 - s14*s34 + s16*s36
    s38 = s18*s35 - s17*s34 + s19*s36
    s39 = q10*q10
    s40 = q11*q11
    s41 = q12*q12
    s42 = q13*q13
    s43 = s39 + s40
    s44 = s39 - s40
    s45 = s41 + s42
    s46 = s41 - s42
    s47 = 2.0*(q11*q12)
    s48 = 2.0*(q10*q13)
    s49 = 2.0*(q11*q13)
    s50 = 2.0*(q10*q12)
    s51 = 2.0*(q12*q13)
    s52 = 2.0*(q10*q11)
    s53 = s43 - s45
    s54 = s47 - s48
    s55 = s49 + s50
    s56 = s47 + s48
    s57 = s44 + s46
    s58 = s51 - s52
    s59 = s49 - s50
    s60 = s51 + s52
    s61 = s44 - s46
    s62 = 0.15*v11
    s63 = 0.15*v10
    s64 = v10*s63 + v11*s62
    s65 = v9*s63
    s66 = v9*s62
    s67 = s53*s64
    s68 = s54*s65
    s69 = s55*s66
    s70 = s56*s64
    s71 = s57*s65
    s72 = s58*s66
    s73 = s59*s64
    s74 = s60*s65
    s75 = s61*s66
    s76 = 0.15*s55
    s77 = 0.15*s58
    s78 = 0.15*s61
    s79 = 0.15*s54
    s80 = 0.15*s57
    s81 = 0.15*s60
    s82 = s31 - (s67 - s68 - s69)
    s83 = q17*q17
    s84 = q18*q18
    s85 = q19*q19
    s86 = q20*q20
    s87 = s83 - s84
    s88 = s85 - s86
    s89 = 2.0*(q18*q19)
    s90 = 2.0*(q17*q20)
    s91 = 2.0*(q18*q20)
    s92 = 2.0*(q17*q19)
    s93 = 2.0*(q19*q20)
    s94 = 2.0*(q17*q18)
    s95 = s83 + s84 - (s85 + s86)
    s96 = s89 - s90
    s97 = s91 + s92
    s98 = s89 + s90
    s99 = s87 + s88
    s100 = s93 - s94
    s101 = s91 - s92
    s102 = s93 + s94
    s103 = s87 - s88
    s104 = s69 + s68 - s67
    s105 = s72 + s71 - s70
    s106 = s75 + s74 - s73
    s107 = v9*v10
    s108 = v11*v11 + v9*v9
    s109 = v10*v11
    s110 = v17*v17
    s111 = v16*v16 + s110
    s112 = v15*v16
    s113 = v15*v17
    s114 = s99*s112 - s98*s111 + s100*s113
    s115 = s102*s112 - s101*s111 + s103*s113
    s116 = s55*s95 + s58*s98 + s61*s101
    s117 = s95*(s45 - s43) - s56*s98 + s101*(s50 - s49)
    s118 = s94 - s93
    s119 = s57*s118 - s54*s97 + s60*(s88 - s87)
    s120 = s54*s96 + s57*s99 + s60*s102
    s121 = s54*(s96*s112 - s95*s111 + s97*s113) + s57*s114 + s60*s115 + s95*(s53*s107 - s54*s108 + s55*s109)
    s122 = s121 + s98*(s56*s107 - s57*s108 + s58*s109) + s101*(s59*s107 - s60*s108 + s61*s109) + (v17*s96 - v16*s97)*(2.0*(v9*s55 - v11*s53))
    s123 = s122 + (v17*s99 - v16*s100)*(2.0*(v9*s58 - v11*s56)) + (v17*s102 - v16*s103)*(2.0*(v9*s61 - v11*s59))
    s124 = s92 - s91
    s125 = 0.5*v3
    s126 = 0.5*v4
    s127 = 0.5*v5
    s128 = 0.5*v9
    s129 = 0.5*v10
    s130 = 0.5*v11
    s131 = 0.5*v15
    s132 = 0.5*v16
    s133 = 0.5*v17
    s134 = 1.0/(s15*s19 + s18*(s11 - s10))
    s135 = s15*s134
    s136 = s18*s134
    s137 = s16*s134
    s138 = s19*s134
    s139 = 1.0/(s99*s103 + s102*s118)
    s140 = s99*s139
    s141 = s102*s139
    s142 = s100*s139
    s143 = s103*s139
    s144 = s25 + s25
    s145 = s26 + s26
    s146 = s27 + s27
    s147 = 0.075*s58
    s148 = s77 + s77
    s149 = s80 + s80
    s150 = 0.075*s61
    s151 = s78 + s78
    s152 = s81 + s81
    s153 = 0.3*s55
    s154 = 0.3*s54
    s155 = s76*s153
    s156 = s79*s154
    s157 = 2.5*s144
    s158 = s153 + 0.375*s55
    s159 = s76*s157 + s144*s153
    s160 = s79*s157 + s144*s154
    s161 = s155 + 0.004 + s77*s147 + s78*s150 + s155 + s76*s158
    s162 = s80*s147 + s81*s150 + s79*s153 + s79*s158 + s76*s154
    s163 = s156 + 0.004 + s80*(0.075*s57) + s81*(0.075*s60) + s156 + s79*(s154 + 0.375*s54)
    s164 = s116*(s116*gauge_9)
    s165 = s103*(s103*gauge_15)
    s166 = 2500.0*s116
    s167 = 10000.0*s103
    s168 = s38*s135 - s37*s136
    s169 = s38*s137 - s37*s138
    s170 = s28*s168
    s171 = s31 + s170
    s172 = s29*s168
    s173 = s32 + s172
    s174 = s30*s168
    s175 = s33 + s174
    s176 = s115*s140 - s114*s141
    s177 = s115*s142 - s114*s143
    s178 = s171 + s82 + s170
    s179 = 0.5*s105
    s180 = s105 + s173 + s32 - (s70 - s71 - s72) + s172
    s181 = -4.905 + 0.5*s106
    s182 = s106 + s175 + s33 - (s73 - s74 - s75) + s174
    s183 = 2.0*s104
    s184 = s183 + 2.5*s178
    s185 = 0.0036*(v9*v11) + s77*s179 + s78*s181 + s76*s183 + s76*s184 + s153*s178
    s186 = 0.0036*s107 + s80*s179 + s81*s181 + s79*s183 + s79*s184 + s154*s178
    s187 = 1.0/(mask_16 + s103*s167)*(s101*s112 - s102*(s110 + v15*v15) + s103*(v16*v17) + s124*s177)
    s188 = 1e-05*s169
    s189 = s149*s151 - s148*s152
    s190 = 1.0/s189
    s191 = s152*s190
    s192 = s149*s190
    s193 = s151*s190
    s194 = s148*s190
    s195 = s146*s192 - s145*s191
    s196 = s146*s194 - s145*s193
    s197 = s161*s195 - s162*s196 - s159
    s198 = s160 + s163*s196 - s162*s195
    s199 = 0.0001 + s25*(0.0048*s13) + s26*(0.0048*s15) + s27*(0.0048*s18) + s144*s157 + s195*s197 + s196*s198
    s200 = s117*s196
    s201 = (s148*s148 + s151*s151)*(s149*s149 + s152*s152)
    s202 = (mask_11 + s164 + s200*(gauge_3*s200) < 1e-06*(s164 + s117*(s117*gauge_11) + s119*(s119*gauge_16) + s120*(s120*gauge_17)))
    s203 = 1.0/(s199 - (s159*s195 - s160*s196))
    s204 = s200*s203
    s205 = s182*s192 - s180*s191
    s206 = s182*s194 - s180*s193
    s207 = 9e-05*(v4*v5) + s25*(0.12*s171) + s26*(0.12*s173) - s27*(-1.1772 - 0.12*s175) + s144*s184 - (s185*s195 - s186*s196)
    s208 = s207 + s197*s205 + s198*s206
    s209 = 1.0/(mask_11 + s116*s166 + s200*s204)*(s204*s208 - (s123 + s119*s176 + s120*s177 + s117*s206))
    s210 = s203*s208 - s204*s209
    s211 = s205 - s195*s210
    s212 = s206 - s196*s210
    s213 = s185 - (s161*s211 - s162*s212) - s159*s210
    s214 = s160*s210 + s117*s209 - (s186 + s163*s212 - s162*s211)
    s215 = s191*s213 + s193*s214
    s216 = s192*s213 + s194*s214
    s217 = s25*s210
    s218 = s217 - s170
    s219 = s31 - s218
    s220 = s32 - (s26*s210 - s172)
    s221 = s33 - (s27*s210 - s174)
    s222 = s77*s211 - s80*s212 - s105
    s223 = s78*s211 - s81*s212 - s106
    s224 = s76*s211
    s225 = s79*s212
    s226 = s217 + s218 - s31 - s170 + s224 - s225
    s227 = s82 - s226
    s228 = s104 - (s224 + s226 - s82 - s225)
    s229 = s119*s209 - 0.0001*s176
    s230 = s124*s187 + 0.0001*s177 - s120*s209
    s231 = s215 + 0.12*s220
    s232 = -1.1772 - (0.12*s221 - s216)
    s233 = 0.5*s222
    s234 = s216 + 0.5*s223 - -4.905
    s235 = 2.0*s228
    s236 = s235 + 0.5*s227
    s237 = s236 + 0.12*s219
    s238 = 9e-05*s36 + 0.0001*s168 + s28*s237 + s29*s231 - s30*s232 + s28*s236 + s29*s215 - s30*s216
    s239 = (((s189*s189 <= 0.0001*s201 + mask_6 + mask_7) | (s201*(gauge_10*gauge_11) < 1e-12)) | s202)
    # outputs
    ydot[0] = v0  # rate of crank.x
    ydot[1] = v1  # rate of crank.y
    ydot[2] = v2  # rate of crank.z
    ydot[3] = -(q4*s125 + q5*s126 + q6*s127)  # rate of crank.e0
    ydot[4] = q3*s125 + q5*s127 - q6*s126  # rate of crank.e1
    ydot[5] = q3*s126 + q6*s125 - q4*s127  # rate of crank.e2
    ydot[6] = q3*s127 + q4*s126 - q5*s125  # rate of crank.e3
    ydot[7] = v6  # rate of rod.x
    ydot[8] = v7  # rate of rod.y
    ydot[9] = v8  # rate of rod.z
    ydot[10] = -(q11*s128 + q12*s129 + q13*s130)  # rate of rod.e0
    ydot[11] = q10*s128 + q12*s130 - q13*s129  # rate of rod.e1
    ydot[12] = q10*s129 + q13*s128 - q11*s130  # rate of rod.e2
    ydot[13] = q10*s130 + q11*s129 - q12*s128  # rate of rod.e3
    ydot[14] = v12  # rate of slider.x
    ydot[15] = v13  # rate of slider.y
    ydot[16] = v14  # rate of slider.z
    ydot[17] = -(q18*s131 + q19*s132 + q20*s133)  # rate of slider.e0
    ydot[18] = q17*s131 + q19*s133 - q20*s132  # rate of slider.e1
    ydot[19] = q17*s132 + q20*s131 - q18*s133  # rate of slider.e2
    ydot[20] = q17*s133 + q18*s132 - q19*s131  # rate of slider.e3
    ydot[21] = s219  # rate of crank.vx
    ydot[22] = s220  # rate of crank.vy
    ydot[23] = s221  # rate of crank.vz
    ydot[24] = s210  # rate of crank.wx
    ydot[25] = s168  # rate of crank.wy
    ydot[26] = s169  # rate of crank.wz
    ydot[27] = s227  # rate of rod.vx
    ydot[28] = s222  # rate of rod.vy
    ydot[29] = s223  # rate of rod.vz
    ydot[30] = s166*s209  # rate of rod.wx
    ydot[31] = s211  # rate of rod.wy
    ydot[32] = s212  # rate of rod.wz
    ydot[33] = s228  # rate of slider.vx
    ydot[34] = 0.0  # rate of slider.vy
    ydot[35] = 0.0  # rate of slider.vz
    ydot[36] = -s167*s187  # rate of slider.wx
    ydot[37] = s176  # rate of slider.wy
    ydot[38] = s177  # rate of slider.wz
    ydot[39] = 0.0  # rate of work
    w[MULTIPLIERS] = -s237  # A.x
    w[MULTIPLIERS + 1] = -s231  # A.y
    w[MULTIPLIERS + 2] = s232  # A.z
    w[MULTIPLIERS + 3] = -(s137*s188 + s135*s238)  # A.first
    w[MULTIPLIERS + 4] = -(s138*s188 + s136*s238)  # A.second
    w[MULTIPLIERS + 5] = -s236  # B.x
    w[MULTIPLIERS + 6] = -s215  # B.y
    w[MULTIPLIERS + 7] = s216  # B.z
    w[MULTIPLIERS + 8] = -s235  # C.x
    w[MULTIPLIERS + 9] = s233 - s215  # C.y
    w[MULTIPLIERS + 10] = s234  # C.z
    w[MULTIPLIERS + 11] = -s209  # C.cross
    w[MULTIPLIERS + 12] = s215 - s233  # guide.across1
    w[MULTIPLIERS + 13] = -19.62 - s234  # guide.across2
    w[MULTIPLIERS + 14] = s140*s229 - s142*s230  # guide.first
    w[MULTIPLIERS + 15] = s141*s229 - s143*s230  # guide.second
    w[MULTIPLIERS + 16] = s187  # guide.angle
    return int((s239 | (mask_16 + s165 < 1e-06*(s165 + s124*(s124*gauge_17)))))


@njit(error_model="numpy", fastmath={"contract"})
def rhs_by_pivots(t, y, p, w, iw, ydot):
    """The same with a pivot for each row of a loop, q', v', power and multipliers; 1 where a pivot of S is suspicious: 762 operations."""
    # inputs
    q3 = y[3]  # crank.e0 [1]
    q4 = y[4]  # crank.e1 [1]
    q5 = y[5]  # crank.e2 [1]
    q6 = y[6]  # crank.e3 [1]
    v0 = y[21]  # crank.vx [m/s]
    v1 = y[22]  # crank.vy [m/s]
    v2 = y[23]  # crank.vz [m/s]
    v3 = y[24]  # crank.wx [rad/s]
    v4 = y[25]  # crank.wy [rad/s]
    v5 = y[26]  # crank.wz [rad/s]
    q10 = y[10]  # rod.e0 [1]
    q11 = y[11]  # rod.e1 [1]
    q12 = y[12]  # rod.e2 [1]
    q13 = y[13]  # rod.e3 [1]
    v6 = y[27]  # rod.vx [m/s]
    v7 = y[28]  # rod.vy [m/s]
    v8 = y[29]  # rod.vz [m/s]
    v9 = y[30]  # rod.wx [rad/s]
    v10 = y[31]  # rod.wy [rad/s]
    v11 = y[32]  # rod.wz [rad/s]
    q17 = y[17]  # slider.e0 [1]
    q18 = y[18]  # slider.e1 [1]
    q19 = y[19]  # slider.e2 [1]
    q20 = y[20]  # slider.e3 [1]
    v12 = y[33]  # slider.vx [m/s]
    v13 = y[34]  # slider.vy [m/s]
    v14 = y[35]  # slider.vz [m/s]
    v15 = y[36]  # slider.wx [rad/s]
    v16 = y[37]  # slider.wy [rad/s]
    v17 = y[38]  # slider.wz [rad/s]
    mask_6 = w[MASK + 6]  # B.y
    mask_7 = w[MASK + 7]  # B.z
    mask_11 = w[MASK + 11]  # C.cross
    mask_16 = w[MASK + 16]  # guide.angle
    gauge_9 = w[GAUGE + 9]  # rod.wx
    gauge_11 = w[GAUGE + 11]  # rod.wz
    gauge_15 = w[GAUGE + 15]  # slider.wx
    gauge_16 = w[GAUGE + 16]  # slider.wy
    gauge_17 = w[GAUGE + 17]  # slider.wz
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
    s10 = 2.0*(q5*q6)
    s11 = 2.0*(q3*q4)
    s12 = s0 + s1 - (s2 + s3)
    s13 = s6 - s7
    s14 = s6 + s7
    s15 = s4 + s5
    s16 = s10 - s11
    s17 = s8 - s9
    s18 = s10 + s11
    s19 = s4 - s5
    s20 = 0.04*v4
    s21 = 0.04*v3
    s22 = v5*s21
    s23 = v5*s20
    s24 = v3*s21 + v4*s20
    s25 = 0.04*s13
    s26 = 0.04*s15
    s27 = 0.04*s18
    s28 = 0.04*s12
    s29 = 0.04*s14
    s30 = 0.04*s17
    s31 = s12*s22 + s13*s23 - (s8 + s9)*s24
    s32 = s14*s22 + s15*s23 - s16*s24
    s33 = s17*s22 + s18*s23 - s19*s24
    s34 = v4*v4 + v5*v5
    s35 = v3*v4
    s36 = v3*v5
    s37 = s15*s35 - s14*s34 + s16*s36
    s38 = s18*s35 - s17*s34 + s19*s36
    s39 = q10*q10
    s40 = q11*q11
    s41 = q12*q12
    s42 = q13*q13
    s43 = s39 + s40
    s44 = s39 - s40
    s45 = s41 + s42
    s46 = s41 - s42
    s47 = 2.0*(q11*q12)
    s48 = 2.0*(q10*q13)
    s49 = 2.0*(q11*q13)
    s50 = 2.0*(q10*q12)
    s51 = 2.0*(q12*q13)
    s52 = 2.0*(q10*q11)
    s53 = s43 - s45
    s54 = s47 - s48
    s55 = s49 + s50
    s56 = s47 + s48
    s57 = s44 + s46
    s58 = s51 - s52
    s59 = s49 - s50
    s60 = s51 + s52
    s61 = s44 - s46
    s62 = 0.15*v11
    s63 = 0.15*v10
    s64 = v10*s63 + v11*s62
    s65 = v9*s63
    s66 = v9*s62
    s67 = s53*s64
    s68 = s54*s65
    s69 = s55*s66
    s70 = s56*s64
    s71 = s57*s65
    s72 = s58*s66
    s73 = s59*s64
    s74 = s60*s65
    s75 = s61*s66
    s76 = 0.15*s55
    s77 = 0.15*s58
    s78 = 0.15*s61
    s79 = 0.15*s54
    s80 = 0.15*s57
    s81 = 0.15*s60
    s82 = s31 - (s67 - s68 - s69)
    s83 = q17*q17
    s84 = q18*q18
    s85 = q19*q19
    s86 = q20*q20
    s87 = s83 - s84
    s88 = s85 - s86
    s89 = 2.0*(q18*q19)
    s90 = 2.0*(q17*q20)
    s91 = 2.0*(q18*q20)
    s92 = 2.0*(q17*q19)
    s93 = 2.0*(q19*q20)
    s94 = 2.0*(q17*q18)
    s95 = s83 + s84 - (s85 + s86)
    s96 = s89 - s90
    s97 = s91 + s92
    s98 = s89 + s90
    s99 = s87 + s88
    s100 = s93 - s94
    s101 = s91 - s92
    s102 = s93 + s94
    s103 = s87 - s88
    s104 = s69 + s68 - s67
    s105 = s72 + s71 - s70
    s106 = s75 + s74 - s73
    s107 = v9*v10
    s108 = v11*v11 + v9*v9
    s109 = v10*v11
    s110 = v17*v17
    s111 = v16*v16 + s110
    s112 = v15*v16
    s113 = v15*v17
    s114 = s99*s112 - s98*s111 + s100*s113
    s115 = s102*s112 - s101*s111 + s103*s113
    s116 = s55*s95 + s58*s98 + s61*s101
    s117 = s95*(s45 - s43) - s56*s98 + s101*(s50 - s49)
    s118 = s94 - s93
    s119 = s57*s118 - s54*s97 + s60*(s88 - s87)
    s120 = s54*s96 + s57*s99 + s60*s102
    s121 = s54*(s96*s112 - s95*s111 + s97*s113) + s57*s114 + s60*s115 + s95*(s53*s107 - s54*s108 + s55*s109)
    s122 = s121 + s98*(s56*s107 - s57*s108 + s58*s109) + s101*(s59*s107 - s60*s108 + s61*s109) + (v17*s96 - v16*s97)*(2.0*(v9*s55 - v11*s53))
    s123 = s122 + (v17*s99 - v16*s100)*(2.0*(v9*s58 - v11*s56)) + (v17*s102 - v16*s103)*(2.0*(v9*s61 - v11*s59))
    s124 = s92 - s91
    s125 = 0.5*v3
    s126 = 0.5*v4
    s127 = 0.5*v5
    s128 = 0.5*v9
    s129 = 0.5*v10
    s130 = 0.5*v11
    s131 = 0.5*v15
    s132 = 0.5*v16
    s133 = 0.5*v17
    s134 = 1.0/(s15*s19 + s18*(s11 - s10))
    s135 = s15*s134
    s136 = s18*s134
    s137 = s16*s134
    s138 = s19*s134
    s139 = 1.0/(s99*s103 + s102*s118)
    s140 = s99*s139
    s141 = s102*s139
    s142 = s100*s139
    s143 = s103*s139
    s144 = s25 + s25
    s145 = s26 + s26
    s146 = s27 + s27
    s147 = 0.075*s58
    s148 = 0.075*s61
    s149 = 0.3*s55
    s150 = 0.3*s54
    s151 = s76*s149
    s152 = s79*s150
    s153 = 2.5*s144
    s154 = s149 + 0.375*s55
    s155 = s76*s153 + s144*s149
    s156 = s79*s153 + s144*s150
    s157 = s116*(s116*gauge_9) + s117*(s117*gauge_11)
    s158 = s103*(s103*gauge_15)
    s159 = 2500.0*s116
    s160 = 10000.0*s103
    s161 = 1.0/(0.0001 + s25*(0.0048*s13) + s26*(0.0048*s15) + s27*(0.0048*s18) + s144*s153)
    s162 = s155*s161
    s163 = s156*s161
    s164 = s145*s161
    s165 = s146*s161
    s166 = s156*s162 - (s80*s147 + s81*s148 + s79*s149 + s79*s154 + s76*s150)
    s167 = s77 + s77 - s145*s162
    s168 = s78 + s78 - s146*s162
    s169 = s152 + 0.004 + s80*(0.075*s57) + s81*(0.075*s60) + s152 + s79*(s150 + 0.375*s54) - s156*s163
    s170 = 1.0/(s151 + 0.004 + s77*s147 + s78*s148 + s151 + s76*s154 - s155*s162)
    s171 = s166*s170
    s172 = s167*s170
    s173 = s168*s170
    s174 = s145*s163 - (s80 + s80) - s167*s171
    s175 = s146*s163 - (s81 + s81) - s168*s171
    s176 = 1.0/(s169 - s166*s171)
    s177 = s174*s176
    s178 = s175*s176
    s179 = s117*s176
    s180 = s146*s164 + s168*s172 + s175*s177
    s181 = s117*s177
    s182 = s146*s165 + s168*s173 + s175*s178
    s183 = s116*s159 + s117*s179
    s184 = mask_6 + s145*s164 + s167*s172 + s174*s177
    s185 = 1.0/s184
    s186 = s180*s185
    s187 = s181*s185
    s188 = s181*s186 - s117*s178
    s189 = mask_7 + s182 - s180*s186
    s190 = 1.0/s189
    s191 = s188*s190
    s192 = mask_11 - (s181*s187 - s183 + s188*s191)
    s193 = s38*s135 - s37*s136
    s194 = s38*s137 - s37*s138
    s195 = s28*s193
    s196 = s31 + s195
    s197 = s29*s193
    s198 = s32 + s197
    s199 = s30*s193
    s200 = s33 + s199
    s201 = s115*s140 - s114*s141
    s202 = s115*s142 - s114*s143
    s203 = s196 + s82 + s195
    s204 = 0.5*s105
    s205 = -4.905 + 0.5*s106
    s206 = 2.0*s104
    s207 = s206 + 2.5*s203
    s208 = 9e-05*(v4*v5) + s25*(0.12*s196) + s26*(0.12*s198) - s27*(-1.1772 - 0.12*s200) + s144*s207
    s209 = 0.0036*(v9*v11) + s77*s204 + s78*s205 + s76*s206 + s76*s207 + s149*s203 - s162*s208
    s210 = s163*s208 - (0.0036*s107 + s80*s204 + s81*s205 + s79*s206 + s79*s207 + s150*s203) - s171*s209
    s211 = s105 + s198 + s32 - (s70 - s71 - s72) + s197 - s164*s208 - s172*s209 - s177*s210
    s212 = s106 + s200 + s33 - (s73 - s74 - s75) + s199 - s165*s208 - s173*s209 - s178*s210 - s186*s211
    s213 = 1.0/s192*(s191*s212 - (s123 + s119*s201 + s120*s202 + s179*s210 + s187*s211))
    s214 = s190*s212 + s191*s213
    s215 = s186*s214 - s185*s211 + s187*s213
    s216 = 1.0/(mask_16 + s103*s160)*(s101*s112 - s102*(s110 + v15*v15) + s103*(v16*v17) + s124*s202)
    s217 = s176*s210 - s177*s215 + s178*s214 + s179*s213
    s218 = s170*s209 - s171*s217 - s172*s215 + s173*s214
    s219 = s161*s208 - s162*s218 + s163*s217 - s164*s215 + s165*s214
    s220 = s25*s219
    s221 = s220 - s195
    s222 = s31 - s221
    s223 = s32 - (s26*s219 - s197)
    s224 = s33 - (s27*s219 - s199)
    s225 = s77*s218 - s80*s217 - s105
    s226 = s78*s218 - s81*s217 - s106
    s227 = s76*s218
    s228 = s79*s217
    s229 = s220 + s221 - s31 - s195 + s227 - s228
    s230 = s82 - s229
    s231 = s104 - (s227 + s229 - s82 - s228)
    s232 = s119*s213 - 0.0001*s201
    s233 = 0.0001*s202 - s120*s213 + s124*s216
    s234 = s215 - 0.12*s223
    s235 = -1.1772 - (s214 + 0.12*s224)
    s236 = s215 + 0.5*s225
    s237 = 0.5*s226 - s214 - -4.905
    s238 = 2.0*s231
    s239 = s238 + 0.5*s230
    s240 = s239 + 0.12*s222
    s241 = 9e-05*s36 + 0.0001*s193 + s28*s240 - s29*s234 - s30*s235 + s28*s239 - s29*s215 + s30*s214
    s242 = 1e-05*s194
    s243 = ((mask_11 + s157 < 1e-06*(s157 + s119*(s119*gauge_16) + s120*(s120*gauge_17))) | (mask_16 + s158 < 1e-06*(s158 + s124*(s124*gauge_17))))
    # outputs
    ydot[0] = v0  # rate of crank.x
    ydot[1] = v1  # rate of crank.y
    ydot[2] = v2  # rate of crank.z
    ydot[3] = -(q4*s125 + q5*s126 + q6*s127)  # rate of crank.e0
    ydot[4] = q3*s125 + q5*s127 - q6*s126  # rate of crank.e1
    ydot[5] = q3*s126 + q6*s125 - q4*s127  # rate of crank.e2
    ydot[6] = q3*s127 + q4*s126 - q5*s125  # rate of crank.e3
    ydot[7] = v6  # rate of rod.x
    ydot[8] = v7  # rate of rod.y
    ydot[9] = v8  # rate of rod.z
    ydot[10] = -(q11*s128 + q12*s129 + q13*s130)  # rate of rod.e0
    ydot[11] = q10*s128 + q12*s130 - q13*s129  # rate of rod.e1
    ydot[12] = q10*s129 + q13*s128 - q11*s130  # rate of rod.e2
    ydot[13] = q10*s130 + q11*s129 - q12*s128  # rate of rod.e3
    ydot[14] = v12  # rate of slider.x
    ydot[15] = v13  # rate of slider.y
    ydot[16] = v14  # rate of slider.z
    ydot[17] = -(q18*s131 + q19*s132 + q20*s133)  # rate of slider.e0
    ydot[18] = q17*s131 + q19*s133 - q20*s132  # rate of slider.e1
    ydot[19] = q17*s132 + q20*s131 - q18*s133  # rate of slider.e2
    ydot[20] = q17*s133 + q18*s132 - q19*s131  # rate of slider.e3
    ydot[21] = s222  # rate of crank.vx
    ydot[22] = s223  # rate of crank.vy
    ydot[23] = s224  # rate of crank.vz
    ydot[24] = s219  # rate of crank.wx
    ydot[25] = s193  # rate of crank.wy
    ydot[26] = s194  # rate of crank.wz
    ydot[27] = s230  # rate of rod.vx
    ydot[28] = s225  # rate of rod.vy
    ydot[29] = s226  # rate of rod.vz
    ydot[30] = s159*s213  # rate of rod.wx
    ydot[31] = s218  # rate of rod.wy
    ydot[32] = s217  # rate of rod.wz
    ydot[33] = s231  # rate of slider.vx
    ydot[34] = 0.0  # rate of slider.vy
    ydot[35] = 0.0  # rate of slider.vz
    ydot[36] = -s160*s216  # rate of slider.wx
    ydot[37] = s201  # rate of slider.wy
    ydot[38] = s202  # rate of slider.wz
    ydot[39] = 0.0  # rate of work
    w[MULTIPLIERS] = -s240  # A.x
    w[MULTIPLIERS + 1] = s234  # A.y
    w[MULTIPLIERS + 2] = s235  # A.z
    w[MULTIPLIERS + 3] = -(s135*s241 + s137*s242)  # A.first
    w[MULTIPLIERS + 4] = -(s136*s241 + s138*s242)  # A.second
    w[MULTIPLIERS + 5] = -s239  # B.x
    w[MULTIPLIERS + 6] = s215  # B.y
    w[MULTIPLIERS + 7] = -s214  # B.z
    w[MULTIPLIERS + 8] = -s238  # C.x
    w[MULTIPLIERS + 9] = s236  # C.y
    w[MULTIPLIERS + 10] = s237  # C.z
    w[MULTIPLIERS + 11] = -s213  # C.cross
    w[MULTIPLIERS + 12] = -s236  # guide.across1
    w[MULTIPLIERS + 13] = -19.62 - s237  # guide.across2
    w[MULTIPLIERS + 14] = s140*s232 - s142*s233  # guide.first
    w[MULTIPLIERS + 15] = s141*s232 - s143*s233  # guide.second
    w[MULTIPLIERS + 16] = s216  # guide.angle
    return int((((s243 | (s184 < 2e-06)) | (s189 < 1e-06*max(s182, 2.0))) | (s192 < 1e-06*s183)))


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
    if rhs_by_pivots(t, y, p, w, iw, ydot) == 0:
        return 0
    geometry(t, y, p, w)
    skipped = 0
    for i in range(17):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs_by_pivots(t, y, p, w, iw, ydot)
    for i in range(17):
        w[MASK + i] = w[SAVED + i]
    iw[SUSPECTS] += 1
    if skipped == 0:
        iw[LIGHT] += 1
    return 0
