"""Method `baumgarte` for model `driven-four-bar`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[17] alpha (default 5.0)
p[18] beta (default 5.0)
"""

import math

from numba import njit

from .model import geometry, measure

MASK = 24  # sections of w
SAVED = 33
PIVOT = 60
CHANGE = 69


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 20 operations, 37 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p17 = p[17]
    p18 = p[18]
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
    p[19] = s0
    p[20] = s1
    p[21] = s2
    p[22] = 2.0*p17
    p[23] = p18*p18
    p[24] = s3
    p[25] = s4
    p[26] = s5
    p[27] = 1.0/(5.333333333333333*p1)
    p[28] = s6
    p[29] = 1.0/(2.083333333333333*p2)
    p[30] = s7
    p[31] = s9
    p[32] = s7 - s8
    p[33] = s8 - s9
    p[34] = 1e-06*s4
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by baumgarte; 1 where a pivot of S is suspicious: 415 operations, 2579585 before sharing."""
    # inputs
    p3 = p[3]  # crank_start [rad]
    p4 = p[4]  # crank_speed [rad/s]
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    mask_0 = w[24]
    mask_1 = w[25]
    mask_2 = w[26]
    mask_3 = w[27]
    mask_4 = w[28]
    mask_5 = w[29]
    mask_6 = w[30]
    mask_7 = w[31]
    mask_8 = w[32]
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
    p32 = p[32]
    p33 = p[33]
    p34 = p[34]
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
    s19 = v2*s1
    s20 = v2*s0
    s21 = v5*s8
    s22 = v5*s7
    s23 = v8*s15
    s24 = v8*s14
    s25 = s3 + (v0 + s19)*p22 + (q0 - s0)*p23
    s26 = s17 + (v6 + s23)*p22 + (q6 - 10.0 - s14)*p23
    s27 = s1*p25
    s28 = s0*p25
    s29 = s8*p27
    s30 = s7*p27
    s31 = s15*p29
    s32 = s14*p29
    s33 = s1*s27
    s34 = p24 + s33
    s35 = s0*s27
    s36 = s33 - p24
    s37 = s0*s28
    s38 = p24 + s37
    s39 = s8*s29
    s40 = p26 + s34 + s39
    s41 = s7*s29
    s42 = s39 - p26
    s43 = s7*s30
    s44 = p26 + s38 + s43
    s45 = s8*s30
    s46 = s15*s31
    s47 = p28 + p26 + s39 + s46
    s48 = s14*s31
    s49 = p28 - s46
    s50 = s14*s32
    s51 = p28 + p26 + s43 + s50
    s52 = s15*s32
    s53 = p28 + s50
    s54 = 1.0/(mask_6 + p28 + s46)
    s55 = s48*s54
    s56 = s49*s54
    s57 = s52*s54
    s58 = s48 + s49*s55
    s59 = p28 - s50 + s52*s55
    s60 = mask_7 + s53 - s48*s55
    s61 = 1.0/s60
    s62 = s58*s61
    s63 = s59*s61
    s64 = s41 + s48 + s52*s56 + s59*s62
    s65 = mask_4 + s47 - s49*s56 - s58*s62
    s66 = 1.0/s65
    s67 = s64*s66
    s68 = s42*s66
    s69 = s45*s66
    s70 = s42*s67 - s41
    s71 = s43 - p26 - s45*s67
    s72 = mask_5 + s51 - s52*s57 - s59*s63 - s64*s67
    s73 = 1.0/s72
    s74 = s70*s73
    s75 = s71*s73
    s76 = 1.0/(mask_0 + s34)
    s77 = s35*s76
    s78 = s27*s76
    s79 = s36*s76
    s80 = s35*s77
    s81 = s27*s77 - s28
    s82 = s36*s77 - s1*s28
    s83 = s37 - p24 - s80
    s84 = mask_1 + s38 - s80
    s85 = 1.0/s84
    s86 = s81*s85
    s87 = s82*s85
    s88 = s83*s85
    s89 = s27 - s36*s78 - s82*s86
    s90 = s35*s78 - s28 - s83*s86
    s91 = mask_8 + p25 - s27*s78 - s81*s86
    s92 = 1.0/s91
    s93 = s89*s92
    s94 = s90*s92
    s95 = s45*s68 - (s35 + s41) - s71*s74 + s35*s79 - s83*s87 - s90*s93
    s96 = mask_2 + s40 - s42*s68 - s70*s74 - s36*s79 - s82*s87 - s89*s93
    s97 = 1.0/s96
    s98 = s95*s97
    s99 = mask_3 + s44 - s45*s69 - s71*s75 - s80 - s83*s88 - s90*s94 - s95*s98
    s100 = s18 + (v7 - s24)*p22 + (q7 - s15)*p23 - p31 + s26*s55
    s101 = (q6 - q3 + s14 - s7)*p23 - (s17 - s10 - (v6 + s21 - v3 - s23)*p22) - s26*s56 - s62*s100
    s102 = p33 - (s18 - s11 - (v7 - (v4 + s22) + s24)*p22 - (q7 - q4 + s15 - s8)*p23) - s26*s57 - s63*s100
    s103 = s102 + s67*s101
    s104 = s4 + s11 + (v4 - (v1 + s20) - s22)*p22 + (q4 - q1 - s8 - s1)*p23 + p32 + s69*s101 - s75*s103
    s105 = s25*s77
    s106 = s4 + (v1 - s20)*p22 + (q1 - s1)*p23 - p30 + s105
    s107 = s3 + s10 + (v3 + s19 - v0 + s21)*p22 + (q3 - q0 - s7 - s0)*p23 - s68*s101 - s74*s103 - s25*s79
    s108 = (v2 - p4)*p22 + (q2 - (p3 + t*p4))*p23 - s25*s78 - s86*s106
    s109 = s107 - s87*s106 - s93*s108
    s110 = 1.0/s99*(s104 + s105 - s88*s106 - s94*s108 - s98*s109)
    s111 = s97*s109
    s112 = s98*s110
    s113 = s111 - s112
    s114 = s92*s108 - s93*s113 - s94*s110
    s115 = s85*s106 - s86*s114 - s87*s113 - s88*s110
    s116 = s25*s76 + s77*s115 - s78*s114 - s79*s113 + s77*s110
    s117 = s73*s103 - s74*s113
    s118 = s75*s110
    s119 = s117 - s118
    s120 = s66*s101 + s67*s119 - s68*s113 + s69*s110
    s121 = s61*s100 - s62*s120 - s63*s119
    s122 = s26*s54 + s55*s121 - s56*s120 - s57*s119
    s123 = (((((s60 < 1e-06*s53) | (s65 < 1e-06*s47)) | (s72 < 1e-06*s51)) | (s84 < 1e-06*s38)) | (s91 < p34))
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
    ydot[9] = -p24*(s116 + s112 - s111)
    ydot[10] = -p24*(p19 + s115 - s110)
    ydot[11] = -p25*(s114 + s1*s116 - s0*s115 + s1*s113 - s0*s110)
    ydot[12] = p26*(s120 - s113)
    ydot[13] = -p26*(p20 + s110 + s118 - s117)
    ydot[14] = p27*(s7*s119 - (s8*s113 - s7*s110 + s8*s120))
    ydot[15] = -p28*(s120 + s122)
    ydot[16] = -p28*(p21 + s119 + s121)
    ydot[17] = p29*(s14*s121 - (s14*s119 - s15*s120 + s15*s122))
    ydot[18] = -p4*s114
    w[15] = s116
    w[16] = s115
    w[17] = s113
    w[18] = s110
    w[19] = s120
    w[20] = s119
    w[21] = s122
    w[22] = s121
    w[23] = s114
    return int(((s123 | (s96 < 1e-06*s40)) | (s99 < 1e-06*s44)))


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
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
