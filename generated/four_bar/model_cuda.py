"""Model `four-bar`: what every method of it shares, for CUDA. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
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
    p[3] = 0.5*p0
    p[4] = 9.81*p0
    p[5] = 0.16666666666666666*p0
    p[6] = 0.5*p1
    p[7] = 9.81*p1
    p[8] = 2.6666666666666665*p1
    p[9] = 0.5*p2
    p[10] = 9.81*p2
    p[11] = 1.0416666666666665*p2
    p[12] = 0.3333333333333333*p0
    p[13] = 5.333333333333333*p1
    p[14] = 2.083333333333333*p2
    return 0

@cuda.jit(device=True)
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 211 operations, 217815 before sharing."""
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
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_7 = w[30]
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
    s16 = s1*s1
    s17 = 1.0 + s16
    s18 = s0*s1
    s19 = -1.0 + s16
    s20 = s0*s0
    s21 = 1.0 + s20
    s22 = s8*s8
    s23 = 1.0 + s17 + s22
    s24 = s5*s8
    s25 = -1.0 + s22
    s26 = s5*s5
    s27 = 1.0 + s21 + s26
    s28 = s12*s12
    s29 = 1.0 + 1.0 + s22 + s28
    s30 = s10*s12
    s31 = 1.0 - s28
    s32 = s10*s10
    s33 = 1.0 + 1.0 + s26 + s32
    s34 = 1.0 + s32
    s35 = 1.0/s17
    s36 = s18*s35
    s37 = -s36
    s38 = s19*s35
    s39 = s18*s36
    s40 = s21 - s39
    s41 = s19*s36 - s18
    s42 = -1.0 + s20 - s39
    s43 = 1.0*(s40 > mask_1 + 1e-12*s21)
    s44 = s43/(s40 + 1.0 - s43)
    s45 = s41*s44
    s46 = s42*s44
    s47 = s23 - s19*s38 - s41*s45
    s48 = s18*s38 - (s18 + s24) - s42*s45
    s49 = 1.0/(1.0 + s28)
    s50 = s30*s49
    s51 = s31*s49
    s52 = s30*s50
    s53 = s34 - s52
    s54 = s30 + s31*s50
    s55 = 1.0 - s32 + s52
    s56 = 1.0*(s53 > mask_7 + 1e-12*s34)
    s57 = s56/(s53 + 1.0 - s56)
    s58 = s54*s57
    s59 = s55*s57
    s60 = 1.0*(s47 > mask_2 + 1e-12*s23)
    s61 = s60/(s47 + 1.0 - s60)
    s62 = s48*s61
    s63 = s25*s61
    s64 = s24*s61
    s65 = s27 - s39 - s42*s46 - s48*s62
    s66 = s24 + s25*s62
    s67 = -1.0 + s26 + s24*s62
    s68 = 1.0*(s65 > mask_3 + 1e-12*s27)
    s69 = s68/(s65 + 1.0 - s68)
    s70 = s66*s69
    s71 = s67*s69
    s72 = s29 - s31*s51 - s54*s58 - s25*s63 - s66*s70
    s73 = s24*s63 - (s24 + s30 + s30*s51 + s55*s58) + s67*s70
    s74 = 1.0*(s72 > mask_4 + 1e-12*s29)
    s75 = s74/(s72 + 1.0 - s74)
    s76 = s73*s75
    s77 = s33 - s52 - s55*s59 - s24*s64 - s67*s71 - s73*s76
    s78 = 1.0*(s77 > mask_5 + 1e-12*s33)
    s79 = s40/s21
    s80 = s47/s23
    s81 = s65/s27
    s82 = s72/s29
    s83 = s77/s33
    s84 = min(min(min(min(min(1.0, mask_1 + s79), mask_2 + s80), mask_3 + s81), mask_4 + s82), mask_5 + s83)
    s85 = s53/s34
    # outputs
    w[39] = s3
    w[40] = s4
    w[41] = s7
    w[42] = s9
    w[43] = s11
    w[44] = s13
    w[45] = s14
    w[46] = s15
    w[0] = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15)
    w[81] = s1
    w[82] = s2
    w[83] = s1
    w[84] = s8
    w[85] = s2
    w[86] = s6
    w[87] = s8
    w[88] = -s12
    w[89] = s6
    w[90] = s10
    w[91] = s12
    w[92] = -s10
    w[56] = s79
    w[57] = s80
    w[58] = s81
    w[59] = s82
    w[60] = s83
    w[62] = s85
    w[5] = s56 + 1.0 + s78 + s74 + s68 + s60 + 1.0 + s43
    w[4] = min(s84, mask_7 + s85)
    w[93] = s37
    w[94] = s38
    w[95] = s37
    w[96] = s45
    w[97] = s46
    w[98] = -s50
    w[99] = s51
    w[100] = s50
    w[101] = s58
    w[102] = s59
    w[103] = s62
    w[104] = s63
    w[105] = -s64
    w[106] = -s70
    w[107] = s71
    w[108] = s76
    w[109] = s35
    w[110] = s44
    w[111] = s49
    w[112] = s57
    w[113] = s61
    w[114] = s69
    w[115] = s75
    w[116] = s78/(s77 + 1.0 - s78)
    return 0

