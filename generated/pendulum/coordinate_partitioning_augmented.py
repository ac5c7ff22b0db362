"""Method `coordinate-partitioning` for model `pendulum`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 1, templates 2b445adb8ae4f174
option solver = augmented
p[3] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

CHANGE = 19  # sections of w
DEPENDENT = 35
DENSE = 37


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
    """matrices and start of the iteration: 16 operations, 30 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    v0 = y[2]  # bob.vx [m/s]
    q1 = y[1]  # bob.y [m]
    v1 = y[3]  # bob.vy [m/s]
    p4 = p[4]
    p5 = p[5]
    p6 = p[6]
    # intermediate terms
    s0 = q0*p5
    s1 = q1*s0
    s2 = 1.0/(p0 + q0*s0)
    s3 = s1*s2
    # outputs
    w[26] = s3
    w[27] = s2
    w[28] = 1.0/(p0 + q1*(q1*p5) - s1*s3)
    w[29] = q0
    w[30] = q1
    w[31] = p4
    w[32] = -(v0*v0 + v1*v1)
    w[33] = 0.0
    w[34] = p6
    w[13] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration of coordinate-partitioning: 36 operations, 359 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    p5 = p[5]
    kept_factor_0 = w[26]
    kept_factor_1 = w[27]
    kept_factor_2 = w[28]
    kept_jacobian_0 = w[29]
    kept_jacobian_1 = w[30]
    kept_force_0 = w[31]
    kept_target_0 = w[32]
    kept_acceleration_0 = w[33]
    kept_acceleration_1 = w[34]
    multipliers_0 = w[13]
    # intermediate terms
    s0 = p5*(kept_jacobian_0*kept_acceleration_0 + kept_jacobian_1*kept_acceleration_1 - kept_target_0)
    s1 = multipliers_0 + s0
    s2 = p0*kept_acceleration_0 + kept_jacobian_0*s1
    s3 = kept_factor_2*(kept_force_0 - p0*kept_acceleration_1 - kept_jacobian_1*s1 + kept_factor_0*s2)
    s4 = kept_factor_1*s2 + kept_factor_0*s3
    s5 = kept_acceleration_0 - s4
    s6 = kept_acceleration_1 + s3
    # outputs
    w[33] = s5
    w[34] = s6
    w[13] = multipliers_0 + p5*(kept_jacobian_0*s5 + kept_jacobian_1*s6 - kept_target_0)
    w[9] = math.sqrt((s4*s4 + s3*s3)/(1.0 + s5*s5 + s6*s6))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power: 0 operations, 0 before sharing."""
    # inputs
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    kept_acceleration_0 = w[33]
    kept_acceleration_1 = w[34]
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = kept_acceleration_0
    ydot[3] = kept_acceleration_1
    ydot[4] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
    jacobian_0 = w[23]
    jacobian_1 = w[24]
    # outputs
    w[37] = jacobian_0
    w[38] = jacobian_1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D P D^T: 18 operations, 42 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    dependent_0 = w[35]
    dependent_1 = w[36]
    # intermediate terms
    s0 = q0*q0 + q1*q1
    s1 = 0.5*(s0 - 1.0)
    s2 = q0*(q0*dependent_0) + q1*(q1*dependent_1)
    # outputs
    w[16] = s1
    w[0] = math.sqrt(s1*s1)
    w[23] = q0
    w[24] = q1
    w[5] = 1.0
    w[4] = 1.0
    w[10] = min(1.0, s2/s0 + 1.0*(1e-12*s0 > s0))
    w[39] = 1.0/s2
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 7 operations, 8 before sharing."""
    # inputs
    jacobian_0 = w[23]
    jacobian_1 = w[24]
    dependent_0 = w[35]
    dependent_1 = w[36]
    law_reciprocal_0 = w[39]
    residual_0 = w[16]
    # intermediate terms
    s0 = law_reciprocal_0*residual_0
    # outputs
    w[19] = -dependent_0*(jacobian_0*s0)
    w[20] = -dependent_1*(jacobian_1*s0)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accelerate(t, y, p, w, iw, ydot):
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
def choose(p, w, iw):
    """Choose the dependent columns of D by elimination with complete pivoting."""
    for k in range(2):
        w[DENSE + k] = 0.0
    expand(p, w)
    for j in range(2):
        w[DEPENDENT + j] = 0.0
    for i in range(1):  # rows of unequal size must not decide
        total = 0.0
        for j in range(2):
            total += w[DENSE + 2 * i + j] ** 2
        for j in range(2):
            w[DENSE + 2 * i + j] /= math.sqrt(total)
    for step in range(1):
        largest, row, column = 0.0, -1, -1
        for i in range(step, 1):
            for j in range(2):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 2 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 2 * i + j]), i, j
        if largest < 1e-6:  # the square root of the threshold at which D D^T skips a row
            break
        w[DEPENDENT + column] = 1.0
        for j in range(2):
            a, b = DENSE + 2 * step + j, DENSE + 2 * row + j
            w[a], w[b] = w[b], w[a]
        for i in range(step + 1, 1):
            factor = w[DENSE + 2 * i + column] / w[DENSE + 2 * step + column]
            if factor != 0.0:
                for j in range(2):
                    w[DENSE + 2 * i + j] -= factor * w[DENSE + 2 * step + j]
    iw[7] += 1
    return 0



@njit(error_model="numpy", fastmath={"contract"})
def close(t, y, p, w, iw):
    """Dependent coordinates from Phi = 0 and dependent velocities from D v = nu, the independent ones kept."""
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
    return bits


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state, whose dependent part is closed first."""
    close(t, y, p, w, iw)
    return accelerate(t, y, p, w, iw, ydot)


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Close an accepted state, choose another partition where this one has become poor, and measure."""
    if iw[5] == 0:
        geometry(t, y, p, w)
        current = w[10]
        if iw[7] == 0 or current < 0.1 * w[11]:
            choose(p, w, iw)
            geometry(t, y, p, w)
            w[11] = w[10]
    bits = close(t, y, p, w, iw)
    measure(t, y, p, w)
    return bits
