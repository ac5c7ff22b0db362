"""Method `direct-correction` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 1, templates 8f8565515c2742ad
option weight = mass
p[15] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import drift, energies

PHI = 32  # sections of w
DRIFT = 48
PIVOT = 56
MASK = 16
RIGHT = 64
CHANGE = 72
SAVED = 24


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 17 operations, 32 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    s3 = 1.0/p0
    s4 = 1.0/p1
    s5 = 1.0/p2
    s6 = s0*s3
    s7 = s1*s4
    s8 = s2*s5
    # outputs
    p[16] = s0
    p[17] = s1
    p[18] = s2
    p[19] = s3
    p[20] = 1.0/(0.3333333333333333*p0)
    p[21] = s4
    p[22] = 1.0/(5.333333333333333*p1)
    p[23] = s5
    p[24] = 1.0/(2.083333333333333*p2)
    p[25] = s6
    p[26] = s8
    p[27] = s6 - s7
    p[28] = s7 - s8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 288 operations, 1442826 before sharing."""
    # inputs
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    mask_0 = w[16]
    mask_1 = w[17]
    mask_2 = w[18]
    mask_3 = w[19]
    mask_4 = w[20]
    mask_5 = w[21]
    mask_6 = w[22]
    mask_7 = w[23]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = s0*s2
    s4 = s1*s2
    s5 = math.cos(q5)
    s6 = math.sin(q5)
    s7 = 4.0*s5
    s8 = 4.0*s6
    s9 = 4.0*(v5*v5)
    s10 = s5*s9
    s11 = s6*s9
    s12 = math.cos(q8)
    s13 = math.sin(q8)
    s14 = 2.5*s12
    s15 = 2.5*s13
    s16 = 2.5*(v8*v8)
    s17 = s12*s16
    s18 = s13*s16
    s19 = s1*p20
    s20 = s0*p20
    s21 = s8*p22
    s22 = s7*p22
    s23 = s15*p24
    s24 = s14*p24
    s25 = s1*s19
    s26 = p19 + s25
    s27 = s0*s19
    s28 = s25 - p19
    s29 = s0*s20
    s30 = p19 + s29
    s31 = s8*s21
    s32 = p21 + s26 + s31
    s33 = s7*s21
    s34 = s31 - p21
    s35 = s7*s22
    s36 = p21 + s30 + s35
    s37 = s15*s23
    s38 = p23 + p21 + s31 + s37
    s39 = s14*s23
    s40 = p23 - s37
    s41 = s14*s24
    s42 = p23 + p21 + s35 + s41
    s43 = s15*s24
    s44 = p23 + s41
    s45 = 1.0/(mask_0 + s26)
    s46 = s27*s45
    s47 = s28*s45
    s48 = s27*s46
    s49 = s28*s46 - s1*s20
    s50 = s29 - p19 - s48
    s51 = mask_1 + s30 - s48
    s52 = 1.0/s51
    s53 = s49*s52
    s54 = s50*s52
    s55 = s27*s47 - (s27 + s33) - s50*s53
    s56 = 1.0/(mask_6 + p23 + s37)
    s57 = s39*s56
    s58 = s40*s56
    s59 = s43*s56
    s60 = s39 + s40*s57
    s61 = p23 - s41 + s43*s57
    s62 = mask_7 + s44 - s39*s57
    s63 = 1.0/s62
    s64 = s60*s63
    s65 = s61*s63
    s66 = mask_2 + s32 - s28*s47 - s49*s53
    s67 = 1.0/s66
    s68 = s55*s67
    s69 = s34*s67
    s70 = s33*s67
    s71 = s8*s22 + s34*s68
    s72 = s35 - p21 + s33*s68
    s73 = mask_3 + s36 - s48 - s50*s54 - s55*s68
    s74 = 1.0/s73
    s75 = s71*s74
    s76 = s72*s74
    s77 = s33*s69 - (s33 + s39 + s43*s58 + s61*s64) + s72*s75
    s78 = mask_4 + s38 - s40*s58 - s60*s64 - s34*s69 - s71*s75
    s79 = 1.0/s78
    s80 = s77*s79
    s81 = mask_5 + s42 - s43*s59 - s61*s65 - s33*s70 - s72*s76 - s77*s80
    s82 = s3*s46
    s83 = s4 - p25 + s82
    s84 = s3 + s10 - s3*s47 - s53*s83
    s85 = s18 - p26 + s17*s57
    s86 = s4 + s11 + p27 + s82 - s54*s83 - s68*s84
    s87 = s10 - s17 - s17*s58 - s64*s85 - s69*s84 + s75*s86
    s88 = 1.0/s81*(p28 - (s18 - s11) - s17*s59 - s65*s85 + s70*s84 - s76*s86 - s80*s87)
    s89 = s79*s87
    s90 = s80*s88
    s91 = s89 - s90
    s92 = s74*s86 + s75*s91
    s93 = s76*s88
    s94 = s92 - s93
    s95 = s67*s84 - s68*s94 - s69*s91 + s70*s88
    s96 = s63*s85 - s64*s91 - s65*s88
    s97 = s17*s56 + s57*s96 - s58*s91 - s59*s88
    s98 = s52*s83 - s53*s95 - s54*s94
    s99 = s3*s45 + s46*s98 - s47*s95 + s46*s94
    s100 = (((((s51 < 1e-06*s30) | (s62 < 1e-06*s44)) | (s66 < 1e-06*s32)) | (s73 < 1e-06*s36)) | (s78 < 1e-06*s38))
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
    ydot[9] = p19*(s95 - s99)
    ydot[10] = -p19*(p16 + s98 + s93 - s92)
    ydot[11] = p20*(s0*s94 - (s1*s99 - s0*s98 + s1*s95))
    ydot[12] = -p21*(s95 + s90 - s89)
    ydot[13] = -p21*(p17 + s94 - s88)
    ydot[14] = p22*(s7*s88 - (s8*s95 - s7*s94 + s8*s91))
    ydot[15] = -p23*(s91 + s97)
    ydot[16] = -p23*(p18 + s88 + s96)
    ydot[17] = p24*(s14*s96 - (s14*s88 - s15*s91 + s15*s97))
    ydot[18] = 0.0
    w[8] = s99
    w[9] = s98
    w[10] = s95
    w[11] = s94
    w[12] = s91
    w[13] = s88
    w[14] = s97
    w[15] = s96
    return int((s100 | (s81 < 1e-06*s42)))


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 291 operations, 152853 before sharing."""
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
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = 4.0*math.cos(q5)
    s4 = -s3
    s5 = 4.0*math.sin(q5)
    s6 = 2.5*math.cos(q8)
    s7 = 2.5*math.sin(q8)
    s8 = s1*p20
    s9 = s0*p20
    s10 = s5*p22
    s11 = s3*p22
    s12 = s7*p24
    s13 = s6*p24
    s14 = s1*s8
    s15 = p19 + s14
    s16 = s0*s8
    s17 = s14 - p19
    s18 = s0*s9
    s19 = p19 + s18
    s20 = s5*s10
    s21 = s3*s10
    s22 = s20 - p21
    s23 = s3*s11
    s24 = s7*s12
    s25 = s6*s12
    s26 = p23 - s24
    s27 = s6*s13
    s28 = s7*s13
    s29 = s1*s1
    s30 = 1.0 + s29
    s31 = s0*s1
    s32 = -1.0 + s29
    s33 = s0*s0
    s34 = 1.0 + s33
    s35 = s5*s5
    s36 = 1.0 + s30 + s35
    s37 = s3*s5
    s38 = -1.0 + s35
    s39 = s3*s3
    s40 = 1.0 + s34 + s39
    s41 = s7*s7
    s42 = 1.0 + 1.0 + s35 + s41
    s43 = s6*s7
    s44 = 1.0 - s41
    s45 = s6*s6
    s46 = 1.0 + 1.0 + s39 + s45
    s47 = 1.0 + s45
    s48 = 1.0/s30
    s49 = s31*s48
    s50 = s32*s48
    s51 = s31*s49
    s52 = s34 - s51
    s53 = s32*s49 - s31
    s54 = -1.0 + s33 - s51
    s55 = 1.0*(s52 > 1e-12*s34)
    s56 = 1.0 - s55
    s57 = s55/(s52 + s56)
    s58 = s53*s57
    s59 = s36 - s32*s50 - s53*s58
    s60 = s31*s50 - (s31 + s37) - s54*s58
    s61 = 1.0/(1.0 + s41)
    s62 = s43*s61
    s63 = s44*s61
    s64 = s43*s62
    s65 = s47 - s64
    s66 = s43 + s44*s62
    s67 = 1.0 - s45 + s64
    s68 = 1.0*(s65 > 1e-12*s47)
    s69 = 1.0 - s68
    s70 = s68/(s65 + s69)
    s71 = s66*s70
    s72 = 1.0*(s59 > 1e-12*s36)
    s73 = 1.0 - s72
    s74 = s72/(s59 + s73)
    s75 = s60*s74
    s76 = s38*s74
    s77 = s40 - s51 - s54*(s54*s57) - s60*s75
    s78 = s37 + s38*s75
    s79 = -1.0 + s39 + s37*s75
    s80 = 1.0*(s77 > 1e-12*s40)
    s81 = 1.0 - s80
    s82 = s80/(s77 + s81)
    s83 = s78*s82
    s84 = s42 - s44*s63 - s66*s71 - s38*s76 - s78*s83
    s85 = s37*s76 - (s37 + s43 + s43*s63 + s67*s71) + s79*s83
    s86 = 1.0*(s84 > 1e-12*s42)
    s87 = 1.0 - s86
    s88 = s46 - s64 - s67*(s67*s70) - s37*(s37*s74) - s79*(s79*s82) - s85*(s85*(s86/(s84 + s87)))
    s89 = 1.0*(s88 > 1e-12*s46)
    s90 = 1.0/s15
    s91 = s16*s90
    s92 = -s91
    s93 = s17*s90
    s94 = s16*s91
    s95 = s17*s91 - s1*s9
    s96 = s18 - p19 - s94
    s97 = s55/(s56 + s19 - s94)
    s98 = s95*s97
    s99 = s96*s97
    s100 = s16*s93 - (s16 + s21) - s96*s98
    s101 = 1.0/(p23 + s24)
    s102 = s25*s101
    s103 = s26*s101
    s104 = s28*s101
    s105 = s25 + s26*s102
    s106 = p23 - s27 + s28*s102
    s107 = s68/(s69 + p23 + s27 - s25*s102)
    s108 = s105*s107
    s109 = s106*s107
    s110 = s72/(s73 + p21 + s15 + s20 - s17*s93 - s95*s98)
    s111 = s100*s110
    s112 = s22*s110
    s113 = s21*s110
    s114 = s5*s11 + s22*s111
    s115 = s23 - p21 + s21*s111
    s116 = s80/(s81 + p21 + s19 + s23 - s94 - s96*s99 - s100*s111)
    s117 = s114*s116
    s118 = s115*s116
    s119 = s21*s112 - (s21 + s25 + s28*s103 + s106*s108) + s115*s117
    s120 = s86/(s87 + p23 + p21 + s20 + s24 - s26*s103 - s105*s108 - s22*s112 - s114*s117)
    s121 = s119*s120
    s122 = 1.0 - s89 + p23 + p21 + s23 + s27 - s28*s104 - s106*s109 - s21*s113 - s115*s118 - s119*s121
    # outputs
    w[32] = q0 - s0
    w[33] = q1 - s1
    w[34] = q3 - q0 - s3 - s0
    w[35] = q4 - q1 - s5 - s1
    w[36] = q6 - q3 + s6 - s3
    w[37] = q7 - q4 + s7 - s5
    w[38] = q6 - 10.0 - s6
    w[39] = q7 - s7
    w[90] = s1
    w[91] = s2
    w[92] = s1
    w[93] = s5
    w[94] = s2
    w[95] = s4
    w[96] = s5
    w[97] = -s7
    w[98] = s4
    w[99] = s6
    w[100] = s7
    w[101] = -s6
    w[57] = s52/s34
    w[58] = s59/s36
    w[59] = s77/s40
    w[60] = s84/s42
    w[61] = s88/s46
    w[63] = s65/s47
    w[126] = s92
    w[127] = s93
    w[128] = s92
    w[129] = s98
    w[130] = s99
    w[131] = -s102
    w[132] = s103
    w[133] = s104
    w[134] = s108
    w[135] = s109
    w[136] = s111
    w[137] = s112
    w[138] = -s113
    w[139] = -s117
    w[140] = s118
    w[141] = s121
    w[142] = s90
    w[143] = s97
    w[144] = s101
    w[145] = s107
    w[146] = s110
    w[147] = s116
    w[148] = s120
    w[149] = s89/s122
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """change of v (or of q by N) = D^+ times the section `right`: 111 operations, 6990 before sharing."""
    # inputs
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    law_lower_0 = w[126]
    law_lower_1 = w[127]
    law_lower_2 = w[128]
    law_lower_3 = w[129]
    law_lower_4 = w[130]
    law_lower_5 = w[131]
    law_lower_6 = w[132]
    law_lower_7 = w[133]
    law_lower_8 = w[134]
    law_lower_9 = w[135]
    law_lower_10 = w[136]
    law_lower_11 = w[137]
    law_lower_12 = w[138]
    law_lower_13 = w[139]
    law_lower_14 = w[140]
    law_lower_15 = w[141]
    law_reciprocal_0 = w[142]
    law_reciprocal_1 = w[143]
    law_reciprocal_2 = w[144]
    law_reciprocal_3 = w[145]
    law_reciprocal_4 = w[146]
    law_reciprocal_5 = w[147]
    law_reciprocal_6 = w[148]
    law_reciprocal_7 = w[149]
    right_0 = w[64]
    right_1 = w[65]
    right_2 = w[66]
    right_3 = w[67]
    right_4 = w[68]
    right_5 = w[69]
    right_6 = w[70]
    right_7 = w[71]
    jacobian_0 = w[90]
    jacobian_1 = w[91]
    jacobian_2 = w[92]
    jacobian_3 = w[93]
    jacobian_4 = w[94]
    jacobian_5 = w[95]
    jacobian_6 = w[96]
    jacobian_7 = w[97]
    jacobian_8 = w[98]
    jacobian_9 = w[99]
    jacobian_10 = w[100]
    jacobian_11 = w[101]
    # intermediate terms
    s0 = right_1 - law_lower_0*right_0
    s1 = right_2 - law_lower_1*right_0 - law_lower_3*s0
    s2 = right_7 - law_lower_5*right_6
    s3 = right_3 - law_lower_2*right_0 - law_lower_4*s0 - law_lower_10*s1
    s4 = right_4 - law_lower_6*right_6 - law_lower_8*s2 - law_lower_11*s1 - law_lower_13*s3
    s5 = right_5 - law_lower_7*right_6 - law_lower_9*s2 - law_lower_12*s1 - law_lower_14*s3 - law_lower_15*s4
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
    s17 = law_reciprocal_2*right_6 - law_lower_5*s16 - law_lower_6*s9 - law_lower_7*s6
    s18 = law_reciprocal_1*s0 - law_lower_3*s15 - law_lower_4*s12
    s19 = law_reciprocal_0*right_0 - law_lower_0*s18 - law_lower_1*s15 - law_lower_2*s12
    # outputs
    w[72] = p19*(s19 + s14 - s13)
    w[73] = p19*(s18 + s11 - s10)
    w[74] = p20*(s19*jacobian_0 + s18*jacobian_1 + s15*jacobian_2 + s12*jacobian_4)
    w[75] = p21*(s15 + s8 - s7)
    w[76] = p21*(s12 - s6)
    w[77] = p22*(s15*jacobian_3 + s12*jacobian_5 + s9*jacobian_6 + s6*jacobian_8)
    w[78] = p23*(s9 + s17)
    w[79] = p23*(s6 + s16)
    w[80] = p24*(s9*jacobian_7 + s6*jacobian_9 + s17*jacobian_10 + s16*jacobian_11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(8):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(8):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def norm(w, first):
    """Euclidean norm of a section of 8 rows."""
    total = 0.0
    for i in range(first, first + 8):
        total += w[i] * w[i]
    return math.sqrt(total)


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    bits = 0
    geometry(t, y, p, w)
    violation = norm(w, PHI)
    tolerance = p[15] * w[6]
    last = math.inf
    for _ in range(12):
        # at the floor of rounding another iteration gains nothing
        if violation <= tolerance or (violation > 0.5 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        for i in range(8):
            w[RIGHT + i] = -w[PHI + i]
        spread(p, w)
        for j in range(9):
            y[j] += w[CHANGE + j]
        iw[3] += 1
        bits |= 2
        geometry(t, y, p, w)
        violation = norm(w, PHI)
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    drift(y, w)
    for i in range(8):
        w[RIGHT + i] = -w[DRIFT + i]
    spread(p, w)
    for j in range(9):
        y[9 + j] += w[CHANGE + j]
    drift(y, w)
    bits |= 2
    energies(t, y, p, w)
    smallest = 1.0
    rank = 0
    for i in range(8):
        pivot = w[PIVOT + i]
        if pivot >= 1e-12:
            rank += 1
        if w[MASK + i] == 0.0 and pivot < smallest:
            smallest = pivot
    w[0] = violation
    w[1] = norm(w, DRIFT)
    w[4] = smallest
    w[5] = rank
    return bits
