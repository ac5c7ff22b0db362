"""Method `baumgarte` for model `four-bar`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[15] alpha (default 5.0)
p[16] beta (default 5.0)
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
    """numbers that depend on parameters alone: 21 operations, 41 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]
    p16 = p[16]
    # intermediate terms
    s0 = 0.3333333333333333*p0
    s1 = 9.81*p0
    s2 = 5.333333333333333*p1
    s3 = 9.81*p1
    s4 = 2.083333333333333*p2
    s5 = 9.81*p2
    s6 = 2.0*p15
    s7 = p16*p16
    s8 = 1.0/p0
    s9 = 1.0/p1
    s10 = 1.0/p2
    s11 = s1*s8
    s12 = s3*s9
    s13 = s5*s10
    # outputs
    p[17] = s1
    p[18] = s3
    p[19] = s5
    p[20] = s6
    p[21] = s7
    p[22] = s8
    p[23] = 1.0/s0
    p[24] = s9
    p[25] = 1.0/s2
    p[26] = s10
    p[27] = 1.0/s4
    p[28] = s11
    p[29] = s13
    p[30] = s11 - s12
    p[31] = s12 - s13
    p[32] = s0
    p[33] = s2
    p[34] = s4
    p[35] = -s6
    p[36] = -s7
    return 0


@njit(error_model="numpy", fastmath={"contract"})
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


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, k, p, w, r):
    """F(t, y, k) of the descriptor form, and the power: 183 operations, 298 before sharing."""
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
    p32 = p[32]
    p17 = p[17]
    p33 = p[33]
    p18 = p[18]
    p34 = p[34]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
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
    s19 = v2*s1
    s20 = v2*s0
    s21 = v5*s8
    s22 = v5*s7
    s23 = v8*s15
    s24 = v8*s14
    s25 = s1*k11
    s26 = s0*k11
    s27 = s8*k14
    s28 = s7*k14
    s29 = s15*k17
    s30 = s14*k17
    s31 = k16 - (k13 + s28) + s30 - (s18 - s11 - (v7 - (v4 + s22) + s24)*p20 - (q7 - q4 + s15 - s8)*p21)
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
    r[10] = p17 + p0*k10 + k19 - k21
    r[11] = p32*k11 + s1*k18 - s0*k19 + s1*k20 - s0*k21
    r[12] = p1*k12 + k20 - k22
    r[13] = p18 + p1*k13 + k21 - k23
    r[14] = p33*k14 + s8*k20 - s7*k21 + s8*k22 - s7*k23
    r[15] = p2*k15 + k22 + k24
    r[16] = p19 + p2*k16 + k23 + k25
    r[17] = p34*k17 + s14*k23 - s15*k22 + s15*k24 - s14*k25
    r[18] = s3 + (v0 + s19)*p20 + (q0 - s0)*p21 + k9 + s25
    r[19] = s4 + (v1 - s20)*p20 + (q1 - s1)*p21 + k10 - s26
    r[20] = s3 + s10 + (v3 + s19 - v0 + s21)*p20 + (q3 - q0 - s7 - s0)*p21 + k12 + s25 - k9 + s27
    r[21] = s4 + s11 + (v4 - (v1 + s20) - s22)*p20 + (q4 - q1 - s8 - s1)*p21 + k13 - (k10 + s26) - s28
    r[22] = k15 + s27 - k12 - s29 - (s17 - s10 - (v6 + s21 - v3 - s23)*p20 - (q6 - q3 + s14 - s7)*p21)
    r[23] = s31
    r[24] = s17 + (v6 + s23)*p20 + (q6 - 10.0 - s14)*p21 + k15 + s29
    r[25] = s18 + (v7 - s24)*p20 + (q7 - s15)*p21 + k16 - s30
    w[14] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """entries of dF/dk and dF/dy of the descriptor form: 119 operations, 371 before sharing."""
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
    p32 = p[32]
    p33 = p[33]
    p34 = p[34]
    p20 = p[20]
    p21 = p[21]
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
    p35 = p[35]
    p36 = p[36]
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
    s10 = s5*s9
    s11 = math.cos(q8)
    s12 = math.sin(q8)
    s13 = 2.5*s11
    s14 = 2.5*s12
    s15 = -s14
    s16 = 2.5*(v8*v8)
    s17 = -s13
    s18 = s6*k14
    s19 = s14*k17
    s20 = v2 + v2
    s21 = 4.0*(v5 + v5)
    s22 = 2.5*(v8 + v8)
    s23 = s12*s22
    s24 = v5*s6*p20
    s25 = s13*p20
    s26 = s0*s20 + s1*p20
    s27 = s1*s20 - s0*p20
    s28 = s4*s21 + s8*p20
    s29 = s5*s21 - s6*p20
    s30 = s11*s22 + s14*p20
    s31 = s11*s16 + v8*s14*p20
    s32 = s8*p21
    s33 = s13*p21
    s34 = s0*k11 + v2*s0*p20 - s1*s2 + s1*p21
    s35 = s1*k11 + s0*s2 + v2*s1*p20 - s0*p21
    s36 = s8*k14 + s4*s9 + v5*s8*p20 - s6*p21
    s37 = s13*k17 + v8*s13*p20 - s12*s16 + s14*p21
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
    j[24] = p32
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
    j[36] = p33
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
    j[48] = p34
    j[49] = s15
    j[50] = s13
    j[51] = s14
    j[52] = s17
    j[53] = s13*k24 - (s13*k22 + s14*k23) + s14*k25
    j[54] = 1.0
    j[55] = s1
    j[56] = p21
    j[57] = s34
    j[58] = p20
    j[59] = s26
    j[60] = 1.0
    j[61] = s3
    j[62] = p21
    j[63] = s35
    j[64] = p20
    j[65] = s27
    j[66] = -1.0
    j[67] = s1
    j[68] = 1.0
    j[69] = s8
    j[70] = p36
    j[71] = s34
    j[72] = p21
    j[73] = s18 + s24 - s10 + s32
    j[74] = p35
    j[75] = s26
    j[76] = p20
    j[77] = s28
    j[78] = -1.0
    j[79] = s3
    j[80] = 1.0
    j[81] = s7
    j[82] = p36
    j[83] = s35
    j[84] = p21
    j[85] = s36
    j[86] = p35
    j[87] = s27
    j[88] = p20
    j[89] = s29
    j[90] = -1.0
    j[91] = s8
    j[92] = 1.0
    j[93] = s15
    j[94] = p36
    j[95] = s18 + s32 - (s10 - s24)
    j[96] = p21
    j[97] = -s37
    j[98] = p35
    j[99] = s28
    j[100] = p20
    j[101] = -s30
    j[102] = -1.0
    j[103] = s7
    j[104] = 1.0
    j[105] = s13
    j[106] = p36
    j[107] = s36
    j[108] = p21
    j[109] = s33 - s31 - s19
    j[110] = p35
    j[111] = s29
    j[112] = p20
    j[113] = s25 - s23
    j[114] = 1.0
    j[115] = s14
    j[116] = p21
    j[117] = s37
    j[118] = p20
    j[119] = s30
    j[120] = 1.0
    j[121] = s17
    j[122] = p21
    j[123] = s19 + s31 - s33
    j[124] = p20
    j[125] = s23 - s25
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
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
