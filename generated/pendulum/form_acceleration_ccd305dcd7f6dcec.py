"""Descriptor form, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, k, p, w, r):
    """F(t, y, k) of the descriptor form, and the power: 33 operations, 39 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]  # 9.81*bob_mass
    p6 = p[6]  # gain
    p7 = p[7]  # a
    status_12 = w[12]  # step
    k0 = k[0]
    k1 = k[1]
    k2 = k[2]
    k3 = k[3]
    k4 = k[4]
    # intermediate terms
    s0 = min(p6, p7*(1.0/status_12))
    s1 = v0*v0 + v1*v1 + (q0*v0 + q1*v1)*(2.0*s0) + 0.5*(q0*q0 + q1*q1 - 1.0)*(s0*s0) + q0*k2 + q1*k3
    # outputs
    r[0] = k0 - v0
    r[1] = k1 - v1
    r[2] = p0*k2 + q0*k4
    r[3] = p3 + p0*k3 + q1*k4
    r[4] = s1
    w[18] = 0.0  # power
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """entries of dF/dk and dF/dy of the descriptor form: 23 operations, 48 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p6 = p[6]  # gain
    p7 = p[7]  # a
    status_12 = w[12]  # step
    k2 = k[2]
    k3 = k[3]
    k4 = k[4]
    # intermediate terms
    s0 = min(p6, p7*(1.0/status_12))
    s1 = 2.0*s0
    s2 = s0*s0
    # outputs
    j[0] = 1.0
    j[1] = -1.0
    j[2] = 1.0
    j[3] = -1.0
    j[4] = p0
    j[5] = q0
    j[6] = k4
    j[7] = p0
    j[8] = q1
    j[9] = k4
    j[10] = q0
    j[11] = q1
    j[12] = k2 + v0*s1 + s2*(0.5*(q0 + q0))
    j[13] = k3 + v1*s1 + s2*(0.5*(q1 + q1))
    j[14] = v0 + v0 + q0*s1
    j[15] = v1 + v1 + q1*s1
    return 0
