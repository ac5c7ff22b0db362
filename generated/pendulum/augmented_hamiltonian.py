"""Method `augmented-hamiltonian` for model `pendulum`. Emitted by symgen; do not edit.

momenta are integrated; velocities satisfy their constraint in every evaluation
Bayo, Avello, Nonlinear Dyn. 5 (1994) 209-231, doi 10.1007/BF00045677
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
p[3] penalty (default 10000000.0)
p[4] iteration_tolerance (default 1e-13)
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
    p[5] = s0
    p[6] = s1
    p[7] = s0*s1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rates(t, y, p, w, iw, ydot):
    """q', v' and multipliers for results: 20 operations, 46 before sharing."""
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
def begin(t, y, p, w):
    """matrices and start of the iteration: 16 operations, 44 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]
    mask_0 = w[16]
    # intermediate terms
    s0 = p3*(1.0*(1.0 > mask_0))
    s1 = q0*s0
    s2 = q1*s1
    s3 = 1.0/(p0 + q0*s1)
    s4 = s2*s3
    # outputs
    w[28] = s4
    w[29] = s3
    w[30] = 1.0/(p0 + q1*(q1*s0) - s2*s4)
    w[31] = s0
    w[32] = q0
    w[33] = q1
    w[34] = p0*v0
    w[35] = p0*v1
    w[36] = v0
    w[37] = v1
    w[38] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration of augmented-hamiltonian: 35 operations, 346 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    kept_factor_0 = w[28]
    kept_factor_1 = w[29]
    kept_factor_2 = w[30]
    kept_penalties_0 = w[31]
    kept_jacobian_0 = w[32]
    kept_jacobian_1 = w[33]
    kept_momentum_0 = w[34]
    kept_momentum_1 = w[35]
    kept_velocity_0 = w[36]
    kept_velocity_1 = w[37]
    kept_impulse_0 = w[38]
    # intermediate terms
    s0 = kept_impulse_0 + kept_penalties_0*(kept_jacobian_0*kept_velocity_0 + kept_jacobian_1*kept_velocity_1)
    s1 = kept_momentum_0 - p0*kept_velocity_0 - kept_jacobian_0*s0
    s2 = kept_factor_2*(kept_momentum_1 - p0*kept_velocity_1 - kept_jacobian_1*s0 - kept_factor_0*s1)
    s3 = kept_factor_1*s1 - kept_factor_0*s2
    s4 = kept_velocity_0 + s3
    s5 = kept_velocity_1 + s2
    # outputs
    w[36] = s4
    w[37] = s5
    w[38] = kept_impulse_0 + kept_penalties_0*(kept_jacobian_0*s4 + kept_jacobian_1*s5)
    w[9] = math.sqrt((s3*s3 + s2*s2)/(1.0 + s4*s4 + s5*s5))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power: 5 operations, 5 before sharing."""
    # inputs
    p5 = p[5]
    kept_velocity_0 = w[36]
    kept_velocity_1 = w[37]
    kept_impulse_0 = w[38]
    p6 = p[6]
    # outputs
    ydot[0] = kept_velocity_0
    ydot[1] = kept_velocity_1
    ydot[2] = kept_velocity_0*kept_impulse_0*p6
    ydot[3] = (kept_velocity_1*kept_impulse_0 - p5)*p6
    ydot[4] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 13 operations, 23 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    p6 = p[6]
    # intermediate terms
    s0 = 0.5*(q0*q0 + q1*q1 - 1.0)
    # outputs
    w[18] = s0
    w[0] = math.sqrt(s0*s0)
    w[25] = q0
    w[26] = q1
    w[5] = 1.0
    w[4] = 1.0
    w[39] = 1.0/(q0*(q0*p6) + q1*(q1*p6))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 7 operations, 8 before sharing."""
    # inputs
    p6 = p[6]
    law_reciprocal_0 = w[39]
    residual_0 = w[18]
    jacobian_0 = w[25]
    jacobian_1 = w[26]
    # intermediate terms
    s0 = law_reciprocal_0*residual_0
    # outputs
    w[21] = -p6*(s0*jacobian_0)
    w[22] = -p6*(s0*jacobian_1)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state by iteration until v' changes no more, at most 30 times."""
    begin(t, y, p, w)
    last = math.inf
    for _ in range(30):
        iterate(p, w)
        iw[6] += 1
        increment = w[9]
        # at the floor of rounding another iteration gains nothing
        if increment <= p[4] or (increment > 0.5 * last and increment < 1e-6):
            break
        last = increment
    finish(t, y, p, w, ydot)
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
