"""Model `pendulum`: what every method of it shares. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
2 coordinates, 2 velocities, 1 constraint rows, 1 parameters,
0 fill-ins in the factor of D D^T

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     bob.x [m]
y[1]     bob.y [m]
y[2]     bob.vx [m/s]
y[3]     bob.vy [m/s]
y[4]     work of forces without potential and of drivers [J]
p[0]     bob_mass [kg]
row 0    link.distance [m]

w[0:19]  status
w[19:20]  multipliers
w[20:21]  mask
w[21:22]  saved
w[22:23]  residual
w[23:24]  nu
w[24:25]  pivot
w[25:27]  change
w[27:29]  mass
w[29:31]  gauge
w[31:32]  row_weight
w[32:34]  jacobian
w[34:35]  reciprocal

Left out:
- z coordinates, Euler parameters and 3x3 inertia tensors: the mechanism is planar
- the kinematic map N: planar velocities are the rates of the coordinates
- gyroscopic terms: they vanish in the plane
- columns of the ground: the ground does not move
- angle of bob: a point mass has none
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 2 operations, 2 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # outputs
    p[1] = 0.5*p0  # 0.5*bob_mass
    p[2] = 9.81*p0  # 9.81*bob_mass
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 8 operations, 33 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    # intermediate terms
    s0 = q0*q0 + q1*q1
    s1 = 0.5*(s0 - 1.0)
    s2 = math.sqrt(s1*s1)
    # outputs
    w[22] = s1  # link.distance
    w[0] = s2  # position_violation
    w[8] = s2  # position_measure
    w[32] = q0  # D link.distance, bob.vx
    w[33] = q1  # D link.distance, bob.vy
    w[5] = 1.0  # rank
    w[4] = 1.0  # smallest_pivot
    w[10] = 1.0  # shortest_row
    w[34] = 1.0/s0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 5 operations, 6 before sharing."""
    # inputs
    reciprocal_0 = w[34]
    residual_0 = w[22]  # link.distance
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    # intermediate terms
    s0 = reciprocal_0*residual_0
    # outputs
    w[25] = -s0*jacobian_0  # bob.vx
    w[26] = -s0*jacobian_1  # bob.vy
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 11 operations, 25 before sharing."""
    # inputs
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p1 = p[1]  # 0.5*bob_mass
    p2 = p[2]  # 9.81*bob_mass
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    # intermediate terms
    s0 = v0*jacobian_0 + v1*jacobian_1
    s1 = math.sqrt(s0*s0)
    # outputs
    w[22] = s0  # link.distance
    w[1] = s1  # velocity_violation
    w[9] = s1  # velocity_measure
    w[2] = v0*v0*p1 + v1*v1*p1  # kinetic
    w[3] = q1*p2  # potential
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates: 7 operations, 7 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    ydot_2 = ydot[2]  # rate of bob.vx
    ydot_3 = ydot[3]  # rate of bob.vy
    # outputs
    out[0] = v0*v0 + v1*v1 + q0*ydot_2 + q1*ydot_3  # link.distance
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """diagonal of M: 0 operations, 0 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # outputs
    w[27] = p0  # bob.vx
    w[28] = p0  # bob.vy
    return 0
