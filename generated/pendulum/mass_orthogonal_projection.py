"""Method `mass-orthogonal-projection` for model `pendulum`. Emitted by symgen; do not edit.

positions and velocities projected in the metric of M by iterations with M + a D^T D
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130, doi 10.1007/BF01833296
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[3] penalty (default 10000000.0)
p[4] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MASK = 16  # sections of w
RESIDUAL = 18
CHANGE = 21
MOVED = 31
FORCE_OF_CONSTRAINTS = 33


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 3 operations, 5 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 1.0/p0
    # outputs
    p[5] = s0
    p[6] = s1
    p[7] = s0*s1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by mass-orthogonal-projection: 20 operations, 46 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p5 = p[5]
    mask_0 = w[16]
    p6 = p[6]
    p7 = p[7]
    # intermediate terms
    s0 = (v0*v0 + v1*v1 - q1*p7)*(1.0/(mask_0 + q0*(q0*p6) + q1*(q1*p6)))
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = -p6*(q0*s0)
    ydot[3] = -p6*(p5 + q1*s0)
    ydot[4] = 0.0
    w[15] = s0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of M + a D^T D: 21 operations, 57 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    p3 = p[3]
    mask_0 = w[16]
    # intermediate terms
    s0 = 0.5*(q0*q0 + q1*q1 - 1.0)
    s1 = p3*(1.0*(1.0 > mask_0))
    s2 = q0*s1
    s3 = q1*s2
    s4 = 1.0/(p0 + q0*s2)
    s5 = s3*s4
    # outputs
    w[18] = s0
    w[0] = math.sqrt(s0*s0)
    w[25] = q0
    w[26] = q1
    w[5] = 1.0
    w[4] = 1.0
    w[28] = s5
    w[29] = s4
    w[30] = 1.0/(p0 + q1*(q1*s1) - s3*s5)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 20 operations, 135 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    p3 = p[3]
    mask_0 = w[16]
    residual_0 = w[18]
    moved_0 = w[31]
    moved_1 = w[32]
    force_of_constraints_0 = w[33]
    jacobian_0 = w[25]
    jacobian_1 = w[26]
    law_lower_0 = w[28]
    law_reciprocal_0 = w[29]
    law_reciprocal_1 = w[30]
    # intermediate terms
    s0 = p3*(1.0*(1.0 > mask_0))*residual_0
    s1 = force_of_constraints_0 + s0
    s2 = s0 + s1
    s3 = p0*moved_0 + s2*jacobian_0
    s4 = law_reciprocal_1*(s3*law_lower_0 - (p0*moved_1 + s2*jacobian_1))
    s5 = s3*law_reciprocal_0 + law_lower_0*s4
    # outputs
    w[21] = -s5
    w[22] = s4
    w[31] = moved_0 - s5
    w[32] = moved_1 + s4
    w[33] = s1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state by mass-orthogonal projections and measure it; bits as for other corrections."""
    bits = 2
    tolerance = p[4] * w[6]
    last = math.inf
    for j in range(2):
        w[MOVED + j] = 0.0
    for round in range(20):
        geometry(t, y, p, w)
        violation = w[0]
        if round == 0:
            for i in range(1):
                w[FORCE_OF_CONSTRAINTS + i] = -p[3] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or (violation > 0.9 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        spread(p, w)
        for j in range(2):
            y[j] += w[CHANGE + j]
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    tolerance = p[4] * w[7]
    last = math.inf
    for j in range(2):
        w[MOVED + j] = 0.0
    for round in range(20):
        measure(t, y, p, w)
        violation = w[1]
        if round == 0:
            for i in range(1):
                w[FORCE_OF_CONSTRAINTS + i] = -p[3] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or violation > 0.9 * last:
            break
        last = violation
        spread(p, w)
        for j in range(2):
            y[2 + j] += w[CHANGE + j]
        iw[3] += 1
    return bits
