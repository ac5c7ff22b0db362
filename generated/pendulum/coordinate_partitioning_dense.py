"""Method `coordinate-partitioning` for model `pendulum`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
option solver = dense
p[3] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MULTIPLIERS = 15  # sections of w
MASK = 16
RESIDUAL = 18
CHANGE = 21
MASS = 23
DEPENDENT = 28
DENSE = 30
ROW_LENGTH = 32
ROW_CHOSEN = 33
ROW_CORNER = 34
ROW_FACTOR = 35
BASIS = 36
SMALL = 40
REDUCED = 44
FORCE = 46
WEIGHED = 48


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 2 operations, 2 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # outputs
    p[4] = -9.81*p0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
    jacobian_0 = w[25]
    jacobian_1 = w[26]
    # outputs
    w[30] = jacobian_0
    w[31] = jacobian_1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def aim(t, y, p, w):
    """the section `residual` = what D v' shall be, `force` = f: 4 operations, 4 before sharing."""
    # inputs
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p4 = p[4]
    # outputs
    w[18] = -(v0*v0 + v1*v1)
    w[46] = 0.0
    w[47] = p4
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def weigh(p, w):
    """the section `weighed` = M times `change`: 2 operations, 2 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    change_0 = w[21]
    change_1 = w[22]
    # outputs
    w[48] = p0*change_0
    w[49] = p0*change_1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """q' and power: 0 operations, 0 before sharing."""
    # inputs
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[4] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D P D^T: 18 operations, 43 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    dependent_0 = w[28]
    dependent_1 = w[29]
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
    w[50] = 1.0/s3
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 7 operations, 8 before sharing."""
    # inputs
    jacobian_0 = w[25]
    jacobian_1 = w[26]
    dependent_0 = w[28]
    dependent_1 = w[29]
    law_reciprocal_0 = w[50]
    residual_0 = w[18]
    # intermediate terms
    s0 = law_reciprocal_0*residual_0
    # outputs
    w[21] = -dependent_0*(jacobian_0*s0)
    w[22] = -dependent_1*(jacobian_1*s0)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def reflect(w, k, section):
    """Apply reflection `k` to the vector of a section of w."""
    total = 0.0
    for j in range(k, 2):
        total += w[DENSE + 2 * k + j] * w[section + j]
    total *= w[ROW_FACTOR + k]
    for j in range(k, 2):
        w[section + j] -= total * w[DENSE + 2 * k + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def factorise(p, w):
    """Q R of D^T by Householder's reflections with pivoting, rows of D scaled to length 1; return the rank.

    Row i of the section `dense` holds, in the order chosen, R above the diagonal and then the reflection.
    """
    for k in range(2):
        w[DENSE + k] = 0.0
    expand(p, w)
    rows = 0
    for i in range(1):
        total = 0.0
        for j in range(2):
            total += w[DENSE + 2 * i + j] ** 2
        w[ROW_LENGTH + i] = math.sqrt(total)
        if w[MASK + i] > 0.0 or total == 0.0:  # permanently redundant rows are left out, here as elsewhere
            continue
        for j in range(2):
            w[DENSE + 2 * rows + j] = w[DENSE + 2 * i + j] / w[ROW_LENGTH + i]
        w[ROW_CHOSEN + rows] = i
        rows += 1
    for k in range(min(rows, 2)):
        largest, best = 0.0, k
        for i in range(k, rows):
            total = 0.0
            for j in range(k, 2):
                total += w[DENSE + 2 * i + j] ** 2
            if total > largest:
                largest, best = total, i
        if largest < 1e-12:
            return k
        for j in range(2):
            a, b = DENSE + 2 * k + j, DENSE + 2 * best + j
            w[a], w[b] = w[b], w[a]
        w[ROW_CHOSEN + k], w[ROW_CHOSEN + best] = w[ROW_CHOSEN + best], w[ROW_CHOSEN + k]
        first = w[DENSE + 2 * k + k]
        corner = -math.copysign(math.sqrt(largest), first)
        w[ROW_CORNER + k] = corner
        w[DENSE + 2 * k + k] = first - corner
        w[ROW_FACTOR + k] = 1.0 / (largest - corner * first)
        for i in range(k + 1, rows):
            reflect(w, k, DENSE + 2 * i)
    return min(rows, 2)


@njit(error_model="numpy", fastmath={"contract"})
def accelerate(t, y, p, w, iw, ydot):
    """Rates of the state: v' = b + Z z with D b = g, D Z = 0 and Z^T M Z z = Z^T (f - M b), from Q R of D^T."""
    geometry(t, y, p, w)
    aim(t, y, p, w)
    rank = factorise(p, w)
    if iw[9] == 0 or rank < iw[10]:
        iw[10] = rank
    iw[9] += 1
    degrees = 2 - rank
    # b = Q (z, 0) with R^T z = g
    for j in range(2):
        w[CHANGE + j] = 0.0
    for i in range(rank):
        row = int(w[ROW_CHOSEN + i])
        total = w[RESIDUAL + row] / w[ROW_LENGTH + row]
        for j in range(i):
            total -= w[DENSE + 2 * i + j] * w[CHANGE + j]
        w[CHANGE + i] = total / w[ROW_CORNER + i]
    for k in range(rank - 1, -1, -1):
        reflect(w, k, CHANGE)
    weigh(p, w)
    for j in range(2):
        ydot[2 + j] = w[CHANGE + j]
        w[FORCE + j] -= w[WEIGHED + j]
    # the columns of Q behind the rank are a basis Z of the tangent space
    for c in range(degrees):
        for j in range(2):
            w[BASIS + 2 * c + j] = 1.0 if j == rank + c else 0.0
        for k in range(rank - 1, -1, -1):
            reflect(w, k, BASIS + 2 * c)
    for c in range(degrees):
        for j in range(2):
            w[CHANGE + j] = w[BASIS + 2 * c + j]
        weigh(p, w)
        for r in range(c, degrees):
            total = 0.0
            for j in range(2):
                total += w[BASIS + 2 * r + j] * w[WEIGHED + j]
            w[SMALL + 2 * r + c] = total
        total = 0.0
        for j in range(2):
            total += w[BASIS + 2 * c + j] * w[FORCE + j]
        w[REDUCED + c] = total
    largest = 0.0
    for c in range(degrees):
        largest = max(largest, w[SMALL + 2 * c + c])
    for c in range(degrees):  # L D L^T in place; a direction without mass gets no acceleration
        pivot = w[SMALL + 2 * c + c]
        if not pivot > 1e-15 * largest:
            w[SMALL + 2 * c + c] = math.inf
            continue
        for r in range(c + 1, degrees):
            factor = w[SMALL + 2 * r + c] / pivot
            for k in range(r, degrees):
                w[SMALL + 2 * k + r] -= factor * w[SMALL + 2 * k + c]
            w[REDUCED + r] -= factor * w[REDUCED + c]
    for c in range(degrees - 1, -1, -1):
        total = w[REDUCED + c]
        for r in range(c + 1, degrees):
            total -= w[SMALL + 2 * r + c] * w[REDUCED + r]
        w[REDUCED + c] = total / w[SMALL + 2 * c + c]
        for j in range(2):
            ydot[2 + j] += w[REDUCED + c] * w[BASIS + 2 * c + j]
            w[CHANGE + j] = w[BASIS + 2 * c + j]
        weigh(p, w)
        for j in range(2):
            w[FORCE + j] -= w[REDUCED + c] * w[WEIGHED + j]
    # D^T lambda = f - M v', which the section `force` holds by now
    for k in range(rank):
        reflect(w, k, FORCE)
    for i in range(1):
        w[MULTIPLIERS + i] = 0.0
    for i in range(rank - 1, -1, -1):
        row = int(w[ROW_CHOSEN + i])
        scaled = w[FORCE + i] / w[ROW_CORNER + i]
        for j in range(i):
            w[FORCE + j] -= w[DENSE + 2 * i + j] * scaled
        w[MULTIPLIERS + row] = scaled / w[ROW_LENGTH + row]
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
