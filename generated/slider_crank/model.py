"""Model `slider-crank`: what every method of it shares. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 1, templates 8f8565515c2742ad
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

import numpy as np
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
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 115 operations, 13165 before sharing."""
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
    # intermediate terms
    s0 = 0.075*math.cos(q2)
    s1 = -s0
    s2 = 0.075*math.sin(q2)
    s3 = 0.225*math.cos(q5)
    s4 = -s3
    s5 = 0.225*math.sin(q5)
    s6 = s2*s2
    s7 = 1.0 + s6
    s8 = s0*s2
    s9 = -1.0 + s6
    s10 = s0*s0
    s11 = 1.0 + s10
    s12 = s5*s5
    s13 = 1.0 + s7 + s12
    s14 = s3*s5
    s15 = -1.0 + s12
    s16 = s3*s3
    s17 = 1.0 + s11 + s16
    s18 = 1.0 + 1.0 + s16
    s19 = 1.0/s7
    s20 = s8*s19
    s21 = -s20
    s22 = s9*s19
    s23 = s8*s20
    s24 = s11 - s23
    s25 = s9*s20 - s8
    s26 = -1.0 + s10 - s23
    s27 = 1.0*(s24 > 1e-12*s11)
    s28 = s27/(s24 + 1.0 - s27)
    s29 = s25*s28
    s30 = s26*s28
    s31 = 1.0/(1.0 + 1.0 + s12)
    s32 = s14*s31
    s33 = -s32
    s34 = s15*s31
    s35 = s14*s32
    s36 = s18 - 1.0 - s35
    s37 = s15*s32 - s14
    s38 = -1.0 + s16 - s35
    s39 = 1.0*(s36 > 1e-12*s18)
    s40 = s39/(s36 + 1.0 - s39)
    s41 = s37*s40
    s42 = s38*s40
    s43 = s13 - s9*s22 - s25*s29 - s15*s34 - s37*s41
    s44 = s8*s22 - (s8 + s14) - s26*s29 + s14*s34 - s38*s41
    s45 = 1.0*(s43 > 1e-12*s13)
    s46 = s45/(s43 + 1.0 - s45)
    s47 = s44*s46
    s48 = s17 - s23 - s26*s30 - s35 - s38*s42 - s44*s47
    s49 = 1.0*(s48 > 1e-12*s17)
    # outputs
    w[32] = q0 - s0
    w[33] = q1 - s2
    w[34] = q3 - q0 - s3 - s0
    w[35] = q4 - q1 - s5 - s2
    w[36] = q6 - q3 - s3
    w[37] = q7 - q4 - s5
    w[38] = q7
    w[39] = q8
    w[90] = s2
    w[91] = s1
    w[92] = s2
    w[93] = s5
    w[94] = s1
    w[95] = s4
    w[96] = s5
    w[97] = s4
    w[57] = s24/s11
    w[58] = s43/s13
    w[59] = s48/s17
    w[61] = s36/s18
    w[98] = s21
    w[99] = s22
    w[100] = s21
    w[101] = s29
    w[102] = s30
    w[103] = s33
    w[104] = s34
    w[105] = s33
    w[106] = s41
    w[107] = s42
    w[108] = s47
    w[109] = s19
    w[110] = s28
    w[111] = s31
    w[112] = s40
    w[113] = s46
    w[114] = s49/(s48 + 1.0 - s49)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """change of v (or of q by N) = D^+ times the section `right`: 74 operations, 1619 before sharing."""
    # inputs
    lower_0 = w[98]
    lower_1 = w[99]
    lower_2 = w[100]
    lower_3 = w[101]
    lower_4 = w[102]
    lower_5 = w[103]
    lower_6 = w[104]
    lower_7 = w[105]
    lower_8 = w[106]
    lower_9 = w[107]
    lower_10 = w[108]
    reciprocal_0 = w[109]
    reciprocal_1 = w[110]
    reciprocal_2 = w[111]
    reciprocal_3 = w[112]
    reciprocal_4 = w[113]
    reciprocal_5 = w[114]
    right_0 = w[64]
    right_1 = w[65]
    right_2 = w[66]
    right_3 = w[67]
    right_4 = w[68]
    right_5 = w[69]
    right_6 = w[70]
    right_7 = w[71]
    jacobian_0 = w[90]
    jacobian_1 = w[91]
    jacobian_2 = w[92]
    jacobian_3 = w[93]
    jacobian_4 = w[94]
    jacobian_5 = w[95]
    jacobian_6 = w[96]
    jacobian_7 = w[97]
    # intermediate terms
    s0 = right_1 - lower_0*right_0
    s1 = right_5 - right_6 - lower_5*right_4
    s2 = right_2 - lower_1*right_0 - lower_3*s0 - lower_6*right_4 - lower_8*s1
    s3 = reciprocal_5*(right_3 - lower_2*right_0 - lower_4*s0 - lower_7*right_4 - lower_9*s1 - lower_10*s2)
    s4 = reciprocal_4*s2
    s5 = lower_10*s3
    s6 = s4 - s5
    s7 = reciprocal_3*s1 - lower_8*s6
    s8 = lower_9*s3
    s9 = s7 - s8
    s10 = reciprocal_2*right_4 - lower_5*s9 - lower_6*s6
    s11 = lower_7*s3
    s12 = s10 - s11
    s13 = reciprocal_1*s0 - lower_3*s6 - lower_4*s3
    s14 = reciprocal_0*right_0 - lower_0*s13 - lower_1*s6 - lower_2*s3
    # outputs
    w[72] = s14 + s5 - s4
    w[73] = s13 - s3
    w[74] = s14*jacobian_0 + s13*jacobian_1 + s6*jacobian_2 + s3*jacobian_4
    w[75] = s6 + s11 - s10
    w[76] = s3 + s8 - s7
    w[77] = s6*jacobian_3 + s3*jacobian_5 + s12*jacobian_6 + s9*jacobian_7
    w[78] = s12
    w[79] = s9 + right_6 - s9
    w[80] = right_7
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def drift(y, w):
    """D v - nu with the D and nu that `geometry` left: 20 operations, 20 before sharing."""
    # inputs
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # rod.vx [m/s]
    v4 = y[13]  # rod.vy [m/s]
    v5 = y[14]  # rod.omega [rad/s]
    v6 = y[15]  # slider.vx [m/s]
    v7 = y[16]  # slider.vy [m/s]
    v8 = y[17]  # slider.omega [rad/s]
    jacobian_0 = w[90]
    jacobian_1 = w[91]
    jacobian_2 = w[92]
    jacobian_3 = w[93]
    jacobian_4 = w[94]
    jacobian_5 = w[95]
    jacobian_6 = w[96]
    jacobian_7 = w[97]
    # outputs
    w[48] = v0 + v2*jacobian_0
    w[49] = v1 + v2*jacobian_1
    w[50] = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    w[51] = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    w[52] = v6 + v5*jacobian_6 - v3
    w[53] = v7 + v5*jacobian_7 - v4
    w[54] = v7
    w[55] = v8
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def energies(t, y, p, w):
    """kinetic and potential energy: 31 operations, 31 before sharing."""
    # inputs
    v0 = y[9]  # crank.vx [m/s]
    q1 = y[1]  # crank.y [m]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # rod.vx [m/s]
    q4 = y[4]  # rod.y [m]
    v4 = y[13]  # rod.vy [m/s]
    v5 = y[14]  # rod.omega [rad/s]
    v6 = y[15]  # slider.vx [m/s]
    q7 = y[7]  # slider.y [m]
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
    # intermediate terms
    s0 = p3*(v0*v0) + p3*(v1*v1) + v2*v2*p5 + p6*(v3*v3) + p6*(v4*v4) + v5*v5*p8 + p9*(v6*v6) + p9*(v7*v7)
    # outputs
    w[2] = s0 + 0.00025*(v8*v8)
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
    v6 = y[15]  # slider.vx [m/s]
    q8 = y[8]  # slider.theta [rad]
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
    w[81] = p0
    w[82] = p0
    w[83] = p11
    w[84] = p1
    w[85] = p1
    w[86] = p12
    w[87] = p2
    w[88] = p2
    w[89] = 0.0005
    return 0
