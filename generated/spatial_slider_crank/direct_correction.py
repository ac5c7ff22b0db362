"""Method `direct-correction` for model `spatial-slider-crank`. Emitted by symgen; do not edit.

Positions and velocities are projected after each step with the pseudoinverse of D.
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
Yu, Chen, Comput. Mech. 26 (2000) 52-57
digest c2100cf33b5a79dfbf6312decf2b60a90e5d16c871d4de291fc3b6621fc4eecf, format 3, templates a1bfe8da2fcb1eac
option solver = elimination
option weight = identity
option when = step
p[0] tolerance (default 1e-13)

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

from model import geometry, measure, move, normalise

MULTIPLIERS = 22  # sections of w
MASK = 39
SAVED = 56
RESIDUAL = 73
PIVOT = 107
CHANGE = 124
GAUGE = 160
JACOBIAN = 195
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
def spread(p, w):
    """The correction -D^+ times the section `residual`, of v, or of q by N: 320 operations."""
    # inputs
    mask_6 = w[MASK + 6]  # B.y
    mask_7 = w[MASK + 7]  # B.z
    mask_11 = w[MASK + 11]  # C.cross
    mask_16 = w[MASK + 16]  # guide.angle
    residual_0 = w[RESIDUAL]  # A.x
    residual_1 = w[RESIDUAL + 1]  # A.y
    residual_2 = w[RESIDUAL + 2]  # A.z
    residual_3 = w[RESIDUAL + 3]  # A.first
    residual_4 = w[RESIDUAL + 4]  # A.second
    residual_5 = w[RESIDUAL + 5]  # B.x
    residual_6 = w[RESIDUAL + 6]  # B.y
    residual_7 = w[RESIDUAL + 7]  # B.z
    residual_8 = w[RESIDUAL + 8]  # C.x
    residual_9 = w[RESIDUAL + 9]  # C.y
    residual_10 = w[RESIDUAL + 10]  # C.z
    residual_11 = w[RESIDUAL + 11]  # C.cross
    residual_12 = w[RESIDUAL + 12]  # guide.across1
    residual_13 = w[RESIDUAL + 13]  # guide.across2
    residual_14 = w[RESIDUAL + 14]  # guide.first
    residual_15 = w[RESIDUAL + 15]  # guide.second
    residual_16 = w[RESIDUAL + 16]  # guide.angle
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.wx
    jacobian_1 = w[JACOBIAN + 1]  # D A.x, crank.wy
    jacobian_2 = w[JACOBIAN + 2]  # D A.y, crank.wx
    jacobian_3 = w[JACOBIAN + 3]  # D A.y, crank.wy
    jacobian_4 = w[JACOBIAN + 4]  # D A.z, crank.wx
    jacobian_5 = w[JACOBIAN + 5]  # D A.z, crank.wy
    jacobian_6 = w[JACOBIAN + 6]  # D A.first, crank.wy
    jacobian_7 = w[JACOBIAN + 7]  # D A.first, crank.wz
    jacobian_8 = w[JACOBIAN + 8]  # D A.second, crank.wy
    jacobian_9 = w[JACOBIAN + 9]  # D A.second, crank.wz
    jacobian_10 = w[JACOBIAN + 10]  # D B.x, crank.wx
    jacobian_11 = w[JACOBIAN + 11]  # D B.x, crank.wy
    jacobian_12 = w[JACOBIAN + 12]  # D B.x, rod.wy
    jacobian_13 = w[JACOBIAN + 13]  # D B.x, rod.wz
    jacobian_14 = w[JACOBIAN + 14]  # D B.y, crank.wx
    jacobian_15 = w[JACOBIAN + 15]  # D B.y, crank.wy
    jacobian_16 = w[JACOBIAN + 16]  # D B.y, rod.wy
    jacobian_17 = w[JACOBIAN + 17]  # D B.y, rod.wz
    jacobian_18 = w[JACOBIAN + 18]  # D B.z, crank.wx
    jacobian_19 = w[JACOBIAN + 19]  # D B.z, crank.wy
    jacobian_20 = w[JACOBIAN + 20]  # D B.z, rod.wy
    jacobian_21 = w[JACOBIAN + 21]  # D B.z, rod.wz
    jacobian_22 = w[JACOBIAN + 22]  # D C.x, rod.wy
    jacobian_23 = w[JACOBIAN + 23]  # D C.x, rod.wz
    jacobian_24 = w[JACOBIAN + 24]  # D C.y, rod.wy
    jacobian_25 = w[JACOBIAN + 25]  # D C.y, rod.wz
    jacobian_26 = w[JACOBIAN + 26]  # D C.z, rod.wy
    jacobian_27 = w[JACOBIAN + 27]  # D C.z, rod.wz
    jacobian_28 = w[JACOBIAN + 28]  # D C.cross, rod.wx
    jacobian_29 = w[JACOBIAN + 29]  # D C.cross, rod.wz
    jacobian_30 = w[JACOBIAN + 30]  # D C.cross, slider.wy
    jacobian_31 = w[JACOBIAN + 31]  # D C.cross, slider.wz
    jacobian_32 = w[JACOBIAN + 32]  # D guide.first, slider.wy
    jacobian_33 = w[JACOBIAN + 33]  # D guide.first, slider.wz
    jacobian_34 = w[JACOBIAN + 34]  # D guide.second, slider.wy
    jacobian_35 = w[JACOBIAN + 35]  # D guide.second, slider.wz
    jacobian_36 = w[JACOBIAN + 36]  # D guide.angle, slider.wx
    jacobian_37 = w[JACOBIAN + 37]  # D guide.angle, slider.wz
    pivot_16 = w[PIVOT + 16]  # guide.angle
    pivot_6 = w[PIVOT + 6]  # B.y
    pivot_7 = w[PIVOT + 7]  # B.z
    pivot_11 = w[PIVOT + 11]  # C.cross
    # intermediate terms
    s0 = 1.0/(jacobian_6*jacobian_9 - jacobian_7*jacobian_8)
    s1 = 1.0/(jacobian_32*jacobian_35 - jacobian_33*jacobian_34)
    s2 = jacobian_0 + jacobian_10
    s3 = jacobian_2 + jacobian_14
    s4 = jacobian_4 + jacobian_18
    s5 = 2.0*s2
    s6 = jacobian_22 + 2.0*jacobian_12
    s7 = jacobian_12*s5 + jacobian_22*s2
    s8 = jacobian_13*s5 + jacobian_23*s2
    s9 = 1.0 + jacobian_24*jacobian_24 + jacobian_26*jacobian_26 + jacobian_22*jacobian_22 + jacobian_12*s6
    s10 = jacobian_24*jacobian_25 + jacobian_26*jacobian_27 + jacobian_22*jacobian_23 + jacobian_13*s6
    s11 = 1.0 + jacobian_25*jacobian_25 + jacobian_27*jacobian_27 + jacobian_23*jacobian_23 + jacobian_13*(jacobian_23 + 2.0*jacobian_13)
    s12 = 1.0/(1.0 + jacobian_0*jacobian_0 + jacobian_2*jacobian_2 + jacobian_4*jacobian_4 + s2*s5)
    s13 = s7*s12
    s14 = s8*s12
    s15 = s3*s12
    s16 = s4*s12
    s17 = s10 + jacobian_12*jacobian_23 - s8*s13
    s18 = jacobian_16 + jacobian_24 - s3*s13
    s19 = jacobian_20 + jacobian_26 - s4*s13
    s20 = 1.0/(s9 + jacobian_12*jacobian_22 - s7*s13)
    s21 = s17*s20
    s22 = s18*s20
    s23 = s19*s20
    s24 = jacobian_17 + jacobian_25 - s3*s14 - s18*s21
    s25 = jacobian_21 + jacobian_27 - s4*s14 - s19*s21
    s26 = 1.0/(s11 + jacobian_13*jacobian_23 - s8*s14 - s17*s21)
    s27 = s24*s26
    s28 = s25*s26
    s29 = jacobian_29*s26
    s30 = s4*s15 + s19*s22 + s25*s27
    s31 = jacobian_29*s27
    s32 = 1.0*(pivot_6 > mask_6 + 1e-12)/max(s3*s15 + s18*s22 + s24*s27, 1e-300)
    s33 = s30*s32
    s34 = s31*s32
    s35 = s31*s33 - jacobian_29*s28
    s36 = 1.0*(pivot_7 > mask_7 + 1e-12)/max(s4*s16 + s19*s23 + s25*s28 - s30*s33, 1e-300)
    s37 = s35*s36
    s38 = 1.0*(pivot_11 > mask_11 + 1e-12)/max(-(s31*s34 - (jacobian_28*jacobian_28 + jacobian_29*s29) + s35*s37), 1e-300)
    s39 = residual_4*(jacobian_7*s0) - residual_3*(jacobian_9*s0)
    s40 = jacobian_1*s39
    s41 = residual_0 + s40
    s42 = jacobian_3*s39
    s43 = residual_1 + s42
    s44 = jacobian_5*s39
    s45 = residual_2 + s44
    s46 = jacobian_11*s39
    s47 = residual_12 - residual_9
    s48 = residual_13 - residual_10
    s49 = residual_15*(jacobian_33*s1) - residual_14*(jacobian_35*s1)
    s50 = residual_14*(jacobian_34*s1) - residual_15*(jacobian_32*s1)
    s51 = s41 + residual_5 + s46
    s52 = residual_8 + 2.0*s51
    s53 = jacobian_0*s41 + jacobian_2*s43 + jacobian_4*s45 + s2*s52
    s54 = jacobian_24*s47 + jacobian_26*s48 - residual_8*jacobian_22 - jacobian_12*s52 - jacobian_22*s51
    s55 = jacobian_25*s47 + jacobian_27*s48 - residual_8*jacobian_23 - jacobian_13*s52 - jacobian_23*s51
    s56 = s54 + s13*s53
    s57 = s55 + s14*s53 - s21*s56
    s58 = s15*s53 - (s43 + residual_6 + jacobian_15*s39 + residual_9 - residual_12) - s22*s56 - s27*s57
    s59 = s16*s53 - (s45 + residual_7 + jacobian_19*s39 + residual_10 - residual_13) - s23*s56 - s28*s57
    s60 = s59 - s33*s58
    s61 = s38*(s37*s60 - (residual_11 + jacobian_30*s49 + jacobian_31*s50 + s29*s57 + s34*s58))
    s62 = s36*s60 + s37*s61
    s63 = s33*s62 - s32*s58 + s34*s61
    s64 = 1.0*(pivot_16 > mask_16 + 1e-12)/max(jacobian_36*jacobian_36, 1e-300)*(residual_16 + jacobian_37*s50)
    s65 = s26*s57 - s27*s63 + s28*s62 + s29*s61
    s66 = s20*s56 - s21*s65 - s22*s63 + s23*s62
    s67 = s16*s62 - (s12*s53 + s13*s66 + s14*s65 + s15*s63)
    s68 = residual_0 + s40 + jacobian_0*s67
    s69 = residual_5 + s46 + s68 + jacobian_10*s67 + jacobian_12*s66 + jacobian_13*s65
    # outputs
    w[CHANGE] = -s68  # crank.vx
    w[CHANGE + 1] = -(residual_1 + s42 + jacobian_2*s67)  # crank.vy
    w[CHANGE + 2] = -(residual_2 + s44 + jacobian_4*s67)  # crank.vz
    w[CHANGE + 3] = s67  # crank.wx
    w[CHANGE + 4] = s39  # crank.wy
    w[CHANGE + 5] = residual_3*(jacobian_8*s0) - residual_4*(jacobian_6*s0)  # crank.wz
    w[CHANGE + 6] = -s69  # rod.vx
    w[CHANGE + 7] = residual_9 + jacobian_24*s66 + jacobian_25*s65 - residual_12  # rod.vy
    w[CHANGE + 8] = residual_10 + jacobian_26*s66 + jacobian_27*s65 - residual_13  # rod.vz
    w[CHANGE + 9] = jacobian_28*s61  # rod.wx
    w[CHANGE + 10] = s66  # rod.wy
    w[CHANGE + 11] = s65  # rod.wz
    w[CHANGE + 12] = -(residual_8 + s69 + jacobian_22*s66 + jacobian_23*s65)  # slider.vx
    w[CHANGE + 13] = -residual_12  # slider.vy
    w[CHANGE + 14] = -residual_13  # slider.vz
    w[CHANGE + 15] = -jacobian_36*s64  # slider.wx
    w[CHANGE + 16] = s49  # slider.wy
    w[CHANGE + 17] = s50  # slider.wz
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def drift(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left: 76 operations."""
    # inputs
    v0 = y[21]  # crank.vx [m/s]
    v1 = y[22]  # crank.vy [m/s]
    v2 = y[23]  # crank.vz [m/s]
    v3 = y[24]  # crank.wx [rad/s]
    v4 = y[25]  # crank.wy [rad/s]
    v5 = y[26]  # crank.wz [rad/s]
    v6 = y[27]  # rod.vx [m/s]
    v7 = y[28]  # rod.vy [m/s]
    v8 = y[29]  # rod.vz [m/s]
    v9 = y[30]  # rod.wx [rad/s]
    v10 = y[31]  # rod.wy [rad/s]
    v11 = y[32]  # rod.wz [rad/s]
    v12 = y[33]  # slider.vx [m/s]
    v13 = y[34]  # slider.vy [m/s]
    v14 = y[35]  # slider.vz [m/s]
    v15 = y[36]  # slider.wx [rad/s]
    v16 = y[37]  # slider.wy [rad/s]
    v17 = y[38]  # slider.wz [rad/s]
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.wx
    jacobian_1 = w[JACOBIAN + 1]  # D A.x, crank.wy
    jacobian_2 = w[JACOBIAN + 2]  # D A.y, crank.wx
    jacobian_3 = w[JACOBIAN + 3]  # D A.y, crank.wy
    jacobian_4 = w[JACOBIAN + 4]  # D A.z, crank.wx
    jacobian_5 = w[JACOBIAN + 5]  # D A.z, crank.wy
    jacobian_6 = w[JACOBIAN + 6]  # D A.first, crank.wy
    jacobian_7 = w[JACOBIAN + 7]  # D A.first, crank.wz
    jacobian_8 = w[JACOBIAN + 8]  # D A.second, crank.wy
    jacobian_9 = w[JACOBIAN + 9]  # D A.second, crank.wz
    jacobian_10 = w[JACOBIAN + 10]  # D B.x, crank.wx
    jacobian_11 = w[JACOBIAN + 11]  # D B.x, crank.wy
    jacobian_12 = w[JACOBIAN + 12]  # D B.x, rod.wy
    jacobian_13 = w[JACOBIAN + 13]  # D B.x, rod.wz
    jacobian_14 = w[JACOBIAN + 14]  # D B.y, crank.wx
    jacobian_15 = w[JACOBIAN + 15]  # D B.y, crank.wy
    jacobian_16 = w[JACOBIAN + 16]  # D B.y, rod.wy
    jacobian_17 = w[JACOBIAN + 17]  # D B.y, rod.wz
    jacobian_18 = w[JACOBIAN + 18]  # D B.z, crank.wx
    jacobian_19 = w[JACOBIAN + 19]  # D B.z, crank.wy
    jacobian_20 = w[JACOBIAN + 20]  # D B.z, rod.wy
    jacobian_21 = w[JACOBIAN + 21]  # D B.z, rod.wz
    jacobian_22 = w[JACOBIAN + 22]  # D C.x, rod.wy
    jacobian_23 = w[JACOBIAN + 23]  # D C.x, rod.wz
    jacobian_24 = w[JACOBIAN + 24]  # D C.y, rod.wy
    jacobian_25 = w[JACOBIAN + 25]  # D C.y, rod.wz
    jacobian_26 = w[JACOBIAN + 26]  # D C.z, rod.wy
    jacobian_27 = w[JACOBIAN + 27]  # D C.z, rod.wz
    jacobian_28 = w[JACOBIAN + 28]  # D C.cross, rod.wx
    jacobian_29 = w[JACOBIAN + 29]  # D C.cross, rod.wz
    jacobian_30 = w[JACOBIAN + 30]  # D C.cross, slider.wy
    jacobian_31 = w[JACOBIAN + 31]  # D C.cross, slider.wz
    jacobian_32 = w[JACOBIAN + 32]  # D guide.first, slider.wy
    jacobian_33 = w[JACOBIAN + 33]  # D guide.first, slider.wz
    jacobian_34 = w[JACOBIAN + 34]  # D guide.second, slider.wy
    jacobian_35 = w[JACOBIAN + 35]  # D guide.second, slider.wz
    jacobian_36 = w[JACOBIAN + 36]  # D guide.angle, slider.wx
    jacobian_37 = w[JACOBIAN + 37]  # D guide.angle, slider.wz
    # outputs
    w[RESIDUAL] = v0 + v3*jacobian_0 + v4*jacobian_1  # A.x
    w[RESIDUAL + 1] = v1 + v3*jacobian_2 + v4*jacobian_3  # A.y
    w[RESIDUAL + 2] = v2 + v3*jacobian_4 + v4*jacobian_5  # A.z
    w[RESIDUAL + 3] = v4*jacobian_6 + v5*jacobian_7  # A.first
    w[RESIDUAL + 4] = v4*jacobian_8 + v5*jacobian_9  # A.second
    w[RESIDUAL + 5] = v6 + v3*jacobian_10 - v0 + v4*jacobian_11 + v10*jacobian_12 + v11*jacobian_13  # B.x
    w[RESIDUAL + 6] = v7 + v3*jacobian_14 - v1 + v4*jacobian_15 + v10*jacobian_16 + v11*jacobian_17  # B.y
    w[RESIDUAL + 7] = v8 + v3*jacobian_18 - v2 + v4*jacobian_19 + v10*jacobian_20 + v11*jacobian_21  # B.z
    w[RESIDUAL + 8] = v12 + v10*jacobian_22 - v6 + v11*jacobian_23  # C.x
    w[RESIDUAL + 9] = v13 + v10*jacobian_24 - v7 + v11*jacobian_25  # C.y
    w[RESIDUAL + 10] = v14 + v10*jacobian_26 - v8 + v11*jacobian_27  # C.z
    w[RESIDUAL + 11] = v9*jacobian_28 + v11*jacobian_29 + v16*jacobian_30 + v17*jacobian_31  # C.cross
    w[RESIDUAL + 12] = v13  # guide.across1
    w[RESIDUAL + 13] = v14  # guide.across2
    w[RESIDUAL + 14] = v16*jacobian_32 + v17*jacobian_33  # guide.first
    w[RESIDUAL + 15] = v16*jacobian_34 + v17*jacobian_35  # guide.second
    w[RESIDUAL + 16] = v15*jacobian_36 + v17*jacobian_37  # guide.angle
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
            for j in range(21, 39):
                y[j] += w[CHANGE - 21 + j]
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
