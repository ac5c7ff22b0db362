"""Right-hand side, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry

MULTIPLIERS = 19  # sections of w
MASK = 20
RESIDUAL = 22
CHANGE = 25
GAUGE = 29
DENSE = 37
ROW_LENGTH = 39
ROW_CHOSEN = 40
ROW_CORNER = 41
ROW_FACTOR = 42
BASIS = 43
SMALL = 47
REDUCED = 51
FORCE = 53
WEIGHED = 55


@njit(error_model="numpy", fastmath={"contract"})
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    # outputs
    w[37] = jacobian_0
    w[38] = jacobian_1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def aim(t, y, p, w):
    """the section `residual` = what D v' shall be, `force` = f: 4 operations, 4 before sharing."""
    # inputs
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]  # -9.81*bob_mass
    # outputs
    w[22] = -(v0*v0 + v1*v1)  # link.distance
    w[53] = 0.0
    w[54] = p3
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def weigh(p, w):
    """the section `weighed` = M times `change`: 2 operations, 2 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    change_0 = w[25]  # bob.vx
    change_1 = w[26]  # bob.vy
    # outputs
    w[55] = p0*change_0
    w[56] = p0*change_1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """q' and power: 0 operations, 0 before sharing."""
    # inputs
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    # outputs
    ydot[0] = v0  # rate of bob.x
    ydot[1] = v1  # rate of bob.y
    ydot[4] = 0.0  # rate of work
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
    """Q R of (D G^1/2)^T by Householder's reflections with pivoting, rows scaled to length 1; return the rank.

    Row i of the section `dense` holds, in the order chosen, R above the diagonal and then the reflection.
    """
    for k in range(2):
        w[DENSE + k] = 0.0
    expand(p, w)
    rows = 0
    for i in range(1):
        total = 0.0
        for j in range(2):
            w[DENSE + 2 * i + j] *= math.sqrt(w[GAUGE + j])
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
def rhs(t, y, p, w, iw, ydot):
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
    for j in range(2):
        w[CHANGE + j] *= math.sqrt(w[GAUGE + j])
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
        for j in range(2):
            w[BASIS + 2 * c + j] *= math.sqrt(w[GAUGE + j])
    for c in range(degrees):  # lower triangle of the mass matrix over a basis, and the right-hand side behind it
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
    for j in range(2):
        w[FORCE + j] *= math.sqrt(w[GAUGE + j])
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
