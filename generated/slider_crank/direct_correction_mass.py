"""Method `direct-correction` for model `slider-crank`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 1, templates 8f8565515c2742ad
option weight = mass
p[13] tolerance (default 1e-13)
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
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # rod.vx [m/s]
    v4 = y[13]  # rod.vy [m/s]
    q5 = y[5]  # rod.theta [rad]
    v5 = y[14]  # rod.omega [rad/s]
    v6 = y[15]  # slider.vx [m/s]
    v7 = y[16]  # slider.vy [m/s]
    v8 = y[17]  # slider.omega [rad/s]
    p14 = p[14]
    p15 = p[15]
    p16 = p[16]
    mask_0 = w[16]
    mask_1 = w[17]
    mask_2 = w[18]
    mask_3 = w[19]
    mask_4 = w[20]
    mask_5 = w[21]
    mask_6 = w[22]
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
    w[8] = s72
    w[9] = s71
    w[10] = s66
    w[11] = s63
    w[12] = s70
    w[13] = s69
    w[14] = -s73
    w[15] = 0.0
    return int(((((s40 < 1e-06*s23) | (s50 < 1e-06*s31)) | (s55 < 1e-06*s25)) | (s58 < 1e-06*s29)))


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 198 operations, 13443 before sharing."""
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
    s2 = 0.075*math.sin(q2)
    s3 = 0.225*math.cos(q5)
    s4 = -s3
    s5 = 0.225*math.sin(q5)
    s6 = s2*p18
    s7 = s0*p18
    s8 = s5*p20
    s9 = s3*p20
    s10 = s2*s6
    s11 = p17 + s10
    s12 = s0*s6
    s13 = s10 - p17
    s14 = s0*s7
    s15 = p17 + s14
    s16 = s5*s8
    s17 = s3*s8
    s18 = s16 - p19
    s19 = s3*s9
    s20 = s5*s9
    s21 = s2*s2
    s22 = 1.0 + s21
    s23 = s0*s2
    s24 = -1.0 + s21
    s25 = s0*s0
    s26 = 1.0 + s25
    s27 = s5*s5
    s28 = 1.0 + s22 + s27
    s29 = s3*s5
    s30 = -1.0 + s27
    s31 = s3*s3
    s32 = 1.0 + s26 + s31
    s33 = 1.0 + 1.0 + s31
    s34 = 1.0/s22
    s35 = s23*s34
    s36 = s24*s34
    s37 = s23*s35
    s38 = s26 - s37
    s39 = s24*s35 - s23
    s40 = -1.0 + s25 - s37
    s41 = 1.0*(s38 > 1e-12*s26)
    s42 = 1.0 - s41
    s43 = s41/(s38 + s42)
    s44 = s39*s43
    s45 = 1.0/(1.0 + 1.0 + s27)
    s46 = s29*s45
    s47 = s30*s45
    s48 = s29*s46
    s49 = s33 - 1.0 - s48
    s50 = s30*s46 - s29
    s51 = -1.0 + s31 - s48
    s52 = 1.0*(s49 > 1e-12*s33)
    s53 = 1.0 - s52
    s54 = s52/(s49 + s53)
    s55 = s50*s54
    s56 = s28 - s24*s36 - s39*s44 - s30*s47 - s50*s55
    s57 = s23*s36 - (s23 + s29) - s40*s44 + s29*s47 - s51*s55
    s58 = 1.0*(s56 > 1e-12*s28)
    s59 = 1.0 - s58
    s60 = s32 - s37 - s40*(s40*s43) - s48 - s51*(s51*s54) - s57*(s57*(s58/(s56 + s59)))
    s61 = 1.0*(s60 > 1e-12*s32)
    s62 = 1.0/s11
    s63 = s12*s62
    s64 = -s63
    s65 = s13*s62
    s66 = s12*s63
    s67 = s13*s63 - s2*s7
    s68 = s14 - p17 - s66
    s69 = s41/(s42 + s15 - s66)
    s70 = s67*s69
    s71 = s68*s69
    s72 = 1.0/(p21 + p19 + s16)
    s73 = s17*s72
    s74 = s18*s72
    s75 = s20*s72
    s76 = s18*s73 - s17
    s77 = s19 - p19 - s20*s73
    s78 = s52/(s53 + p21 + p19 + s19 - p28 - s17*s73)
    s79 = s76*s78
    s80 = s77*s78
    s81 = s12*s65 - (s12 + s17) - s68*s70 + s20*s74 - s77*s79
    s82 = s58/(s59 + p19 + s11 + s16 - s13*s65 - s67*s70 - s18*s74 - s76*s79)
    s83 = s81*s82
    # outputs
    w[32] = q0 - s0
    w[33] = q1 - s2
    w[34] = q3 - q0 - s3 - s0
    w[35] = q4 - q1 - s5 - s2
    w[36] = q6 - q3 - s3
    w[37] = q7 - q4 - s5
    w[38] = q7
    w[39] = q8
    w[90] = s2
    w[91] = s1
    w[92] = s2
    w[93] = s5
    w[94] = s1
    w[95] = s4
    w[96] = s5
    w[97] = s4
    w[57] = s38/s26
    w[58] = s56/s28
    w[59] = s60/s32
    w[61] = s49/s33
    w[115] = p27
    w[116] = s64
    w[117] = s65
    w[118] = s64
    w[119] = s70
    w[120] = s71
    w[121] = -s73
    w[122] = s74
    w[123] = -s75
    w[124] = s79
    w[125] = s80
    w[126] = s83
    w[127] = p26
    w[128] = s62
    w[129] = s69
    w[130] = s72
    w[131] = s78
    w[132] = s82
    w[133] = s61/(1.0 - s61 + p19 + s15 + s19 - s66 - s68*s71 - s20*s75 - s77*s80 - s81*s83)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """change of v (or of q by N) = D^+ times the section `right`: 85 operations, 1736 before sharing."""
    # inputs
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    law_lower_0 = w[115]
    law_lower_1 = w[116]
    law_lower_2 = w[117]
    law_lower_3 = w[118]
    law_lower_4 = w[119]
    law_lower_5 = w[120]
    law_lower_6 = w[121]
    law_lower_7 = w[122]
    law_lower_8 = w[123]
    law_lower_9 = w[124]
    law_lower_10 = w[125]
    law_lower_11 = w[126]
    law_reciprocal_0 = w[127]
    law_reciprocal_1 = w[128]
    law_reciprocal_2 = w[129]
    law_reciprocal_3 = w[130]
    law_reciprocal_4 = w[131]
    law_reciprocal_5 = w[132]
    law_reciprocal_6 = w[133]
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
    # intermediate terms
    s0 = right_1 - law_lower_1*right_0
    s1 = right_5 - law_lower_0*right_6 - law_lower_6*right_4
    s2 = right_2 - law_lower_2*right_0 - law_lower_4*s0 - law_lower_7*right_4 - law_lower_9*s1
    s3 = right_3 - law_lower_3*right_0 - law_lower_5*s0 - law_lower_8*right_4 - law_lower_10*s1 - law_lower_11*s2
    s4 = law_reciprocal_6*s3
    s5 = law_reciprocal_5*s2
    s6 = law_lower_11*s4
    s7 = s5 - s6
    s8 = law_reciprocal_4*s1 - law_lower_9*s7
    s9 = law_lower_10*s4
    s10 = s8 - s9
    s11 = law_reciprocal_3*right_4 - law_lower_6*s10 - law_lower_7*s7
    s12 = law_lower_8*s4
    s13 = s11 - s12
    s14 = law_reciprocal_2*s0 - law_lower_4*s7 - law_lower_5*s4
    s15 = law_reciprocal_1*right_0 - law_lower_1*s14 - law_lower_2*s7 - law_lower_3*s4
    # outputs
    w[72] = p17*(s15 + s6 - s5)
    w[73] = p17*(s14 - s4)
    w[74] = p18*(s15*jacobian_0 + s14*jacobian_1 + s7*jacobian_2 + s4*jacobian_4)
    w[75] = p19*(s7 + s12 - s11)
    w[76] = p19*(s4 + s9 - s8)
    w[77] = p20*(s7*jacobian_3 + s4*jacobian_5 + s13*jacobian_6 + s10*jacobian_7)
    w[78] = p21*s13
    w[79] = p21*(s10 + law_reciprocal_0*right_6 - law_lower_0*s10)
    w[80] = right_7
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
    tolerance = p[13] * w[6]
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
