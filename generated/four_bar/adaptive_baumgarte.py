"""Method `adaptive-baumgarte` for model `four-bar`. Emitted by symgen; do not edit.

Baumgarte's gains bounded by a multiple of one over the step
Chang, Nikravesh, J. Mech. Trans. Autom. Des. 107 (1985) 488-492; Lin, Huang, J. Mech. Des. 124 (2002) 633-640, doi 10.1115/1.1519277
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[15] gain (default 20.0)
p[16] a (default 1.0)
"""

import math

from numba import njit

from .model import geometry, measure

MASK = 23  # sections of w
SAVED = 31
PIVOT = 55
CHANGE = 63


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
    p[17] = s0
    p[18] = s1
    p[19] = s2
    p[20] = s3
    p[21] = 1.0/(0.3333333333333333*p0)
    p[22] = s4
    p[23] = 1.0/(5.333333333333333*p1)
    p[24] = s5
    p[25] = 1.0/(2.083333333333333*p2)
    p[26] = s6
    p[27] = s8
    p[28] = s6 - s7
    p[29] = s7 - s8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by adaptive-baumgarte; 1 where a pivot of S is suspicious: 364 operations, 1552175 before sharing."""
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
    p15 = p[15]
    p16 = p[16]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    status_8 = w[8]
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
    s19 = min(p15, p16*(1.0/status_8))
    s20 = v2*s1
    s21 = v2*s0
    s22 = v5*s8
    s23 = v5*s7
    s24 = v8*s15
    s25 = v8*s14
    s26 = 2.0*s19
    s27 = s19*s19
    s28 = s3 + (v0 + s20)*s26 + (q0 - s0)*s27
    s29 = s17 + (v6 + s24)*s26 + (q6 - 10.0 - s14)*s27
    s30 = s1*p21
    s31 = s0*p21
    s32 = s8*p23
    s33 = s7*p23
    s34 = s15*p25
    s35 = s14*p25
    s36 = s1*s30
    s37 = p20 + s36
    s38 = s0*s30
    s39 = s36 - p20
    s40 = s0*s31
    s41 = p20 + s40
    s42 = s8*s32
    s43 = p22 + s37 + s42
    s44 = s7*s32
    s45 = s42 - p22
    s46 = s7*s33
    s47 = p22 + s41 + s46
    s48 = s15*s34
    s49 = p24 + p22 + s42 + s48
    s50 = s14*s34
    s51 = p24 - s48
    s52 = s14*s35
    s53 = p24 + p22 + s46 + s52
    s54 = s15*s35
    s55 = p24 + s52
    s56 = 1.0/(mask_0 + s37)
    s57 = s38*s56
    s58 = s39*s56
    s59 = s38*s57
    s60 = s39*s57 - s1*s31
    s61 = s40 - p20 - s59
    s62 = mask_1 + s41 - s59
    s63 = 1.0/s62
    s64 = s60*s63
    s65 = s61*s63
    s66 = s38*s58 - (s38 + s44) - s61*s64
    s67 = 1.0/(mask_6 + p24 + s48)
    s68 = s50*s67
    s69 = s51*s67
    s70 = s54*s67
    s71 = s50 + s51*s68
    s72 = p24 - s52 + s54*s68
    s73 = mask_7 + s55 - s50*s68
    s74 = 1.0/s73
    s75 = s71*s74
    s76 = s72*s74
    s77 = mask_2 + s43 - s39*s58 - s60*s64
    s78 = 1.0/s77
    s79 = s66*s78
    s80 = s45*s78
    s81 = s44*s78
    s82 = s8*s33 + s45*s79
    s83 = s46 - p22 + s44*s79
    s84 = mask_3 + s47 - s59 - s61*s65 - s66*s79
    s85 = 1.0/s84
    s86 = s82*s85
    s87 = s83*s85
    s88 = s44*s80 - (s44 + s50 + s54*s69 + s72*s75) + s83*s86
    s89 = mask_4 + s49 - s51*s69 - s71*s75 - s45*s80 - s82*s86
    s90 = 1.0/s89
    s91 = s88*s90
    s92 = mask_5 + s53 - s54*s70 - s72*s76 - s44*s81 - s83*s87 - s88*s91
    s93 = s28*s57
    s94 = s4 + (v1 - s21)*s26 + (q1 - s1)*s27 - p26 + s93
    s95 = s3 + s10 + (v3 + s20 - v0 + s22)*s26 + (q3 - q0 - s7 - s0)*s27 - s28*s58 - s64*s94
    s96 = s18 + (v7 - s25)*s26 + (q7 - s15)*s27 - p27 + s29*s68
    s97 = p29 - (s18 - s11 - (v7 - (v4 + s23) + s25)*s26 - (q7 - q4 + s15 - s8)*s27) - s29*s70 - s76*s96
    s98 = s4 + s11 + (v4 - (v1 + s21) - s23)*s26 + (q4 - q1 - s8 - s1)*s27 + p28 + s93 - s65*s94 - s79*s95
    s99 = (q6 - q3 + s14 - s7)*s27 - (s17 - s10 - (v6 + s22 - v3 - s24)*s26) - s29*s69 - s75*s96 - s80*s95
    s100 = s99 + s86*s98
    s101 = 1.0/s92*(s97 + s81*s95 - s87*s98 - s91*s100)
    s102 = s90*s100
    s103 = s91*s101
    s104 = s102 - s103
    s105 = s85*s98 + s86*s104
    s106 = s87*s101
    s107 = s105 - s106
    s108 = s78*s95 - s79*s107 - s80*s104 + s81*s101
    s109 = s74*s96 - s75*s104 - s76*s101
    s110 = s29*s67 + s68*s109 - s69*s104 - s70*s101
    s111 = s63*s94 - s64*s108 - s65*s107
    s112 = s28*s56 + s57*s111 - s58*s108 + s57*s107
    s113 = (((((s62 < 1e-06*s41) | (s73 < 1e-06*s55)) | (s77 < 1e-06*s43)) | (s84 < 1e-06*s47)) | (s89 < 1e-06*s49))
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
    ydot[9] = p20*(s108 - s112)
    ydot[10] = -p20*(p17 + s111 + s106 - s105)
    ydot[11] = p21*(s0*s107 - (s1*s112 - s0*s111 + s1*s108))
    ydot[12] = -p22*(s108 + s103 - s102)
    ydot[13] = -p22*(p18 + s107 - s101)
    ydot[14] = p23*(s7*s101 - (s8*s108 - s7*s107 + s8*s104))
    ydot[15] = -p24*(s104 + s110)
    ydot[16] = -p24*(p19 + s101 + s109)
    ydot[17] = p25*(s14*s109 - (s14*s101 - s15*s104 + s15*s110))
    ydot[18] = 0.0
    w[15] = s112
    w[16] = s111
    w[17] = s108
    w[18] = s107
    w[19] = s104
    w[20] = s101
    w[21] = s110
    w[22] = s109
    return int((s113 | (s92 < 1e-06*s53)))


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
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
