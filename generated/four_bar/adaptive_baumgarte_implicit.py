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
    p[17] = s1
    p[18] = s3
    p[19] = s5
    p[20] = s6
    p[21] = 1.0/s0
    p[22] = s7
    p[23] = 1.0/s2
    p[24] = s8
    p[25] = 1.0/s4
    p[26] = s9
    p[27] = s11
    p[28] = s9 - s10
    p[29] = s10 - s11
    p[30] = s0
    p[31] = s2
    p[32] = s4
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
def residual(t, y, k, p, w, r):
    """F(t, y, k) of the descriptor form, and the power: 188 operations, 386 before sharing."""
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
    p30 = p[30]
    p17 = p[17]
    p31 = p[31]
    p18 = p[18]
    p32 = p[32]
    p19 = p[19]
    p15 = p[15]
    p16 = p[16]
    status_8 = w[8]
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
    s19 = min(p15, p16*(1.0/status_8))
    s20 = v2*s1
    s21 = v2*s0
    s22 = v5*s8
    s23 = v5*s7
    s24 = v8*s15
    s25 = v8*s14
    s26 = 2.0*s19
    s27 = s19*s19
    s28 = s1*k11
    s29 = s0*k11
    s30 = s8*k14
    s31 = s7*k14
    s32 = s15*k17
    s33 = s14*k17
    s34 = k16 - (k13 + s31) + s33 - (s18 - s11 - (v7 - (v4 + s23) + s25)*s26 - (q7 - q4 + s15 - s8)*s27)
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
    r[11] = p30*k11 + s1*k18 - s0*k19 + s1*k20 - s0*k21
    r[12] = p1*k12 + k20 - k22
    r[13] = p18 + p1*k13 + k21 - k23
    r[14] = p31*k14 + s8*k20 - s7*k21 + s8*k22 - s7*k23
    r[15] = p2*k15 + k22 + k24
    r[16] = p19 + p2*k16 + k23 + k25
    r[17] = p32*k17 + s14*k23 - s15*k22 + s15*k24 - s14*k25
    r[18] = s3 + (v0 + s20)*s26 + (q0 - s0)*s27 + k9 + s28
    r[19] = s4 + (v1 - s21)*s26 + (q1 - s1)*s27 + k10 - s29
    r[20] = s3 + s10 + (v3 + s20 - v0 + s22)*s26 + (q3 - q0 - s7 - s0)*s27 + k12 + s28 - k9 + s30
    r[21] = s4 + s11 + (v4 - (v1 + s21) - s23)*s26 + (q4 - q1 - s8 - s1)*s27 + k13 - (k10 + s29) - s31
    r[22] = k15 + s30 - k12 - s32 - (s17 - s10 - (v6 + s22 - v3 - s24)*s26 - (q6 - q3 + s14 - s7)*s27)
    r[23] = s34
    r[24] = s17 + (v6 + s24)*s26 + (q6 - 10.0 - s14)*s27 + k15 + s32
    r[25] = s18 + (v7 - s25)*s26 + (q7 - s15)*s27 + k16 - s33
    w[14] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """entries of dF/dk and dF/dy of the descriptor form: 126 operations, 691 before sharing."""
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
    p30 = p[30]
    p31 = p[31]
    p32 = p[32]
    p15 = p[15]
    p16 = p[16]
    status_8 = w[8]
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
    s10 = s5*s9
    s11 = math.cos(q8)
    s12 = math.sin(q8)
    s13 = 2.5*s11
    s14 = 2.5*s12
    s15 = -s14
    s16 = 2.5*(v8*v8)
    s17 = -s13
    s18 = min(p15, p16*(1.0/status_8))
    s19 = 2.0*s18
    s20 = s18*s18
    s21 = s6*k14
    s22 = s14*k17
    s23 = v2 + v2
    s24 = 4.0*(v5 + v5)
    s25 = 2.5*(v8 + v8)
    s26 = s12*s25
    s27 = -s19
    s28 = v5*s6*s19
    s29 = s13*s19
    s30 = s0*s23 + s1*s19
    s31 = s1*s23 - s0*s19
    s32 = s4*s24 + s8*s19
    s33 = s5*s24 - s6*s19
    s34 = s11*s25 + s14*s19
    s35 = s11*s16 + v8*s14*s19
    s36 = -s20
    s37 = s8*s20
    s38 = s13*s20
    s39 = s0*k11 + v2*s0*s19 - s1*s2 + s1*s20
    s40 = s1*k11 + s0*s2 + v2*s1*s19 - s0*s20
    s41 = s8*k14 + s4*s9 + v5*s8*s19 - s6*s20
    s42 = s13*k17 + v8*s13*s19 - s12*s16 + s14*s20
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
    j[24] = p30
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
    j[36] = p31
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
    j[48] = p32
    j[49] = s15
    j[50] = s13
    j[51] = s14
    j[52] = s17
    j[53] = s13*k24 - (s13*k22 + s14*k23) + s14*k25
    j[54] = 1.0
    j[55] = s1
    j[56] = s20
    j[57] = s39
    j[58] = s19
    j[59] = s30
    j[60] = 1.0
    j[61] = s3
    j[62] = s20
    j[63] = s40
    j[64] = s19
    j[65] = s31
    j[66] = -1.0
    j[67] = s1
    j[68] = 1.0
    j[69] = s8
    j[70] = s36
    j[71] = s39
    j[72] = s20
    j[73] = s21 + s28 - s10 + s37
    j[74] = s27
    j[75] = s30
    j[76] = s19
    j[77] = s32
    j[78] = -1.0
    j[79] = s3
    j[80] = 1.0
    j[81] = s7
    j[82] = s36
    j[83] = s40
    j[84] = s20
    j[85] = s41
    j[86] = s27
    j[87] = s31
    j[88] = s19
    j[89] = s33
    j[90] = -1.0
    j[91] = s8
    j[92] = 1.0
    j[93] = s15
    j[94] = s36
    j[95] = s21 + s37 - (s10 - s28)
    j[96] = s20
    j[97] = -s42
    j[98] = s27
    j[99] = s32
    j[100] = s19
    j[101] = -s34
    j[102] = -1.0
    j[103] = s7
    j[104] = 1.0
    j[105] = s13
    j[106] = s36
    j[107] = s41
    j[108] = s20
    j[109] = s38 - s35 - s22
    j[110] = s27
    j[111] = s33
    j[112] = s19
    j[113] = s29 - s26
    j[114] = 1.0
    j[115] = s14
    j[116] = s20
    j[117] = s42
    j[118] = s19
    j[119] = s34
    j[120] = 1.0
    j[121] = s17
    j[122] = s20
    j[123] = s22 + s35 - s38
    j[124] = s19
    j[125] = s26 - s29
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
