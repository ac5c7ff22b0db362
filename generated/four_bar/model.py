"""Model `four-bar`: what every method of it shares. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 1, templates 8f8565515c2742ad
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

@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D D^T that decides rank: 170 operations, 151204 before sharing."""
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
    s27 = 1.0/s9
    s28 = s10*s27
    s29 = -s28
    s30 = s11*s27
    s31 = s10*s28
    s32 = s13 - s31
    s33 = s11*s28 - s10
    s34 = -1.0 + s12 - s31
    s35 = 1.0*(s32 > 1e-12*s13)
    s36 = s35/(s32 + 1.0 - s35)
    s37 = s33*s36
    s38 = s34*s36
    s39 = s15 - s11*s30 - s33*s37
    s40 = s10*s30 - (s10 + s16) - s34*s37
    s41 = 1.0/(1.0 + s20)
    s42 = s22*s41
    s43 = s23*s41
    s44 = s22*s42
    s45 = s26 - s44
    s46 = s22 + s23*s42
    s47 = 1.0 - s24 + s44
    s48 = 1.0*(s45 > 1e-12*s26)
    s49 = s48/(s45 + 1.0 - s48)
    s50 = s46*s49
    s51 = s47*s49
    s52 = 1.0*(s39 > 1e-12*s15)
    s53 = s52/(s39 + 1.0 - s52)
    s54 = s40*s53
    s55 = s17*s53
    s56 = s16*s53
    s57 = s19 - s31 - s34*s38 - s40*s54
    s58 = s16 + s17*s54
    s59 = -1.0 + s18 + s16*s54
    s60 = 1.0*(s57 > 1e-12*s19)
    s61 = s60/(s57 + 1.0 - s60)
    s62 = s58*s61
    s63 = s59*s61
    s64 = s21 - s23*s43 - s46*s50 - s17*s55 - s58*s62
    s65 = s16*s55 - (s16 + s22 + s22*s43 + s47*s50) + s59*s62
    s66 = 1.0*(s64 > 1e-12*s21)
    s67 = s66/(s64 + 1.0 - s66)
    s68 = s65*s67
    s69 = s25 - s44 - s47*s51 - s16*s56 - s59*s63 - s65*s68
    s70 = 1.0*(s69 > 1e-12*s25)
    # outputs
    w[32] = q0 - s0
    w[33] = q1 - s1
    w[34] = q3 - q0 - s3 - s0
    w[35] = q4 - q1 - s5 - s1
    w[36] = q6 - q3 + s6 - s3
    w[37] = q7 - q4 + s7 - s5
    w[38] = q6 - 10.0 - s6
    w[39] = q7 - s7
    w[90] = s1
    w[91] = s2
    w[92] = s1
    w[93] = s5
    w[94] = s2
    w[95] = s4
    w[96] = s5
    w[97] = -s7
    w[98] = s4
    w[99] = s6
    w[100] = s7
    w[101] = -s6
    w[57] = s32/s13
    w[58] = s39/s15
    w[59] = s57/s19
    w[60] = s64/s21
    w[61] = s69/s25
    w[63] = s45/s26
    w[102] = s29
    w[103] = s30
    w[104] = s29
    w[105] = s37
    w[106] = s38
    w[107] = -s42
    w[108] = s43
    w[109] = s42
    w[110] = s50
    w[111] = s51
    w[112] = s54
    w[113] = s55
    w[114] = -s56
    w[115] = -s62
    w[116] = s63
    w[117] = s68
    w[118] = s27
    w[119] = s36
    w[120] = s41
    w[121] = s49
    w[122] = s53
    w[123] = s61
    w[124] = s67
    w[125] = s70/(s69 + 1.0 - s70)
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """change of v (or of q by N) = D^+ times the section `right`: 102 operations, 6981 before sharing."""
    # inputs
    lower_0 = w[102]
    lower_1 = w[103]
    lower_2 = w[104]
    lower_3 = w[105]
    lower_4 = w[106]
    lower_5 = w[107]
    lower_6 = w[108]
    lower_7 = w[109]
    lower_8 = w[110]
    lower_9 = w[111]
    lower_10 = w[112]
    lower_11 = w[113]
    lower_12 = w[114]
    lower_13 = w[115]
    lower_14 = w[116]
    lower_15 = w[117]
    reciprocal_0 = w[118]
    reciprocal_1 = w[119]
    reciprocal_2 = w[120]
    reciprocal_3 = w[121]
    reciprocal_4 = w[122]
    reciprocal_5 = w[123]
    reciprocal_6 = w[124]
    reciprocal_7 = w[125]
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
    jacobian_8 = w[98]
    jacobian_9 = w[99]
    jacobian_10 = w[100]
    jacobian_11 = w[101]
    # intermediate terms
    s0 = right_1 - lower_0*right_0
    s1 = right_2 - lower_1*right_0 - lower_3*s0
    s2 = right_7 - lower_5*right_6
    s3 = right_3 - lower_2*right_0 - lower_4*s0 - lower_10*s1
    s4 = right_4 - lower_6*right_6 - lower_8*s2 - lower_11*s1 - lower_13*s3
    s5 = reciprocal_7*(right_5 - lower_7*right_6 - lower_9*s2 - lower_12*s1 - lower_14*s3 - lower_15*s4)
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
    s16 = reciprocal_2*right_6 - lower_5*s15 - lower_6*s8 - lower_7*s5
    s17 = reciprocal_1*s0 - lower_3*s14 - lower_4*s11
    s18 = reciprocal_0*right_0 - lower_0*s17 - lower_1*s14 - lower_2*s11
    # outputs
    w[72] = s18 + s13 - s12
    w[73] = s17 + s10 - s9
    w[74] = s18*jacobian_0 + s17*jacobian_1 + s14*jacobian_2 + s11*jacobian_4
    w[75] = s14 + s7 - s6
    w[76] = s11 - s5
    w[77] = s14*jacobian_3 + s11*jacobian_5 + s8*jacobian_6 + s5*jacobian_8
    w[78] = s8 + s16
    w[79] = s5 + s15
    w[80] = s8*jacobian_7 + s5*jacobian_9 + s16*jacobian_10 + s15*jacobian_11
    return 0

