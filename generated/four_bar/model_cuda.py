"""Model `four-bar`: what every method of it shares, for CUDA. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 2f2faf4a02ce3130
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
p[3:15]  numbers computed by `prepare`
row 0    A.x [m]
row 1    A.y [m]
row 2    B.x [m]
row 3    B.y [m]
row 4    C.x [m]
row 5    C.y [m]
row 6    D.x [m]
row 7    D.y [m]

w[0:19]     status: single numbers, named in this module where it uses them
w[19:27]    multipliers: Lagrange multipliers, one a row
w[27:35]    mask: inf at rows that depend on others, else 0
w[35:43]    saved: `mask` while `confirm` leaves out further rows
w[43:51]    residual: Phi after `geometry`, D v - nu after `measure`
w[51:59]    nu: right-hand side of D v = nu
w[59:67]    pivot: pivots of D G D^T over its diagonal: near 0 a row depends on others
w[67:76]    change: correction of velocities, or of positions, that `spread` leaves
w[76:85]    mass: diagonal of M
w[85:94]    gauge: diagonal of G, the metric in which rank is decided: 1, or 1/l^2 for a rotation of a body of length l
w[94:102]   row_weight: factors that make rows of different units comparable
w[102:114]  jacobian: entries of D that are not constant
w[114:130]  lower: L of the factorisation of D G D^T, below the diagonal
w[130:138]  reciprocal: reciprocals of the pivots of D G D^T, 0 for rows left out

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

MASK = 27  # sections of w
RESIDUAL = 43
PIVOT = 59
CHANGE = 67
MASS = 76
GAUGE = 85
JACOBIAN = 102
LOWER = 114
RECIPROCAL = 130
POSITION_VIOLATION = 0  # numbers in w
VELOCITY_VIOLATION = 1
KINETIC = 2
POTENTIAL = 3
SMALLEST_PIVOT = 4
RANK = 5
POSITION_MEASURE = 8
VELOCITY_MEASURE = 9
SHORTEST_ROW = 10


@cuda.jit(device=True)
def prepare(p):
    """Numbers that depend on parameters alone: 12 operations, 12 before sharing."""
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
    mask_1 = w[MASK + 1]  # A.y
    mask_2 = w[MASK + 2]  # B.x
    mask_3 = w[MASK + 3]  # B.y
    mask_4 = w[MASK + 4]  # C.x
    mask_5 = w[MASK + 5]  # C.y
    mask_7 = w[MASK + 7]  # D.y
    gauge_2 = w[GAUGE + 2]  # crank.omega
    gauge_5 = w[GAUGE + 5]  # coupler.omega
    gauge_8 = w[GAUGE + 8]  # rocker.omega
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
    w[RESIDUAL] = s3  # A.x
    w[RESIDUAL + 1] = s4  # A.y
    w[RESIDUAL + 2] = s7  # B.x
    w[RESIDUAL + 3] = s9  # B.y
    w[RESIDUAL + 4] = s11  # C.x
    w[RESIDUAL + 5] = s13  # C.y
    w[RESIDUAL + 6] = s14  # D.x
    w[RESIDUAL + 7] = s15  # D.y
    w[POSITION_VIOLATION] = s86  # position_violation
    w[POSITION_MEASURE] = s86  # position_measure
    w[JACOBIAN] = s1  # D A.x, crank.omega
    w[JACOBIAN + 1] = s2  # D A.y, crank.omega
    w[JACOBIAN + 2] = s1  # D B.x, crank.omega
    w[JACOBIAN + 3] = s8  # D B.x, coupler.omega
    w[JACOBIAN + 4] = s2  # D B.y, crank.omega
    w[JACOBIAN + 5] = s6  # D B.y, coupler.omega
    w[JACOBIAN + 6] = s8  # D C.x, coupler.omega
    w[JACOBIAN + 7] = -s12  # D C.x, rocker.omega
    w[JACOBIAN + 8] = s6  # D C.y, coupler.omega
    w[JACOBIAN + 9] = s10  # D C.y, rocker.omega
    w[JACOBIAN + 10] = s12  # D D.x, rocker.omega
    w[JACOBIAN + 11] = -s10  # D D.y, rocker.omega
    w[PIVOT + 1] = s87  # A.y
    w[PIVOT + 2] = s88  # B.x
    w[PIVOT + 3] = s89  # B.y
    w[PIVOT + 4] = s90  # C.x
    w[PIVOT + 5] = s91  # C.y
    w[PIVOT + 7] = s93  # D.y
    w[RANK] = s63 + 1.0 + s85 + s81 + s75 + s67 + 1.0 + s50  # rank
    w[SMALLEST_PIVOT] = min(s92, mask_7 + s93)  # smallest_pivot
    w[SHORTEST_ROW] = 1.0  # shortest_row
    w[LOWER] = s44
    w[LOWER + 1] = s45
    w[LOWER + 2] = s44
    w[LOWER + 3] = s52
    w[LOWER + 4] = s53
    w[LOWER + 5] = -s57
    w[LOWER + 6] = s58
    w[LOWER + 7] = s59
    w[LOWER + 8] = s65
    w[LOWER + 9] = s66
    w[LOWER + 10] = s69
    w[LOWER + 11] = s70
    w[LOWER + 12] = -s71
    w[LOWER + 13] = -s77
    w[LOWER + 14] = s78
    w[LOWER + 15] = s83
    w[RECIPROCAL] = s42
    w[RECIPROCAL + 1] = s51
    w[RECIPROCAL + 2] = s56
    w[RECIPROCAL + 3] = s64
    w[RECIPROCAL + 4] = s68
    w[RECIPROCAL + 5] = s76
    w[RECIPROCAL + 6] = s82
    w[RECIPROCAL + 7] = s85/max(s84, 1e-300)
    return 0


@cuda.jit(device=True)
def spread(p, w):
    """The correction -D^+ times the section `residual`, of v, or of q by N: 105 operations, 6984 before sharing."""
    # inputs
    gauge_2 = w[GAUGE + 2]  # crank.omega
    gauge_5 = w[GAUGE + 5]  # coupler.omega
    gauge_8 = w[GAUGE + 8]  # rocker.omega
    lower_0 = w[LOWER]
    lower_1 = w[LOWER + 1]
    lower_2 = w[LOWER + 2]
    lower_3 = w[LOWER + 3]
    lower_4 = w[LOWER + 4]
    lower_5 = w[LOWER + 5]
    lower_6 = w[LOWER + 6]
    lower_7 = w[LOWER + 7]
    lower_8 = w[LOWER + 8]
    lower_9 = w[LOWER + 9]
    lower_10 = w[LOWER + 10]
    lower_11 = w[LOWER + 11]
    lower_12 = w[LOWER + 12]
    lower_13 = w[LOWER + 13]
    lower_14 = w[LOWER + 14]
    lower_15 = w[LOWER + 15]
    reciprocal_0 = w[RECIPROCAL]
    reciprocal_1 = w[RECIPROCAL + 1]
    reciprocal_2 = w[RECIPROCAL + 2]
    reciprocal_3 = w[RECIPROCAL + 3]
    reciprocal_4 = w[RECIPROCAL + 4]
    reciprocal_5 = w[RECIPROCAL + 5]
    reciprocal_6 = w[RECIPROCAL + 6]
    reciprocal_7 = w[RECIPROCAL + 7]
    residual_0 = w[RESIDUAL]  # A.x
    residual_1 = w[RESIDUAL + 1]  # A.y
    residual_2 = w[RESIDUAL + 2]  # B.x
    residual_3 = w[RESIDUAL + 3]  # B.y
    residual_4 = w[RESIDUAL + 4]  # C.x
    residual_5 = w[RESIDUAL + 5]  # C.y
    residual_6 = w[RESIDUAL + 6]  # D.x
    residual_7 = w[RESIDUAL + 7]  # D.y
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.omega
    jacobian_1 = w[JACOBIAN + 1]  # D A.y, crank.omega
    jacobian_2 = w[JACOBIAN + 2]  # D B.x, crank.omega
    jacobian_3 = w[JACOBIAN + 3]  # D B.x, coupler.omega
    jacobian_4 = w[JACOBIAN + 4]  # D B.y, crank.omega
    jacobian_5 = w[JACOBIAN + 5]  # D B.y, coupler.omega
    jacobian_6 = w[JACOBIAN + 6]  # D C.x, coupler.omega
    jacobian_7 = w[JACOBIAN + 7]  # D C.x, rocker.omega
    jacobian_8 = w[JACOBIAN + 8]  # D C.y, coupler.omega
    jacobian_9 = w[JACOBIAN + 9]  # D C.y, rocker.omega
    jacobian_10 = w[JACOBIAN + 10]  # D D.x, rocker.omega
    jacobian_11 = w[JACOBIAN + 11]  # D D.y, rocker.omega
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
    w[CHANGE] = s13 - s12 - s18  # crank.vx
    w[CHANGE + 1] = s17 + s10 - s9  # crank.vy
    w[CHANGE + 2] = gauge_2*(s17*jacobian_1 - s18*jacobian_0 + s14*jacobian_2 + s11*jacobian_4)  # crank.omega
    w[CHANGE + 3] = s14 + s7 - s6  # coupler.vx
    w[CHANGE + 4] = s11 - s5  # coupler.vy
    w[CHANGE + 5] = gauge_5*(s14*jacobian_3 + s11*jacobian_5 + s8*jacobian_6 + s5*jacobian_8)  # coupler.omega
    w[CHANGE + 6] = s8 - s16  # rocker.vx
    w[CHANGE + 7] = s5 + s15  # rocker.vy
    w[CHANGE + 8] = gauge_8*(s8*jacobian_7 + s5*jacobian_9 - s16*jacobian_10 + s15*jacobian_11)  # rocker.omega
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
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.omega
    jacobian_1 = w[JACOBIAN + 1]  # D A.y, crank.omega
    jacobian_2 = w[JACOBIAN + 2]  # D B.x, crank.omega
    jacobian_3 = w[JACOBIAN + 3]  # D B.x, coupler.omega
    jacobian_4 = w[JACOBIAN + 4]  # D B.y, crank.omega
    jacobian_5 = w[JACOBIAN + 5]  # D B.y, coupler.omega
    jacobian_6 = w[JACOBIAN + 6]  # D C.x, coupler.omega
    jacobian_7 = w[JACOBIAN + 7]  # D C.x, rocker.omega
    jacobian_8 = w[JACOBIAN + 8]  # D C.y, coupler.omega
    jacobian_9 = w[JACOBIAN + 9]  # D C.y, rocker.omega
    jacobian_10 = w[JACOBIAN + 10]  # D D.x, rocker.omega
    jacobian_11 = w[JACOBIAN + 11]  # D D.y, rocker.omega
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
    w[RESIDUAL] = s1  # A.x
    w[RESIDUAL + 1] = s2  # A.y
    w[RESIDUAL + 2] = s3  # B.x
    w[RESIDUAL + 3] = s4  # B.y
    w[RESIDUAL + 4] = s5  # C.x
    w[RESIDUAL + 5] = s6  # C.y
    w[RESIDUAL + 6] = s7  # D.x
    w[RESIDUAL + 7] = s8  # D.y
    w[VELOCITY_VIOLATION] = s9  # velocity_violation
    w[VELOCITY_MEASURE] = s9  # velocity_measure
    w[KINETIC] = s0 + v8*v8*p11  # kinetic
    w[POTENTIAL] = q1*p4 + q4*p7 + q7*p10  # potential
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
    """Diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p12 = p[12]  # 0.3333333333333333*crank_mass
    p13 = p[13]  # 5.333333333333333*coupler_mass
    p14 = p[14]  # 2.083333333333333*rocker_mass
    # outputs
    w[MASS] = p0  # crank.vx
    w[MASS + 1] = p0  # crank.vy
    w[MASS + 2] = p12  # crank.omega
    w[MASS + 3] = p1  # coupler.vx
    w[MASS + 4] = p1  # coupler.vy
    w[MASS + 5] = p13  # coupler.omega
    w[MASS + 6] = p2  # rocker.vx
    w[MASS + 7] = p2  # rocker.vy
    w[MASS + 8] = p14  # rocker.omega
    return 0
