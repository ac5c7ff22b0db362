"""Model `four-bar`: what every method of it shares. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a1bfe8da2fcb1eac
9 coordinates, 9 velocities, 8 constraint rows, 3 parameters,
6 of 8 rows eliminated without a division, together with velocities that they fix

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

MASK = 27  # sections of w
RESIDUAL = 43
PIVOT = 59
CHANGE = 67
GAUGE = 85
JACOBIAN = 102
POSITION_VIOLATION = 0  # numbers in w
VELOCITY_VIOLATION = 1
KINETIC = 2
POTENTIAL = 3
SMALLEST_PIVOT = 4
RANK = 5
POSITION_MEASURE = 8
VELOCITY_MEASURE = 9
SHORTEST_ROW = 10


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 12 operations."""
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


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 129 operations."""
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
    mask_4 = w[MASK + 4]  # C.x
    mask_5 = w[MASK + 5]  # C.y
    gauge_2 = w[GAUGE + 2]  # crank.omega
    gauge_5 = w[GAUGE + 5]  # coupler.omega
    gauge_8 = w[GAUGE + 8]  # rocker.omega
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = q0 - s0
    s4 = q1 - s1
    s5 = math.cos(q5)
    s6 = math.sin(q5)
    s7 = 4.0*s5
    s8 = -s7
    s9 = q3 - q0 - s7 - s0
    s10 = 4.0*s6
    s11 = q4 - q1 - s10 - s1
    s12 = math.cos(q8)
    s13 = math.sin(q8)
    s14 = 2.5*s12
    s15 = q6 - q3 + s14 - s7
    s16 = 2.5*s13
    s17 = q7 - q4 + s16 - s10
    s18 = q6 - 10.0 - s14
    s19 = q7 - s16
    s20 = 1.0 + 1.0 + s10*(s10*gauge_5) + s16*(s16*gauge_8)
    s21 = 1.0 + 1.0 + s7*(s7*gauge_5) + s14*(s14*gauge_8)
    s22 = s1 + s1
    s23 = s0 + s0
    s24 = 5.0*s13
    s25 = 5.0*s12
    s26 = 8.0*(s1*s6 + s0*s5)
    s27 = 1.0/(1.0/gauge_8 + 6.25)
    s28 = s24*s27
    s29 = 1.0/(1.0/gauge_2 + 5.0)
    s30 = s26*s29
    s31 = s22*s29
    s32 = 8.0*s6 - s22*s30
    s33 = s23*s30 - 8.0*s5
    s34 = 1.0/(1.0/gauge_5 + 16.0 - s26*s30)
    s35 = s32*s34
    s36 = s24*s28 + s22*s31 + s32*s35
    s37 = s25*s28 + s23*s31 - s33*s35
    s38 = 1.0*(s36 > mask_4 + 1e-12*s20)
    s39 = s25*(s25*s27) + s23*(s23*s29) + s33*(s33*s34) - s37*(s37*(s38/max(s36, 1e-300)))
    s40 = math.sqrt(s3*s3 + s4*s4 + s9*s9 + s11*s11 + s15*s15 + s17*s17 + s18*s18 + s19*s19)
    s41 = s36/s20
    s42 = s39/s21
    # outputs
    w[RESIDUAL] = s3  # A.x
    w[RESIDUAL + 1] = s4  # A.y
    w[RESIDUAL + 2] = s9  # B.x
    w[RESIDUAL + 3] = s11  # B.y
    w[RESIDUAL + 4] = s15  # C.x
    w[RESIDUAL + 5] = s17  # C.y
    w[RESIDUAL + 6] = s18  # D.x
    w[RESIDUAL + 7] = s19  # D.y
    w[POSITION_VIOLATION] = s40  # position_violation
    w[POSITION_MEASURE] = s40  # position_measure
    w[JACOBIAN] = s1  # D A.x, crank.omega
    w[JACOBIAN + 1] = s2  # D A.y, crank.omega
    w[JACOBIAN + 2] = s1  # D B.x, crank.omega
    w[JACOBIAN + 3] = s10  # D B.x, coupler.omega
    w[JACOBIAN + 4] = s2  # D B.y, crank.omega
    w[JACOBIAN + 5] = s8  # D B.y, coupler.omega
    w[JACOBIAN + 6] = s10  # D C.x, coupler.omega
    w[JACOBIAN + 7] = -s16  # D C.x, rocker.omega
    w[JACOBIAN + 8] = s8  # D C.y, coupler.omega
    w[JACOBIAN + 9] = s14  # D C.y, rocker.omega
    w[JACOBIAN + 10] = s16  # D D.x, rocker.omega
    w[JACOBIAN + 11] = -s14  # D D.y, rocker.omega
    w[PIVOT + 4] = s41  # C.x
    w[PIVOT + 5] = s42  # C.y
    w[RANK] = 1.0 + 1.0 + 1.0*(s39 > mask_5 + 1e-12*s21) + 4.0 + s38  # rank
    w[SMALLEST_PIVOT] = min(min(1.0, mask_4 + s41), mask_5 + s42)  # smallest_pivot
    w[SHORTEST_ROW] = 1.0  # shortest_row
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """The correction -D^+ times the section `residual`, of v, or of q by N: 150 operations."""
    # inputs
    mask_4 = w[MASK + 4]  # C.x
    mask_5 = w[MASK + 5]  # C.y
    gauge_2 = w[GAUGE + 2]  # crank.omega
    gauge_5 = w[GAUGE + 5]  # coupler.omega
    gauge_8 = w[GAUGE + 8]  # rocker.omega
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
    pivot_4 = w[PIVOT + 4]  # C.x
    pivot_5 = w[PIVOT + 5]  # C.y
    # intermediate terms
    s0 = jacobian_0 + jacobian_2
    s1 = jacobian_1 + jacobian_4
    s2 = jacobian_7 - jacobian_10
    s3 = jacobian_9 - jacobian_11
    s4 = jacobian_3*s0 + jacobian_5*s1
    s5 = 1.0/(1.0/gauge_8 + jacobian_10*jacobian_10 + jacobian_11*jacobian_11)
    s6 = s2*s5
    s7 = s3*s5
    s8 = 1.0/(1.0/gauge_2 + jacobian_0*jacobian_0 + jacobian_1*jacobian_1 + s0*s0 + s1*s1)
    s9 = s4*s8
    s10 = s0*s8
    s11 = s1*s8
    s12 = jacobian_3 + jacobian_6 - s0*s9
    s13 = jacobian_5 + jacobian_8 - s1*s9
    s14 = 1.0/(1.0/gauge_5 + jacobian_3*jacobian_3 + jacobian_5*jacobian_5 - s4*s9)
    s15 = s12*s14
    s16 = s13*s14
    s17 = s3*s6 + s1*s10 + s13*s15
    s18 = 1.0*(pivot_4 > mask_4 + 1e-12)/max(s2*s6 + s0*s10 + s12*s15, 1e-300)
    s19 = s17*s18
    s20 = residual_0 + residual_2
    s21 = residual_1 + residual_3
    s22 = residual_6*jacobian_10 + residual_7*jacobian_11
    s23 = residual_0*jacobian_0 + residual_1*jacobian_1 + s0*s20 + s1*s21
    s24 = s9*s23 - (jacobian_3*s20 + jacobian_5*s21)
    s25 = residual_6 - residual_4 - s20 + s6*s22 + s10*s23 - s15*s24
    s26 = 1.0*(pivot_5 > mask_5 + 1e-12)/max(s3*s7 + s1*s11 + s13*s16 - s17*s19, 1e-300)*(residual_7 - residual_5 - s21 + s7*s22 + s11*s23 - s16*s24 - s19*s25)
    s27 = s19*s26 - s18*s25
    s28 = s14*s24 - s15*s27 + s16*s26
    s29 = s11*s26 - (s8*s23 + s9*s28 + s10*s27)
    s30 = s7*s26 - (s5*s22 + s6*s27)
    s31 = residual_0 + jacobian_0*s29
    s32 = residual_1 + jacobian_1*s29
    # outputs
    w[CHANGE] = -s31  # crank.vx
    w[CHANGE + 1] = -s32  # crank.vy
    w[CHANGE + 2] = s29  # crank.omega
    w[CHANGE + 3] = -(residual_2 + s31 + jacobian_2*s29 + jacobian_3*s28)  # coupler.vx
    w[CHANGE + 4] = -(residual_3 + s32 + jacobian_4*s29 + jacobian_5*s28)  # coupler.vy
    w[CHANGE + 5] = s28  # coupler.omega
    w[CHANGE + 6] = -(residual_6 + jacobian_10*s30)  # rocker.vx
    w[CHANGE + 7] = -(residual_7 + jacobian_11*s30)  # rocker.vy
    w[CHANGE + 8] = s30  # rocker.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 75 operations."""
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
