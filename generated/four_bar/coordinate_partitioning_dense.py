"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = dense
p[15] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MULTIPLIERS = 15  # sections of w
MASK = 23
RESIDUAL = 39
CHANGE = 63
MASS = 72
DEPENDENT = 117
DENSE = 126
ROW_LENGTH = 198
ROW_CHOSEN = 206
ROW_CORNER = 214
ROW_FACTOR = 222
BASIS = 230
SMALL = 311
REDUCED = 392
FORCE = 401
WEIGHED = 410


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # outputs
    p[16] = -9.81*p0
    p[17] = -9.81*p1
    p[18] = -9.81*p2
    p[19] = 0.3333333333333333*p0
    p[20] = 5.333333333333333*p1
    p[21] = 2.083333333333333*p2
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    jacobian_8 = w[89]
    jacobian_9 = w[90]
    jacobian_10 = w[91]
    jacobian_11 = w[92]
    # outputs
    w[126] = 1.0
    w[128] = jacobian_0
    w[136] = 1.0
    w[137] = jacobian_1
    w[144] = -1.0
    w[146] = jacobian_2
    w[147] = 1.0
    w[149] = jacobian_3
    w[154] = -1.0
    w[155] = jacobian_4
    w[157] = 1.0
    w[158] = jacobian_5
    w[165] = -1.0
    w[167] = jacobian_6
    w[168] = 1.0
    w[170] = jacobian_7
    w[175] = -1.0
    w[176] = jacobian_8
    w[178] = 1.0
    w[179] = jacobian_9
    w[186] = 1.0
    w[188] = jacobian_10
    w[196] = 1.0
    w[197] = jacobian_11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def aim(t, y, p, w):
    """the section `residual` = what D v' shall be, `force` = f: 27 operations, 54 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    # intermediate terms
    s0 = v2*v2
    s1 = math.cos(q2)*s0
    s2 = math.sin(q2)*s0
    s3 = 4.0*(v5*v5)
    s4 = math.cos(q5)*s3
    s5 = math.sin(q5)*s3
    s6 = 2.5*(v8*v8)
    s7 = math.cos(q8)*s6
    s8 = math.sin(q8)*s6
    # outputs
    w[39] = -s1
    w[40] = -s2
    w[41] = -(s1 + s4)
    w[42] = -(s2 + s5)
    w[43] = s7 - s4
    w[44] = s8 - s5
    w[45] = -s7
    w[46] = -s8
    w[401] = 0.0
    w[402] = p16
    w[403] = 0.0
    w[404] = 0.0
    w[405] = p17
    w[406] = 0.0
    w[407] = 0.0
    w[408] = p18
    w[409] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def weigh(p, w):
    """the section `weighed` = M times `change`: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    change_0 = w[63]
    change_1 = w[64]
    change_2 = w[65]
    change_3 = w[66]
    change_4 = w[67]
    change_5 = w[68]
    change_6 = w[69]
    change_7 = w[70]
    change_8 = w[71]
    # outputs
    w[410] = p0*change_0
    w[411] = p0*change_1
    w[412] = p19*change_2
    w[413] = p1*change_3
    w[414] = p1*change_4
    w[415] = p20*change_5
    w[416] = p2*change_6
    w[417] = p2*change_7
    w[418] = p21*change_8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """q' and power: 0 operations, 0 before sharing."""
    # inputs
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
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
    ydot[18] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D P D^T: 373 operations, 475926 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_7 = w[30]
    dependent_0 = w[117]
    dependent_1 = w[118]
    dependent_2 = w[119]
    dependent_3 = w[120]
    dependent_4 = w[121]
    dependent_5 = w[122]
    dependent_6 = w[123]
    dependent_7 = w[124]
    dependent_8 = w[125]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = q0 - s0
    s4 = q1 - s1
    s5 = 4.0*math.cos(q5)
    s6 = -s5
    s7 = q3 - q0 - s5 - s0
    s8 = 4.0*math.sin(q5)
    s9 = q4 - q1 - s8 - s1
    s10 = 2.5*math.cos(q8)
    s11 = q6 - q3 + s10 - s5
    s12 = 2.5*math.sin(q8)
    s13 = q7 - q4 + s12 - s8
    s14 = q6 - 10.0 - s10
    s15 = q7 - s12
    s16 = s1*s1
    s17 = 1.0 + s16
    s18 = s0*s1
    s19 = -1.0 + s16
    s20 = s0*s0
    s21 = 1.0 + s20
    s22 = s8*s8
    s23 = 1.0 + s17 + s22
    s24 = s5*s8
    s25 = -1.0 + s22
    s26 = s5*s5
    s27 = 1.0 + s21 + s26
    s28 = s12*s12
    s29 = 1.0 + 1.0 + s22 + s28
    s30 = s10*s12
    s31 = 1.0 - s28
    s32 = s10*s10
    s33 = 1.0 + 1.0 + s26 + s32
    s34 = 1.0 + s28
    s35 = 1.0 + s32
    s36 = 1.0/s17
    s37 = s18*s36
    s38 = s19*s36
    s39 = s18*s37
    s40 = s21 - s39
    s41 = s19*s37 - s18
    s42 = -1.0 + s20 - s39
    s43 = 1.0*(s40 > mask_1 + 1e-12*s21)
    s44 = 1.0 - s43
    s45 = s43/(s40 + s44)
    s46 = s41*s45
    s47 = s23 - s19*s38 - s41*s46
    s48 = s18*s38 - (s18 + s24) - s42*s46
    s49 = 1.0/s34
    s50 = s30*s49
    s51 = s31*s49
    s52 = s30*s50
    s53 = s35 - s52
    s54 = s30 + s31*s50
    s55 = 1.0 - s32 + s52
    s56 = 1.0*(s53 > mask_7 + 1e-12*s35)
    s57 = 1.0 - s56
    s58 = s56/(s53 + s57)
    s59 = s54*s58
    s60 = 1.0*(s47 > mask_2 + 1e-12*s23)
    s61 = 1.0 - s60
    s62 = s60/(s47 + s61)
    s63 = s48*s62
    s64 = s25*s62
    s65 = s27 - s39 - s42*(s42*s45) - s48*s63
    s66 = s24 + s25*s63
    s67 = -1.0 + s26 + s24*s63
    s68 = 1.0*(s65 > mask_3 + 1e-12*s27)
    s69 = 1.0 - s68
    s70 = s68/(s65 + s69)
    s71 = s66*s70
    s72 = s29 - s31*s51 - s54*s59 - s25*s64 - s66*s71
    s73 = s24*s64 - (s24 + s30 + s30*s51 + s55*s59) + s67*s71
    s74 = 1.0*(s72 > mask_4 + 1e-12*s29)
    s75 = 1.0 - s74
    s76 = s74/(s72 + s75)
    s77 = s33 - s52 - s55*(s55*s58) - s24*(s24*s62) - s67*(s67*s70) - s73*(s73*s76)
    s78 = 1.0*(s77 > mask_5 + 1e-12*s33)
    s79 = 1.0 - s78
    s80 = s78/(s77 + s79)
    s81 = s1*dependent_2
    s82 = s0*dependent_2
    s83 = s8*dependent_5
    s84 = s5*dependent_5
    s85 = s12*dependent_8
    s86 = s10*dependent_8
    s87 = s1*s81
    s88 = dependent_0 + s87
    s89 = s0*s81
    s90 = s87 - dependent_0
    s91 = s0*s82
    s92 = dependent_1 + s91
    s93 = s8*s83
    s94 = s5*s83
    s95 = s93 - dependent_3
    s96 = s5*s84
    s97 = s12*s85
    s98 = s10*s85
    s99 = dependent_6 - s97
    s100 = s10*s86
    s101 = s12*s86
    s102 = dependent_6 + s97
    s103 = 1.0/s88
    s104 = s89*s103
    s105 = -s104
    s106 = s90*s103
    s107 = s89*s104
    s108 = s92 - s107
    s109 = s90*s104 - s1*s82
    s110 = s91 - dependent_1 - s107
    s111 = s43/(s44 + s108)
    s112 = s109*s111
    s113 = s110*s111
    s114 = dependent_3 + s88 + s93 - s90*s106 - s109*s112
    s115 = s89*s106 - (s89 + s94) - s110*s112
    s116 = 1.0/s102
    s117 = s98*s116
    s118 = s99*s116
    s119 = s101*s116
    s120 = dependent_7 + s100 - s98*s117
    s121 = s98 + s99*s117
    s122 = dependent_7 - s100 + s101*s117
    s123 = s56/(s57 + s120)
    s124 = s121*s123
    s125 = s122*s123
    s126 = s60/(s61 + s114)
    s127 = s115*s126
    s128 = s95*s126
    s129 = s94*s126
    s130 = dependent_4 + s92 + s96 - s107 - s110*s113 - s115*s127
    s131 = s8*s84 + s95*s127
    s132 = s96 - dependent_4 + s94*s127
    s133 = s68/(s69 + s130)
    s134 = s131*s133
    s135 = s132*s133
    s136 = dependent_6 + dependent_3 + s93 + s97 - s99*s118 - s121*s124 - s95*s128 - s131*s134
    s137 = s94*s128 - (s94 + s98 + s101*s118 + s122*s124) + s132*s134
    s138 = s74/(s75 + s136)
    s139 = s137*s138
    s140 = dependent_7 + dependent_4 + s96 + s100 - s101*s119 - s122*s125 - s94*s129 - s132*s135 - s137*s139
    s141 = (s36*s88 + 1.0 - s17*s36)*(s45*s108 + 1.0 - s40*s45)*(s49*s102 + 1.0 - s34*s49)*(s58*s120 + 1.0 - s53*s58)
    s142 = s141*(s62*s114 + 1.0 - s47*s62)*(s70*s130 + 1.0 - s65*s70)*(s76*s136 + 1.0 - s72*s76)*(s80*s140 + 1.0 - s77*s80)
    s143 = s40/s21
    s144 = s47/s23
    s145 = s65/s27
    s146 = s72/s29
    s147 = s77/s33
    s148 = min(min(min(min(min(1.0, mask_1 + s143), mask_2 + s144), mask_3 + s145), mask_4 + s146), mask_5 + s147)
    s149 = s53/s35
    # outputs
    w[39] = s3
    w[40] = s4
    w[41] = s7
    w[42] = s9
    w[43] = s11
    w[44] = s13
    w[45] = s14
    w[46] = s15
    w[0] = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15)
    w[81] = s1
    w[82] = s2
    w[83] = s1
    w[84] = s8
    w[85] = s2
    w[86] = s6
    w[87] = s8
    w[88] = -s12
    w[89] = s6
    w[90] = s10
    w[91] = s12
    w[92] = -s10
    w[56] = s143
    w[57] = s144
    w[58] = s145
    w[59] = s146
    w[60] = s147
    w[62] = s149
    w[5] = s56 + 1.0 + s78 + s74 + s68 + s60 + 1.0 + s43
    w[4] = min(s148, mask_7 + s149)
    w[10] = s142
    w[419] = s105
    w[420] = s106
    w[421] = s105
    w[422] = s112
    w[423] = s113
    w[424] = -s117
    w[425] = s118
    w[426] = s119
    w[427] = s124
    w[428] = s125
    w[429] = s127
    w[430] = s128
    w[431] = -s129
    w[432] = -s134
    w[433] = s135
    w[434] = s139
    w[435] = s103
    w[436] = s111
    w[437] = s116
    w[438] = s123
    w[439] = s126
    w[440] = s133
    w[441] = s138
    w[442] = s78/(s79 + s140)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 111 operations, 6990 before sharing."""
    # inputs
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    jacobian_8 = w[89]
    jacobian_9 = w[90]
    jacobian_10 = w[91]
    jacobian_11 = w[92]
    dependent_0 = w[117]
    dependent_1 = w[118]
    dependent_2 = w[119]
    dependent_3 = w[120]
    dependent_4 = w[121]
    dependent_5 = w[122]
    dependent_6 = w[123]
    dependent_7 = w[124]
    dependent_8 = w[125]
    law_lower_0 = w[419]
    law_lower_1 = w[420]
    law_lower_2 = w[421]
    law_lower_3 = w[422]
    law_lower_4 = w[423]
    law_lower_5 = w[424]
    law_lower_6 = w[425]
    law_lower_7 = w[426]
    law_lower_8 = w[427]
    law_lower_9 = w[428]
    law_lower_10 = w[429]
    law_lower_11 = w[430]
    law_lower_12 = w[431]
    law_lower_13 = w[432]
    law_lower_14 = w[433]
    law_lower_15 = w[434]
    law_reciprocal_0 = w[435]
    law_reciprocal_1 = w[436]
    law_reciprocal_2 = w[437]
    law_reciprocal_3 = w[438]
    law_reciprocal_4 = w[439]
    law_reciprocal_5 = w[440]
    law_reciprocal_6 = w[441]
    law_reciprocal_7 = w[442]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
    # intermediate terms
    s0 = law_lower_0*residual_0 - residual_1
    s1 = law_lower_1*residual_0 - residual_2 - law_lower_3*s0
    s2 = law_lower_5*residual_6 - residual_7
    s3 = law_lower_2*residual_0 - residual_3 - law_lower_4*s0 - law_lower_10*s1
    s4 = law_lower_6*residual_6 - residual_4 - law_lower_8*s2 - law_lower_11*s1 - law_lower_13*s3
    s5 = law_lower_7*residual_6 - residual_5 - law_lower_9*s2 - law_lower_12*s1 - law_lower_14*s3 - law_lower_15*s4
    s6 = law_reciprocal_7*s5
    s7 = law_reciprocal_6*s4
    s8 = law_lower_15*s6
    s9 = s7 - s8
    s10 = law_reciprocal_5*s3 - law_lower_13*s9
    s11 = law_lower_14*s6
    s12 = s10 - s11
    s13 = law_reciprocal_4*s1 - law_lower_10*s12 - law_lower_11*s9
    s14 = law_lower_12*s6
    s15 = s13 - s14
    s16 = law_reciprocal_3*s2 - law_lower_8*s9 - law_lower_9*s6
    s17 = law_reciprocal_2*residual_6 + law_lower_5*s16 + law_lower_6*s9 + law_lower_7*s6
    s18 = law_reciprocal_1*s0 - law_lower_3*s15 - law_lower_4*s12
    s19 = law_reciprocal_0*residual_0 + law_lower_0*s18 + law_lower_1*s15 + law_lower_2*s12
    # outputs
    w[63] = dependent_0*(s14 - s13 - s19)
    w[64] = dependent_1*(s18 + s11 - s10)
    w[65] = dependent_2*(jacobian_1*s18 - jacobian_0*s19 + jacobian_2*s15 + jacobian_4*s12)
    w[66] = dependent_3*(s15 + s8 - s7)
    w[67] = dependent_4*(s12 - s6)
    w[68] = dependent_5*(jacobian_3*s15 + jacobian_5*s12 + jacobian_6*s9 + jacobian_8*s6)
    w[69] = dependent_6*(s9 - s17)
    w[70] = dependent_7*(s6 + s16)
    w[71] = dependent_8*(jacobian_7*s9 + jacobian_9*s6 - jacobian_10*s17 + jacobian_11*s16)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def reflect(w, k, section):
    """Apply reflection `k` to the vector of a section of w."""
    total = 0.0
    for j in range(k, 9):
        total += w[DENSE + 9 * k + j] * w[section + j]
    total *= w[ROW_FACTOR + k]
    for j in range(k, 9):
        w[section + j] -= total * w[DENSE + 9 * k + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def factorise(p, w):
    """Q R of D^T by Householder's reflections with pivoting, rows of D scaled to length 1; return the rank.

    Row i of the section `dense` holds, in the order chosen, R above the diagonal and then the reflection.
    """
    for k in range(72):
        w[DENSE + k] = 0.0
    expand(p, w)
    rows = 0
    for i in range(8):
        total = 0.0
        for j in range(9):
            total += w[DENSE + 9 * i + j] ** 2
        w[ROW_LENGTH + i] = math.sqrt(total)
        if w[MASK + i] > 0.0 or total == 0.0:  # permanently redundant rows are left out, here as elsewhere
            continue
        for j in range(9):
            w[DENSE + 9 * rows + j] = w[DENSE + 9 * i + j] / w[ROW_LENGTH + i]
        w[ROW_CHOSEN + rows] = i
        rows += 1
    for k in range(min(rows, 9)):
        largest, best = 0.0, k
        for i in range(k, rows):
            total = 0.0
            for j in range(k, 9):
                total += w[DENSE + 9 * i + j] ** 2
            if total > largest:
                largest, best = total, i
        if largest < 1e-12:
            return k
        for j in range(9):
            a, b = DENSE + 9 * k + j, DENSE + 9 * best + j
            w[a], w[b] = w[b], w[a]
        w[ROW_CHOSEN + k], w[ROW_CHOSEN + best] = w[ROW_CHOSEN + best], w[ROW_CHOSEN + k]
        first = w[DENSE + 9 * k + k]
        corner = -math.copysign(math.sqrt(largest), first)
        w[ROW_CORNER + k] = corner
        w[DENSE + 9 * k + k] = first - corner
        w[ROW_FACTOR + k] = 1.0 / (largest - corner * first)
        for i in range(k + 1, rows):
            reflect(w, k, DENSE + 9 * i)
    return min(rows, 9)


@njit(error_model="numpy", fastmath={"contract"})
def accelerate(t, y, p, w, iw, ydot):
    """Rates of the state: v' = b + Z z with D b = g, D Z = 0 and Z^T M Z z = Z^T (f - M b), from Q R of D^T."""
    geometry(t, y, p, w)
    aim(t, y, p, w)
    rank = factorise(p, w)
    if iw[9] == 0 or rank < iw[10]:
        iw[10] = rank
    iw[9] += 1
    degrees = 9 - rank
    # b = Q (z, 0) with R^T z = g
    for j in range(9):
        w[CHANGE + j] = 0.0
    for i in range(rank):
        row = int(w[ROW_CHOSEN + i])
        total = w[RESIDUAL + row] / w[ROW_LENGTH + row]
        for j in range(i):
            total -= w[DENSE + 9 * i + j] * w[CHANGE + j]
        w[CHANGE + i] = total / w[ROW_CORNER + i]
    for k in range(rank - 1, -1, -1):
        reflect(w, k, CHANGE)
    weigh(p, w)
    for j in range(9):
        ydot[9 + j] = w[CHANGE + j]
        w[FORCE + j] -= w[WEIGHED + j]
    # the columns of Q behind the rank are a basis Z of the tangent space
    for c in range(degrees):
        for j in range(9):
            w[BASIS + 9 * c + j] = 1.0 if j == rank + c else 0.0
        for k in range(rank - 1, -1, -1):
            reflect(w, k, BASIS + 9 * c)
    for c in range(degrees):
        for j in range(9):
            w[CHANGE + j] = w[BASIS + 9 * c + j]
        weigh(p, w)
        for r in range(c, degrees):
            total = 0.0
            for j in range(9):
                total += w[BASIS + 9 * r + j] * w[WEIGHED + j]
            w[SMALL + 9 * r + c] = total
        total = 0.0
        for j in range(9):
            total += w[BASIS + 9 * c + j] * w[FORCE + j]
        w[REDUCED + c] = total
    largest = 0.0
    for c in range(degrees):
        largest = max(largest, w[SMALL + 9 * c + c])
    for c in range(degrees):  # L D L^T in place; a direction without mass gets no acceleration
        pivot = w[SMALL + 9 * c + c]
        if not pivot > 1e-15 * largest:
            w[SMALL + 9 * c + c] = math.inf
            continue
        for r in range(c + 1, degrees):
            factor = w[SMALL + 9 * r + c] / pivot
            for k in range(r, degrees):
                w[SMALL + 9 * k + r] -= factor * w[SMALL + 9 * k + c]
            w[REDUCED + r] -= factor * w[REDUCED + c]
    for c in range(degrees - 1, -1, -1):
        total = w[REDUCED + c]
        for r in range(c + 1, degrees):
            total -= w[SMALL + 9 * r + c] * w[REDUCED + r]
        w[REDUCED + c] = total / w[SMALL + 9 * c + c]
        for j in range(9):
            ydot[9 + j] += w[REDUCED + c] * w[BASIS + 9 * c + j]
            w[CHANGE + j] = w[BASIS + 9 * c + j]
        weigh(p, w)
        for j in range(9):
            w[FORCE + j] -= w[REDUCED + c] * w[WEIGHED + j]
    # D^T lambda = f - M v', which the section `force` holds by now
    for k in range(rank):
        reflect(w, k, FORCE)
    for i in range(8):
        w[MULTIPLIERS + i] = 0.0
    for i in range(rank - 1, -1, -1):
        row = int(w[ROW_CHOSEN + i])
        scaled = w[FORCE + i] / w[ROW_CORNER + i]
        for j in range(i):
            w[FORCE + j] -= w[DENSE + 9 * i + j] * scaled
        w[MULTIPLIERS + row] = scaled / w[ROW_LENGTH + row]
    finish(t, y, p, w, ydot)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def reduce(w, step, column):
    """Make a column of the dense D a unit vector with its 1 in row `step` (Gauss, Jordan)."""
    pivot = w[DENSE + 9 * step + column]
    for j in range(9):
        w[DENSE + 9 * step + j] /= pivot
    for i in range(8):
        factor = w[DENSE + 9 * i + column]
        if i != step and factor != 0.0:
            for j in range(9):
                w[DENSE + 9 * i + j] -= factor * w[DENSE + 9 * step + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def choose(p, w, iw):
    """Choose the dependent columns of D: by complete pivoting, then by exchange while that enlarges their determinant."""
    for k in range(72):
        w[DENSE + k] = 0.0
    expand(p, w)
    for j in range(9):
        w[DEPENDENT + j] = 0.0
    for i in range(8):  # rows of unequal size must not decide
        total = 0.0
        for j in range(9):
            total += w[DENSE + 9 * i + j] ** 2
        for j in range(9):
            w[DENSE + 9 * i + j] /= math.sqrt(total)
    rank = 0
    for step in range(8):
        largest, row, column = 0.0, -1, -1
        for i in range(step, 8):
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 9 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 9 * i + j]), i, j
        if largest < 1e-6:  # the square root of the threshold at which D D^T skips a row
            break
        w[DEPENDENT + column] = 1.0
        for j in range(9):
            a, b = DENSE + 9 * step + j, DENSE + 9 * row + j
            w[a], w[b] = w[b], w[a]
        reduce(w, step, column)
        rank += 1
    # what is left in the other columns is how fast dependent coordinates follow independent ones, with the sign changed
    for exchange in range(9):
        largest, row, column = 1.01, -1, -1
        for i in range(rank):
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 9 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 9 * i + j]), i, j
        if row < 0:
            break
        for j in range(9):
            if w[DEPENDENT + j] == 1.0 and w[DENSE + 9 * row + j] != 0.0:
                w[DEPENDENT + j] = 0.0
        w[DEPENDENT + column] = 1.0
        reduce(w, row, column)
    iw[7] += 1
    return 0



