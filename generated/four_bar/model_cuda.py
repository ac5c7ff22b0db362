"""Model `four-bar`: what every method of it shares, for CUDA. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
9 coordinates, 9 velocities, 8 constraint rows, 3 parameters,
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
row 0    A.x [m]
row 1    A.y [m]
row 2    B.x [m]
row 3    B.y [m]
row 4    C.x [m]
row 5    C.y [m]
row 6    D.x [m]
row 7    D.y [m]

w[0:19]  status
w[19:27]  multipliers
w[27:35]  mask
w[35:43]  saved
w[43:51]  residual
w[51:59]  nu
w[59:67]  pivot
w[67:76]  change
w[76:85]  mass
w[85:94]  gauge
w[94:102]  row_weight
w[102:114]  jacobian
w[114:130]  lower
w[130:138]  reciprocal

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

from numba import cuda


@cuda.jit(device=True)
def prepare(p):
    """numbers that depend on parameters alone: 12 operations, 12 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # outputs
    p[3] = 0.5*p0  # 0.5*crank_mass
    p[4] = 9.81*p0  # 9.81*crank_mass
    p[5] = 0.16666666666666666*p0  # 0.16666666666666666*crank_mass
    p[6] = 0.5*p1  # 0.5*coupler_mass
    p[7] = 9.81*p1  # 9.81*coupler_mass
    p[8] = 2.6666666666666665*p1  # 2.6666666666666665*coupler_mass
    p[9] = 0.5*p2  # 0.5*rocker_mass
    p[10] = 9.81*p2  # 9.81*rocker_mass
    p[11] = 1.0416666666666665*p2  # 1.0416666666666665*rocker_mass
    p[12] = 0.3333333333333333*p0  # 0.3333333333333333*crank_mass
    p[13] = 5.333333333333333*p1  # 5.333333333333333*coupler_mass
    p[14] = 2.083333333333333*p2  # 2.083333333333333*rocker_mass
    return 0


