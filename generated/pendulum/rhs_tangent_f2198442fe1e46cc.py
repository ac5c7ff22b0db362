"""Right-hand side, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry, spread

CHANGE = 25  # sections of w
GAUGE = 29
DEPENDENT = 35
DENSE = 37
BASIS = 39
TRIAL = 43
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
    """the section `residual` = -gamma, the section `force` = f: 3 operations, 3 before sharing."""
    # inputs
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]  # -9.81*bob_mass
    # outputs
    w[22] = v0*v0 + v1*v1  # link.distance
    w[53] = 0.0
    w[54] = p3
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def strike(w):
    """the section `residual` = D times `change`: 3 operations, 3 before sharing."""
    # inputs
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    change_0 = w[25]  # bob.vx
    change_1 = w[26]  # bob.vy
    # outputs
    w[22] = jacobian_0*change_0 + jacobian_1*change_1  # link.distance
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
    """q', power and multipliers: 8 operations, 8 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p4 = p[4]  # 9.81*bob_mass
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    reciprocal_0 = w[34]
    ydot_2 = ydot[2]  # rate of bob.vx
    ydot_3 = ydot[3]  # rate of bob.vy
    # outputs
    ydot[0] = v0  # rate of bob.x
    ydot[1] = v1  # rate of bob.y
    w[19] = -reciprocal_0*(jacobian_0*(p0*ydot_2) + jacobian_1*(p4 + p0*ydot_3))  # link.distance
    ydot[4] = 0.0  # rate of work
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
            w[DENSE + 2 * i + j] *= math.sqrt(w[GAUGE + j])
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
def project(p, w, iw):
    """Basis of the tangent space at the D that `geometry` left: trial = (1 - D^+ D) basis, column by column."""
    for c in range(iw[8]):
        for j in range(2):
            w[CHANGE + j] = w[BASIS + 2 * c + j]
        strike(w)
        spread(p, w)
        for j in range(2):
            w[TRIAL + 2 * c + j] = w[BASIS + 2 * c + j] + w[CHANGE + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state: v' = b + R z' with D R = 0, D b = gamma and R^T M R z' = R^T (f - M b)."""
    geometry(t, y, p, w)
    aim(t, y, p, w)
    spread(p, w)
    weigh(p, w)
    for j in range(2):
        ydot[2 + j] = w[CHANGE + j]
        w[FORCE + j] -= w[WEIGHED + j]
    degrees = iw[8]
    project(p, w, iw)
    for c in range(degrees):  # lower triangle of the mass matrix over a basis, and the right-hand side behind it
        for j in range(2):
            w[CHANGE + j] = w[TRIAL + 2 * c + j]
        weigh(p, w)
        for r in range(c, degrees):
            total = 0.0
            for j in range(2):
                total += w[TRIAL + 2 * r + j] * w[WEIGHED + j]
            w[SMALL + 2 * r + c] = total
        total = 0.0
        for j in range(2):
            total += w[TRIAL + 2 * c + j] * w[FORCE + j]
        w[REDUCED + c] = total
    for c in range(degrees):  # L D L^T in place
        for r in range(c + 1, degrees):
            factor = w[SMALL + 2 * r + c] / w[SMALL + 2 * c + c]
            for k in range(r, degrees):
                w[SMALL + 2 * k + r] -= factor * w[SMALL + 2 * k + c]
            w[REDUCED + r] -= factor * w[REDUCED + c]
    for c in range(degrees - 1, -1, -1):
        total = w[REDUCED + c]
        for r in range(c + 1, degrees):
            total -= w[SMALL + 2 * r + c] * w[REDUCED + r]
        w[REDUCED + c] = total / w[SMALL + 2 * c + c]
        for j in range(2):
            ydot[2 + j] += w[REDUCED + c] * w[TRIAL + 2 * c + j]
    finish(t, y, p, w, ydot)
    return 0
