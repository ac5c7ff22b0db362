"""Method `ggl` for model `pendulum`. Emitted by symgen; do not edit.

stabilised index 2: constraints at position and velocity level in every implicit stage
Gear, Leimkuhler, Gupta, J. Comput. Appl. Math. 12-13 (1985) 77-90, doi 10.1016/0377-0427(85)90008-1
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
option solver = elimination
"""

import math

from numba import njit

from .model import geometry, measure

CHANGE = 21  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 3 operations, 5 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 1.0/p0
    # outputs
    p[3] = s0
    p[4] = s1
    p[5] = s0*s1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by ggl: 20 operations, 46 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]
    mask_0 = w[16]
    p4 = p[4]
    p5 = p[5]
    # intermediate terms
    s0 = (v0*v0 + v1*v1 - q1*p5)*(1.0/(mask_0 + q0*(q0*p4) + q1*(q1*p4)))
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = -p4*(q0*s0)
    ydot[3] = -p4*(p3 + q1*s0)
    ydot[4] = 0.0
    w[15] = s0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, k, p, w, r):
    """F(t, y, k) of the descriptor form, and the power: 21 operations, 21 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]
    k0 = k[0]
    k1 = k[1]
    k2 = k[2]
    k3 = k[3]
    k4 = k[4]
    k5 = k[5]
    # outputs
    r[0] = k0 - v0 + q0*k5
    r[1] = k1 - v1 + q1*k5
    r[2] = p0*k2 + q0*k4
    r[3] = p3 + p0*k3 + q1*k4
    r[4] = q0*v0 + q1*v1
    r[5] = 0.5*(q0*q0 + q1*q1 - 1.0)
    w[14] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """entries of dF/dk and dF/dy of the descriptor form: 4 operations, 4 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    k4 = k[4]
    k5 = k[5]
    # outputs
    j[0] = 1.0
    j[1] = q0
    j[2] = k5
    j[3] = -1.0
    j[4] = 1.0
    j[5] = q1
    j[6] = k5
    j[7] = -1.0
    j[8] = p0
    j[9] = q0
    j[10] = k4
    j[11] = p0
    j[12] = q1
    j[13] = k4
    j[14] = v0
    j[15] = v1
    j[16] = q0
    j[17] = q1
    j[18] = 0.5*(q0 + q0)
    j[19] = 0.5*(q1 + q1)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
