"""Model `driven-four-bar`: what every method of it shares. Emitted by symgen; do not edit.

digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 3, templates 774f5f3a0a6c3684
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

w[0:19]  status
w[19:28]  multipliers
w[28:37]  mask
w[37:46]  saved
w[46:55]  residual
w[55:64]  nu
w[64:73]  pivot
w[73:82]  change
w[82:91]  mass
w[91:100]  gauge
w[100:109]  row_weight
w[109:121]  jacobian
w[121:141]  lower
w[141:150]  reciprocal

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
    p[5] = 0.5*p0  # 0.5*crank_mass
    p[6] = 9.81*p0  # 9.81*crank_mass
    p[7] = 0.16666666666666666*p0  # 0.16666666666666666*crank_mass
    p[8] = 0.5*p1  # 0.5*coupler_mass
    p[9] = 9.81*p1  # 9.81*coupler_mass
    p[10] = 2.6666666666666665*p1  # 2.6666666666666665*coupler_mass
    p[11] = 0.5*p2  # 0.5*rocker_mass
    p[12] = 9.81*p2  # 9.81*rocker_mass
    p[13] = 1.0416666666666665*p2  # 1.0416666666666665*rocker_mass
    p[14] = 0.3333333333333333*p0  # 0.3333333333333333*crank_mass
    p[15] = 5.333333333333333*p1  # 5.333333333333333*coupler_mass
    p[16] = 2.083333333333333*p2  # 2.083333333333333*rocker_mass
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 261 operations, 142124 before sharing."""
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
    mask_1 = w[29]  # A.y
    mask_2 = w[30]  # B.x
    mask_3 = w[31]  # B.y
    mask_4 = w[32]  # C.x
    mask_5 = w[33]  # C.y
    mask_7 = w[35]  # D.y
    mask_8 = w[36]  # motor.driver
    gauge_2 = w[93]  # crank.omega
    gauge_5 = w[96]  # coupler.omega
    gauge_8 = w[99]  # rocker.omega
    status_6 = w[6]  # length_scale
    row_weight_8 = w[108]  # motor.driver
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
    s17 = s1*gauge_2
    s18 = s0*gauge_2
    s19 = s8*gauge_5
    s20 = s5*gauge_5
    s21 = s12*gauge_8
    s22 = s10*gauge_8
    s23 = s1*s17
    s24 = 1.0 + s23
    s25 = s0*s17
    s26 = -1.0 + s23
    s27 = s0*s18
    s28 = 1.0 + s27
    s29 = s8*s19
    s30 = 1.0 + s24 + s29
    s31 = s5*s19
    s32 = -1.0 + s29
    s33 = s5*s20
    s34 = 1.0 + s28 + s33
    s35 = s8*s20
    s36 = s12*s21
    s37 = 1.0 + 1.0 + s29 + s36
    s38 = s10*s21
    s39 = 1.0 - s36
    s40 = s10*s22
    s41 = 1.0 + 1.0 + s33 + s40
    s42 = s12*s22
    s43 = 1.0 + s40
    s44 = 1.0/(1.0 + s36)
    s45 = s38*s44
    s46 = s39*s44
    s47 = s42*s44
    s48 = s43 - s38*s45
    s49 = s38 + s39*s45
    s50 = 1.0 - s40 + s42*s45
    s51 = 1.0*(s48 > mask_7 + 1e-12*s43)
    s52 = s51/max(s48, 1e-300)
    s53 = s49*s52
    s54 = s50*s52
    s55 = s37 - s39*s46 - s49*s53
    s56 = s31 + s38 + s42*s46 + s50*s53
    s57 = 1.0*(s55 > mask_4 + 1e-12*s37)
    s58 = s57/max(s55, 1e-300)
    s59 = s56*s58
    s60 = s32*s58
    s61 = s35*s58
    s62 = s41 - s42*s47 - s50*s54 - s56*s59
    s63 = s32*s59 - s31
    s64 = -1.0 + s33 - s35*s59
    s65 = 1.0*(s62 > mask_5 + 1e-12*s41)
    s66 = s65/max(s62, 1e-300)
    s67 = s63*s66
    s68 = s64*s66
    s69 = 1.0/s24
    s70 = s25*s69
    s71 = -s70
    s72 = s17*s69
    s73 = s26*s69
    s74 = s25*s70
    s75 = s28 - s74
    s76 = s17*s70 - s18
    s77 = s26*s70 - s1*s18
    s78 = -1.0 + s27 - s74
    s79 = 1.0*(s75 > mask_1 + 1e-12*s28)
    s80 = s79/max(s75, 1e-300)
    s81 = s76*s80
    s82 = s77*s80
    s83 = s78*s80
    s84 = gauge_2 - s17*s72 - s76*s81
    s85 = s17 - s26*s72 - s77*s81
    s86 = s25*s72 - s18 - s78*s81
    s87 = 1.0*(s84 > mask_8 + 1e-12*gauge_2)
    s88 = s87/max(s84, 1e-300)
    s89 = s85*s88
    s90 = s86*s88
    s91 = s30 - s32*s60 - s63*s67 - s26*s73 - s77*s82 - s85*s89
    s92 = s35*s60 - (s25 + s31) - s64*s67 + s25*s73 - s78*s82 - s86*s89
    s93 = 1.0*(s91 > mask_2 + 1e-12*s30)
    s94 = s93/max(s91, 1e-300)
    s95 = s92*s94
    s96 = s34 - s35*s61 - s64*s68 - s74 - s78*s83 - s86*s90 - s92*s95
    s97 = 1.0*(s96 > mask_3 + 1e-12*s34)
    s98 = s16*status_6
    s99 = s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15
    s100 = s75/s28
    s101 = s91/s30
    s102 = s96/s34
    s103 = s55/s37
    s104 = s62/s41
    s105 = min(min(min(min(min(1.0, mask_1 + s100), mask_2 + s101), mask_3 + s102), mask_4 + s103), mask_5 + s104)
    s106 = s48/s43
    s107 = s84/gauge_2
    # outputs
    w[46] = s3  # A.x
    w[47] = s4  # A.y
    w[48] = s7  # B.x
    w[49] = s9  # B.y
    w[50] = s11  # C.x
    w[51] = s13  # C.y
    w[52] = s14  # D.x
    w[53] = s15  # D.y
    w[54] = s16  # motor.driver
    w[0] = math.sqrt(s99 + s16*s16)  # position_violation
    w[8] = math.sqrt(s99 + s98*s98)  # position_measure
    w[63] = p4  # motor.driver
    w[109] = s1  # D A.x, crank.omega
    w[110] = s2  # D A.y, crank.omega
    w[111] = s1  # D B.x, crank.omega
    w[112] = s8  # D B.x, coupler.omega
    w[113] = s2  # D B.y, crank.omega
    w[114] = s6  # D B.y, coupler.omega
    w[115] = s8  # D C.x, coupler.omega
    w[116] = -s12  # D C.x, rocker.omega
    w[117] = s6  # D C.y, coupler.omega
    w[118] = s10  # D C.y, rocker.omega
    w[119] = s12  # D D.x, rocker.omega
    w[120] = -s10  # D D.y, rocker.omega
    w[65] = s100  # A.y
    w[66] = s101  # B.x
    w[67] = s102  # B.y
    w[68] = s103  # C.x
    w[69] = s104  # C.y
    w[71] = s106  # D.y
    w[72] = s107  # motor.driver
    w[5] = s87 + s51 + 1.0 + s65 + s57 + s97 + s93 + 1.0 + s79  # rank
    w[4] = min(min(s105, mask_7 + s106), mask_8 + s107)  # smallest_pivot
    w[10] = min(1.0, gauge_2*row_weight_8)  # shortest_row
    w[121] = -s45
    w[122] = s46
    w[123] = s47
    w[124] = s53
    w[125] = s54
    w[126] = -s59
    w[127] = s60
    w[128] = -s61
    w[129] = s67
    w[130] = s68
    w[131] = s71
    w[132] = s72
    w[133] = s73
    w[134] = s71
    w[135] = s81
    w[136] = s82
    w[137] = s83
    w[138] = s89
    w[139] = s90
    w[140] = s95
    w[141] = s44
    w[142] = s52
    w[143] = s58
    w[144] = s66
    w[145] = s69
    w[146] = s80
    w[147] = s88
    w[148] = s94
    w[149] = s97/max(s96, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 123 operations, 10067 before sharing."""
    # inputs
    gauge_2 = w[93]  # crank.omega
    gauge_5 = w[96]  # coupler.omega
    gauge_8 = w[99]  # rocker.omega
    lower_0 = w[121]
    lower_1 = w[122]
    lower_2 = w[123]
    lower_3 = w[124]
    lower_4 = w[125]
    lower_5 = w[126]
    lower_6 = w[127]
    lower_7 = w[128]
    lower_8 = w[129]
    lower_9 = w[130]
    lower_10 = w[131]
    lower_11 = w[132]
    lower_12 = w[133]
    lower_13 = w[134]
    lower_14 = w[135]
    lower_15 = w[136]
    lower_16 = w[137]
    lower_17 = w[138]
    lower_18 = w[139]
    lower_19 = w[140]
    reciprocal_0 = w[141]
    reciprocal_1 = w[142]
    reciprocal_2 = w[143]
    reciprocal_3 = w[144]
    reciprocal_4 = w[145]
    reciprocal_5 = w[146]
    reciprocal_6 = w[147]
    reciprocal_7 = w[148]
    reciprocal_8 = w[149]
    residual_0 = w[46]  # A.x
    residual_1 = w[47]  # A.y
    residual_2 = w[48]  # B.x
    residual_3 = w[49]  # B.y
    residual_4 = w[50]  # C.x
    residual_5 = w[51]  # C.y
    residual_6 = w[52]  # D.x
    residual_7 = w[53]  # D.y
    residual_8 = w[54]  # motor.driver
    jacobian_0 = w[109]  # D A.x, crank.omega
    jacobian_1 = w[110]  # D A.y, crank.omega
    jacobian_2 = w[111]  # D B.x, crank.omega
    jacobian_3 = w[112]  # D B.x, coupler.omega
    jacobian_4 = w[113]  # D B.y, crank.omega
    jacobian_5 = w[114]  # D B.y, coupler.omega
    jacobian_6 = w[115]  # D C.x, coupler.omega
    jacobian_7 = w[116]  # D C.x, rocker.omega
    jacobian_8 = w[117]  # D C.y, coupler.omega
    jacobian_9 = w[118]  # D C.y, rocker.omega
    jacobian_10 = w[119]  # D D.x, rocker.omega
    jacobian_11 = w[120]  # D D.y, rocker.omega
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
    w[73] = s9 - s8 - s13  # crank.vx
    w[74] = s12 - s7  # crank.vy
    w[75] = gauge_2*(s11 + s12*jacobian_1 - s13*jacobian_0 + s10*jacobian_2 + s7*jacobian_4)  # crank.omega
    w[76] = s10 + s18 - s17  # coupler.vx
    w[77] = s7 + s15 - s14  # coupler.vy
    w[78] = gauge_5*(s10*jacobian_3 + s7*jacobian_5 + s19*jacobian_6 + s16*jacobian_8)  # coupler.omega
    w[79] = s19 - s21  # rocker.vx
    w[80] = s16 + s20  # rocker.vy
    w[81] = gauge_8*(s19*jacobian_7 + s16*jacobian_9 - s21*jacobian_10 + s20*jacobian_11)  # rocker.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 82 operations, 214 before sharing."""
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
    p5 = p[5]  # 0.5*crank_mass
    p6 = p[6]  # 9.81*crank_mass
    p7 = p[7]  # 0.16666666666666666*crank_mass
    p8 = p[8]  # 0.5*coupler_mass
    p9 = p[9]  # 9.81*coupler_mass
    p10 = p[10]  # 2.6666666666666665*coupler_mass
    p11 = p[11]  # 0.5*rocker_mass
    p12 = p[12]  # 9.81*rocker_mass
    p13 = p[13]  # 1.0416666666666665*rocker_mass
    status_6 = w[6]  # length_scale
    jacobian_0 = w[109]  # D A.x, crank.omega
    jacobian_1 = w[110]  # D A.y, crank.omega
    jacobian_2 = w[111]  # D B.x, crank.omega
    jacobian_3 = w[112]  # D B.x, coupler.omega
    jacobian_4 = w[113]  # D B.y, crank.omega
    jacobian_5 = w[114]  # D B.y, coupler.omega
    jacobian_6 = w[115]  # D C.x, coupler.omega
    jacobian_7 = w[116]  # D C.x, rocker.omega
    jacobian_8 = w[117]  # D C.y, coupler.omega
    jacobian_9 = w[118]  # D C.y, rocker.omega
    jacobian_10 = w[119]  # D D.x, rocker.omega
    jacobian_11 = w[120]  # D D.y, rocker.omega
    nu_8 = w[63]  # motor.driver
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
    s10 = status_6*s9
    s11 = s1*s1 + s2*s2 + s3*s3 + s4*s4 + s5*s5 + s6*s6 + s7*s7 + s8*s8
    # outputs
    w[46] = s1  # A.x
    w[47] = s2  # A.y
    w[48] = s3  # B.x
    w[49] = s4  # B.y
    w[50] = s5  # C.x
    w[51] = s6  # C.y
    w[52] = s7  # D.x
    w[53] = s8  # D.y
    w[54] = s9  # motor.driver
    w[1] = math.sqrt(s11 + s9*s9)  # velocity_violation
    w[9] = math.sqrt(s11 + s10*s10)  # velocity_measure
    w[2] = s0 + v8*v8*p13  # kinetic
    w[3] = q1*p6 + q4*p9 + q7*p12  # potential
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
    out[8] = ydot_11  # motor.driver
    out[9] = q2  # A.angle
    out[10] = v2  # rate of A.angle
    out[11] = q5 - q2  # B.angle
    out[12] = v5 - v2  # rate of B.angle
    out[13] = q8 - q5  # C.angle
    out[14] = v8 - v5  # rate of C.angle
    out[15] = q8  # D.angle
    out[16] = v8  # rate of D.angle
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p14 = p[14]  # 0.3333333333333333*crank_mass
    p15 = p[15]  # 5.333333333333333*coupler_mass
    p16 = p[16]  # 2.083333333333333*rocker_mass
    # outputs
    w[82] = p0  # crank.vx
    w[83] = p0  # crank.vy
    w[84] = p14  # crank.omega
    w[85] = p1  # coupler.vx
    w[86] = p1  # coupler.vy
    w[87] = p15  # coupler.omega
    w[88] = p2  # rocker.vx
    w[89] = p2  # rocker.vy
    w[90] = p16  # rocker.omega
    return 0
