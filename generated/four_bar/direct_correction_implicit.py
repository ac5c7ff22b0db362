"""Method `direct-correction` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = identity
p[15] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import geometry, measure, spread

MASK = 23  # sections of w
SAVED = 31
PIVOT = 55
CHANGE = 63


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 17 operations, 35 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 0.3333333333333333*p0
    s1 = 9.81*p0
    s2 = 5.333333333333333*p1
    s3 = 9.81*p1
    s4 = 2.083333333333333*p2
    s5 = 9.81*p2
    s6 = 1.0/p0
    s7 = 1.0/p1
    s8 = 1.0/p2
    s9 = s1*s6
    s10 = s3*s7
    s11 = s5*s8
    # outputs
    p[16] = s1
    p[17] = s3
    p[18] = s5
    p[19] = s6
    p[20] = 1.0/s0
    p[21] = s7
    p[22] = 1.0/s2
    p[23] = s8
    p[24] = 1.0/s4
    p[25] = s9
    p[26] = s11
    p[27] = s9 - s10
    p[28] = s10 - s11
    p[29] = s0
    p[30] = s2
    p[31] = s4
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 288 operations, 1442826 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
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
    w[15] = s99
    w[16] = s98
    w[17] = s95
    w[18] = s94
    w[19] = s91
    w[20] = s88
    w[21] = s97
    w[22] = s96
    return int((s100 | (s81 < 1e-06*s42)))


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, k, p, w, r):
    """F(t, y, k) of the descriptor form, and the power: 112 operations, 181 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p29 = p[29]
    p16 = p[16]
    p30 = p[30]
    p17 = p[17]
    p31 = p[31]
    p18 = p[18]
    k0 = k[0]
    k1 = k[1]
    k2 = k[2]
    k3 = k[3]
    k4 = k[4]
    k5 = k[5]
    k6 = k[6]
    k7 = k[7]
    k8 = k[8]
    k9 = k[9]
    k10 = k[10]
    k11 = k[11]
    k12 = k[12]
    k13 = k[13]
    k14 = k[14]
    k15 = k[15]
    k16 = k[16]
    k17 = k[17]
    k18 = k[18]
    k19 = k[19]
    k20 = k[20]
    k21 = k[21]
    k22 = k[22]
    k23 = k[23]
    k24 = k[24]
    k25 = k[25]
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
    s19 = s1*k11
    s20 = s0*k11
    s21 = s8*k14
    s22 = s7*k14
    s23 = s15*k17
    s24 = s14*k17
    # outputs
    r[0] = k0 - v0
    r[1] = k1 - v1
    r[2] = k2 - v2
    r[3] = k3 - v3
    r[4] = k4 - v4
    r[5] = k5 - v5
    r[6] = k6 - v6
    r[7] = k7 - v7
    r[8] = k8 - v8
    r[9] = p0*k9 + k18 - k20
    r[10] = p16 + p0*k10 + k19 - k21
    r[11] = p29*k11 + s1*k18 - s0*k19 + s1*k20 - s0*k21
    r[12] = p1*k12 + k20 - k22
    r[13] = p17 + p1*k13 + k21 - k23
    r[14] = p30*k14 + s8*k20 - s7*k21 + s8*k22 - s7*k23
    r[15] = p2*k15 + k22 + k24
    r[16] = p18 + p2*k16 + k23 + k25
    r[17] = p31*k17 + s14*k23 - s15*k22 + s15*k24 - s14*k25
    r[18] = s3 + k9 + s19
    r[19] = s4 + k10 - s20
    r[20] = s3 + s10 + k12 + s19 - k9 + s21
    r[21] = s4 + s11 + k13 - (k10 + s20) - s22
    r[22] = k15 + s21 - k12 - s23 - (s17 - s10)
    r[23] = k16 - (k13 + s22) + s24 - (s18 - s11)
    r[24] = s17 + k15 + s23
    r[25] = s18 + k16 - s24
    w[14] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """entries of dF/dk and dF/dy of the descriptor form: 73 operations, 228 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    p29 = p[29]
    p30 = p[30]
    p31 = p[31]
    k11 = k[11]
    k14 = k[14]
    k17 = k[17]
    k18 = k[18]
    k19 = k[19]
    k20 = k[20]
    k21 = k[21]
    k22 = k[22]
    k23 = k[23]
    k24 = k[24]
    k25 = k[25]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = -s0
    s4 = math.cos(q5)
    s5 = math.sin(q5)
    s6 = 4.0*s4
    s7 = -s6
    s8 = 4.0*s5
    s9 = 4.0*(v5*v5)
    s10 = math.cos(q8)
    s11 = math.sin(q8)
    s12 = 2.5*s10
    s13 = 2.5*s11
    s14 = -s13
    s15 = 2.5*(v8*v8)
    s16 = s11*s15
    s17 = -s12
    s18 = s12*k17
    s19 = v2 + v2
    s20 = s0*s19
    s21 = s1*s19
    s22 = 4.0*(v5 + v5)
    s23 = s4*s22
    s24 = s5*s22
    s25 = 2.5*(v8 + v8)
    s26 = s10*s25
    s27 = s11*s25
    s28 = s0*k11 - s1*s2
    s29 = s0*s2 + s1*k11
    s30 = s6*k14 - s5*s9
    s31 = s4*s9 + s8*k14
    s32 = s10*s15 + s13*k17
    # outputs
    j[0] = 1.0
    j[1] = -1.0
    j[2] = 1.0
    j[3] = -1.0
    j[4] = 1.0
    j[5] = -1.0
    j[6] = 1.0
    j[7] = -1.0
    j[8] = 1.0
    j[9] = -1.0
    j[10] = 1.0
    j[11] = -1.0
    j[12] = 1.0
    j[13] = -1.0
    j[14] = 1.0
    j[15] = -1.0
    j[16] = 1.0
    j[17] = -1.0
    j[18] = p0
    j[19] = 1.0
    j[20] = -1.0
    j[21] = p0
    j[22] = 1.0
    j[23] = -1.0
    j[24] = p29
    j[25] = s1
    j[26] = s3
    j[27] = s1
    j[28] = s3
    j[29] = s0*k18 + s1*k19 + s0*k20 + s1*k21
    j[30] = p1
    j[31] = 1.0
    j[32] = -1.0
    j[33] = p1
    j[34] = 1.0
    j[35] = -1.0
    j[36] = p30
    j[37] = s8
    j[38] = s7
    j[39] = s8
    j[40] = s7
    j[41] = s6*k20 + s8*k21 + s6*k22 + s8*k23
    j[42] = p2
    j[43] = 1.0
    j[44] = 1.0
    j[45] = p2
    j[46] = 1.0
    j[47] = 1.0
    j[48] = p31
    j[49] = s14
    j[50] = s12
    j[51] = s13
    j[52] = s17
    j[53] = s12*k24 - (s12*k22 + s13*k23) + s13*k25
    j[54] = 1.0
    j[55] = s1
    j[56] = s28
    j[57] = s20
    j[58] = 1.0
    j[59] = s3
    j[60] = s29
    j[61] = s21
    j[62] = -1.0
    j[63] = s1
    j[64] = 1.0
    j[65] = s8
    j[66] = s28
    j[67] = s30
    j[68] = s20
    j[69] = s23
    j[70] = -1.0
    j[71] = s3
    j[72] = 1.0
    j[73] = s7
    j[74] = s29
    j[75] = s31
    j[76] = s21
    j[77] = s24
    j[78] = -1.0
    j[79] = s8
    j[80] = 1.0
    j[81] = s14
    j[82] = s30
    j[83] = s16 - s18
    j[84] = s23
    j[85] = -s26
    j[86] = -1.0
    j[87] = s7
    j[88] = 1.0
    j[89] = s12
    j[90] = s31
    j[91] = -s32
    j[92] = s24
    j[93] = -s27
    j[94] = 1.0
    j[95] = s13
    j[96] = s18 - s16
    j[97] = s26
    j[98] = 1.0
    j[99] = s17
    j[100] = s32
    j[101] = s27
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
    measure(t, y, p, w)
    return bits
