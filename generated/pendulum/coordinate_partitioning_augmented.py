"""Method `coordinate-partitioning` for model `pendulum`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
option solver = augmented
p[3] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

CHANGE = 21  # sections of w
MASS = 23
DEPENDENT = 38
DENSE = 40


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
    """one iteration of coordinate-partitioning: 36 operations, 359 before sharing."""
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
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
    jacobian_0 = w[25]
    jacobian_1 = w[26]
    # outputs
    w[40] = jacobian_0
    w[41] = jacobian_1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D P D^T: 18 operations, 43 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    dependent_0 = w[38]
    dependent_1 = w[39]
    # intermediate terms
    s0 = q0*q0 + q1*q1
    s1 = 0.5*(s0 - 1.0)
    s2 = 1.0/s0
    s3 = q0*(q0*dependent_0) + q1*(q1*dependent_1)
    # outputs
    w[18] = s1
    w[0] = math.sqrt(s1*s1)
    w[25] = q0
    w[26] = q1
    w[5] = 1.0
    w[4] = 1.0
    w[10] = s2*s3 + 1.0 - s0*s2
    w[42] = 1.0/s3
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 7 operations, 8 before sharing."""
    # inputs
    jacobian_0 = w[25]
    jacobian_1 = w[26]
    dependent_0 = w[38]
    dependent_1 = w[39]
    law_reciprocal_0 = w[42]
    residual_0 = w[18]
    # intermediate terms
    s0 = law_reciprocal_0*residual_0
    # outputs
    w[21] = -dependent_0*(jacobian_0*s0)
    w[22] = -dependent_1*(jacobian_1*s0)
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
def reduce(w, step, column):
    """Make a column of the dense D a unit vector with its 1 in row `step` (Gauss, Jordan)."""
    pivot = w[DENSE + 2 * step + column]
    for j in range(2):
        w[DENSE + 2 * step + j] /= pivot
    for i in range(1):
        factor = w[DENSE + 2 * i + column]
        if i != step and factor != 0.0:
            for j in range(2):
                w[DENSE + 2 * i + j] -= factor * w[DENSE + 2 * step + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def choose(p, w, iw):
    """Choose the dependent columns of D: by complete pivoting, then by exchange while that enlarges their determinant."""
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
    rank = 0
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
        reduce(w, step, column)
        rank += 1
    # what is left in the other columns is how fast dependent coordinates follow independent ones, with the sign changed
    for exchange in range(2):
        largest, row, column = 1.01, -1, -1
        for i in range(rank):
            for j in range(2):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 2 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 2 * i + j]), i, j
        if row < 0:
            break
        for j in range(2):
            if w[DEPENDENT + j] == 1.0 and w[DENSE + 2 * row + j] != 0.0:
                w[DEPENDENT + j] = 0.0
        w[DEPENDENT + column] = 1.0
        reduce(w, row, column)
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
def release(w):
    """Make all coordinates dependent, weighted by M^-1: near a singular position no partition determines the motion."""
    largest = 0.0
    for j in range(2):
        largest = max(largest, w[MASS + j])
    for j in range(2):
        w[DEPENDENT + j] = 1.0 / max(w[MASS + j], 1e-6 * largest)  # massless bodies give way, within reason
    w[11] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Close an accepted state, choose another partition where this one has become poor, and measure."""
    poor = False
    if iw[5] == 0:
        geometry(t, y, p, w)
        # the root of the smallest pivot is the sine of an angle: it says whether the next step meets a singular position
        sine = math.sqrt(max(w[4], 0.0))
        fall = max(w[13] - sine, 0.0)
        w[13] = sine
        first = iw[7] == 0
        released = w[11] == 0.0 and not first
        if sine - fall < 0.01:
            if not released:
                release(w)
                iw[7] += 1
        else:
            quality = w[10]
            w[11] = max(w[11], quality)
            ahead = quality - max(w[12] - quality, 0.0)
            poor = released or ahead < 0.3 * w[11]
            w[12] = quality
            if first:
                choose(p, w, iw)
                geometry(t, y, p, w)
                w[11] = w[10]
    bits = close(t, y, p, w, iw)
    if poor:  # after closing: the partition that was integrated with is better for it than one from a singular position
        choose(p, w, iw)
        geometry(t, y, p, w)
        w[11] = w[10]
        w[12] = w[10]
    measure(t, y, p, w)
    return bits