@cuda.jit(device=True)
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 217 operations, 99577 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    mask_1 = w[28]  # A.y
    mask_2 = w[29]  # B.x
    mask_3 = w[30]  # B.y
    mask_4 = w[31]  # C.x
    mask_5 = w[32]  # C.y
    mask_7 = w[34]  # D.y
    gauge_2 = w[87]  # crank.omega
    gauge_5 = w[90]  # coupler.omega
    gauge_8 = w[93]  # rocker.omega
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
    s16 = s1*gauge_2
    s17 = s0*gauge_2
    s18 = s8*gauge_5
    s19 = s5*gauge_5
    s20 = s12*gauge_8
    s21 = s10*gauge_8
    s22 = s1*s16
    s23 = 1.0 + s22
    s24 = s0*s16
    s25 = -1.0 + s22
    s26 = s0*s17
    s27 = 1.0 + s26
    s28 = s8*s18
    s29 = 1.0 + s23 + s28
    s30 = s5*s18
    s31 = -1.0 + s28
    s32 = s5*s19
    s33 = 1.0 + s27 + s32
    s34 = s12*s20
    s35 = 1.0 + 1.0 + s28 + s34
    s36 = s10*s20
    s37 = 1.0 - s34
    s38 = s10*s21
    s39 = 1.0 + 1.0 + s32 + s38
    s40 = s12*s21
    s41 = 1.0 + s38
    s42 = 1.0/s23
    s43 = s24*s42
    s44 = -s43
    s45 = s25*s42
    s46 = s24*s43
    s47 = s27 - s46
    s48 = s25*s43 - s1*s17
    s49 = -1.0 + s26 - s46
    s50 = 1.0*(s47 > mask_1 + 1e-12*s27)
    s51 = s50/max(s47, 1e-300)
    s52 = s48*s51
    s53 = s49*s51
    s54 = s29 - s25*s45 - s48*s52
    s55 = s24*s45 - (s24 + s30) - s49*s52
    s56 = 1.0/(1.0 + s34)
    s57 = s36*s56
    s58 = s37*s56
    s59 = s40*s56
    s60 = s41 - s36*s57
    s61 = s36 + s37*s57
    s62 = 1.0 - s38 + s40*s57
    s63 = 1.0*(s60 > mask_7 + 1e-12*s41)
    s64 = s63/max(s60, 1e-300)
    s65 = s61*s64
    s66 = s62*s64
    s67 = 1.0*(s54 > mask_2 + 1e-12*s29)
    s68 = s67/max(s54, 1e-300)
    s69 = s55*s68
    s70 = s31*s68
    s71 = s30*s68
    s72 = s33 - s46 - s49*s53 - s55*s69
    s73 = s8*s19 + s31*s69
    s74 = -1.0 + s32 + s30*s69
    s75 = 1.0*(s72 > mask_3 + 1e-12*s33)
    s76 = s75/max(s72, 1e-300)
    s77 = s73*s76
    s78 = s74*s76
    s79 = s35 - s37*s58 - s61*s65 - s31*s70 - s73*s77
    s80 = s30*s70 - (s30 + s36 + s40*s58 + s62*s65) + s74*s77
    s81 = 1.0*(s79 > mask_4 + 1e-12*s35)
    s82 = s81/max(s79, 1e-300)
    s83 = s80*s82
    s84 = s39 - s40*s59 - s62*s66 - s30*s71 - s74*s78 - s80*s83
    s85 = 1.0*(s84 > mask_5 + 1e-12*s39)
    s86 = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15)
    s87 = s47/s27
    s88 = s54/s29
    s89 = s72/s33
    s90 = s79/s35
    s91 = s84/s39
    s92 = min(min(min(min(min(1.0, mask_1 + s87), mask_2 + s88), mask_3 + s89), mask_4 + s90), mask_5 + s91)
    s93 = s60/s41
    # outputs
    w[43] = s3  # A.x
    w[44] = s4  # A.y
    w[45] = s7  # B.x
    w[46] = s9  # B.y
    w[47] = s11  # C.x
    w[48] = s13  # C.y
    w[49] = s14  # D.x
    w[50] = s15  # D.y
    w[0] = s86  # position_violation
    w[8] = s86  # position_measure
    w[102] = s1  # D A.x, crank.omega
    w[103] = s2  # D A.y, crank.omega
    w[104] = s1  # D B.x, crank.omega
    w[105] = s8  # D B.x, coupler.omega
    w[106] = s2  # D B.y, crank.omega
    w[107] = s6  # D B.y, coupler.omega
    w[108] = s8  # D C.x, coupler.omega
    w[109] = -s12  # D C.x, rocker.omega
    w[110] = s6  # D C.y, coupler.omega
    w[111] = s10  # D C.y, rocker.omega
    w[112] = s12  # D D.x, rocker.omega
    w[113] = -s10  # D D.y, rocker.omega
    w[60] = s87  # A.y
    w[61] = s88  # B.x
    w[62] = s89  # B.y
    w[63] = s90  # C.x
    w[64] = s91  # C.y
    w[66] = s93  # D.y
    w[5] = s63 + 1.0 + s85 + s81 + s75 + s67 + 1.0 + s50  # rank
    w[4] = min(s92, mask_7 + s93)  # smallest_pivot
    w[10] = 1.0  # shortest_row
    w[114] = s44
    w[115] = s45
    w[116] = s44
    w[117] = s52
    w[118] = s53
    w[119] = -s57
    w[120] = s58
    w[121] = s59
    w[122] = s65
    w[123] = s66
    w[124] = s69
    w[125] = s70
    w[126] = -s71
    w[127] = -s77
    w[128] = s78
    w[129] = s83
    w[130] = s42
    w[131] = s51
    w[132] = s56
    w[133] = s64
    w[134] = s68
    w[135] = s76
    w[136] = s82
    w[137] = s85/max(s84, 1e-300)
    return 0


