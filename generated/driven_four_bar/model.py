"""Model `driven-four-bar`: what every method of it shares. Emitted by symgen; do not edit.

digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 2, templates 06e8f0c6b361de81
9 coordinates, 9 velocities, 9 constraint rows, 5 parameters,
0 fill-ins in the factor of D D^T

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     crank.x [m]
y[1]     crank.y [m]
y[2]     crank.theta [rad]
y[3]     coupler.x [m]
y[4]     coupler.y [m]
y[5]     coupler.theta [rad]
y[6]     rocker.x [m]
y[7]     rocker.y [m]
y[8]     rocker.theta [rad]
y[9]     crank.vx [m/s]
y[10]    crank.vy [m/s]
y[11]    crank.omega [rad/s]
y[12]    coupler.vx [m/s]
y[13]    coupler.vy [m/s]
y[14]    coupler.omega [rad/s]
y[15]    rocker.vx [m/s]
y[16]    rocker.vy [m/s]
y[17]    rocker.omega [rad/s]
y[18]    work of forces without potential and of drivers [J]
p[0]     crank_mass [kg]
p[1]     coupler_mass [kg]
p[2]     rocker_mass [kg]
p[3]     crank_start [rad]
p[4]     crank_speed [rad/s]
row 0    A.x [m]
row 1    A.y [m]
row 2    B.x [m]
row 3    B.y [m]
row 4    C.x [m]
row 5    C.y [m]
row 6    D.x [m]
row 7    D.y [m]
row 8    motor.driver [rad]

Left out:
- z coordinates, Euler parameters and 3x3 inertia tensors: the mechanism is planar
- the kinematic map N: planar velocities are the rates of the coordinates
- gyroscopic terms: they vanish in the plane
- columns of the ground: the ground does not move
- centre-of-mass offset of crank: its centre of mass is the frame's origin
- centre-of-mass offset of coupler: its centre of mass is the frame's origin
- centre-of-mass offset of rocker: its centre of mass is the frame's origin
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 12 operations, 12 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # outputs
    p[5] = 0.5*p0
    p[6] = 9.81*p0
    p[7] = 0.16666666666666666*p0
    p[8] = 0.5*p1
    p[9] = 9.81*p1
    p[10] = 2.6666666666666665*p1
    p[11] = 0.5*p2
    p[12] = 9.81*p2
    p[13] = 1.0416666666666665*p2
    p[14] = 0.3333333333333333*p0
    p[15] = 5.333333333333333*p1
    p[16] = 2.083333333333333*p2
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 248 operations, 319370 before sharing."""
    # inputs
    p3 = p[3]  # crank_start [rad]
    p4 = p[4]  # crank_speed [rad/s]
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    mask_1 = w[25]
    mask_2 = w[26]
    mask_3 = w[27]
    mask_4 = w[28]
    mask_5 = w[29]
    mask_7 = w[31]
    mask_8 = w[32]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = q0 - s0
    s4 = q1 - s1
    s5 = 4.0*math.cos(q5)
    s6 = -s5
    s7 = q3 - q0 - s5 - s0
    s8 = 4.0*math.sin(q5)
    s9 = q4 - q1 - s8 - s1
    s10 = 2.5*math.cos(q8)
    s11 = q6 - q3 + s10 - s5
    s12 = 2.5*math.sin(q8)
    s13 = q7 - q4 + s12 - s8
    s14 = q6 - 10.0 - s10
    s15 = q7 - s12
    s16 = q2 - (p3 + t*p4)
    s17 = s1*s1
    s18 = 1.0 + s17
    s19 = s0*s1
    s20 = -1.0 + s17
    s21 = s0*s0
    s22 = 1.0 + s21
    s23 = s8*s8
    s24 = 1.0 + s18 + s23
    s25 = s5*s8
    s26 = -1.0 + s23
    s27 = s5*s5
    s28 = 1.0 + s22 + s27
    s29 = s12*s12
    s30 = 1.0 + 1.0 + s23 + s29
    s31 = s10*s12
    s32 = 1.0 - s29
    s33 = s10*s10
    s34 = 1.0 + 1.0 + s27 + s33
    s35 = 1.0 + s33
    s36 = 1.0/(1.0 + s29)
    s37 = s31*s36
    s38 = s32*s36
    s39 = s31*s37
    s40 = s35 - s39
    s41 = s31 + s32*s37
    s42 = 1.0 - s33 + s39
    s43 = 1.0*(s40 > mask_7 + 1e-12*s35)
    s44 = s43/(s40 + 1.0 - s43)
    s45 = s41*s44
    s46 = s42*s44
    s47 = s30 - s32*s38 - s41*s45
    s48 = s25 + s31 + s31*s38 + s42*s45
    s49 = 1.0*(s47 > mask_4 + 1e-12*s30)
    s50 = s49/(s47 + 1.0 - s49)
    s51 = s48*s50
    s52 = s26*s50
    s53 = s25*s50
    s54 = s34 - s39 - s42*s46 - s48*s51
    s55 = s26*s51 - s25
    s56 = -1.0 + s27 - s25*s51
    s57 = 1.0*(s54 > mask_5 + 1e-12*s34)
    s58 = s57/(s54 + 1.0 - s57)
    s59 = s55*s58
    s60 = s56*s58
    s61 = 1.0/s18
    s62 = s19*s61
    s63 = -s62
    s64 = s1*s61
    s65 = s20*s61
    s66 = s19*s62
    s67 = s22 - s66
    s68 = s1*s62 - s0
    s69 = s20*s62 - s19
    s70 = -1.0 + s21 - s66
    s71 = 1.0*(s67 > mask_1 + 1e-12*s22)
    s72 = s71/(s67 + 1.0 - s71)
    s73 = s68*s72
    s74 = s69*s72
    s75 = s70*s72
    s76 = 1.0 - s1*s64 - s68*s73
    s77 = s1 - s20*s64 - s69*s73
    s78 = s19*s64 - s0 - s70*s73
    s79 = 1.0*(s76 > mask_8 + 1e-12)
    s80 = s79/(s76 + 1.0 - s79)
    s81 = s77*s80
    s82 = s78*s80
    s83 = s24 - s26*s52 - s55*s59 - s20*s65 - s69*s74 - s77*s81
    s84 = s25*s52 - (s19 + s25) - s56*s59 + s19*s65 - s70*s74 - s78*s81
    s85 = 1.0*(s83 > mask_2 + 1e-12*s24)
    s86 = s85/(s83 + 1.0 - s85)
    s87 = s84*s86
    s88 = s28 - s25*s53 - s56*s60 - s66 - s70*s75 - s78*s82 - s84*s87
    s89 = 1.0*(s88 > mask_3 + 1e-12*s28)
    s90 = s67/s22
    s91 = s83/s24
    s92 = s88/s28
    s93 = s47/s30
    s94 = s54/s34
    s95 = min(min(min(min(min(1.0, mask_1 + s90), mask_2 + s91), mask_3 + s92), mask_4 + s93), mask_5 + s94)
    s96 = s40/s35
    # outputs
    w[42] = s3
    w[43] = s4
    w[44] = s7
    w[45] = s9
    w[46] = s11
    w[47] = s13
    w[48] = s14
    w[49] = s15
    w[50] = s16
    w[0] = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15 + s16*s16)
    w[59] = p4
    w[87] = s1
    w[88] = s2
    w[89] = s1
    w[90] = s8
    w[91] = s2
    w[92] = s6
    w[93] = s8
    w[94] = -s12
    w[95] = s6
    w[96] = s10
    w[97] = s12
    w[98] = -s10
    w[61] = s90
    w[62] = s91
    w[63] = s92
    w[64] = s93
    w[65] = s94
    w[67] = s96
    w[68] = s76
    w[5] = s79 + s43 + 1.0 + s57 + s49 + s89 + s85 + 1.0 + s71
    w[4] = min(min(s95, mask_7 + s96), mask_8 + s76)
    w[99] = -s37
    w[100] = s38
    w[101] = s37
    w[102] = s45
    w[103] = s46
    w[104] = -s51
    w[105] = s52
    w[106] = -s53
    w[107] = s59
    w[108] = s60
    w[109] = s63
    w[110] = s64
    w[111] = s65
    w[112] = s63
    w[113] = s73
    w[114] = s74
    w[115] = s75
    w[116] = s81
    w[117] = s82
    w[118] = s87
    w[119] = s36
    w[120] = s44
    w[121] = s50
    w[122] = s58
    w[123] = s61
    w[124] = s72
    w[125] = s80
    w[126] = s86
    w[127] = s89/(s88 + 1.0 - s89)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 120 operations, 10064 before sharing."""
    # inputs
    lower_0 = w[99]
    lower_1 = w[100]
    lower_2 = w[101]
    lower_3 = w[102]
    lower_4 = w[103]
    lower_5 = w[104]
    lower_6 = w[105]
    lower_7 = w[106]
    lower_8 = w[107]
    lower_9 = w[108]
    lower_10 = w[109]
    lower_11 = w[110]
    lower_12 = w[111]
    lower_13 = w[112]
    lower_14 = w[113]
    lower_15 = w[114]
    lower_16 = w[115]
    lower_17 = w[116]
    lower_18 = w[117]
    lower_19 = w[118]
    reciprocal_0 = w[119]
    reciprocal_1 = w[120]
    reciprocal_2 = w[121]
    reciprocal_3 = w[122]
    reciprocal_4 = w[123]
    reciprocal_5 = w[124]
    reciprocal_6 = w[125]
    reciprocal_7 = w[126]
    reciprocal_8 = w[127]
    residual_0 = w[42]
    residual_1 = w[43]
    residual_2 = w[44]
    residual_3 = w[45]
    residual_4 = w[46]
    residual_5 = w[47]
    residual_6 = w[48]
    residual_7 = w[49]
    residual_8 = w[50]
    jacobian_0 = w[87]
    jacobian_1 = w[88]
    jacobian_2 = w[89]
    jacobian_3 = w[90]
    jacobian_4 = w[91]
    jacobian_5 = w[92]
    jacobian_6 = w[93]
    jacobian_7 = w[94]
    jacobian_8 = w[95]
    jacobian_9 = w[96]
    jacobian_10 = w[97]
    jacobian_11 = w[98]
    # intermediate terms
    s0 = lower_0*residual_6 - residual_7
    s1 = lower_1*residual_6 - residual_4 - lower_3*s0
    s2 = lower_2*residual_6 - residual_5 - lower_4*s0 - lower_5*s1
    s3 = lower_10*residual_0 - residual_1
    s4 = lower_11*residual_0 - residual_8 - lower_14*s3
    s5 = lower_12*residual_0 - (residual_2 + lower_6*s1 + lower_8*s2) - lower_15*s3 - lower_17*s4
    s6 = lower_13*residual_0 - (residual_3 + lower_7*s1 + lower_9*s2) - lower_16*s3 - lower_18*s4 - lower_19*s5
    s7 = reciprocal_8*s6
    s8 = reciprocal_7*s5
    s9 = lower_19*s7
    s10 = s8 - s9
    s11 = reciprocal_6*s4 - lower_17*s10 - lower_18*s7
    s12 = reciprocal_5*s3 - lower_14*s11 - lower_15*s10 - lower_16*s7
    s13 = reciprocal_4*residual_0 + lower_10*s12 + lower_11*s11 + lower_12*s10 + lower_13*s7
    s14 = reciprocal_3*s2 - lower_8*s10
    s15 = lower_9*s7
    s16 = s14 - s15
    s17 = reciprocal_2*s1 - lower_5*s16 - lower_6*s10
    s18 = lower_7*s7
    s19 = s17 - s18
    s20 = reciprocal_1*s0 - lower_3*s19 - lower_4*s16
    s21 = reciprocal_0*residual_6 + lower_0*s20 + lower_1*s19 + lower_2*s16
    # outputs
    w[69] = s9 - s8 - s13
    w[70] = s12 - s7
    w[71] = s11 + s12*jacobian_1 - s13*jacobian_0 + s10*jacobian_2 + s7*jacobian_4
    w[72] = s10 + s18 - s17
    w[73] = s7 + s15 - s14
    w[74] = s10*jacobian_3 + s7*jacobian_5 + s19*jacobian_6 + s16*jacobian_8
    w[75] = s19 - s21
    w[76] = s16 + s20
    w[77] = s19*jacobian_7 + s16*jacobian_9 - s21*jacobian_10 + s20*jacobian_11
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 78 operations, 136 before sharing."""
    # inputs
    q1 = y[1]  # crank.y [m]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q4 = y[4]  # coupler.y [m]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q7 = y[7]  # rocker.y [m]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p5 = p[5]
    p6 = p[6]
    p7 = p[7]
    p8 = p[8]
    p9 = p[9]
    p10 = p[10]
    p11 = p[11]
    p12 = p[12]
    p13 = p[13]
    jacobian_0 = w[87]
    jacobian_1 = w[88]
    jacobian_2 = w[89]
    jacobian_3 = w[90]
    jacobian_4 = w[91]
    jacobian_5 = w[92]
    jacobian_6 = w[93]
    jacobian_7 = w[94]
    jacobian_8 = w[95]
    jacobian_9 = w[96]
    jacobian_10 = w[97]
    jacobian_11 = w[98]
    nu_8 = w[59]
    # intermediate terms
    s0 = p5*(v0*v0) + p5*(v1*v1) + v2*v2*p7 + p8*(v3*v3) + p8*(v4*v4) + v5*v5*p10 + p11*(v6*v6) + p11*(v7*v7)
    s1 = v0 + v2*jacobian_0
    s2 = v1 + v2*jacobian_1
    s3 = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    s4 = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    s5 = v6 + v5*jacobian_6 - v3 + v8*jacobian_7
    s6 = v7 + v5*jacobian_8 - v4 + v8*jacobian_9
    s7 = v6 + v8*jacobian_10
    s8 = v7 + v8*jacobian_11
    s9 = v2 - nu_8
    # outputs
    w[42] = s1
    w[43] = s2
    w[44] = s3
    w[45] = s4
    w[46] = s5
    w[47] = s6
    w[48] = s7
    w[49] = s8
    w[50] = s9
    w[1] = math.sqrt(s1*s1 + s2*s2 + s3*s3 + s4*s4 + s5*s5 + s6*s6 + s7*s7 + s8*s8 + s9*s9)
    w[2] = s0 + v8*v8*p13
    w[3] = q1*p6 + q4*p9 + q7*p12
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates: 59 operations, 108 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    ydot_9 = ydot[9]
    ydot_10 = ydot[10]
    ydot_11 = ydot[11]
    ydot_12 = ydot[12]
    ydot_13 = ydot[13]
    ydot_14 = ydot[14]
    ydot_15 = ydot[15]
    ydot_16 = ydot[16]
    ydot_17 = ydot[17]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = s0*s2
    s4 = s1*s2
    s5 = math.cos(q5)
    s6 = math.sin(q5)
    s7 = 4.0*(v5*v5)
    s8 = s5*s7
    s9 = s6*s7
    s10 = math.cos(q8)
    s11 = math.sin(q8)
    s12 = 2.5*(v8*v8)
    s13 = s10*s12
    s14 = s11*s12
    s15 = s1*ydot_11
    s16 = s0*ydot_11
    s17 = 4.0*s6*ydot_14
    s18 = 4.0*s5*ydot_14
    s19 = 2.5*s11*ydot_17
    s20 = 2.5*s10*ydot_17
    # outputs
    out[0] = s3 + ydot_9 + s15
    out[1] = s4 + ydot_10 - s16
    out[2] = s3 + s8 + ydot_12 + s15 - ydot_9 + s17
    out[3] = s4 + s9 + ydot_13 - (ydot_10 + s16) - s18
    out[4] = ydot_15 + s17 - ydot_12 - s19 - (s13 - s8)
    out[5] = ydot_16 - (ydot_13 + s18) + s20 - (s14 - s9)
    out[6] = s13 + ydot_15 + s19
    out[7] = s14 + ydot_16 - s20
    out[8] = ydot_11
    out[9] = q2
    out[10] = v2
    out[11] = q5 - q2
    out[12] = v5 - v2
    out[13] = q8 - q5
    out[14] = v8 - v5
    out[15] = q8
    out[16] = v8
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p14 = p[14]
    p15 = p[15]
    p16 = p[16]
    # outputs
    w[78] = p0
    w[79] = p0
    w[80] = p14
    w[81] = p1
    w[82] = p1
    w[83] = p15
    w[84] = p2
    w[85] = p2
    w[86] = p16
    return 0
