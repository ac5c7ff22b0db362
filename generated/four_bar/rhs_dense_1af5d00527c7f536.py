"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry

MULTIPLIERS = 19  # sections of w
MASK = 27
RESIDUAL = 43
CHANGE = 67
GAUGE = 85
DENSE = 147
ROW_LENGTH = 219
ROW_CHOSEN = 227
ROW_CORNER = 235
ROW_FACTOR = 243
BASIS = 251
SMALL = 332
REDUCED = 413
FORCE = 422
WEIGHED = 431


@njit(error_model="numpy", fastmath={"contract"})
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
    jacobian_0 = w[102]  # D A.x, crank.omega
    jacobian_1 = w[103]  # D A.y, crank.omega
    jacobian_2 = w[104]  # D B.x, crank.omega
    jacobian_3 = w[105]  # D B.x, coupler.omega
    jacobian_4 = w[106]  # D B.y, crank.omega
    jacobian_5 = w[107]  # D B.y, coupler.omega
    jacobian_6 = w[108]  # D C.x, coupler.omega
    jacobian_7 = w[109]  # D C.x, rocker.omega
    jacobian_8 = w[110]  # D C.y, coupler.omega
    jacobian_9 = w[111]  # D C.y, rocker.omega
    jacobian_10 = w[112]  # D D.x, rocker.omega
    jacobian_11 = w[113]  # D D.y, rocker.omega
    # outputs
    w[147] = 1.0
    w[149] = jacobian_0
    w[157] = 1.0
    w[158] = jacobian_1
    w[165] = -1.0
    w[167] = jacobian_2
    w[168] = 1.0
    w[170] = jacobian_3
    w[175] = -1.0
    w[176] = jacobian_4
    w[178] = 1.0
    w[179] = jacobian_5
    w[186] = -1.0
    w[188] = jacobian_6
    w[189] = 1.0
    w[191] = jacobian_7
    w[196] = -1.0
    w[197] = jacobian_8
    w[199] = 1.0
    w[200] = jacobian_9
    w[207] = 1.0
    w[209] = jacobian_10
    w[217] = 1.0
    w[218] = jacobian_11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def aim(t, y, p, w):
    """the section `residual` = what D v' shall be, `force` = f: 107 operations, 259 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p15 = p[15]  # -9.81*crank_mass
    p16 = p[16]  # -9.81*coupler_mass
    p17 = p[17]  # -9.81*rocker_mass
    p21 = p[21]  # gain
    p22 = p[22]  # a
    status_12 = w[12]  # step
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = s0*s2
    s4 = s1*s2
    s5 = math.cos(q5)
    s6 = math.sin(q5)
    s7 = 4.0*s5
    s8 = 4.0*s6
    s9 = 4.0*(v5*v5)
    s10 = s5*s9
    s11 = s6*s9
    s12 = math.cos(q8)
    s13 = math.sin(q8)
    s14 = 2.5*s12
    s15 = 2.5*s13
    s16 = 2.5*(v8*v8)
    s17 = s12*s16
    s18 = s13*s16
    s19 = min(p21, p22*(1.0/status_12))
    s20 = v2*s1
    s21 = v2*s0
    s22 = v5*s8
    s23 = v5*s7
    s24 = v8*s15
    s25 = v8*s14
    s26 = 2.0*s19
    s27 = s19*s19
    # outputs
    w[43] = -(s3 + (v0 + s20)*s26 + (q0 - s0)*s27)  # A.x
    w[44] = -(s4 + (v1 - s21)*s26 + (q1 - s1)*s27)  # A.y
    w[45] = -(s3 + s10 + (v3 + s20 - v0 + s22)*s26 + (q3 - q0 - s7 - s0)*s27)  # B.x
    w[46] = -(s4 + s11 + (v4 - (v1 + s21) - s23)*s26 + (q4 - q1 - s8 - s1)*s27)  # B.y
    w[47] = s17 - s10 - (v6 + s22 - v3 - s24)*s26 - (q6 - q3 + s14 - s7)*s27  # C.x
    w[48] = s18 - s11 - (v7 - (v4 + s23) + s25)*s26 - (q7 - q4 + s15 - s8)*s27  # C.y
    w[49] = -(s17 + (v6 + s24)*s26 + (q6 - 10.0 - s14)*s27)  # D.x
    w[50] = -(s18 + (v7 - s25)*s26 + (q7 - s15)*s27)  # D.y
    w[422] = 0.0
    w[423] = p15
    w[424] = 0.0
    w[425] = 0.0
    w[426] = p16
    w[427] = 0.0
    w[428] = 0.0
    w[429] = p17
    w[430] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def weigh(p, w):
    """the section `weighed` = M times `change`: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p18 = p[18]  # 0.3333333333333333*crank_mass
    p19 = p[19]  # 5.333333333333333*coupler_mass
    p20 = p[20]  # 2.083333333333333*rocker_mass
    change_0 = w[67]  # crank.vx
    change_1 = w[68]  # crank.vy
    change_2 = w[69]  # crank.omega
    change_3 = w[70]  # coupler.vx
    change_4 = w[71]  # coupler.vy
    change_5 = w[72]  # coupler.omega
    change_6 = w[73]  # rocker.vx
    change_7 = w[74]  # rocker.vy
    change_8 = w[75]  # rocker.omega
    # outputs
    w[431] = p0*change_0
    w[432] = p0*change_1
    w[433] = p18*change_2
    w[434] = p1*change_3
    w[435] = p1*change_4
    w[436] = p19*change_5
    w[437] = p2*change_6
    w[438] = p2*change_7
    w[439] = p20*change_8
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
    ydot[0] = v0  # rate of crank.x
    ydot[1] = v1  # rate of crank.y
    ydot[2] = v2  # rate of crank.theta
    ydot[3] = v3  # rate of coupler.x
    ydot[4] = v4  # rate of coupler.y
    ydot[5] = v5  # rate of coupler.theta
    ydot[6] = v6  # rate of rocker.x
    ydot[7] = v7  # rate of rocker.y
    ydot[8] = v8  # rate of rocker.theta
    ydot[18] = 0.0  # rate of work
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
    """Q R of (D G^1/2)^T by Householder's reflections with pivoting, rows scaled to length 1; return the rank.

    Row i of the section `dense` holds, in the order chosen, R above the diagonal and then the reflection.
    """
    for k in range(72):
        w[DENSE + k] = 0.0
    expand(p, w)
    rows = 0
    for i in range(8):
        total = 0.0
        for j in range(9):
            w[DENSE + 9 * i + j] *= math.sqrt(w[GAUGE + j])
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
    for j in range(9):
        w[CHANGE + j] *= math.sqrt(w[GAUGE + j])
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
        for j in range(9):
            w[BASIS + 9 * c + j] *= math.sqrt(w[GAUGE + j])
    for c in range(degrees):  # lower triangle of the mass matrix over a basis, and the right-hand side behind it
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
    for j in range(9):
        w[FORCE + j] *= math.sqrt(w[GAUGE + j])
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