@cuda.jit(device=True)
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 105 operations, 6984 before sharing."""
    # inputs
    gauge_2 = w[87]  # crank.omega
    gauge_5 = w[90]  # coupler.omega
    gauge_8 = w[93]  # rocker.omega
    lower_0 = w[114]
    lower_1 = w[115]
    lower_2 = w[116]
    lower_3 = w[117]
    lower_4 = w[118]
    lower_5 = w[119]
    lower_6 = w[120]
    lower_7 = w[121]
    lower_8 = w[122]
    lower_9 = w[123]
    lower_10 = w[124]
    lower_11 = w[125]
    lower_12 = w[126]
    lower_13 = w[127]
    lower_14 = w[128]
    lower_15 = w[129]
    reciprocal_0 = w[130]
    reciprocal_1 = w[131]
    reciprocal_2 = w[132]
    reciprocal_3 = w[133]
    reciprocal_4 = w[134]
    reciprocal_5 = w[135]
    reciprocal_6 = w[136]
    reciprocal_7 = w[137]
    residual_0 = w[43]  # A.x
    residual_1 = w[44]  # A.y
    residual_2 = w[45]  # B.x
    residual_3 = w[46]  # B.y
    residual_4 = w[47]  # C.x
    residual_5 = w[48]  # C.y
    residual_6 = w[49]  # D.x
    residual_7 = w[50]  # D.y
    jacobian_0 = w[102]  # D A.x, crank.omega
    jacobian_1 = w[103]  # D A.y, crank.omega
    jacobian_2 = w[104]  # D B.x, crank.omega
    jacobian_3 = w[105]  # D B.x, coupler.omega
    jacobian_4 = w[106]  # D B.y, crank.omega
    jacobian_5 = w[107]  # D B.y, coupler.omega
    jacobian_6 = w[108]  # D C.x, coupler.omega
    jacobian_7 = w[109]  # D C.x, rocker.omega
    jacobian_8 = w[110]  # D C.y, coupler.omega
    jacobian_9 = w[111]  # D C.y, rocker.omega
    jacobian_10 = w[112]  # D D.x, rocker.omega
    jacobian_11 = w[113]  # D D.y, rocker.omega
    # intermediate terms
    s0 = lower_0*residual_0 - residual_1
    s1 = lower_1*residual_0 - residual_2 - lower_3*s0
    s2 = lower_5*residual_6 - residual_7
    s3 = lower_2*residual_0 - residual_3 - lower_4*s0 - lower_10*s1
    s4 = lower_6*residual_6 - residual_4 - lower_8*s2 - lower_11*s1 - lower_13*s3
    s5 = reciprocal_7*(lower_7*residual_6 - residual_5 - lower_9*s2 - lower_12*s1 - lower_14*s3 - lower_15*s4)
    s6 = reciprocal_6*s4
    s7 = lower_15*s5
    s8 = s6 - s7
    s9 = reciprocal_5*s3 - lower_13*s8
    s10 = lower_14*s5
    s11 = s9 - s10
    s12 = reciprocal_4*s1 - lower_10*s11 - lower_11*s8
    s13 = lower_12*s5
    s14 = s12 - s13
    s15 = reciprocal_3*s2 - lower_8*s8 - lower_9*s5
    s16 = reciprocal_2*residual_6 + lower_5*s15 + lower_6*s8 + lower_7*s5
    s17 = reciprocal_1*s0 - lower_3*s14 - lower_4*s11
    s18 = reciprocal_0*residual_0 + lower_0*s17 + lower_1*s14 + lower_2*s11
    # outputs
    w[67] = s13 - s12 - s18  # crank.vx
    w[68] = s17 + s10 - s9  # crank.vy
    w[69] = gauge_2*(s17*jacobian_1 - s18*jacobian_0 + s14*jacobian_2 + s11*jacobian_4)  # crank.omega
    w[70] = s14 + s7 - s6  # coupler.vx
    w[71] = s11 - s5  # coupler.vy
    w[72] = gauge_5*(s14*jacobian_3 + s11*jacobian_5 + s8*jacobian_6 + s5*jacobian_8)  # coupler.omega
    w[73] = s8 - s16  # rocker.vx
    w[74] = s5 + s15  # rocker.vy
    w[75] = gauge_8*(s8*jacobian_7 + s5*jacobian_9 - s16*jacobian_10 + s15*jacobian_11)  # rocker.omega
    return 0


@cuda.jit(device=True)
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 75 operations, 203 before sharing."""
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
    p3 = p[3]  # 0.5*crank_mass
    p4 = p[4]  # 9.81*crank_mass
    p5 = p[5]  # 0.16666666666666666*crank_mass
    p6 = p[6]  # 0.5*coupler_mass
    p7 = p[7]  # 9.81*coupler_mass
    p8 = p[8]  # 2.6666666666666665*coupler_mass
    p9 = p[9]  # 0.5*rocker_mass
    p10 = p[10]  # 9.81*rocker_mass
    p11 = p[11]  # 1.0416666666666665*rocker_mass
    jacobian_0 = w[102]  # D A.x, crank.omega
    jacobian_1 = w[103]  # D A.y, crank.omega
    jacobian_2 = w[104]  # D B.x, crank.omega
    jacobian_3 = w[105]  # D B.x, coupler.omega
    jacobian_4 = w[106]  # D B.y, crank.omega
    jacobian_5 = w[107]  # D B.y, coupler.omega
    jacobian_6 = w[108]  # D C.x, coupler.omega
    jacobian_7 = w[109]  # D C.x, rocker.omega
    jacobian_8 = w[110]  # D C.y, coupler.omega
    jacobian_9 = w[111]  # D C.y, rocker.omega
    jacobian_10 = w[112]  # D D.x, rocker.omega
    jacobian_11 = w[113]  # D D.y, rocker.omega
    # intermediate terms
    s0 = p3*(v0*v0) + p3*(v1*v1) + v2*v2*p5 + p6*(v3*v3) + p6*(v4*v4) + v5*v5*p8 + p9*(v6*v6) + p9*(v7*v7)
    s1 = v0 + v2*jacobian_0
    s2 = v1 + v2*jacobian_1
    s3 = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    s4 = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    s5 = v6 + v5*jacobian_6 - v3 + v8*jacobian_7
    s6 = v7 + v5*jacobian_8 - v4 + v8*jacobian_9
    s7 = v6 + v8*jacobian_10
    s8 = v7 + v8*jacobian_11
    s9 = math.sqrt(s1*s1 + s2*s2 + s3*s3 + s4*s4 + s5*s5 + s6*s6 + s7*s7 + s8*s8)
    # outputs
    w[43] = s1  # A.x
    w[44] = s2  # A.y
    w[45] = s3  # B.x
    w[46] = s4  # B.y
    w[47] = s5  # C.x
    w[48] = s6  # C.y
    w[49] = s7  # D.x
    w[50] = s8  # D.y
    w[1] = s9  # velocity_violation
    w[9] = s9  # velocity_measure
    w[2] = s0 + v8*v8*p11  # kinetic
    w[3] = q1*p4 + q4*p7 + q7*p10  # potential
    return 0


