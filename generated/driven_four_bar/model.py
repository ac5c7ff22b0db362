"""Model `driven-four-bar`: what every method of it shares. Emitted by symgen; do not edit.

digest 272d50317a49e3a6fa31d4e2a99b6be5bd3f3431249c13a8e2670c9daaa1915c, format 1, templates 8f8565515c2742ad
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

import numpy as np
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
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 201 operations, 222522 before sharing."""
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
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = 4.0*math.cos(q5)
    s4 = -s3
    s5 = 4.0*math.sin(q5)
    s6 = 2.5*math.cos(q8)
    s7 = 2.5*math.sin(q8)
    s8 = s1*s1
    s9 = 1.0 + s8
    s10 = s0*s1
    s11 = -1.0 + s8
    s12 = s0*s0
    s13 = 1.0 + s12
    s14 = s5*s5
    s15 = 1.0 + s9 + s14
    s16 = s3*s5
    s17 = -1.0 + s14
    s18 = s3*s3
    s19 = 1.0 + s13 + s18
    s20 = s7*s7
    s21 = 1.0 + 1.0 + s14 + s20
    s22 = s6*s7
    s23 = 1.0 - s20
    s24 = s6*s6
    s25 = 1.0 + 1.0 + s18 + s24
    s26 = 1.0 + s24
    s27 = 1.0/(1.0 + s20)
    s28 = s22*s27
    s29 = s23*s27
    s30 = s22*s28
    s31 = s26 - s30
    s32 = s22 + s23*s28
    s33 = 1.0 - s24 + s30
    s34 = 1.0*(s31 > 1e-12*s26)
    s35 = s34/(s31 + 1.0 - s34)
    s36 = s32*s35
    s37 = s33*s35
    s38 = s21 - s23*s29 - s32*s36
    s39 = s16 + s22 + s22*s29 + s33*s36
    s40 = 1.0*(s38 > 1e-12*s21)
    s41 = s40/(s38 + 1.0 - s40)
    s42 = s39*s41
    s43 = s17*s41
    s44 = s16*s41
    s45 = s25 - s30 - s33*s37 - s39*s42
    s46 = s17*s42 - s16
    s47 = -1.0 + s18 - s16*s42
    s48 = 1.0*(s45 > 1e-12*s25)
    s49 = s48/(s45 + 1.0 - s48)
    s50 = s46*s49
    s51 = s47*s49
    s52 = 1.0/s9
    s53 = s10*s52
    s54 = -s53
    s55 = s1*s52
    s56 = s11*s52
    s57 = s10*s53
    s58 = s13 - s57
    s59 = s1*s53 - s0
    s60 = s11*s53 - s10
    s61 = -1.0 + s12 - s57
    s62 = 1.0*(s58 > 1e-12*s13)
    s63 = s62/(s58 + 1.0 - s62)
    s64 = s59*s63
    s65 = s60*s63
    s66 = s61*s63
    s67 = 1.0 - s1*s55 - s59*s64
    s68 = s1 - s11*s55 - s60*s64
    s69 = s10*s55 - s0 - s61*s64
    s70 = 1.0*(s67 > 1e-12)
    s71 = s70/(s67 + 1.0 - s70)
    s72 = s68*s71
    s73 = s69*s71
    s74 = s15 - s17*s43 - s46*s50 - s11*s56 - s60*s65 - s68*s72
    s75 = s16*s43 - (s10 + s16) - s47*s50 + s10*s56 - s61*s65 - s69*s72
    s76 = 1.0*(s74 > 1e-12*s15)
    s77 = s76/(s74 + 1.0 - s76)
    s78 = s75*s77
    s79 = s19 - s16*s44 - s47*s51 - s57 - s61*s66 - s69*s73 - s75*s78
    s80 = 1.0*(s79 > 1e-12*s19)
    # outputs
    w[35] = q0 - s0
    w[36] = q1 - s1
    w[37] = q3 - q0 - s3 - s0
    w[38] = q4 - q1 - s5 - s1
    w[39] = q6 - q3 + s6 - s3
    w[40] = q7 - q4 + s7 - s5
    w[41] = q6 - 10.0 - s6
    w[42] = q7 - s7
    w[43] = q2 - (p3 + t*p4)
    w[52] = p4
    w[98] = s1
    w[99] = s2
    w[100] = s1
    w[101] = s5
    w[102] = s2
    w[103] = s4
    w[104] = s5
    w[105] = -s7
    w[106] = s4
    w[107] = s6
    w[108] = s7
    w[109] = -s6
    w[63] = s58/s13
    w[64] = s74/s15
    w[65] = s79/s19
    w[66] = s38/s21
    w[67] = s45/s25
    w[69] = s31/s26
    w[70] = s67
    w[110] = -s28
    w[111] = s29
    w[112] = s28
    w[113] = s36
    w[114] = s37
    w[115] = -s42
    w[116] = s43
    w[117] = -s44
    w[118] = s50
    w[119] = s51
    w[120] = s54
    w[121] = s55
    w[122] = s56
    w[123] = s54
    w[124] = s64
    w[125] = s65
    w[126] = s66
    w[127] = s72
    w[128] = s73
    w[129] = s78
    w[130] = s27
    w[131] = s35
    w[132] = s41
    w[133] = s49
    w[134] = s52
    w[135] = s63
    w[136] = s71
    w[137] = s77
    w[138] = s80/(s79 + 1.0 - s80)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """change of v (or of q by N) = D^+ times the section `right`: 120 operations, 10064 before sharing."""
    # inputs
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
    lower_11 = w[121]
    lower_12 = w[122]
    lower_13 = w[123]
    lower_14 = w[124]
    lower_15 = w[125]
    lower_16 = w[126]
    lower_17 = w[127]
    lower_18 = w[128]
    lower_19 = w[129]
    reciprocal_0 = w[130]
    reciprocal_1 = w[131]
    reciprocal_2 = w[132]
    reciprocal_3 = w[133]
    reciprocal_4 = w[134]
    reciprocal_5 = w[135]
    reciprocal_6 = w[136]
    reciprocal_7 = w[137]
    reciprocal_8 = w[138]
    right_0 = w[71]
    right_1 = w[72]
    right_2 = w[73]
    right_3 = w[74]
    right_4 = w[75]
    right_5 = w[76]
    right_6 = w[77]
    right_7 = w[78]
    right_8 = w[79]
    jacobian_0 = w[98]
    jacobian_1 = w[99]
    jacobian_2 = w[100]
    jacobian_3 = w[101]
    jacobian_4 = w[102]
    jacobian_5 = w[103]
    jacobian_6 = w[104]
    jacobian_7 = w[105]
    jacobian_8 = w[106]
    jacobian_9 = w[107]
    jacobian_10 = w[108]
    jacobian_11 = w[109]
    # intermediate terms
    s0 = right_7 - lower_0*right_6
    s1 = right_4 - lower_1*right_6 - lower_3*s0
    s2 = right_5 - lower_2*right_6 - lower_4*s0 - lower_5*s1
    s3 = right_1 - lower_10*right_0
    s4 = right_8 - lower_11*right_0 - lower_14*s3
    s5 = right_2 - lower_6*s1 - lower_8*s2 - lower_12*right_0 - lower_15*s3 - lower_17*s4
    s6 = right_3 - lower_7*s1 - lower_9*s2 - lower_13*right_0 - lower_16*s3 - lower_18*s4 - lower_19*s5
    s7 = reciprocal_8*s6
    s8 = reciprocal_7*s5
    s9 = lower_19*s7
    s10 = s8 - s9
    s11 = reciprocal_6*s4 - lower_17*s10 - lower_18*s7
    s12 = reciprocal_5*s3 - lower_14*s11 - lower_15*s10 - lower_16*s7
    s13 = reciprocal_4*right_0 - lower_10*s12 - lower_11*s11 - lower_12*s10 - lower_13*s7
    s14 = reciprocal_3*s2 - lower_8*s10
    s15 = lower_9*s7
    s16 = s14 - s15
    s17 = reciprocal_2*s1 - lower_5*s16 - lower_6*s10
    s18 = lower_7*s7
    s19 = s17 - s18
    s20 = reciprocal_1*s0 - lower_3*s19 - lower_4*s16
    s21 = reciprocal_0*right_6 - lower_0*s20 - lower_1*s19 - lower_2*s16
    # outputs
    w[80] = s13 + s9 - s8
    w[81] = s12 - s7
    w[82] = s11 + s13*jacobian_0 + s12*jacobian_1 + s10*jacobian_2 + s7*jacobian_4
    w[83] = s10 + s18 - s17
    w[84] = s7 + s15 - s14
    w[85] = s10*jacobian_3 + s7*jacobian_5 + s19*jacobian_6 + s16*jacobian_8
    w[86] = s19 + s21
    w[87] = s16 + s20
    w[88] = s19*jacobian_7 + s16*jacobian_9 + s21*jacobian_10 + s20*jacobian_11
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def drift(y, w):
    """D v - nu with the D and nu that `geometry` left: 29 operations, 29 before sharing."""
    # inputs
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    jacobian_0 = w[98]
    jacobian_1 = w[99]
    jacobian_2 = w[100]
    jacobian_3 = w[101]
    jacobian_4 = w[102]
    jacobian_5 = w[103]
    jacobian_6 = w[104]
    jacobian_7 = w[105]
    jacobian_8 = w[106]
    jacobian_9 = w[107]
    jacobian_10 = w[108]
    jacobian_11 = w[109]
    nu_8 = w[52]
    # outputs
    w[53] = v0 + v2*jacobian_0
    w[54] = v1 + v2*jacobian_1
    w[55] = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    w[56] = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    w[57] = v6 + v5*jacobian_6 - v3 + v8*jacobian_7
    w[58] = v7 + v5*jacobian_8 - v4 + v8*jacobian_9
    w[59] = v6 + v8*jacobian_10
    w[60] = v7 + v8*jacobian_11
    w[61] = v2 - nu_8
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def energies(t, y, p, w):
    """kinetic and potential energy: 31 operations, 31 before sharing."""
    # inputs
    v0 = y[9]  # crank.vx [m/s]
    q1 = y[1]  # crank.y [m]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # coupler.vx [m/s]
    q4 = y[4]  # coupler.y [m]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    v6 = y[15]  # rocker.vx [m/s]
    q7 = y[7]  # rocker.y [m]
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
    # intermediate terms
    s0 = p5*(v0*v0) + p5*(v1*v1) + v2*v2*p7 + p8*(v3*v3) + p8*(v4*v4) + v5*v5*p10 + p11*(v6*v6) + p11*(v7*v7)
    # outputs
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
    w[89] = p0
    w[90] = p0
    w[91] = p14
    w[92] = p1
    w[93] = p1
    w[94] = p15
    w[95] = p2
    w[96] = p2
    w[97] = p16
    return 0
