"""Model `four-bar`: what every method of it shares. Emitted by symgen; do not edit.

digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
3 coordinates, 3 velocities, 2 constraint rows, 3 parameters,
0 fill-ins in the factor of D D^T

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     crank.theta [rad]
y[1]     rocker.theta [rad]
y[2]     coupler.theta [rad]
y[3]     crank.omega [rad/s]
y[4]     rocker.omega [rad/s]
y[5]     coupler.omega [rad/s]
y[6]     work of forces without potential and of drivers [J]
p[0]     crank_mass [kg]
p[1]     coupler_mass [kg]
p[2]     rocker_mass [kg]
row 0    C.x [m]
row 1    C.y [m]

w[0:19]  status
w[19:21]  multipliers
w[21:23]  mask
w[23:25]  saved
w[25:27]  residual
w[27:29]  nu
w[29:31]  pivot
w[31:34]  change
w[34:37]  mass
w[37:40]  gauge
w[40:42]  row_weight
w[42:48]  jacobian
w[48:49]  lower
w[49:51]  reciprocal
w[51:52]  mass_entry

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
    """numbers that depend on parameters alone: 19 operations, 20 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 4.0*p1
    # outputs
    p[3] = s0  # 4.0*coupler_mass
    p[4] = 0.5*p0  # 0.5*crank_mass
    p[5] = 0.16666666666666666*p0  # 0.16666666666666666*crank_mass
    p[6] = 9.81*p0  # 9.81*crank_mass
    p[7] = 0.5*p1  # 0.5*coupler_mass
    p[8] = 2.6666666666666665*p1  # 2.6666666666666665*coupler_mass
    p[9] = 9.81*p1  # 9.81*coupler_mass
    p[10] = 0.5*p2  # 0.5*rocker_mass
    p[11] = 1.0416666666666665*p2  # 1.0416666666666665*rocker_mass
    p[12] = 9.81*p2  # 9.81*rocker_mass
    p[13] = 5.333333333333333*p1 + 16.0*p1
    p[14] = 2.083333333333333*p2 + 6.25*p2  # 2.083333333333333*rocker_mass + 6.25*rocker_mass
    p[15] = s0 + p0 + 0.3333333333333333*p0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 73 operations, 1145 before sharing."""
    # inputs
    q0 = y[0]  # crank.theta [rad]
    q1 = y[1]  # rocker.theta [rad]
    q2 = y[2]  # coupler.theta [rad]
    p3 = p[3]  # 4.0*coupler_mass
    mask_0 = w[21]  # C.x
    mask_1 = w[22]  # C.y
    gauge_0 = w[37]  # crank.omega
    gauge_1 = w[38]  # rocker.omega
    gauge_2 = w[39]  # coupler.omega
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 2.0*math.cos(q0)
    s3 = 2.0*math.sin(q0)
    s4 = 5.0*math.cos(q1)
    s5 = 8.0*s0
    s6 = 10.0 - s2 + s4 - s5
    s7 = 5.0*math.sin(q1)
    s8 = 8.0*s1
    s9 = s7 - s3 - s8
    s10 = s3*gauge_0
    s11 = s7*gauge_1
    s12 = s8*gauge_2
    s13 = s3*s10 + s7*s11 + s8*s12
    s14 = s2*s10 + s4*s11 + s5*s12
    s15 = s2*(s2*gauge_0) + s4*(s4*gauge_1) + s5*(s5*gauge_2)
    s16 = max(s13, 2.0)
    s17 = 1.0*(s13 > mask_0 + 1e-12*s16)
    s18 = s17/max(s13, 1e-300)
    s19 = s14*s18
    s20 = s15 - s14*s19
    s21 = max(s15, 2.0)
    s22 = 1.0*(s20 > mask_1 + 1e-12*s21)
    s23 = math.sqrt(s6*s6 + s9*s9)
    s24 = s13/s16
    s25 = s20/s21
    # outputs
    w[25] = s6  # C.x
    w[26] = s9  # C.y
    w[0] = s23  # position_violation
    w[8] = s23  # position_measure
    w[42] = s3  # D C.x, crank.omega
    w[43] = -s7  # D C.x, rocker.omega
    w[44] = s8  # D C.x, coupler.omega
    w[45] = -s2  # D C.y, crank.omega
    w[46] = s4  # D C.y, rocker.omega
    w[47] = -s5  # D C.y, coupler.omega
    w[29] = s24  # C.x
    w[30] = s25  # C.y
    w[5] = s17 + s22  # rank
    w[4] = min(min(1.0, mask_0 + s24), mask_1 + s25)  # smallest_pivot
    w[10] = 1.0  # shortest_row
    w[48] = -s19
    w[49] = s18
    w[50] = s22/max(s20, 1e-300)
    w[51] = s3*(s1*p3) + s2*(s0*p3)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 18 operations, 39 before sharing."""
    # inputs
    gauge_0 = w[37]  # crank.omega
    gauge_1 = w[38]  # rocker.omega
    gauge_2 = w[39]  # coupler.omega
    lower_0 = w[48]
    reciprocal_0 = w[49]
    reciprocal_1 = w[50]
    residual_0 = w[25]  # C.x
    residual_1 = w[26]  # C.y
    jacobian_0 = w[42]  # D C.x, crank.omega
    jacobian_1 = w[43]  # D C.x, rocker.omega
    jacobian_2 = w[44]  # D C.x, coupler.omega
    jacobian_3 = w[45]  # D C.y, crank.omega
    jacobian_4 = w[46]  # D C.y, rocker.omega
    jacobian_5 = w[47]  # D C.y, coupler.omega
    # intermediate terms
    s0 = reciprocal_1*(lower_0*residual_0 - residual_1)
    s1 = reciprocal_0*residual_0 + lower_0*s0
    # outputs
    w[31] = gauge_0*(s0*jacobian_3 - s1*jacobian_0)  # crank.omega
    w[32] = gauge_1*(s0*jacobian_4 - s1*jacobian_1)  # rocker.omega
    w[33] = gauge_2*(s0*jacobian_5 - s1*jacobian_2)  # coupler.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 65 operations, 142 before sharing."""
    # inputs
    q0 = y[0]  # crank.theta [rad]
    q1 = y[1]  # rocker.theta [rad]
    q2 = y[2]  # coupler.theta [rad]
    v0 = y[3]  # crank.omega [rad/s]
    v1 = y[4]  # rocker.omega [rad/s]
    v2 = y[5]  # coupler.omega [rad/s]
    p4 = p[4]  # 0.5*crank_mass
    p5 = p[5]  # 0.16666666666666666*crank_mass
    p6 = p[6]  # 9.81*crank_mass
    p7 = p[7]  # 0.5*coupler_mass
    p8 = p[8]  # 2.6666666666666665*coupler_mass
    p9 = p[9]  # 9.81*coupler_mass
    p10 = p[10]  # 0.5*rocker_mass
    p11 = p[11]  # 1.0416666666666665*rocker_mass
    p12 = p[12]  # 9.81*rocker_mass
    jacobian_0 = w[42]  # D C.x, crank.omega
    jacobian_1 = w[43]  # D C.x, rocker.omega
    jacobian_2 = w[44]  # D C.x, coupler.omega
    jacobian_3 = w[45]  # D C.y, crank.omega
    jacobian_4 = w[46]  # D C.y, rocker.omega
    jacobian_5 = w[47]  # D C.y, coupler.omega
    # intermediate terms
    s0 = math.cos(q0)
    s1 = math.sin(q0)
    s2 = 2.0*s1
    s3 = v0*s1
    s4 = v0*s0
    s5 = 4.0*math.sin(q2)
    s6 = v0*s2 + v2*s5
    s7 = v0*(2.0*s0) + v2*(4.0*math.cos(q2))
    s8 = 2.5*math.sin(q1)
    s9 = v1*s8
    s10 = v1*(2.5*math.cos(q1))
    s11 = p4*(s3*s3 + s4*s4) + v0*v0*p5 + p7*(s6*s6 + s7*s7) + v2*v2*p8 + p10*(s9*s9 + s10*s10) + v1*v1*p11
    s12 = v0*jacobian_0 + v1*jacobian_1 + v2*jacobian_2
    s13 = v0*jacobian_3 + v1*jacobian_4 + v2*jacobian_5
    s14 = math.sqrt(s12*s12 + s13*s13)
    # outputs
    w[25] = s12  # C.x
    w[26] = s13  # C.y
    w[1] = s14  # velocity_violation
    w[9] = s14  # velocity_measure
    w[2] = s11  # kinetic
    w[3] = s1*p6 + (s2 + s5)*p9 + s8*p12  # potential
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates: 43 operations, 56 before sharing."""
    # inputs
    q0 = y[0]  # crank.theta [rad]
    q1 = y[1]  # rocker.theta [rad]
    q2 = y[2]  # coupler.theta [rad]
    v0 = y[3]  # crank.omega [rad/s]
    v1 = y[4]  # rocker.omega [rad/s]
    v2 = y[5]  # coupler.omega [rad/s]
    ydot_3 = ydot[3]  # rate of crank.omega
    ydot_4 = ydot[4]  # rate of rocker.omega
    ydot_5 = ydot[5]  # rate of coupler.omega
    # intermediate terms
    s0 = math.cos(q1)
    s1 = math.sin(q1)
    s2 = math.cos(q2)
    s3 = math.sin(q2)
    s4 = 2.0*math.cos(q0)
    s5 = 2.0*math.sin(q0)
    s6 = v0*v0
    s7 = 8.0*(v2*v2)
    s8 = 5.0*(v1*v1)
    # outputs
    out[0] = s4*s6 + s2*s7 - s0*s8 + s5*ydot_3 - 5.0*s1*ydot_4 + 8.0*s3*ydot_5  # C.x
    out[1] = s5*s6 + s3*s7 - s1*s8 + 5.0*s0*ydot_4 - s4*ydot_3 - 8.0*s2*ydot_5  # C.y
    out[2] = q0  # A.angle
    out[3] = v0  # rate of A.angle
    out[4] = q2 - q0  # B.angle
    out[5] = v2 - v0  # rate of B.angle
    out[6] = q1 - q2  # C.angle
    out[7] = v1 - v2  # rate of C.angle
    out[8] = q1  # D.angle
    out[9] = v1  # rate of D.angle
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p13 = p[13]
    p14 = p[14]  # 2.083333333333333*rocker_mass + 6.25*rocker_mass
    p15 = p[15]
    # outputs
    w[34] = p15  # crank.omega
    w[36] = p13  # coupler.omega
    w[35] = p14  # rocker.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def bodies(t, y, p, w, ydot, out):
    """coordinates, velocities and accelerations of bodies: 60 operations, 109 before sharing."""
    # inputs
    q0 = y[0]  # crank.theta [rad]
    q1 = y[1]  # rocker.theta [rad]
    q2 = y[2]  # coupler.theta [rad]
    v0 = y[3]  # crank.omega [rad/s]
    v1 = y[4]  # rocker.omega [rad/s]
    v2 = y[5]  # coupler.omega [rad/s]
    ydot_3 = ydot[3]  # rate of crank.omega
    ydot_4 = ydot[4]  # rate of rocker.omega
    ydot_5 = ydot[5]  # rate of coupler.omega
    # intermediate terms
    s0 = math.cos(q0)
    s1 = math.sin(q0)
    s2 = 2.0*s0
    s3 = 2.0*s1
    s4 = v0*v0
    s5 = 4.0*math.cos(q2)
    s6 = 4.0*math.sin(q2)
    s7 = 2.5*math.cos(q1)
    s8 = 2.5*math.sin(q1)
    s9 = v1*v1
    s10 = v2*v2
    # outputs
    out[0] = s0
    out[1] = s1
    out[2] = q0
    out[3] = s2 + s5
    out[4] = s3 + s6
    out[5] = q2
    out[6] = 10.0 + s7
    out[7] = s8
    out[8] = q1
    out[9] = -v0*s1
    out[10] = v0*s0
    out[11] = v0
    out[12] = -(v0*s3 + v2*s6)
    out[13] = v0*s2 + v2*s5
    out[14] = v2
    out[15] = -v1*s8
    out[16] = v1*s7
    out[17] = v1
    out[18] = -(s0*s4 + s1*ydot_3)
    out[19] = s0*ydot_3 - s1*s4
    out[20] = ydot_3
    out[21] = -(s2*s4 + s5*s10 + s6*ydot_5 + s3*ydot_3)
    out[22] = s5*ydot_5 - (s3*s4 + s6*s10) + s2*ydot_3
    out[23] = ydot_5
    out[24] = -(s7*s9 + s8*ydot_4)
    out[25] = s7*ydot_4 - s8*s9
    out[26] = ydot_4
    return 0