@cuda.jit(device=True)
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 102 operations, 6981 before sharing."""
    # inputs
    lower_0 = w[93]
    lower_1 = w[94]
    lower_2 = w[95]
    lower_3 = w[96]
    lower_4 = w[97]
    lower_5 = w[98]
    lower_6 = w[99]
    lower_7 = w[100]
    lower_8 = w[101]
    lower_9 = w[102]
    lower_10 = w[103]
    lower_11 = w[104]
    lower_12 = w[105]
    lower_13 = w[106]
    lower_14 = w[107]
    lower_15 = w[108]
    reciprocal_0 = w[109]
    reciprocal_1 = w[110]
    reciprocal_2 = w[111]
    reciprocal_3 = w[112]
    reciprocal_4 = w[113]
    reciprocal_5 = w[114]
    reciprocal_6 = w[115]
    reciprocal_7 = w[116]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    jacobian_8 = w[89]
    jacobian_9 = w[90]
    jacobian_10 = w[91]
    jacobian_11 = w[92]
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
    w[63] = s13 - s12 - s18
    w[64] = s17 + s10 - s9
    w[65] = s17*jacobian_1 - s18*jacobian_0 + s14*jacobian_2 + s11*jacobian_4
    w[66] = s14 + s7 - s6
    w[67] = s11 - s5
    w[68] = s14*jacobian_3 + s11*jacobian_5 + s8*jacobian_6 + s5*jacobian_8
    w[69] = s8 - s16
    w[70] = s5 + s15
    w[71] = s8*jacobian_7 + s5*jacobian_9 - s16*jacobian_10 + s15*jacobian_11
    return 0

@cuda.jit(device=True)
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 75 operations, 131 before sharing."""
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
    p3 = p[3]
    p4 = p[4]
    p5 = p[5]
    p6 = p[6]
    p7 = p[7]
    p8 = p[8]
    p9 = p[9]
    p10 = p[10]
    p11 = p[11]
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    jacobian_8 = w[89]
    jacobian_9 = w[90]
    jacobian_10 = w[91]
    jacobian_11 = w[92]
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
    # outputs
    w[39] = s1
    w[40] = s2
    w[41] = s3
    w[42] = s4
    w[43] = s5
    w[44] = s6
    w[45] = s7
    w[46] = s8
    w[1] = math.sqrt(s1*s1 + s2*s2 + s3*s3 + s4*s4 + s5*s5 + s6*s6 + s7*s7 + s8*s8)
    w[2] = s0 + v8*v8*p11
    w[3] = q1*p4 + q4*p7 + q7*p10
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
    out[8] = q2
    out[9] = v2
    out[10] = q5 - q2
    out[11] = v5 - v2
    out[12] = q8 - q5
    out[13] = v8 - v5
    out[14] = q8
    out[15] = v8
    return 0

@cuda.jit(device=True)
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p12 = p[12]
    p13 = p[13]
    p14 = p[14]
    # outputs
    w[72] = p0
    w[73] = p0
    w[74] = p12
    w[75] = p1
    w[76] = p1
    w[77] = p13
    w[78] = p2
    w[79] = p2
    w[80] = p14
    return 0
