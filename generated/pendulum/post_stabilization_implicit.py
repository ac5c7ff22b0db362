"""Method `post-stabilization` for model `pendulum`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = identity
"""

import math

from numba import njit

from .model import geometry, measure, spread

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
    """q', v', power and multipliers by post-stabilization: 20 operations, 46 before sharing."""
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
    """F(t, y, k) of the descriptor form, and the power: 16 operations, 16 before sharing."""
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
    # outputs
    r[0] = k0 - v0
    r[1] = k1 - v1
    r[2] = p0*k2 + q0*k4
    r[3] = p3 + p0*k3 + q1*k4
    r[4] = v0*v0 + v1*v1 + q0*k2 + q1*k3
    w[14] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """entries of dF/dk and dF/dy of the descriptor form: 2 operations, 2 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    k2 = k[2]
    k3 = k[3]
    k4 = k[4]
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
    j[12] = k2
    j[13] = k3
    j[14] = v0 + v0
    j[15] = v1 + v1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = 0.0
    last = math.inf
    bits = 2
    for round in range(2):
        geometry(t, y, p, w)
        violation = w[0]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        closed = violation <= tolerance or stalled or round == 1
        if closed:
            measure(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(2, 4):
                y[j] += w[CHANGE - 2 + j]
            break
        for j in range(2):
            y[j] += w[CHANGE + j]
        last = violation
        iw[3] += 1
    measure(t, y, p, w)
    return bits
