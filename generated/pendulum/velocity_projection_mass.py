"""Method `velocity-projection` for model `pendulum`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = mass
"""

import math

from numba import njit

from .model import measure

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
    """q', v', power and multipliers by velocity-projection: 20 operations, 46 before sharing."""
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
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 13 operations, 23 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    p4 = p[4]
    # intermediate terms
    s0 = 0.5*(q0*q0 + q1*q1 - 1.0)
    # outputs
    w[18] = s0
    w[0] = math.sqrt(s0*s0)
    w[25] = q0
    w[26] = q1
    w[5] = 1.0
    w[4] = 1.0
    w[28] = 1.0/(q0*(q0*p4) + q1*(q1*p4))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 7 operations, 8 before sharing."""
    # inputs
    p4 = p[4]
    law_reciprocal_0 = w[28]
    residual_0 = w[18]
    jacobian_0 = w[25]
    jacobian_1 = w[26]
    # intermediate terms
    s0 = law_reciprocal_0*residual_0
    # outputs
    w[21] = -p4*(s0*jacobian_0)
    w[22] = -p4*(s0*jacobian_1)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = 0.0
    last = math.inf
    bits = 2
    for round in range(1):
        geometry(t, y, p, w)
        violation = w[0]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        closed = violation <= tolerance or stalled or round == 0
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
