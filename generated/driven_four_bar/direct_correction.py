"""Method `direct-correction` for model `driven-four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = identity
p[17] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import geometry, measure, spread

MASK = 24  # sections of w
SAVED = 33
PIVOT = 60
CHANGE = 69


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 18 operations, 35 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    s3 = 1.0/p0
    s4 = 1.0/(0.3333333333333333*p0)
    s5 = 1.0/p1
    s6 = 1.0/p2
    s7 = s0*s3
    s8 = s1*s5
    s9 = s2*s6
    # outputs
    p[18] = s0
    p[19] = s1
    p[20] = s2
    p[21] = s3
    p[22] = s4
    p[23] = s5
    p[24] = 1.0/(5.333333333333333*p1)
    p[25] = s6
    p[26] = 1.0/(2.083333333333333*p2)
    p[27] = s7
    p[28] = s9
    p[29] = s7 - s8
    p[30] = s8 - s9
    p[31] = 1e-06*s4
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 335 operations, 2491705 before sharing."""
    # inputs
    p4 = p[4]  # crank_speed [rad/s]
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
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    mask_0 = w[24]
    mask_1 = w[25]
    mask_2 = w[26]
    mask_3 = w[27]
    mask_4 = w[28]
    mask_5 = w[29]
    mask_6 = w[30]
    mask_7 = w[31]
    mask_8 = w[32]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    p29 = p[29]
    p30 = p[30]
    p31 = p[31]
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
    s19 = s1*p22
    s20 = s0*p22
    s21 = s8*p24
    s22 = s7*p24
    s23 = s15*p26
    s24 = s14*p26
    s25 = s1*s19
    s26 = p21 + s25
    s27 = s0*s19
    s28 = s25 - p21
    s29 = s0*s20
    s30 = p21 + s29
    s31 = s8*s21
    s32 = p23 + s26 + s31
    s33 = s7*s21
    s34 = s31 - p23
    s35 = s7*s22
    s36 = p23 + s30 + s35
    s37 = s8*s22
    s38 = s15*s23
    s39 = p25 + p23 + s31 + s38
    s40 = s14*s23
    s41 = p25 - s38
    s42 = s14*s24
    s43 = p25 + p23 + s35 + s42
    s44 = s15*s24
    s45 = p25 + s42
    s46 = 1.0/(mask_6 + p25 + s38)
    s47 = s40*s46
    s48 = s41*s46
    s49 = s44*s46
    s50 = s40 + s41*s47
    s51 = p25 - s42 + s44*s47
    s52 = mask_7 + s45 - s40*s47
    s53 = 1.0/s52
    s54 = s50*s53
    s55 = s51*s53
    s56 = s33 + s40 + s44*s48 + s51*s54
    s57 = mask_4 + s39 - s41*s48 - s50*s54
    s58 = 1.0/s57
    s59 = s56*s58
    s60 = s34*s58
    s61 = s37*s58
    s62 = s34*s59 - s33
    s63 = s35 - p23 - s37*s59
    s64 = mask_5 + s43 - s44*s49 - s51*s55 - s56*s59
    s65 = 1.0/s64
    s66 = s62*s65
    s67 = s63*s65
    s68 = 1.0/(mask_0 + s26)
    s69 = s27*s68
    s70 = s19*s68
    s71 = s28*s68
    s72 = s27*s69
    s73 = s19*s69 - s20
    s74 = s28*s69 - s1*s20
    s75 = s29 - p21 - s72
    s76 = mask_1 + s30 - s72
    s77 = 1.0/s76
    s78 = s73*s77
    s79 = s74*s77
    s80 = s75*s77
    s81 = s19 - s28*s70 - s74*s78
    s82 = s27*s70 - s20 - s75*s78
    s83 = mask_8 + p22 - s19*s70 - s73*s78
    s84 = 1.0/s83
    s85 = s81*s84
    s86 = s82*s84
    s87 = s37*s60 - (s27 + s33) - s63*s66 + s27*s71 - s75*s79 - s82*s85
    s88 = mask_2 + s32 - s34*s60 - s62*s66 - s28*s71 - s74*s79 - s81*s85
    s89 = 1.0/s88
    s90 = s87*s89
    s91 = mask_3 + s36 - s37*s61 - s63*s67 - s72 - s75*s80 - s82*s86 - s87*s90
    s92 = s18 - p28 + s17*s47
    s93 = s10 - s17 - s17*s48 - s54*s92
    s94 = p30 - (s18 - s11) - s17*s49 - s55*s92 + s59*s93
    s95 = s3*s69
    s96 = s4 - p27 + s95
    s97 = s3*s70 + s78*s96
    s98 = s3 + s10 - s60*s93 - s66*s94 - s3*s71 - s79*s96 + s85*s97
    s99 = 1.0/s91*(s4 + s11 + p29 + s61*s93 - s67*s94 + s95 - s80*s96 + s86*s97 - s90*s98)
    s100 = s89*s98
    s101 = s90*s99
    s102 = s100 - s101
    s103 = s84*s97 + s85*s102 + s86*s99
    s104 = s77*s96 + s78*s103 - s79*s102 - s80*s99
    s105 = s3*s68 + s69*s104 + s70*s103 - s71*s102 + s69*s99
    s106 = s65*s94 - s66*s102
    s107 = s67*s99
    s108 = s106 - s107
    s109 = s58*s93 + s59*s108 - s60*s102 + s61*s99
    s110 = s53*s92 - s54*s109 - s55*s108
    s111 = s17*s46 + s47*s110 - s48*s109 - s49*s108
    s112 = (((((s52 < 1e-06*s45) | (s57 < 1e-06*s39)) | (s64 < 1e-06*s43)) | (s76 < 1e-06*s30)) | (s83 < p31))
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
    ydot[9] = -p21*(s105 + s101 - s100)
    ydot[10] = -p21*(p18 + s104 - s99)
    ydot[11] = p22*(s103 - (s1*s105 - s0*s104 + s1*s102 - s0*s99))
    ydot[12] = p23*(s109 - s102)
    ydot[13] = -p23*(p19 + s99 + s107 - s106)
    ydot[14] = p24*(s7*s108 - (s8*s102 - s7*s99 + s8*s109))
    ydot[15] = -p25*(s109 + s111)
    ydot[16] = -p25*(p20 + s108 + s110)
    ydot[17] = p26*(s14*s110 - (s14*s108 - s15*s109 + s15*s111))
    ydot[18] = p4*s103
    w[15] = s105
    w[16] = s104
    w[17] = s102
    w[18] = s99
    w[19] = s109
    w[20] = s108
    w[21] = s111
    w[22] = s110
    w[23] = -s103
    return int(((s112 | (s88 < 1e-06*s32)) | (s91 < 1e-06*s36)))


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(9):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(9):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[17] * w[6]
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
