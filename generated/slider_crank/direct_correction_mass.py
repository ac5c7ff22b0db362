"""Method `direct-correction` for model `slider-crank`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = mass
p[13] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MASK = 23  # sections of w
SAVED = 31
PIVOT = 55
CHANGE = 63


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 18 operations, 42 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # rod_mass [kg]
    p2 = p[2]  # slider_mass [kg]
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
    s9 = 1.0/s5
    s10 = s5*s9
    # outputs
    p[14] = s0
    p[15] = s1
    p[16] = s2
    p[17] = s3
    p[18] = 1.0/(0.001875*p0)
    p[19] = s4
    p[20] = 1.0/(0.016875*p1)
    p[21] = s5
    p[22] = s6
    p[23] = s8
    p[24] = s6 - s7
    p[25] = s7 - s8
    p[26] = s9
    p[27] = s10
    p[28] = s5*s10
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 214 operations, 156132 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # rod.theta [rad]
    v3 = y[12]  # rod.vx [m/s]
    v4 = y[13]  # rod.vy [m/s]
    v5 = y[14]  # rod.omega [rad/s]
    v6 = y[15]  # slider.vx [m/s]
    v7 = y[16]  # slider.vy [m/s]
    v8 = y[17]  # slider.omega [rad/s]
    p14 = p[14]
    p15 = p[15]
    p16 = p[16]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 0.075*s0
    s3 = 0.075*s1
    s4 = 0.075*(v2*v2)
    s5 = s0*s4
    s6 = s1*s4
    s7 = math.cos(q5)
    s8 = math.sin(q5)
    s9 = 0.225*s7
    s10 = 0.225*s8
    s11 = 0.225*(v5*v5)
    s12 = s7*s11
    s13 = s8*s11
    s14 = s3*p18
    s15 = s2*p18
    s16 = s10*p20
    s17 = s9*p20
    s18 = s3*s14
    s19 = p17 + s18
    s20 = s2*s14
    s21 = s18 - p17
    s22 = s2*s15
    s23 = p17 + s22
    s24 = s10*s16
    s25 = p19 + s19 + s24
    s26 = s9*s16
    s27 = s24 - p19
    s28 = s9*s17
    s29 = p19 + s23 + s28
    s30 = s10*s17
    s31 = p21 + p19 + s28
    s32 = 1.0/(mask_6 + p21)
    s33 = p21*s32
    s34 = 1.0/(mask_0 + s19)
    s35 = s20*s34
    s36 = s21*s34
    s37 = s20*s35
    s38 = s21*s35 - s3*s15
    s39 = s22 - p17 - s37
    s40 = mask_1 + s23 - s37
    s41 = 1.0/s40
    s42 = s38*s41
    s43 = s39*s41
    s44 = 1.0/(mask_4 + p21 + p19 + s24)
    s45 = s26*s44
    s46 = s27*s44
    s47 = s30*s44
    s48 = s27*s45 - s26
    s49 = s28 - p19 - s30*s45
    s50 = mask_5 + s31 - p21*s33 - s26*s45
    s51 = 1.0/s50
    s52 = s48*s51
    s53 = s49*s51
    s54 = s20*s36 - (s20 + s26) - s39*s42 + s30*s46 - s49*s52
    s55 = mask_2 + s25 - s21*s36 - s38*s42 - s27*s46 - s48*s52
    s56 = 1.0/s55
    s57 = s54*s56
    s58 = mask_3 + s29 - s37 - s39*s43 - s30*s47 - s49*s53 - s54*s57
    s59 = s5*s35
    s60 = s6 - p22 + s59
    s61 = s13 + p25 + p23*s33 + s12*s45
    s62 = s5 + s12 - s5*s36 - s42*s60 - s12*s46 - s52*s61
    s63 = 1.0/s58*(s6 + s13 + p24 + s59 - s43*s60 + s12*s47 - s53*s61 - s57*s62)
    s64 = s56*s62
    s65 = s57*s63
    s66 = s64 - s65
    s67 = s51*s61 - s52*s66
    s68 = s53*s63
    s69 = s67 - s68
    s70 = s12*s44 + s45*s69 - s46*s66 + s47*s63
    s71 = s41*s60 - s42*s66 - s43*s63
    s72 = s5*s34 + s35*s71 - s36*s66 + s35*s63
    s73 = p23*s32 + s33*s69
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
    ydot[9] = -p17*(s72 + s65 - s64)
    ydot[10] = -p17*(p14 + s71 - s63)
    ydot[11] = p18*(s2*s63 - (s3*s72 - s2*s71 + s3*s66))
    ydot[12] = p19*(s70 - s66)
    ydot[13] = -p19*(p15 + s63 + s68 - s67)
    ydot[14] = p20*(s9*s69 - (s10*s66 - s9*s63 + s10*s70))
    ydot[15] = -p21*s70
    ydot[16] = -p21*(p16 + s69 - s73)
    ydot[17] = 0.0
    ydot[18] = 0.0
    w[15] = s72
    w[16] = s71
    w[17] = s66
    w[18] = s63
    w[19] = s70
    w[20] = s69
    w[21] = -s73
    w[22] = 0.0
    return int(((((s40 < 1e-06*s23) | (s50 < 1e-06*s31)) | (s55 < 1e-06*s25)) | (s58 < 1e-06*s29)))


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 233 operations, 19246 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # rod.x [m]
    q4 = y[4]  # rod.y [m]
    q5 = y[5]  # rod.theta [rad]
    q6 = y[6]  # slider.x [m]
    q7 = y[7]  # slider.y [m]
    q8 = y[8]  # slider.theta [rad]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_5 = w[28]
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    # intermediate terms
    s0 = 0.075*math.cos(q2)
    s1 = -s0
    s2 = q0 - s0
    s3 = 0.075*math.sin(q2)
    s4 = q1 - s3
    s5 = 0.225*math.cos(q5)
    s6 = -s5
    s7 = q3 - q0 - s5 - s0
    s8 = 0.225*math.sin(q5)
    s9 = q4 - q1 - s8 - s3
    s10 = q6 - q3 - s5
    s11 = q7 - q4 - s8
    s12 = s3*p18
    s13 = s0*p18
    s14 = s8*p20
    s15 = s5*p20
    s16 = s3*s12
    s17 = p17 + s16
    s18 = s0*s12
    s19 = s16 - p17
    s20 = s0*s13
    s21 = p17 + s20
    s22 = s8*s14
    s23 = s5*s14
    s24 = s22 - p19
    s25 = s5*s15
    s26 = s8*s15
    s27 = s3*s3
    s28 = 1.0 + s27
    s29 = s0*s3
    s30 = -1.0 + s27
    s31 = s0*s0
    s32 = 1.0 + s31
    s33 = s8*s8
    s34 = 1.0 + s28 + s33
    s35 = s5*s8
    s36 = -1.0 + s33
    s37 = s5*s5
    s38 = 1.0 + s32 + s37
    s39 = 1.0 + 1.0 + s37
    s40 = 1.0/s28
    s41 = s29*s40
    s42 = s30*s40
    s43 = s29*s41
    s44 = s32 - s43
    s45 = s30*s41 - s29
    s46 = -1.0 + s31 - s43
    s47 = 1.0*(s44 > mask_1 + 1e-12*s32)
    s48 = 1.0 - s47
    s49 = s47/(s44 + s48)
    s50 = s45*s49
    s51 = 1.0/(1.0 + 1.0 + s33)
    s52 = s35*s51
    s53 = s36*s51
    s54 = s35*s52
    s55 = s39 - 1.0 - s54
    s56 = s36*s52 - s35
    s57 = -1.0 + s37 - s54
    s58 = 1.0*(s55 > mask_5 + 1e-12*s39)
    s59 = 1.0 - s58
    s60 = s58/(s55 + s59)
    s61 = s56*s60
    s62 = s34 - s30*s42 - s45*s50 - s36*s53 - s56*s61
    s63 = s29*s42 - (s29 + s35) - s46*s50 + s35*s53 - s57*s61
    s64 = 1.0*(s62 > mask_2 + 1e-12*s34)
    s65 = 1.0 - s64
    s66 = s38 - s43 - s46*(s46*s49) - s54 - s57*(s57*s60) - s63*(s63*(s64/(s62 + s65)))
    s67 = 1.0*(s66 > mask_3 + 1e-12*s38)
    s68 = 1.0/s17
    s69 = s18*s68
    s70 = -s69
    s71 = s19*s68
    s72 = s18*s69
    s73 = s19*s69 - s3*s13
    s74 = s20 - p17 - s72
    s75 = s47/(s48 + s21 - s72)
    s76 = s73*s75
    s77 = s74*s75
    s78 = 1.0/(p21 + p19 + s22)
    s79 = s23*s78
    s80 = s24*s78
    s81 = s26*s78
    s82 = s24*s79 - s23
    s83 = s25 - p19 - s26*s79
    s84 = s58/(s59 + p21 + p19 + s25 - p28 - s23*s79)
    s85 = s82*s84
    s86 = s83*s84
    s87 = s18*s71 - (s18 + s23) - s74*s76 + s26*s80 - s83*s85
    s88 = s64/(s65 + p19 + s17 + s22 - s19*s71 - s73*s76 - s24*s80 - s82*s85)
    s89 = s87*s88
    s90 = s44/s32
    s91 = s62/s34
    s92 = s66/s38
    s93 = s55/s39
    # outputs
    w[39] = s2
    w[40] = s4
    w[41] = s7
    w[42] = s9
    w[43] = s10
    w[44] = s11
    w[45] = q7
    w[46] = q8
    w[0] = math.sqrt(s2*s2 + s4*s4 + s7*s7 + s9*s9 + s10*s10 + s11*s11 + q7*q7 + q8*q8)
    w[81] = s3
    w[82] = s1
    w[83] = s3
    w[84] = s8
    w[85] = s1
    w[86] = s6
    w[87] = s8
    w[88] = s6
    w[56] = s90
    w[57] = s91
    w[58] = s92
    w[60] = s93
    w[5] = 1.0 + 1.0 + s58 + 1.0 + s67 + s64 + 1.0 + s47
    w[4] = min(min(min(min(1.0, mask_1 + s90), mask_2 + s91), mask_3 + s92), mask_5 + s93)
    w[106] = p27
    w[107] = s70
    w[108] = s71
    w[109] = s70
    w[110] = s76
    w[111] = s77
    w[112] = -s79
    w[113] = s80
    w[114] = -s81
    w[115] = s85
    w[116] = s86
    w[117] = s89
    w[118] = p26
    w[119] = s68
    w[120] = s75
    w[121] = s78
    w[122] = s84
    w[123] = s88
    w[124] = s67/(1.0 - s67 + p19 + s21 + s25 - s72 - s74*s77 - s26*s81 - s83*s86 - s87*s89)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 86 operations, 1738 before sharing."""
    # inputs
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    law_lower_0 = w[106]
    law_lower_1 = w[107]
    law_lower_2 = w[108]
    law_lower_3 = w[109]
    law_lower_4 = w[110]
    law_lower_5 = w[111]
    law_lower_6 = w[112]
    law_lower_7 = w[113]
    law_lower_8 = w[114]
    law_lower_9 = w[115]
    law_lower_10 = w[116]
    law_lower_11 = w[117]
    law_reciprocal_0 = w[118]
    law_reciprocal_1 = w[119]
    law_reciprocal_2 = w[120]
    law_reciprocal_3 = w[121]
    law_reciprocal_4 = w[122]
    law_reciprocal_5 = w[123]
    law_reciprocal_6 = w[124]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    # intermediate terms
    s0 = law_lower_1*residual_0 - residual_1
    s1 = law_lower_0*residual_6 - residual_5 + law_lower_6*residual_4
    s2 = law_lower_2*residual_0 - residual_2 - law_lower_4*s0 + law_lower_7*residual_4 - law_lower_9*s1
    s3 = law_lower_3*residual_0 - residual_3 - law_lower_5*s0 + law_lower_8*residual_4 - law_lower_10*s1
    s4 = law_reciprocal_6*(s3 - law_lower_11*s2)
    s5 = law_reciprocal_5*s2
    s6 = law_lower_11*s4
    s7 = s5 - s6
    s8 = law_reciprocal_4*s1 - law_lower_9*s7
    s9 = law_lower_10*s4
    s10 = s8 - s9
    s11 = law_reciprocal_3*residual_4 + law_lower_6*s10 + law_lower_7*s7 + law_lower_8*s4
    s12 = law_reciprocal_2*s0 - law_lower_4*s7 - law_lower_5*s4
    s13 = law_reciprocal_1*residual_0 + law_lower_1*s12 + law_lower_2*s7 + law_lower_3*s4
    # outputs
    w[63] = p17*(s6 - s5 - s13)
    w[64] = p17*(s12 - s4)
    w[65] = p18*(s12*jacobian_1 - s13*jacobian_0 + s7*jacobian_2 + s4*jacobian_4)
    w[66] = p19*(s7 + s11)
    w[67] = p19*(s4 + s9 - s8)
    w[68] = p20*(s7*jacobian_3 + s4*jacobian_5 - s11*jacobian_6 + s10*jacobian_7)
    w[69] = -p21*s11
    w[70] = p21*(s10 - (law_reciprocal_0*residual_6 + law_lower_0*s10))
    w[71] = -residual_7
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
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[13] * w[6]
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
    measure(t, y, p, w)
    return bits
