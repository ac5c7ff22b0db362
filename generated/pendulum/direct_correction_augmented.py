"""Method `direct-correction` for model `pendulum`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
option solver = augmented
option weight = identity
p[3] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import geometry, measure, spread

CHANGE = 21  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 7 operations, 8 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    # outputs
    p[4] = -s0
    p[5] = 50000.0*(p0 + p0)
    p[6] = -s0*(1.0/p0)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 18 operations, 46 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p4 = p[4]
    mask_0 = w[16]
    p5 = p[5]
    p6 = p[6]
    # intermediate terms
    s0 = p5*(1.0*(1.0 > mask_0))
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
    w[34] = p4
    w[35] = -(v0*v0 + v1*v1)
    w[36] = 0.0
    w[37] = p6
    w[15] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration of direct-correction: 36 operations, 359 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    kept_factor_0 = w[28]
    kept_factor_1 = w[29]
    kept_factor_2 = w[30]
    kept_penalties_0 = w[31]
    kept_jacobian_0 = w[32]
    kept_jacobian_1 = w[33]
    kept_force_0 = w[34]
    kept_target_0 = w[35]
    kept_acceleration_0 = w[36]
    kept_acceleration_1 = w[37]
    multipliers_0 = w[15]
    # intermediate terms
    s0 = kept_penalties_0*(kept_jacobian_0*kept_acceleration_0 + kept_jacobian_1*kept_acceleration_1 - kept_target_0)
    s1 = multipliers_0 + s0
    s2 = p0*kept_acceleration_0 + kept_jacobian_0*s1
    s3 = kept_factor_2*(kept_force_0 - p0*kept_acceleration_1 - kept_jacobian_1*s1 + kept_factor_0*s2)
    s4 = kept_factor_1*s2 + kept_factor_0*s3
    s5 = kept_acceleration_0 - s4
    s6 = kept_acceleration_1 + s3
    # outputs
    w[36] = s5
    w[37] = s6
    w[15] = multipliers_0 + kept_penalties_0*(kept_jacobian_0*s5 + kept_jacobian_1*s6 - kept_target_0)
    w[9] = math.sqrt((s4*s4 + s3*s3)/(1.0 + s5*s5 + s6*s6))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power: 0 operations, 0 before sharing."""
    # inputs
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    kept_acceleration_0 = w[36]
    kept_acceleration_1 = w[37]
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = kept_acceleration_0
    ydot[3] = kept_acceleration_1
    ydot[4] = 0.0
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
        if increment <= 1e-13 or (increment > 0.5 * last and increment < 1e-6):
            break
        last = increment
    finish(t, y, p, w, ydot)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[3] * w[6]
    last = math.inf
    bits = 2
    for round in range(15):
        geometry(t, y, p, w)
        violation = w[0]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        closed = violation <= tolerance or stalled or round == 14
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
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    measure(t, y, p, w)
    return bits
