"""Method `baumgarte` for model `n-four-bar-2`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[0] alpha (default 5.0)
p[1] beta (default 5.0)
"""

import math

from numba import njit

from .model import geometry, measure

MASK = 29  # sections of w
SAVED = 43
PIVOT = 85
CHANGE = 99


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 2 operations, 2 before sharing."""
    # inputs
    p0 = p[0]
    p1 = p[1]
    # outputs
    p[2] = 2.0*p0
    p[3] = p1*p1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by baumgarte; 1 where a pivot of S is suspicious: 695 operations, 69731186 before sharing."""
    # inputs
    q0 = y[0]  # vertical0.x [m]
    q1 = y[1]  # vertical0.y [m]
    q2 = y[2]  # vertical0.theta [rad]
    v0 = y[15]  # vertical0.vx [m/s]
    v1 = y[16]  # vertical0.vy [m/s]
    v2 = y[17]  # vertical0.omega [rad/s]
    q3 = y[3]  # coupler0.x [m]
    q4 = y[4]  # coupler0.y [m]
    q5 = y[5]  # coupler0.theta [rad]
    v3 = y[18]  # coupler0.vx [m/s]
    v4 = y[19]  # coupler0.vy [m/s]
    v5 = y[20]  # coupler0.omega [rad/s]
    q6 = y[6]  # vertical1.x [m]
    q7 = y[7]  # vertical1.y [m]
    q8 = y[8]  # vertical1.theta [rad]
    v6 = y[21]  # vertical1.vx [m/s]
    v7 = y[22]  # vertical1.vy [m/s]
    v8 = y[23]  # vertical1.omega [rad/s]
    q9 = y[9]  # coupler1.x [m]
    q10 = y[10]  # coupler1.y [m]
    q11 = y[11]  # coupler1.theta [rad]
    v9 = y[24]  # coupler1.vx [m/s]
    v10 = y[25]  # coupler1.vy [m/s]
    v11 = y[26]  # coupler1.omega [rad/s]
    q12 = y[12]  # vertical2.x [m]
    q13 = y[13]  # vertical2.y [m]
    q14 = y[14]  # vertical2.theta [rad]
    v12 = y[27]  # vertical2.vx [m/s]
    v13 = y[28]  # vertical2.vy [m/s]
    v14 = y[29]  # vertical2.omega [rad/s]
    mask_0 = w[29]
    mask_1 = w[30]
    mask_2 = w[31]
    mask_3 = w[32]
    mask_4 = w[33]
    mask_5 = w[34]
    mask_6 = w[35]
    mask_7 = w[36]
    mask_8 = w[37]
    mask_9 = w[38]
    mask_10 = w[39]
    mask_11 = w[40]
    mask_12 = w[41]
    mask_13 = w[42]
    p2 = p[2]
    p3 = p[3]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 0.5*s0
    s3 = 0.5*s1
    s4 = 0.5*(v2*v2)
    s5 = s0*s4
    s6 = s1*s4
    s7 = math.cos(q5)
    s8 = math.sin(q5)
    s9 = 0.5*s7
    s10 = 0.5*s8
    s11 = 0.5*(v5*v5)
    s12 = s7*s11
    s13 = s8*s11
    s14 = math.cos(q8)
    s15 = math.sin(q8)
    s16 = 0.5*s14
    s17 = 0.5*s15
    s18 = 0.5*(v8*v8)
    s19 = s14*s18
    s20 = s15*s18
    s21 = math.cos(q11)
    s22 = math.sin(q11)
    s23 = 0.5*s21
    s24 = 0.5*s22
    s25 = 0.5*(v11*v11)
    s26 = s21*s25
    s27 = s22*s25
    s28 = math.cos(q14)
    s29 = math.sin(q14)
    s30 = 0.5*s28
    s31 = 0.5*s29
    s32 = 0.5*(v14*v14)
    s33 = s28*s32
    s34 = s29*s32
    s35 = v2*s3
    s36 = v2*s2
    s37 = v5*s10
    s38 = v5*s9
    s39 = v8*s17
    s40 = v8*s16
    s41 = v11*s24
    s42 = v11*s23
    s43 = v14*s31
    s44 = v14*s30
    s45 = s5 + (v0 + s35)*p2 + (q0 - s2)*p3
    s46 = s19 + (v6 + s39)*p2 + (q6 - 1.0 - s16)*p3
    s47 = s33 + (v12 + s43)*p2 + (q12 - 2.0 - s30)*p3
    s48 = 6.0*s1
    s49 = 6.0*s0
    s50 = 6.0*s8
    s51 = 6.0*s7
    s52 = 6.0*s15
    s53 = 6.0*s14
    s54 = 6.0*s22
    s55 = 6.0*s21
    s56 = 6.0*s29
    s57 = 6.0*s28
    s58 = s3*s48
    s59 = 1.0 + s58
    s60 = s2*s48
    s61 = -1.0 + s58
    s62 = s2*s49
    s63 = 1.0 + s62
    s64 = s10*s50
    s65 = 1.0 + s59 + s64
    s66 = s9*s50
    s67 = -1.0 + s64
    s68 = s9*s51
    s69 = 1.0 + s63 + s68
    s70 = s17*s52
    s71 = 1.0 + s70
    s72 = s16*s52
    s73 = -1.0 + s70
    s74 = 1.0 - s70
    s75 = s16*s53
    s76 = 1.0 + s75
    s77 = s17*s53
    s78 = s24*s54
    s79 = 1.0 + s71 + s78
    s80 = s23*s54
    s81 = -1.0 + s78
    s82 = s23*s55
    s83 = 1.0 + s76 + s82
    s84 = s24*s55
    s85 = s70 + 1.0 + 1.0 + s64
    s86 = s75 + 1.0 + 1.0 + s68
    s87 = s31*s56
    s88 = s30*s56
    s89 = 1.0 - s87
    s90 = s30*s57
    s91 = 1.0 + s90
    s92 = s87 + 1.0 + 1.0 + s78
    s93 = s90 + 1.0 + 1.0 + s82
    s94 = 1.0/(mask_0 + s59)
    s95 = s60*s94
    s96 = s61*s94
    s97 = s60*s95
    s98 = s61*s95 - s3*s49
    s99 = -1.0 + s62 - s97
    s100 = mask_1 + s63 - s97
    s101 = 1.0/s100
    s102 = s98*s101
    s103 = s99*s101
    s104 = s60*s96 - (s60 + s66) - s99*s102
    s105 = 1.0/(mask_10 + 1.0 + s87)
    s106 = s88*s105
    s107 = s89*s105
    s108 = s88*s106
    s109 = s31*s57 + s89*s106
    s110 = 1.0 - s90 + s108
    s111 = mask_11 + s91 - s108
    s112 = 1.0/s111
    s113 = s109*s112
    s114 = s110*s112
    s115 = s80 + s88 + s88*s107 + s110*s113
    s116 = mask_2 + s65 - s61*s96 - s98*s102
    s117 = 1.0/s116
    s118 = s104*s117
    s119 = s67*s117
    s120 = s66*s117
    s121 = s10*s51 + s67*s118
    s122 = -1.0 + s68 + s66*s118
    s123 = mask_3 + s69 - s97 - s99*s103 - s104*s118
    s124 = 1.0/s123
    s125 = s121*s124
    s126 = s122*s124
    s127 = mask_12 + s92 - s89*s107 - s109*s113
    s128 = 1.0/s127
    s129 = s115*s128
    s130 = s81*s128
    s131 = s84*s128
    s132 = s81*s129 - s80
    s133 = -1.0 + s82 - s84*s129
    s134 = mask_13 + s93 - s108 - s110*s114 - s115*s129
    s135 = 1.0/s134
    s136 = s132*s135
    s137 = s133*s135
    s138 = 1.0/(mask_4 + s71)
    s139 = s72*s138
    s140 = s73*s138
    s141 = s74*s138
    s142 = s72*s139
    s143 = s73*s139 - s77
    s144 = -1.0 + s75 - s142
    s145 = s77 + s74*s139
    s146 = 1.0 - s75 + s142
    s147 = s72*s140
    s148 = mask_5 + s76 - s142
    s149 = 1.0/s148
    s150 = s143*s149
    s151 = s144*s149
    s152 = s145*s149
    s153 = s146*s149
    s154 = s84*s130 - (s72 + s80) - s133*s136 + s147 - s144*s150
    s155 = -1.0 - s70 - s74*s140 - s145*s150
    s156 = s72 - s147 - s146*s150
    s157 = mask_6 + s79 - s81*s130 - s132*s136 - s73*s140 - s143*s150
    s158 = 1.0/s157
    s159 = s154*s158
    s160 = s155*s158
    s161 = s156*s158
    s162 = s145 - s145*s151 - s155*s159
    s163 = -1.0 - s75 + s142 - s146*s151 - s156*s159
    s164 = mask_7 + s83 - s84*s131 - s133*s137 - s142 - s144*s151 - s154*s159
    s165 = 1.0/s164
    s166 = s162*s165
    s167 = s163*s165
    s168 = s66*s119 - (s66 + s72) + s122*s125 - s72*s141 - s146*s152 - s156*s160 - s163*s166
    s169 = mask_8 + s85 - s67*s119 - s121*s125 - s74*s141 - s145*s152 - s155*s160 - s162*s166
    s170 = 1.0/s169
    s171 = s168*s170
    s172 = mask_9 + s86 - s66*s120 - s122*s126 - s142 - s146*s153 - s156*s161 - s163*s167 - s168*s171
    s173 = s45*s95
    s174 = -9.81 + s6 + (v1 - s36)*p2 + (q1 - s3)*p3 + s173
    s175 = s5 + s12 + (v3 + s35 - v0 + s37)*p2 + (q3 - q0 - s9 - s2)*p3 - s45*s96 - s102*s174
    s176 = s47*s106
    s177 = -9.81 + s34 + (v13 - s44)*p2 + (q13 - s31)*p3 + s176
    s178 = (s30 + q12 - q9 - s23)*p3 - (s33 - s26 - (v12 + s41 - v9 - s43)*p2) - s47*s107 - s113*s177
    s179 = s6 + s13 + (v4 - (v1 + s36) - s38)*p2 + (q4 - q1 - s10 - s3)*p3 + s173 - s103*s174 - s118*s175
    s180 = (s17 + q7 - q4 - s10)*p3 - (s20 - s13 - (s40 + v7 - (v4 + s38))*p2) + s120*s175 - s126*s179
    s181 = (s31 + q13 - q10 - s24)*p3 - (s34 - s27 - (s44 + v13 - (v10 + s42))*p2) - s176 - s114*s177 + s129*s178
    s182 = s20 + s27 + (v10 - (v7 + s40) - s42)*p2 + (q10 - q7 - s24 - s17)*p3 + s131*s178 - s137*s181
    s183 = s46*s139
    s184 = -9.81 + s20 + (v7 - s40)*p2 + (q7 - s17)*p3 + s183
    s185 = s19 + s26 + (v9 + s39 - v6 + s41)*p2 + (q9 - q6 - s23 - s16)*p3 - s130*s178 - s136*s181 - s46*s140
    s186 = (s16 + q6 - q3 - s9)*p3 - (s19 - s12 - (v6 + s37 - v3 - s39)*p2) - s119*s175 + s125*s179 - s46*s141
    s187 = s185 - s150*s184
    s188 = s182 + s183 - s151*s184 - s159*s187
    s189 = s186 - s152*s184 - s160*s187 - s166*s188
    s190 = 1.0/s172*(s180 - s183 - s153*s184 - s161*s187 - s167*s188 - s171*s189)
    s191 = s170*s189
    s192 = s171*s190
    s193 = s191 - s192
    s194 = s165*s188 - s166*s193
    s195 = s167*s190
    s196 = s194 - s195
    s197 = s158*s187 - s159*s196 - s160*s193
    s198 = s161*s190
    s199 = s197 - s198
    s200 = s149*s184 - s150*s199 - s151*s196 - s152*s193 - s153*s190
    s201 = s46*s138 + s139*s200 - s140*s199 + s139*s196 - s141*s193 - s139*s190
    s202 = s135*s181 - s136*s199
    s203 = s137*s196
    s204 = s202 - s203
    s205 = s128*s178 + s129*s204 - s130*s199 + s131*s196
    s206 = s124*s179 + s125*s193
    s207 = s126*s190
    s208 = s206 - s207
    s209 = s117*s175 - s118*s208 - s119*s193 + s120*s190
    s210 = s112*s177 - s113*s205 - s114*s204
    s211 = s47*s105 + s106*s210 - s107*s205 - s106*s204
    s212 = s101*s174 - s102*s209 - s103*s208
    s213 = s45*s94 + s95*s212 - s96*s209 + s95*s208
    s214 = (((((s100 < 1e-06*s63) | (s111 < 1e-06*s91)) | (s116 < 1e-06*s65)) | (s123 < 1e-06*s69)) | (s127 < 1e-06*s92))
    s215 = ((((s214 | (s134 < 1e-06*s93)) | (s148 < 1e-06*s76)) | (s157 < 1e-06*s79)) | (s164 < 1e-06*s83))
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = v2
    ydot[3] = v3
    ydot[4] = v4
    ydot[5] = v5
    ydot[6] = v6
    ydot[7] = v7
    ydot[8] = v8
    ydot[9] = v9
    ydot[10] = v10
    ydot[11] = v11
    ydot[12] = v12
    ydot[13] = v13
    ydot[14] = v14
    ydot[15] = s209 - s213
    ydot[16] = -9.81 - (s212 + s207 - s206)
    ydot[17] = 12.0*(s2*s208 - (s3*s213 - s2*s212 + s3*s209))
    ydot[18] = -(s209 + s192 - s191)
    ydot[19] = -9.81 - (s208 - s190)
    ydot[20] = 12.0*(s9*s190 - (s10*s209 - s9*s208 + s10*s193))
    ydot[21] = -(s193 + s201 + s198 - s197)
    ydot[22] = -9.81 - (s190 + s200 + s195 - s194)
    ydot[23] = -12.0*(s17*s201 - s16*s200 + s17*s199 - s16*s196 - s17*s193 + s16*s190)
    ydot[24] = s205 - s199
    ydot[25] = -9.81 - (s196 + s203 - s202)
    ydot[26] = 12.0*(s23*s204 - (s24*s199 - s23*s196 + s24*s205))
    ydot[27] = -(s205 + s211)
    ydot[28] = -9.81 - (s204 + s210)
    ydot[29] = -12.0*(s31*s211 - s30*s210 - s31*s205 + s30*s204)
    ydot[30] = 0.0
    w[15] = s213
    w[16] = s212
    w[17] = s209
    w[18] = s208
    w[19] = s201
    w[20] = s200
    w[21] = s199
    w[22] = s196
    w[23] = s193
    w[24] = s190
    w[25] = s211
    w[26] = s210
    w[27] = s205
    w[28] = s204
    return int(((s215 | (s169 < 1e-06*s85)) | (s172 < 1e-06*s86)))


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(14):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(14):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