@njit(error_model="numpy", fastmath={"contract"})
def close(t, y, p, w, iw):
    """Dependent coordinates from Phi = 0 and dependent velocities from D v = nu, the independent ones kept."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[15] * w[6]
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
            for j in range(9, 18):
                y[j] += w[CHANGE - 9 + j]
            break
        for j in range(9):
            y[j] += w[CHANGE + j]
        last = violation
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    return bits


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state, whose dependent part is closed first."""
    close(t, y, p, w, iw)
    return accelerate(t, y, p, w, iw, ydot)


@njit(error_model="numpy", fastmath={"contract"})
def release(w):
    """Make all coordinates dependent, weighted by M^-1: near a singular position no partition determines the motion."""
    largest = 0.0
    for j in range(9):
        largest = max(largest, w[MASS + j])
    for j in range(9):
        w[DEPENDENT + j] = 1.0 / max(w[MASS + j], 1e-6 * largest)  # massless bodies give way, within reason
    w[11] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Close an accepted state, choose another partition where this one has become poor, and measure."""
    poor = False
    if iw[5] == 0:
        geometry(t, y, p, w)
        # the root of the smallest pivot is the sine of an angle: it says whether the next step meets a singular position
        sine = math.sqrt(max(w[4], 0.0))
        fall = max(w[13] - sine, 0.0)
        w[13] = sine
        first = iw[7] == 0
        released = w[11] == 0.0 and not first
        if sine - fall < 0.01:
            if not released:
                release(w)
                iw[7] += 1
        else:
            quality = w[10]
            w[11] = max(w[11], quality)
            ahead = quality - max(w[12] - quality, 0.0)
            poor = released or ahead < 0.3 * w[11]
            w[12] = quality
            if first:
                choose(p, w, iw)
                geometry(t, y, p, w)
                w[11] = w[10]
    bits = close(t, y, p, w, iw)
    if poor:  # after closing: the partition that was integrated with is better for it than one from a singular position
        choose(p, w, iw)
        geometry(t, y, p, w)
        w[11] = w[10]
        w[12] = w[10]
    measure(t, y, p, w)
    return bits
