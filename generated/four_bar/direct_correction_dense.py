"""Method `direct-correction` for model `four-bar`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = dense
option weight = identity
p[15] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import geometry, measure, spread

MULTIPLIERS = 15  # sections of w
MASK = 23
RESIDUAL = 39
CHANGE = 63
DENSE = 126
ROW_LENGTH = 198
ROW_CHOSEN = 206
ROW_CORNER = 214
ROW_FACTOR = 222
BASIS = 230
SMALL = 311
REDUCED = 392
FORCE = 401
WEIGHED = 410


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # outputs
    p[16] = -9.81*p0
    p[17] = -9.81*p1
    p[18] = -9.81*p2
    p[19] = 0.3333333333333333*p0
    p[20] = 5.333333333333333*p1
    p[21] = 2.083333333333333*p2
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    jacobian_8 = w[89]
    jacobian_9 = w[90]
    jacobian_10 = w[91]
    jacobian_11 = w[92]
    # outputs
    w[126] = 1.0
    w[128] = jacobian_0
    w[136] = 1.0
    w[137] = jacobian_1
    w[144] = -1.0
    w[146] = jacobian_2
    w[147] = 1.0
    w[149] = jacobian_3
    w[154] = -1.0
    w[155] = jacobian_4
    w[157] = 1.0
    w[158] = jacobian_5
    w[165] = -1.0
    w[167] = jacobian_6
    w[168] = 1.0
    w[170] = jacobian_7
    w[175] = -1.0
    w[176] = jacobian_8
    w[178] = 1.0
    w[179] = jacobian_9
    w[186] = 1.0
    w[188] = jacobian_10
    w[196] = 1.0
    w[197] = jacobian_11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def aim(t, y, p, w):
    """the section `residual` = what D v' shall be, `force` = f: 27 operations, 54 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    # intermediate terms
    s0 = v2*v2
    s1 = math.cos(q2)*s0
    s2 = math.sin(q2)*s0
    s3 = 4.0*(v5*v5)
    s4 = math.cos(q5)*s3
    s5 = math.sin(q5)*s3
    s6 = 2.5*(v8*v8)
    s7 = math.cos(q8)*s6
    s8 = math.sin(q8)*s6
    # outputs
    w[39] = -s1
    w[40] = -s2
    w[41] = -(s1 + s4)
    w[42] = -(s2 + s5)
    w[43] = s7 - s4
    w[44] = s8 - s5
    w[45] = -s7
    w[46] = -s8
    w[401] = 0.0
    w[402] = p16
    w[403] = 0.0
    w[404] = 0.0
    w[405] = p17
    w[406] = 0.0
    w[407] = 0.0
    w[408] = p18
    w[409] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def weigh(p, w):
    """the section `weighed` = M times `change`: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    change_0 = w[63]
    change_1 = w[64]
    change_2 = w[65]
    change_3 = w[66]
    change_4 = w[67]
    change_5 = w[68]
    change_6 = w[69]
    change_7 = w[70]
    change_8 = w[71]
    # outputs
    w[410] = p0*change_0
    w[411] = p0*change_1
    w[412] = p19*change_2
    w[413] = p1*change_3
    w[414] = p1*change_4
    w[415] = p20*change_5
    w[416] = p2*change_6
    w[417] = p2*change_7
    w[418] = p21*change_8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """q' and power: 0 operations, 0 before sharing."""
    # inputs
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = v2
    ydot[3] = v3
    ydot[4] = v4
    ydot[5] = v5
    ydot[6] = v6
    ydot[7] = v7
    ydot[8] = v8
    ydot[18] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def reflect(w, k, section):
    """Apply reflection `k` to the vector of a section of w."""
    total = 0.0
    for j in range(k, 9):
        total += w[DENSE + 9 * k + j] * w[section + j]
    total *= w[ROW_FACTOR + k]
    for j in range(k, 9):
        w[section + j] -= total * w[DENSE + 9 * k + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def factorise(p, w):
    """Q R of D^T by Householder's reflections with pivoting, rows of D scaled to length 1; return the rank.

    Row i of the section `dense` holds, in the order chosen, R above the diagonal and then the reflection.
    """
    for k in range(72):
        w[DENSE + k] = 0.0
    expand(p, w)
    rows = 0
    for i in range(8):
        total = 0.0
        for j in range(9):
            total += w[DENSE + 9 * i + j] ** 2
        w[ROW_LENGTH + i] = math.sqrt(total)
        if w[MASK + i] > 0.0 or total == 0.0:  # permanently redundant rows are left out, here as elsewhere
            continue
        for j in range(9):
            w[DENSE + 9 * rows + j] = w[DENSE + 9 * i + j] / w[ROW_LENGTH + i]
        w[ROW_CHOSEN + rows] = i
        rows += 1
    for k in range(min(rows, 9)):
        largest, best = 0.0, k
        for i in range(k, rows):
            total = 0.0
            for j in range(k, 9):
                total += w[DENSE + 9 * i + j] ** 2
            if total > largest:
                largest, best = total, i
        if largest < 1e-12:
            return k
        for j in range(9):
            a, b = DENSE + 9 * k + j, DENSE + 9 * best + j
            w[a], w[b] = w[b], w[a]
        w[ROW_CHOSEN + k], w[ROW_CHOSEN + best] = w[ROW_CHOSEN + best], w[ROW_CHOSEN + k]
        first = w[DENSE + 9 * k + k]
        corner = -math.copysign(math.sqrt(largest), first)
        w[ROW_CORNER + k] = corner
        w[DENSE + 9 * k + k] = first - corner
        w[ROW_FACTOR + k] = 1.0 / (largest - corner * first)
        for i in range(k + 1, rows):
            reflect(w, k, DENSE + 9 * i)
    return min(rows, 9)


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state: v' = b + Z z with D b = g, D Z = 0 and Z^T M Z z = Z^T (f - M b), from Q R of D^T."""
    geometry(t, y, p, w)
    aim(t, y, p, w)
    rank = factorise(p, w)
    if iw[9] == 0 or rank < iw[10]:
        iw[10] = rank
    iw[9] += 1
    degrees = 9 - rank
    # b = Q (z, 0) with R^T z = g
    for j in range(9):
        w[CHANGE + j] = 0.0
    for i in range(rank):
        row = int(w[ROW_CHOSEN + i])
        total = w[RESIDUAL + row] / w[ROW_LENGTH + row]
        for j in range(i):
            total -= w[DENSE + 9 * i + j] * w[CHANGE + j]
        w[CHANGE + i] = total / w[ROW_CORNER + i]
    for k in range(rank - 1, -1, -1):
        reflect(w, k, CHANGE)
    weigh(p, w)
    for j in range(9):
        ydot[9 + j] = w[CHANGE + j]
        w[FORCE + j] -= w[WEIGHED + j]
    # the columns of Q behind the rank are a basis Z of the tangent space
    for c in range(degrees):
        for j in range(9):
            w[BASIS + 9 * c + j] = 1.0 if j == rank + c else 0.0
        for k in range(rank - 1, -1, -1):
            reflect(w, k, BASIS + 9 * c)
    for c in range(degrees):
        for j in range(9):
            w[CHANGE + j] = w[BASIS + 9 * c + j]
        weigh(p, w)
        for r in range(c, degrees):
            total = 0.0
            for j in range(9):
                total += w[BASIS + 9 * r + j] * w[WEIGHED + j]
            w[SMALL + 9 * r + c] = total
        total = 0.0
        for j in range(9):
            total += w[BASIS + 9 * c + j] * w[FORCE + j]
        w[REDUCED + c] = total
    largest = 0.0
    for c in range(degrees):
        largest = max(largest, w[SMALL + 9 * c + c])
    for c in range(degrees):  # L D L^T in place; a direction without mass gets no acceleration
        pivot = w[SMALL + 9 * c + c]
        if not pivot > 1e-15 * largest:
            w[SMALL + 9 * c + c] = math.inf
            continue
        for r in range(c + 1, degrees):
            factor = w[SMALL + 9 * r + c] / pivot
            for k in range(r, degrees):
                w[SMALL + 9 * k + r] -= factor * w[SMALL + 9 * k + c]
            w[REDUCED + r] -= factor * w[REDUCED + c]
    for c in range(degrees - 1, -1, -1):
        total = w[REDUCED + c]
        for r in range(c + 1, degrees):
            total -= w[SMALL + 9 * r + c] * w[REDUCED + r]
        w[REDUCED + c] = total / w[SMALL + 9 * c + c]
        for j in range(9):
            ydot[9 + j] += w[REDUCED + c] * w[BASIS + 9 * c + j]
            w[CHANGE + j] = w[BASIS + 9 * c + j]
        weigh(p, w)
        for j in range(9):
            w[FORCE + j] -= w[REDUCED + c] * w[WEIGHED + j]
    # D^T lambda = f - M v', which the section `force` holds by now
    for k in range(rank):
        reflect(w, k, FORCE)
    for i in range(8):
        w[MULTIPLIERS + i] = 0.0
    for i in range(rank - 1, -1, -1):
        row = int(w[ROW_CHOSEN + i])
        scaled = w[FORCE + i] / w[ROW_CORNER + i]
        for j in range(i):
            w[FORCE + j] -= w[DENSE + 9 * i + j] * scaled
        w[MULTIPLIERS + row] = scaled / w[ROW_LENGTH + row]
    finish(t, y, p, w, ydot)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[15] * w[6]
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
            for j in range(9, 18):
                y[j] += w[CHANGE - 9 + j]
            break
        for j in range(9):
            y[j] += w[CHANGE + j]
        last = violation
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    measure(t, y, p, w)
    return bits
