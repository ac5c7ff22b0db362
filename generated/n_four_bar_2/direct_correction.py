"""Method `direct-correction` for model `n-four-bar-2`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 80662021c19a455162caa1f92b72ba31e49f4d38e94b865825f0146154f94f36, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = identity
p[0] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import geometry, measure, spread

MASK = 29  # sections of w
SAVED = 43
PIVOT = 85
CHANGE = 99


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 567 operations, 68682633 before sharing."""
    # inputs
    q2 = y[2]  # vertical0.theta [rad]
    v0 = y[15]  # vertical0.vx [m/s]
    v1 = y[16]  # vertical0.vy [m/s]
    v2 = y[17]  # vertical0.omega [rad/s]
    q5 = y[5]  # coupler0.theta [rad]
    v3 = y[18]  # coupler0.vx [m/s]
    v4 = y[19]  # coupler0.vy [m/s]
    v5 = y[20]  # coupler0.omega [rad/s]
    q8 = y[8]  # vertical1.theta [rad]
    v6 = y[21]  # vertical1.vx [m/s]
    v7 = y[22]  # vertical1.vy [m/s]
    v8 = y[23]  # vertical1.omega [rad/s]
    q11 = y[11]  # coupler1.theta [rad]
    v9 = y[24]  # coupler1.vx [m/s]
    v10 = y[25]  # coupler1.vy [m/s]
    v11 = y[26]  # coupler1.omega [rad/s]
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
    s35 = 6.0*s1
    s36 = 6.0*s0
    s37 = 6.0*s8
    s38 = 6.0*s7
    s39 = 6.0*s15
    s40 = 6.0*s14
    s41 = 6.0*s22
    s42 = 6.0*s21
    s43 = 6.0*s29
    s44 = 6.0*s28
    s45 = s3*s35
    s46 = 1.0 + s45
    s47 = s2*s35
    s48 = -1.0 + s45
    s49 = s2*s36
    s50 = 1.0 + s49
    s51 = s10*s37
    s52 = 1.0 + s46 + s51
    s53 = s9*s37
    s54 = -1.0 + s51
    s55 = s9*s38
    s56 = 1.0 + s50 + s55
    s57 = s17*s39
    s58 = 1.0 + s57
    s59 = s16*s39
    s60 = -1.0 + s57
    s61 = 1.0 - s57
    s62 = s16*s40
    s63 = 1.0 + s62
    s64 = s17*s40
    s65 = s24*s41
    s66 = 1.0 + s58 + s65
    s67 = s23*s41
    s68 = -1.0 + s65
    s69 = s23*s42
    s70 = 1.0 + s63 + s69
    s71 = s24*s42
    s72 = s57 + 1.0 + 1.0 + s51
    s73 = s62 + 1.0 + 1.0 + s55
    s74 = s31*s43
    s75 = s30*s43
    s76 = 1.0 - s74
    s77 = s30*s44
    s78 = 1.0 + s77
    s79 = s74 + 1.0 + 1.0 + s65
    s80 = s77 + 1.0 + 1.0 + s69
    s81 = 1.0/(mask_0 + s46)
    s82 = s47*s81
    s83 = s48*s81
    s84 = s47*s82
    s85 = s48*s82 - s3*s36
    s86 = -1.0 + s49 - s84
    s87 = mask_1 + s50 - s84
    s88 = 1.0/s87
    s89 = s85*s88
    s90 = s86*s88
    s91 = s47*s83 - (s47 + s53) - s86*s89
    s92 = 1.0/(mask_10 + 1.0 + s74)
    s93 = s75*s92
    s94 = s76*s92
    s95 = s75*s93
    s96 = s31*s44 + s76*s93
    s97 = 1.0 - s77 + s95
    s98 = mask_11 + s78 - s95
    s99 = 1.0/s98
    s100 = s96*s99
    s101 = s97*s99
    s102 = s67 + s75 + s75*s94 + s97*s100
    s103 = mask_2 + s52 - s48*s83 - s85*s89
    s104 = 1.0/s103
    s105 = s91*s104
    s106 = s54*s104
    s107 = s53*s104
    s108 = s10*s38 + s54*s105
    s109 = -1.0 + s55 + s53*s105
    s110 = mask_3 + s56 - s84 - s86*s90 - s91*s105
    s111 = 1.0/s110
    s112 = s108*s111
    s113 = s109*s111
    s114 = mask_12 + s79 - s76*s94 - s96*s100
    s115 = 1.0/s114
    s116 = s102*s115
    s117 = s68*s115
    s118 = s71*s115
    s119 = s68*s116 - s67
    s120 = -1.0 + s69 - s71*s116
    s121 = mask_13 + s80 - s95 - s97*s101 - s102*s116
    s122 = 1.0/s121
    s123 = s119*s122
    s124 = s120*s122
    s125 = 1.0/(mask_4 + s58)
    s126 = s59*s125
    s127 = s60*s125
    s128 = s61*s125
    s129 = s59*s126
    s130 = s60*s126 - s64
    s131 = -1.0 + s62 - s129
    s132 = s64 + s61*s126
    s133 = 1.0 - s62 + s129
    s134 = s59*s127
    s135 = mask_5 + s63 - s129
    s136 = 1.0/s135
    s137 = s130*s136
    s138 = s131*s136
    s139 = s132*s136
    s140 = s133*s136
    s141 = s71*s117 - (s59 + s67) - s120*s123 + s134 - s131*s137
    s142 = -1.0 - s57 - s61*s127 - s132*s137
    s143 = s59 - s134 - s133*s137
    s144 = mask_6 + s66 - s68*s117 - s119*s123 - s60*s127 - s130*s137
    s145 = 1.0/s144
    s146 = s141*s145
    s147 = s142*s145
    s148 = s143*s145
    s149 = s132 - s132*s138 - s142*s146
    s150 = -1.0 - s62 + s129 - s133*s138 - s143*s146
    s151 = mask_7 + s70 - s71*s118 - s120*s124 - s129 - s131*s138 - s141*s146
    s152 = 1.0/s151
    s153 = s149*s152
    s154 = s150*s152
    s155 = s53*s106 - (s53 + s59) + s109*s112 - s59*s128 - s133*s139 - s143*s147 - s150*s153
    s156 = mask_8 + s72 - s54*s106 - s108*s112 - s61*s128 - s132*s139 - s142*s147 - s149*s153
    s157 = 1.0/s156
    s158 = s155*s157
    s159 = mask_9 + s73 - s53*s107 - s109*s113 - s129 - s133*s140 - s143*s148 - s150*s154 - s155*s158
    s160 = s5*s82
    s161 = s6 + -9.81 + s160
    s162 = s5 + s12 - s5*s83 - s89*s161
    s163 = s33*s93
    s164 = s34 + -9.81 + s163
    s165 = s26 - s33 - s33*s94 - s100*s164
    s166 = s6 + s13 + s160 - s90*s161 - s105*s162
    s167 = s27 - s34 - s163 - s101*s164 + s116*s165
    s168 = s19*s126
    s169 = s20 + -9.81 + s168
    s170 = s19 + s26 - s117*s165 - s123*s167 - s19*s127 - s137*s169
    s171 = s20 + s27 + s118*s165 - s124*s167 + s168 - s138*s169 - s146*s170
    s172 = s12 - s19 - s106*s162 + s112*s166 - s19*s128 - s139*s169 - s147*s170 - s153*s171
    s173 = 1.0/s159*(s13 - s20 + s107*s162 - s113*s166 - s168 - s140*s169 - s148*s170 - s154*s171 - s158*s172)
    s174 = s157*s172
    s175 = s158*s173
    s176 = s174 - s175
    s177 = s152*s171 - s153*s176
    s178 = s154*s173
    s179 = s177 - s178
    s180 = s145*s170 - s146*s179 - s147*s176
    s181 = s148*s173
    s182 = s180 - s181
    s183 = s136*s169 - s137*s182 - s138*s179 - s139*s176 - s140*s173
    s184 = s19*s125 + s126*s183 - s127*s182 + s126*s179 - s128*s176 - s126*s173
    s185 = s122*s167 - s123*s182
    s186 = s124*s179
    s187 = s185 - s186
    s188 = s115*s165 + s116*s187 - s117*s182 + s118*s179
    s189 = s111*s166 + s112*s176
    s190 = s113*s173
    s191 = s189 - s190
    s192 = s104*s162 - s105*s191 - s106*s176 + s107*s173
    s193 = s99*s164 - s100*s188 - s101*s187
    s194 = s33*s92 + s93*s193 - s94*s188 - s93*s187
    s195 = s88*s161 - s89*s192 - s90*s191
    s196 = s5*s81 + s82*s195 - s83*s192 + s82*s191
    s197 = (((((s87 < 1e-06*s50) | (s98 < 1e-06*s78)) | (s103 < 1e-06*s52)) | (s110 < 1e-06*s56)) | (s114 < 1e-06*s79))
    s198 = ((((s197 | (s121 < 1e-06*s80)) | (s135 < 1e-06*s63)) | (s144 < 1e-06*s66)) | (s151 < 1e-06*s70))
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
    ydot[15] = s192 - s196
    ydot[16] = -9.81 - (s195 + s190 - s189)
    ydot[17] = 12.0*(s2*s191 - (s3*s196 - s2*s195 + s3*s192))
    ydot[18] = -(s192 + s175 - s174)
    ydot[19] = -9.81 - (s191 - s173)
    ydot[20] = 12.0*(s9*s173 - (s10*s192 - s9*s191 + s10*s176))
    ydot[21] = -(s176 + s184 + s181 - s180)
    ydot[22] = -9.81 - (s173 + s183 + s178 - s177)
    ydot[23] = -12.0*(s17*s184 - s16*s183 + s17*s182 - s16*s179 - s17*s176 + s16*s173)
    ydot[24] = s188 - s182
    ydot[25] = -9.81 - (s179 + s186 - s185)
    ydot[26] = 12.0*(s23*s187 - (s24*s182 - s23*s179 + s24*s188))
    ydot[27] = -(s188 + s194)
    ydot[28] = -9.81 - (s187 + s193)
    ydot[29] = -12.0*(s31*s194 - s30*s193 - s31*s188 + s30*s187)
    ydot[30] = 0.0
    w[15] = s196
    w[16] = s195
    w[17] = s192
    w[18] = s191
    w[19] = s184
    w[20] = s183
    w[21] = s182
    w[22] = s179
    w[23] = s176
    w[24] = s173
    w[25] = s194
    w[26] = s193
    w[27] = s188
    w[28] = s187
    return int(((s198 | (s156 < 1e-06*s72)) | (s159 < 1e-06*s73)))


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
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[0] * w[6]
    last = math.inf
    bits = 2
    for round in range(15):
        geometry(t, y, p, w)
        violation = w[0]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        closed = violation <= tolerance or stalled or round == 14
        if closed:
            measure(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(15, 30):
                y[j] += w[CHANGE - 15 + j]
            break
        for j in range(15):
            y[j] += w[CHANGE + j]
        last = violation
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    measure(t, y, p, w)
    return bits