@njit(error_model="numpy", fastmath={"contract"})
def drift(y, w):
    """D v - nu with the D and nu that `geometry` left: 28 operations, 28 before sharing."""
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
    jacobian_0 = w[90]
    jacobian_1 = w[91]
    jacobian_2 = w[92]
    jacobian_3 = w[93]
    jacobian_4 = w[94]
    jacobian_5 = w[95]
    jacobian_6 = w[96]
    jacobian_7 = w[97]
    jacobian_8 = w[98]
    jacobian_9 = w[99]
    jacobian_10 = w[100]
    jacobian_11 = w[101]
    # outputs
    w[48] = v0 + v2*jacobian_0
    w[49] = v1 + v2*jacobian_1
    w[50] = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
    w[51] = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
    w[52] = v6 + v5*jacobian_6 - v3 + v8*jacobian_7
    w[53] = v7 + v5*jacobian_8 - v4 + v8*jacobian_9
    w[54] = v6 + v8*jacobian_10
    w[55] = v7 + v8*jacobian_11
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
    p3 = p[3]
    p4 = p[4]
    p5 = p[5]
    p6 = p[6]
    p7 = p[7]
    p8 = p[8]
    p9 = p[9]
    p10 = p[10]
    p11 = p[11]
    # intermediate terms
    s0 = p3*(v0*v0) + p3*(v1*v1) + v2*v2*p5 + p6*(v3*v3) + p6*(v4*v4) + v5*v5*p8 + p9*(v6*v6) + p9*(v7*v7)
    # outputs
    w[2] = s0 + v8*v8*p11
    w[3] = q1*p4 + q4*p7 + q7*p10
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
    out[8] = q2
    out[9] = v2
    out[10] = q5 - q2
    out[11] = v5 - v2
    out[12] = q8 - q5
    out[13] = v8 - v5
    out[14] = q8
    out[15] = v8
    return 0

@njit(error_model="numpy", fastmath={"contract"})
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
    w[81] = p0
    w[82] = p0
    w[83] = p12
    w[84] = p1
    w[85] = p1
    w[86] = p13
    w[87] = p2
    w[88] = p2
    w[89] = p14
    return 0
