"""Model `slider-crank`: what every method of it shares. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 2, templates 06e8f0c6b361de81
9 coordinates, 9 velocities, 8 constraint rows, 3 parameters,
0 fill-ins in the factor of D D^T

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     crank.x [m]
y[1]     crank.y [m]
y[2]     crank.theta [rad]
y[3]     rod.x [m]
y[4]     rod.y [m]
y[5]     rod.theta [rad]
y[6]     slider.x [m]
y[7]     slider.y [m]
y[8]     slider.theta [rad]
y[9]     crank.vx [m/s]
y[10]    crank.vy [m/s]
y[11]    crank.omega [rad/s]
y[12]    rod.vx [m/s]
y[13]    rod.vy [m/s]
y[14]    rod.omega [rad/s]
y[15]    slider.vx [m/s]
y[16]    slider.vy [m/s]
y[17]    slider.omega [rad/s]
y[18]    work of forces without potential and of drivers [J]
p[0]     crank_mass [kg]
p[1]     rod_mass [kg]
p[2]     slider_mass [kg]
row 0    O.x [m]
row 1    O.y [m]
row 2    P.x [m]
row 3    P.y [m]
row 4    Q.x [m]
row 5    Q.y [m]
row 6    guide.normal [m]
row 7    guide.angle [rad]

Left out:
- z coordinates, Euler parameters and 3x3 inertia tensors: the mechanism is planar
- the kinematic map N: planar velocities are the rates of the coordinates
- gyroscopic terms: they vanish in the plane
- columns of the ground: the ground does not move
- centre-of-mass offset of crank: its centre of mass is the frame's origin
- centre-of-mass offset of rod: its centre of mass is the frame's origin
- centre-of-mass offset of slider: its centre of mass is the frame's origin
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 10 operations, 10 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # rod_mass [kg]
    p2 = p[2]  # slider_mass [kg]
    # outputs
    p[3] = 0.5*p0
    p[4] = 9.81*p0
    p[5] = 0.0009375*p0
    p[6] = 0.5*p1
    p[7] = 9.81*p1
    p[8] = 0.0084375*p1
    p[9] = 0.5*p2
    p[10] = 9.81*p2
    p[11] = 0.001875*p0
    p[12] = 0.016875*p1
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 150 operations, 18968 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # rod.x [m]
    q4 = y[4]  # rod.y [m]
    q5 = y[5]  # rod.theta [rad]
    q6 = y[6]  # slider.x [m]
    q7 = y[7]  # slider.y [m]
    q8 = y[8]  # slider.theta [rad]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_5 = w[28]
    # intermediate terms
    s0 = 0.075*math.cos(q2)
    s1 = -s0
    s2 = q0 - s0
    s3 = 0.075*math.sin(q2)
    s4 = q1 - s3
    s5 = 0.225*math.cos(q5)
    s6 = -s5
    s7 = q3 - q0 - s5 - s0
    s8 = 0.225*math.sin(q5)
    s9 = q4 - q1 - s8 - s3
    s10 = q6 - q3 - s5
    s11 = q7 - q4 - s8
    s12 = s3*s3
    s13 = 1.0 + s12
    s14 = s0*s3
    s15 = -1.0 + s12
    s16 = s0*s0
    s17 = 1.0 + s16
    s18 = s8*s8
    s19 = 1.0 + s13 + s18
    s20 = s5*s8
    s21 = -1.0 + s18
    s22 = s5*s5
    s23 = 1.0 + s17 + s22
    s24 = 1.0 + 1.0 + s22
    s25 = 1.0/s13
    s26 = s14*s25
    s27 = -s26
    s28 = s15*s25
    s29 = s14*s26
    s30 = s17 - s29
    s31 = s15*s26 - s14
    s32 = -1.0 + s16 - s29
    s33 = 1.0*(s30 > mask_1 + 1e-12*s17)
    s34 = s33/(s30 + 1.0 - s33)
    s35 = s31*s34
    s36 = s32*s34
    s37 = 1.0/(1.0 + 1.0 + s18)
    s38 = s20*s37
    s39 = -s38
    s40 = s21*s37
    s41 = s20*s38
    s42 = s24 - 1.0 - s41
    s43 = s21*s38 - s20
    s44 = -1.0 + s22 - s41
    s45 = 1.0*(s42 > mask_5 + 1e-12*s24)
    s46 = s45/(s42 + 1.0 - s45)
    s47 = s43*s46
    s48 = s44*s46
    s49 = s19 - s15*s28 - s31*s35 - s21*s40 - s43*s47
    s50 = s14*s28 - (s14 + s20) - s32*s35 + s20*s40 - s44*s47
    s51 = 1.0*(s49 > mask_2 + 1e-12*s19)
    s52 = s51/(s49 + 1.0 - s51)
    s53 = s50*s52
    s54 = s23 - s29 - s32*s36 - s41 - s44*s48 - s50*s53
    s55 = 1.0*(s54 > mask_3 + 1e-12*s23)
    s56 = s30/s17
    s57 = s49/s19
    s58 = s54/s23
    s59 = s42/s24
    # outputs
    w[39] = s2
    w[40] = s4
    w[41] = s7
    w[42] = s9
    w[43] = s10
    w[44] = s11
    w[45] = q7
    w[46] = q8
    w[0] = math.sqrt(s2*s2 + s4*s4 + s7*s7 + s9*s9 + s10*s10 + s11*s11 + q7*q7 + q8*q8)
    w[81] = s3
    w[82] = s1
    w[83] = s3
    w[84] = s8
    w[85] = s1
    w[86] = s6
    w[87] = s8
    w[88] = s6
    w[56] = s56
    w[57] = s57
    w[58] = s58
    w[60] = s59
    w[5] = 1.0 + 1.0 + s45 + 1.0 + s55 + s51 + 1.0 + s33
    w[4] = min(min(min(min(1.0, mask_1 + s56), mask_2 + s57), mask_3 + s58), mask_5 + s59)
    w[89] = s27
    w[90] = s28
    w[91] = s27
    w[92] = s35
    w[93] = s36
    w[94] = s39
    w[95] = s40
    w[96] = s39
    w[97] = s47
    w[98] = s48
    w[99] = s53
    w[100] = s25
    w[101] = s34
    w[102] = s37
    w[103] = s46
    w[104] = s52
    w[105] = s55/(s54 + 1.0 - s55)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 75 operations, 1621 before sharing."""
    # inputs
    lower_0 = w[89]
    lower_1 = w[90]
    lower_2 = w[91]
    lower_3 = w[92]
    lower_4 = w[93]
    lower_5 = w[94]
    lower_6 = w[95]
    lower_7 = w[96]
    lower_8 = w[97]
    lower_9 = w[98]
    lower_10 = w[99]
    reciprocal_0 = w[100]
    reciprocal_1 = w[101]
    reciprocal_2 = w[102]
    reciprocal_3 = w[103]
    reciprocal_4 = w[104]
    reciprocal_5 = w[105]
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
    # intermediate terms
    s0 = lower_0*residual_0 - residual_1
    s1 = residual_6 - residual_5 + lower_5*residual_4
    s2 = lower_1*residual_0 - residual_2 - lower_3*s0 + lower_6*residual_4 - lower_8*s1
    s3 = lower_2*residual_0 - residual_3 - lower_4*s0 + lower_7*residual_4 - lower_9*s1 - lower_10*s2
    s4 = reciprocal_5*s3
    s5 = reciprocal_4*s2
    s6 = lower_10*s4
    s7 = s5 - s6
    s8 = reciprocal_3*s1 - lower_8*s7
    s9 = lower_9*s4
    s10 = s8 - s9
    s11 = reciprocal_2*residual_4 + lower_5*s10 + lower_6*s7 + lower_7*s4
    s12 = reciprocal_1*s0 - lower_3*s7 - lower_4*s4
    s13 = reciprocal_0*residual_0 + lower_0*s12 + lower_1*s7 + lower_2*s4
    # outputs
    w[63] = s6 - s5 - s13
    w[64] = s12 - s4
    w[65] = s12*jacobian_1 - s13*jacobian_0 + s7*jacobian_2 + s4*jacobian_4
    w[66] = s7 + s11
    w[67] = s4 + s9 - s8
    w[68] = s7*jacobian_3 + s4*jacobian_5 - s11*jacobian_6 + s10*jacobian_7
    w[69] = -s11
    w[70] = s10 - (residual_6 + s10)
    w[71] = -residual_7
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 65 operations, 107 before sharing."""
    # inputs
    q1 = y[1]  # crank.y [m]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q4 = y[4]  # rod.y [m]
    v3 = y[12]  # rod.vx [m/s]
    v4 = y[13]  # rod.vy [m/s]
    v5 = y[14]  # rod.omega [rad/s]
    q7 = y[7]  # slider.y [m]
    v6 = y[15]  # slider.vx [m/s]
    v7 = y[16]  # slider.vy [m/s]
    v8 = y[17]  # slider.omega [rad/s]
    p3 = p[3]
    p4 = p[4]
    p5 = p[5]
    p6 = p[6]
    p7 = p[7]
    p8 = p[8]
    p9 = p[9]
    p10 = p[10]
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    # intermediate terms
    s0 = v8*v8
    s1 = v7*v7
    s2 = p3*(v0*v0) + p3*(v1*v1) + v2*v2*p5 + p6*(v3*v3) + p6*(v4*v4) + v5*v5*p8 + p9*(v6*v6) + p9*s1
    s3 = v0 + v2*jacobian_0
    s4 = v1 + v2*jacobian_1
    s5 = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    s6 = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    s7 = v6 + v5*jacobian_6 - v3
    s8 = v7 + v5*jacobian_7 - v4
    # outputs
    w[39] = s3
    w[40] = s4
    w[41] = s5
    w[42] = s6
    w[43] = s7
    w[44] = s8
    w[45] = v7
    w[46] = v8
    w[1] = math.sqrt(s0 + s1 + s3*s3 + s4*s4 + s5*s5 + s6*s6 + s7*s7 + s8*s8)
    w[2] = s2 + 0.00025*s0
    w[3] = q1*p4 + q4*p7 + q7*p10
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates: 44 operations, 80 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # rod.theta [rad]
    v5 = y[14]  # rod.omega [rad/s]
    q6 = y[6]  # slider.x [m]
    q8 = y[8]  # slider.theta [rad]
    v6 = y[15]  # slider.vx [m/s]
    v8 = y[17]  # slider.omega [rad/s]
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
    s2 = 0.075*(v2*v2)
    s3 = s0*s2
    s4 = s1*s2
    s5 = math.cos(q5)
    s6 = math.sin(q5)
    s7 = 0.225*(v5*v5)
    s8 = s5*s7
    s9 = s6*s7
    s10 = 0.075*s1*ydot_11
    s11 = 0.075*s0*ydot_11
    s12 = 0.225*s6*ydot_14
    s13 = 0.225*s5*ydot_14
    # outputs
    out[0] = s3 + ydot_9 + s10
    out[1] = s4 + ydot_10 - s11
    out[2] = s3 + s8 + ydot_12 + s10 - ydot_9 + s12
    out[3] = s4 + s9 + ydot_13 - (ydot_10 + s11) - s13
    out[4] = s8 + ydot_15 + s12 - ydot_12
    out[5] = s9 + ydot_16 - (ydot_13 + s13)
    out[6] = ydot_16
    out[7] = ydot_17
    out[8] = q2
    out[9] = v2
    out[10] = q5 - q2
    out[11] = v5 - v2
    out[12] = q8 - q5
    out[13] = v8 - v5
    out[14] = q6
    out[15] = v6
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # rod_mass [kg]
    p2 = p[2]  # slider_mass [kg]
    p11 = p[11]
    p12 = p[12]
    # outputs
    w[72] = p0
    w[73] = p0
    w[74] = p11
    w[75] = p1
    w[76] = p1
    w[77] = p12
    w[78] = p2
    w[79] = p2
    w[80] = 0.0005
    return 0
