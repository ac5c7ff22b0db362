"""Method `penalty` for model `four-bar`. Emitted by symgen; do not edit.

constraints as stiff elements; the error falls like 1 / penalty
Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195; Ruzzeh, Kovecses, J. Comput. Nonlinear Dyn. 6 (2011) 021011
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
p[15] penalty (default 1000000000.0)
p[16] omega (default 10.0)
p[17] mu (default 1.0)
"""

import math

from numba import njit

from .model import geometry, measure

CHANGE = 63  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p16 = p[16]
    p17 = p[17]
    # outputs
    p[18] = 0.3333333333333333*p0
    p[19] = 9.81*p0
    p[20] = 5.333333333333333*p1
    p[21] = 9.81*p1
    p[22] = 2.083333333333333*p2
    p[23] = 9.81*p2
    p[24] = 2.0*(p16*p17)
    p[25] = p16*p16
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by penalty: 453 operations, 2358711 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
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
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p15 = p[15]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    p24 = p[24]
    p25 = p[25]
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
    s19 = p15*(1.0*(1.0 > mask_0))
    s20 = p15*(1.0*(1.0 > mask_1))
    s21 = p15*(1.0*(1.0 > mask_2))
    s22 = p15*(1.0*(1.0 > mask_3))
    s23 = p15*(1.0*(1.0 > mask_4))
    s24 = p15*(1.0*(1.0 > mask_5))
    s25 = p15*(1.0*(1.0 > mask_6))
    s26 = p15*(1.0*(1.0 > mask_7))
    s27 = v2*s1
    s28 = v2*s0
    s29 = v5*s8
    s30 = v5*s7
    s31 = v8*s15
    s32 = v8*s14
    s33 = s3 + (v0 + s27)*p24 + (q0 - s0)*p25
    s34 = s4 + (v1 - s28)*p24 + (q1 - s1)*p25
    s35 = s3 + s10 + (v3 + s27 - v0 + s29)*p24 + (q3 - q0 - s7 - s0)*p25
    s36 = s4 + s11 + (v4 - (v1 + s28) - s30)*p24 + (q4 - q1 - s8 - s1)*p25
    s37 = s17 - s10 - (v6 + s29 - v3 - s31)*p24 - (q6 - q3 + s14 - s7)*p25
    s38 = s18 - s11 - (v7 - (v4 + s30) + s32)*p24 - (q7 - q4 + s15 - s8)*p25
    s39 = s17 + (v6 + s31)*p24 + (q6 - 10.0 - s14)*p25
    s40 = s18 + (v7 - s32)*p24 + (q7 - s15)*p25
    s41 = s19*s33
    s42 = s20*s34
    s43 = s21*s35
    s44 = s22*s36
    s45 = s23*s37
    s46 = s24*s38
    s47 = s25*s39
    s48 = s26*s40
    s49 = s43 - s41
    s50 = s45 - s47
    s51 = s44 - s42 - p19
    s52 = s46 - s48 - p23
    s53 = s1*s19
    s54 = s0*s20
    s55 = s1*s21
    s56 = s53 - s55
    s57 = s8*s21
    s58 = s0*s22
    s59 = s58 - s54
    s60 = s7*s22
    s61 = s8*s23
    s62 = s15*s23
    s63 = s7*s24
    s64 = s14*s24
    s65 = s15*s25
    s66 = s65 - s62
    s67 = s14*s26
    s68 = s64 - s67
    s69 = 1.0/(s21 + p0 + s19)
    s70 = s56*s69
    s71 = s21*s69
    s72 = s57*s69
    s73 = s55 + s21*s70
    s74 = 1.0/(s22 + p0 + s20)
    s75 = s59*s74
    s76 = s22*s74
    s77 = s60*s74
    s78 = s22*s75 - s58
    s79 = s8*s55 + s7*s58 + s57*s70 - s60*s75
    s80 = 1.0/(s25 + p2 + s23)
    s81 = s66*s80
    s82 = s23*s80
    s83 = s61*s80
    s84 = s62 + s23*s81
    s85 = 1.0/(s26 + p2 + s24)
    s86 = s68*s85
    s87 = s24*s85
    s88 = s63*s85
    s89 = s24*s86 - s64
    s90 = s63*s86 - (s15*s61 + s14*s63 + s61*s81)
    s91 = 1.0/(p18 + s1*s53 + s0*s54 + s1*s55 + s0*s58 - s56*s70 - s59*s75)
    s92 = s73*s91
    s93 = s78*s91
    s94 = s79*s91
    s95 = 1.0/(p22 + s15*s62 + s14*s64 + s15*s65 + s14*s67 - s66*s81 - s68*s86)
    s96 = s84*s95
    s97 = s89*s95
    s98 = s90*s95
    s99 = s78*s92 + s89*s96
    s100 = s57 - s61 - s57*s71 + s61*s82 - s79*s92 - s90*s96
    s101 = p20 + s8*s57 + s7*s60 + s8*s61 + s7*s63 - s57*s72 - s60*s77 - s61*s83 - s63*s88 - s79*s94 - s90*s98
    s102 = 1.0/(s23 + p1 + s21 - s21*s71 - s23*s82 - s73*s92 - s84*s96)
    s103 = s99*s102
    s104 = s100*s102
    s105 = s63 - s60 + s60*s76 - s63*s87 - s79*s93 - s90*s97 + s100*s103
    s106 = 1.0/(s24 + p1 + s22 - s22*s76 - s24*s87 - s78*s93 - s89*s97 - s99*s103)
    s107 = s105*s106
    s108 = s0*s42 - s1*s41 - s1*s43 + s0*s44 - s49*s70 - s51*s75
    s109 = s14*s46 - s15*s45 - s15*s47 + s14*s48 - s50*s81 - s52*s86
    s110 = s49*s71 - (s43 + s45) + s50*s82 - s92*s108 - s96*s109
    s111 = s7*s44 - s8*s43 + s8*s45 - s7*s46 + s49*s72 - s51*s77 - s50*s83 + s52*s88 - s94*s108 - s98*s109
    s112 = s51*s76 - (p21 + s44 + s46) + s52*s87 - s93*s108 - s97*s109 + s103*s110
    s113 = 1.0/(s101 - s100*s104 - s105*s107)*(s111 - s104*s110 - s107*s112)
    s114 = s106*s112
    s115 = s107*s113
    s116 = s114 - s115
    s117 = s102*s110 + s103*s116
    s118 = s104*s113
    s119 = s117 - s118
    s120 = s95*s109 - s96*s119 - s97*s116 - s98*s113
    s121 = s91*s108 - s92*s119 - s93*s116 - s94*s113
    s122 = s52*s85 - s86*s120 + s87*s116 + s88*s113
    s123 = s50*s80 - s81*s120 + s82*s119 - s83*s113
    s124 = s51*s74 - s75*s121 + s76*s116
    s125 = s77*s113
    s126 = s124 - s125
    s127 = s49*s69 - s70*s121 + s71*s119 + s72*s113
    s128 = s1*s121
    s129 = s0*s121
    s130 = s8*s113
    s131 = s7*s113
    s132 = s15*s120
    s133 = s14*s120
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
    ydot[9] = s127
    ydot[10] = s126
    ydot[11] = s121
    ydot[12] = s119
    ydot[13] = s116
    ydot[14] = s113
    ydot[15] = s123
    ydot[16] = s122
    ydot[17] = s120
    ydot[18] = 0.0
    w[15] = s19*(s33 + s127 + s128)
    w[16] = s20*(s34 + s126 - s129)
    w[17] = s21*(s35 + s119 + s128 - s127 + s130)
    w[18] = s22*(s36 + s116 + s125 - s124 - s129 - s131)
    w[19] = s23*(s123 + s130 + s118 - s117 - s132 - s37)
    w[20] = s24*(s122 + s115 - s114 - s131 + s133 - s38)
    w[21] = s25*(s39 + s123 + s132)
    w[22] = s26*(s40 + s122 - s133)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