@cuda.jit(device=True)
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates: 59 operations, 108 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    ydot_9 = ydot[9]  # rate of crank.vx
    ydot_10 = ydot[10]  # rate of crank.vy
    ydot_11 = ydot[11]  # rate of crank.omega
    ydot_12 = ydot[12]  # rate of coupler.vx
    ydot_13 = ydot[13]  # rate of coupler.vy
    ydot_14 = ydot[14]  # rate of coupler.omega
    ydot_15 = ydot[15]  # rate of rocker.vx
    ydot_16 = ydot[16]  # rate of rocker.vy
    ydot_17 = ydot[17]  # rate of rocker.omega
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
    out[0] = s3 + ydot_9 + s15  # A.x
    out[1] = s4 + ydot_10 - s16  # A.y
    out[2] = s3 + s8 + ydot_12 + s15 - ydot_9 + s17  # B.x
    out[3] = s4 + s9 + ydot_13 - (ydot_10 + s16) - s18  # B.y
    out[4] = ydot_15 + s17 - ydot_12 - s19 - (s13 - s8)  # C.x
    out[5] = ydot_16 - (ydot_13 + s18) + s20 - (s14 - s9)  # C.y
    out[6] = s13 + ydot_15 + s19  # D.x
    out[7] = s14 + ydot_16 - s20  # D.y
    out[8] = q2  # A.angle
    out[9] = v2  # rate of A.angle
    out[10] = q5 - q2  # B.angle
    out[11] = v5 - v2  # rate of B.angle
    out[12] = q8 - q5  # C.angle
    out[13] = v8 - v5  # rate of C.angle
    out[14] = q8  # D.angle
    out[15] = v8  # rate of D.angle
    return 0


@cuda.jit(device=True)
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p12 = p[12]  # 0.3333333333333333*crank_mass
    p13 = p[13]  # 5.333333333333333*coupler_mass
    p14 = p[14]  # 2.083333333333333*rocker_mass
    # outputs
    w[76] = p0  # crank.vx
    w[77] = p0  # crank.vy
    w[78] = p12  # crank.omega
    w[79] = p1  # coupler.vx
    w[80] = p1  # coupler.vy
    w[81] = p13  # coupler.omega
    w[82] = p2  # rocker.vx
    w[83] = p2  # rocker.vy
    w[84] = p14  # rocker.omega
    return 0
