"""Method `baumgarte` for model `four-bar`, for CUDA. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[15] alpha (default 5.0)
p[16] beta (default 5.0)
"""

import math

from numba import cuda

from .model_cuda import geometry, measure

MASK = 23  # sections of w
SAVED = 31
PIVOT = 55
CHANGE = 63


@cuda.jit(device=True)
def prepare(p):
    """numbers that depend on parameters alone: 19 operations, 34 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]
    p16 = p[16]
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
    p[17] = s0
    p[18] = s1
    p[19] = s2
    p[20] = 2.0*p15
    p[21] = p16*p16
    p[22] = s3
    p[23] = 1.0/(0.3333333333333333*p0)
    p[24] = s4
    p[25] = 1.0/(5.333333333333333*p1)
    p[26] = s5
    p[27] = 1.0/(2.083333333333333*p2)
    p[28] = s6
    p[29] = s8
    p[30] = s6 - s7
    p[31] = s7 - s8
    return 0


@cuda.jit(device=True)
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by baumgarte; 1 where a pivot of S is suspicious: 359 operations, 1499485 before sharing."""
    # inputs
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
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    p20 = p[20]
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
    s19 = v2*s1
    s20 = v2*s0
    s21 = v5*s8
    s22 = v5*s7
    s23 = v8*s15
    s24 = v8*s14
    s25 = s3 + (v0 + s19)*p20 + (q0 - s0)*p21
    s26 = s17 + (v6 + s23)*p20 + (q6 - 10.0 - s14)*p21
    s27 = s1*p23
    s28 = s0*p23
    s29 = s8*p25
    s30 = s7*p25
    s31 = s15*p27
    s32 = s14*p27
    s33 = s1*s27
    s34 = p22 + s33
    s35 = s0*s27
    s36 = s33 - p22
    s37 = s0*s28
    s38 = p22 + s37
    s39 = s8*s29
    s40 = p24 + s34 + s39
    s41 = s7*s29
    s42 = s39 - p24
    s43 = s7*s30
    s44 = p24 + s38 + s43
    s45 = s15*s31
    s46 = p26 + p24 + s39 + s45
    s47 = s14*s31
    s48 = p26 - s45
    s49 = s14*s32
    s50 = p26 + p24 + s43 + s49
    s51 = s15*s32
    s52 = p26 + s49
    s53 = 1.0/(mask_0 + s34)
    s54 = s35*s53
    s55 = s36*s53
    s56 = s35*s54
    s57 = s36*s54 - s1*s28
    s58 = s37 - p22 - s56
    s59 = mask_1 + s38 - s56
    s60 = 1.0/s59
    s61 = s57*s60
    s62 = s58*s60
    s63 = s35*s55 - (s35 + s41) - s58*s61
    s64 = 1.0/(mask_6 + p26 + s45)
    s65 = s47*s64
    s66 = s48*s64
    s67 = s51*s64
    s68 = s47 + s48*s65
    s69 = p26 - s49 + s51*s65
    s70 = mask_7 + s52 - s47*s65
    s71 = 1.0/s70
    s72 = s68*s71
    s73 = s69*s71
    s74 = mask_2 + s40 - s36*s55 - s57*s61
    s75 = 1.0/s74
    s76 = s63*s75
    s77 = s42*s75
    s78 = s41*s75
    s79 = s8*s30 + s42*s76
    s80 = s43 - p24 + s41*s76
    s81 = mask_3 + s44 - s56 - s58*s62 - s63*s76
    s82 = 1.0/s81
    s83 = s79*s82
    s84 = s80*s82
    s85 = s41*s77 - (s41 + s47 + s51*s66 + s69*s72) + s80*s83
    s86 = mask_4 + s46 - s48*s66 - s68*s72 - s42*s77 - s79*s83
    s87 = 1.0/s86
    s88 = s85*s87
    s89 = mask_5 + s50 - s51*s67 - s69*s73 - s41*s78 - s80*s84 - s85*s88
    s90 = s25*s54
    s91 = s4 + (v1 - s20)*p20 + (q1 - s1)*p21 - p28 + s90
    s92 = s3 + s10 + (v3 + s19 - v0 + s21)*p20 + (q3 - q0 - s7 - s0)*p21 - s25*s55 - s61*s91
    s93 = s18 + (v7 - s24)*p20 + (q7 - s15)*p21 - p29 + s26*s65
    s94 = p31 - (s18 - s11 - (v7 - (v4 + s22) + s24)*p20 - (q7 - q4 + s15 - s8)*p21) - s26*s67 - s73*s93
    s95 = s4 + s11 + (v4 - (v1 + s20) - s22)*p20 + (q4 - q1 - s8 - s1)*p21 + p30 + s90 - s62*s91 - s76*s92
    s96 = (q6 - q3 + s14 - s7)*p21 - (s17 - s10 - (v6 + s21 - v3 - s23)*p20) - s26*s66 - s72*s93 - s77*s92
    s97 = s96 + s83*s95
    s98 = 1.0/s89*(s94 + s78*s92 - s84*s95 - s88*s97)
    s99 = s87*s97
    s100 = s88*s98
    s101 = s99 - s100
    s102 = s82*s95 + s83*s101
    s103 = s84*s98
    s104 = s102 - s103
    s105 = s75*s92 - s76*s104 - s77*s101 + s78*s98
    s106 = s71*s93 - s72*s101 - s73*s98
    s107 = s26*s64 + s65*s106 - s66*s101 - s67*s98
    s108 = s60*s91 - s61*s105 - s62*s104
    s109 = s25*s53 + s54*s108 - s55*s105 + s54*s104
    s110 = (((((s59 < 1e-06*s38) | (s70 < 1e-06*s52)) | (s74 < 1e-06*s40)) | (s81 < 1e-06*s44)) | (s86 < 1e-06*s46))
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
    ydot[9] = p22*(s105 - s109)
    ydot[10] = -p22*(p17 + s108 + s103 - s102)
    ydot[11] = p23*(s0*s104 - (s1*s109 - s0*s108 + s1*s105))
    ydot[12] = -p24*(s105 + s100 - s99)
    ydot[13] = -p24*(p18 + s104 - s98)
    ydot[14] = p25*(s7*s98 - (s8*s105 - s7*s104 + s8*s101))
    ydot[15] = -p26*(s101 + s107)
    ydot[16] = -p26*(p19 + s98 + s106)
    ydot[17] = p27*(s14*s106 - (s14*s98 - s15*s101 + s15*s107))
    ydot[18] = 0.0
    w[15] = s109
    w[16] = s108
    w[17] = s105
    w[18] = s104
    w[19] = s101
    w[20] = s98
    w[21] = s107
    w[22] = s106
    return int((s110 | (s89 < 1e-06*s50)))


@cuda.jit(device=True)
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


@cuda.jit(device=True)
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
