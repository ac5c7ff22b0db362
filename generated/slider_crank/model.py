"""Model `slider-crank`: what every method of it shares. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
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
w[102:110]  jacobian
w[110:121]  lower
w[121:128]  reciprocal

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
    p[3] = 0.5*p0  # 0.5*crank_mass
    p[4] = 9.81*p0  # 9.81*crank_mass
    p[5] = 0.0009375*p0  # 0.0009375*crank_mass
    p[6] = 0.5*p1  # 0.5*rod_mass
    p[7] = 9.81*p1  # 9.81*rod_mass
    p[8] = 0.0084375*p1  # 0.0084375*rod_mass
    p[9] = 0.5*p2  # 0.5*slider_mass
    p[10] = 9.81*p2  # 9.81*slider_mass
    p[11] = 0.001875*p0  # 0.001875*crank_mass
    p[12] = 0.016875*p1  # 0.016875*rod_mass
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 163 operations, 12748 before sharing."""
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
    mask_1 = w[28]  # O.y
    mask_2 = w[29]  # P.x
    mask_3 = w[30]  # P.y
    mask_5 = w[32]  # Q.y
    gauge_2 = w[87]  # crank.omega
    gauge_5 = w[90]  # rod.omega
    gauge_8 = w[93]  # slider.omega
    status_6 = w[6]  # length_scale
    row_weight_7 = w[101]  # guide.angle
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
    s12 = s3*gauge_2
    s13 = s0*gauge_2
    s14 = s8*gauge_5
    s15 = s5*gauge_5
    s16 = s3*s12
    s17 = 1.0 + s16
    s18 = s0*s12
    s19 = -1.0 + s16
    s20 = s0*s13
    s21 = 1.0 + s20
    s22 = s8*s14
    s23 = 1.0 + s17 + s22
    s24 = s5*s14
    s25 = -1.0 + s22
    s26 = s5*s15
    s27 = 1.0 + s21 + s26
    s28 = s8*s15
    s29 = 1.0 + 1.0 + s26
    s30 = 1.0/s17
    s31 = s18*s30
    s32 = -s31
    s33 = s19*s30
    s34 = s18*s31
    s35 = s21 - s34
    s36 = s19*s31 - s3*s13
    s37 = -1.0 + s20 - s34
    s38 = 1.0*(s35 > mask_1 + 1e-12*s21)
    s39 = s38/max(s35, 1e-300)
    s40 = s36*s39
    s41 = s37*s39
    s42 = 1.0/(1.0 + 1.0 + s22)
    s43 = s24*s42
    s44 = s25*s42
    s45 = s28*s42
    s46 = s29 - 1.0 - s24*s43
    s47 = s25*s43 - s24
    s48 = -1.0 + s26 - s28*s43
    s49 = 1.0*(s46 > mask_5 + 1e-12*s29)
    s50 = s49/max(s46, 1e-300)
    s51 = s47*s50
    s52 = s48*s50
    s53 = s23 - s19*s33 - s36*s40 - s25*s44 - s47*s51
    s54 = s18*s33 - (s18 + s24) - s37*s40 + s28*s44 - s48*s51
    s55 = 1.0*(s53 > mask_2 + 1e-12*s23)
    s56 = s55/max(s53, 1e-300)
    s57 = s54*s56
    s58 = s27 - s34 - s37*s41 - s28*s45 - s48*s52 - s54*s57
    s59 = 1.0*(s58 > mask_3 + 1e-12*s27)
    s60 = q8*status_6
    s61 = s2*s2 + s4*s4 + s7*s7 + s9*s9 + s10*s10 + s11*s11 + q7*q7
    s62 = s35/s21
    s63 = s53/s23
    s64 = s58/s27
    s65 = s46/s29
    # outputs
    w[43] = s2  # O.x
    w[44] = s4  # O.y
    w[45] = s7  # P.x
    w[46] = s9  # P.y
    w[47] = s10  # Q.x
    w[48] = s11  # Q.y
    w[49] = q7  # guide.normal
    w[50] = q8  # guide.angle
    w[0] = math.sqrt(s61 + q8*q8)  # position_violation
    w[8] = math.sqrt(s61 + s60*s60)  # position_measure
    w[102] = s3  # D O.x, crank.omega
    w[103] = s1  # D O.y, crank.omega
    w[104] = s3  # D P.x, crank.omega
    w[105] = s8  # D P.x, rod.omega
    w[106] = s1  # D P.y, crank.omega
    w[107] = s6  # D P.y, rod.omega
    w[108] = s8  # D Q.x, rod.omega
    w[109] = s6  # D Q.y, rod.omega
    w[60] = s62  # O.y
    w[61] = s63  # P.x
    w[62] = s64  # P.y
    w[64] = s65  # Q.y
    w[5] = 1.0 + 1.0 + s49 + 1.0 + s59 + s55 + 1.0 + s38  # rank
    w[4] = min(min(min(min(1.0, mask_1 + s62), mask_2 + s63), mask_3 + s64), mask_5 + s65)  # smallest_pivot
    w[10] = min(1.0, gauge_8*row_weight_7)  # shortest_row
    w[110] = s32
    w[111] = s33
    w[112] = s32
    w[113] = s40
    w[114] = s41
    w[115] = -s43
    w[116] = s44
    w[117] = -s45
    w[118] = s51
    w[119] = s52
    w[120] = s57
    w[121] = 1.0/gauge_8
    w[122] = s30
    w[123] = s39
    w[124] = s42
    w[125] = s50
    w[126] = s56
    w[127] = s59/max(s58, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 79 operations, 1625 before sharing."""
    # inputs
    gauge_2 = w[87]  # crank.omega
    gauge_5 = w[90]  # rod.omega
    gauge_8 = w[93]  # slider.omega
    lower_0 = w[110]
    lower_1 = w[111]
    lower_2 = w[112]
    lower_3 = w[113]
    lower_4 = w[114]
    lower_5 = w[115]
    lower_6 = w[116]
    lower_7 = w[117]
    lower_8 = w[118]
    lower_9 = w[119]
    lower_10 = w[120]
    reciprocal_0 = w[121]
    reciprocal_1 = w[122]
    reciprocal_2 = w[123]
    reciprocal_3 = w[124]
    reciprocal_4 = w[125]
    reciprocal_5 = w[126]
    reciprocal_6 = w[127]
    residual_0 = w[43]  # O.x
    residual_1 = w[44]  # O.y
    residual_2 = w[45]  # P.x
    residual_3 = w[46]  # P.y
    residual_4 = w[47]  # Q.x
    residual_5 = w[48]  # Q.y
    residual_6 = w[49]  # guide.normal
    residual_7 = w[50]  # guide.angle
    jacobian_0 = w[102]  # D O.x, crank.omega
    jacobian_1 = w[103]  # D O.y, crank.omega
    jacobian_2 = w[104]  # D P.x, crank.omega
    jacobian_3 = w[105]  # D P.x, rod.omega
    jacobian_4 = w[106]  # D P.y, crank.omega
    jacobian_5 = w[107]  # D P.y, rod.omega
    jacobian_6 = w[108]  # D Q.x, rod.omega
    jacobian_7 = w[109]  # D Q.y, rod.omega
    # intermediate terms
    s0 = lower_0*residual_0 - residual_1
    s1 = residual_6 - residual_5 + lower_5*residual_4
    s2 = lower_1*residual_0 - residual_2 - lower_3*s0 + lower_6*residual_4 - lower_8*s1
    s3 = lower_2*residual_0 - residual_3 - lower_4*s0 + lower_7*residual_4 - lower_9*s1 - lower_10*s2
    s4 = reciprocal_6*s3
    s5 = reciprocal_5*s2
    s6 = lower_10*s4
    s7 = s5 - s6
    s8 = reciprocal_4*s1 - lower_8*s7
    s9 = lower_9*s4
    s10 = s8 - s9
    s11 = reciprocal_3*residual_4 + lower_5*s10 + lower_6*s7 + lower_7*s4
    s12 = reciprocal_2*s0 - lower_3*s7 - lower_4*s4
    s13 = reciprocal_1*residual_0 + lower_0*s12 + lower_1*s7 + lower_2*s4
    # outputs
    w[67] = s6 - s5 - s13  # crank.vx
    w[68] = s12 - s4  # crank.vy
    w[69] = gauge_2*(s12*jacobian_1 - s13*jacobian_0 + s7*jacobian_2 + s4*jacobian_4)  # crank.omega
    w[70] = s7 + s11  # rod.vx
    w[71] = s4 + s9 - s8  # rod.vy
    w[72] = gauge_5*(s7*jacobian_3 + s4*jacobian_5 - s11*jacobian_6 + s10*jacobian_7)  # rod.omega
    w[73] = -s11  # slider.vx
    w[74] = s10 - (residual_6 + s10)  # slider.vy
    w[75] = -gauge_8*(reciprocal_0*residual_7)  # slider.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 69 operations, 165 before sharing."""
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
    p3 = p[3]  # 0.5*crank_mass
    p4 = p[4]  # 9.81*crank_mass
    p5 = p[5]  # 0.0009375*crank_mass
    p6 = p[6]  # 0.5*rod_mass
    p7 = p[7]  # 9.81*rod_mass
    p8 = p[8]  # 0.0084375*rod_mass
    p9 = p[9]  # 0.5*slider_mass
    p10 = p[10]  # 9.81*slider_mass
    status_6 = w[6]  # length_scale
    jacobian_0 = w[102]  # D O.x, crank.omega
    jacobian_1 = w[103]  # D O.y, crank.omega
    jacobian_2 = w[104]  # D P.x, crank.omega
    jacobian_3 = w[105]  # D P.x, rod.omega
    jacobian_4 = w[106]  # D P.y, crank.omega
    jacobian_5 = w[107]  # D P.y, rod.omega
    jacobian_6 = w[108]  # D Q.x, rod.omega
    jacobian_7 = w[109]  # D Q.y, rod.omega
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
    s9 = v8*status_6
    s10 = s1 + s3*s3 + s4*s4 + s5*s5 + s6*s6 + s7*s7 + s8*s8
    # outputs
    w[43] = s3  # O.x
    w[44] = s4  # O.y
    w[45] = s5  # P.x
    w[46] = s6  # P.y
    w[47] = s7  # Q.x
    w[48] = s8  # Q.y
    w[49] = v7  # guide.normal
    w[50] = v8  # guide.angle
    w[1] = math.sqrt(s0 + s10)  # velocity_violation
    w[9] = math.sqrt(s10 + s9*s9)  # velocity_measure
    w[2] = s2 + 0.00025*s0  # kinetic
    w[3] = q1*p4 + q4*p7 + q7*p10  # potential
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
    ydot_9 = ydot[9]  # rate of crank.vx
    ydot_10 = ydot[10]  # rate of crank.vy
    ydot_11 = ydot[11]  # rate of crank.omega
    ydot_12 = ydot[12]  # rate of rod.vx
    ydot_13 = ydot[13]  # rate of rod.vy
    ydot_14 = ydot[14]  # rate of rod.omega
    ydot_15 = ydot[15]  # rate of slider.vx
    ydot_16 = ydot[16]  # rate of slider.vy
    ydot_17 = ydot[17]  # rate of slider.omega
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
    out[0] = s3 + ydot_9 + s10  # O.x
    out[1] = s4 + ydot_10 - s11  # O.y
    out[2] = s3 + s8 + ydot_12 + s10 - ydot_9 + s12  # P.x
    out[3] = s4 + s9 + ydot_13 - (ydot_10 + s11) - s13  # P.y
    out[4] = s8 + ydot_15 + s12 - ydot_12  # Q.x
    out[5] = s9 + ydot_16 - (ydot_13 + s13)  # Q.y
    out[6] = ydot_16  # guide.normal
    out[7] = ydot_17  # guide.angle
    out[8] = q2  # O.angle
    out[9] = v2  # rate of O.angle
    out[10] = q5 - q2  # P.angle
    out[11] = v5 - v2  # rate of P.angle
    out[12] = q8 - q5  # Q.angle
    out[13] = v8 - v5  # rate of Q.angle
    out[14] = q6  # guide.displacement
    out[15] = v6  # rate of guide.displacement
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # rod_mass [kg]
    p2 = p[2]  # slider_mass [kg]
    p11 = p[11]  # 0.001875*crank_mass
    p12 = p[12]  # 0.016875*rod_mass
    # outputs
    w[76] = p0  # crank.vx
    w[77] = p0  # crank.vy
    w[78] = p11  # crank.omega
    w[79] = p1  # rod.vx
    w[80] = p1  # rod.vy
    w[81] = p12  # rod.omega
    w[82] = p2  # slider.vx
    w[83] = p2  # slider.vy
    w[84] = 0.0005  # slider.omega
    return 0
