"""Method `null-space` for model `four-bar`. Emitted by symgen; do not edit.

Accelerations in a tangent basis that is carried on from step to step.
Mani, Haug, Atkinson, J. Mech. Trans. Autom. Des. 107 (1985) 82-87
Singh, Likins, J. Appl. Mech. 52 (1985) 943-948
Kim, Vanderploeg, J. Mech. Trans. Autom. Des. 108 (1986) 183-188
Blajer, Comput. Methods Appl. Mech. Eng. 121 (1995) 45-57
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a1bfe8da2fcb1eac
p[24] tolerance (default 1e-13)

Constraints Phi(q, t) = 0, their rates D v = nu and D v' = gamma; M v' = f - D^T lambda; S = D M^-1 D^T.

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and counters iw. Once: `prepare` of the
model, `prepare`, and `accept` with the start. Then `rhs` gives the rate of a state, `confirm` where `rhs` returns 1,
and `accept` corrects and measures the state at the end of each step.

y[0]     crank.x [m]
y[1]     crank.y [m]
y[2]     crank.theta [rad]
y[3]     coupler.x [m]
y[4]     coupler.y [m]
y[5]     coupler.theta [rad]
y[6]     rocker.x [m]
y[7]     rocker.y [m]
y[8]     rocker.theta [rad]
y[9]     crank.vx [m/s]
y[10]    crank.vy [m/s]
y[11]    crank.omega [rad/s]
y[12]    coupler.vx [m/s]
y[13]    coupler.vy [m/s]
y[14]    coupler.omega [rad/s]
y[15]    rocker.vx [m/s]
y[16]    rocker.vy [m/s]
y[17]    rocker.omega [rad/s]
y[18]    work of forces without potential and of drivers [J]
p[0]     crank_mass [kg]
p[1]     coupler_mass [kg]
p[2]     rocker_mass [kg]
p[3:15]  numbers computed by the model's `prepare`
p[15:24] numbers computed by `prepare`
row 0    A.x [m]
row 1    A.y [m]
row 2    B.x [m]
row 3    B.y [m]
row 4    C.x [m]
row 5    C.y [m]
row 6    D.x [m]
row 7    D.y [m]

w[0:19]     status: single numbers, named in this module where it uses them
w[19:27]    multipliers: Lagrange multipliers, one a row
w[27:35]    mask: inf at rows that depend on others, else 0
w[35:43]    saved: `mask` while `confirm` leaves out further rows
w[43:51]    residual: Phi after `geometry`, D v - nu after `measure`
w[51:59]    nu: right-hand side of D v = nu
w[59:67]    pivot: pivots of D G D^T over its diagonal: near 0 a row depends on others
w[67:76]    change: correction of velocities, or of positions, that `spread` leaves
w[76:85]    mass: diagonal of M
w[85:94]    gauge: diagonal of G, the metric in which rank is decided: 1, or 1/l^2 for a rotation of a body of length l
w[94:102]   row_weight: factors that make rows of different units comparable
w[102:114]  jacobian: entries of D that are not constant
w[114:123]  dependent: 1 at dependent velocities, else 0
w[123:195]  dense: a dense matrix, row by row
w[195:258]  basis: directions of motion that constraints allow
w[258:321]  trial: `basis` before its columns are orthogonal
w[321:370]  small: M in these directions
w[370:377]  reduced: forces, then accelerations in these directions
w[377:386]  force: forces, one a velocity
w[386:395]  weighed: M times a direction or an acceleration
"""

import math

from numba import njit

from model import geometry, measure, spread

MULTIPLIERS = 19  # sections of w
MASK = 27
RESIDUAL = 43
PIVOT = 59
CHANGE = 67
GAUGE = 85
JACOBIAN = 102
DEPENDENT = 114
DENSE = 123
BASIS = 195
TRIAL = 258
SMALL = 321
REDUCED = 370
FORCE = 377
WEIGHED = 386
SMALLEST_PIVOT = 4  # numbers in w
LENGTH_SCALE = 6
POSITION_MEASURE = 8
ITERATIONS = 3  # counters in iw
FAILURES = 4
PROBING = 5
PARTITIONS = 7
DEGREES = 8
TOLERANCE = 24  # parameters of the method in p


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 9 operations."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    # outputs
    p[15] = -s0  # -9.81*crank_mass
    p[16] = -s1  # -9.81*coupler_mass
    p[17] = -s2  # -9.81*rocker_mass
    p[18] = 0.3333333333333333*p0  # 0.3333333333333333*crank_mass
    p[19] = 5.333333333333333*p1  # 5.333333333333333*coupler_mass
    p[20] = 2.083333333333333*p2  # 2.083333333333333*rocker_mass
    p[21] = s0  # 9.81*crank_mass
    p[22] = s1  # 9.81*coupler_mass
    p[23] = s2  # 9.81*rocker_mass
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def expand(p, w):
    """D as a dense matrix: 0 operations."""
    # inputs
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.omega
    jacobian_1 = w[JACOBIAN + 1]  # D A.y, crank.omega
    jacobian_2 = w[JACOBIAN + 2]  # D B.x, crank.omega
    jacobian_3 = w[JACOBIAN + 3]  # D B.x, coupler.omega
    jacobian_4 = w[JACOBIAN + 4]  # D B.y, crank.omega
    jacobian_5 = w[JACOBIAN + 5]  # D B.y, coupler.omega
    jacobian_6 = w[JACOBIAN + 6]  # D C.x, coupler.omega
    jacobian_7 = w[JACOBIAN + 7]  # D C.x, rocker.omega
    jacobian_8 = w[JACOBIAN + 8]  # D C.y, coupler.omega
    jacobian_9 = w[JACOBIAN + 9]  # D C.y, rocker.omega
    jacobian_10 = w[JACOBIAN + 10]  # D D.x, rocker.omega
    jacobian_11 = w[JACOBIAN + 11]  # D D.y, rocker.omega
    # outputs
    w[DENSE] = 1.0
    w[DENSE + 2] = jacobian_0
    w[DENSE + 10] = 1.0
    w[DENSE + 11] = jacobian_1
    w[DENSE + 18] = -1.0
    w[DENSE + 20] = jacobian_2
    w[DENSE + 21] = 1.0
    w[DENSE + 23] = jacobian_3
    w[DENSE + 28] = -1.0
    w[DENSE + 29] = jacobian_4
    w[DENSE + 31] = 1.0
    w[DENSE + 32] = jacobian_5
    w[DENSE + 39] = -1.0
    w[DENSE + 41] = jacobian_6
    w[DENSE + 42] = 1.0
    w[DENSE + 44] = jacobian_7
    w[DENSE + 49] = -1.0
    w[DENSE + 50] = jacobian_8
    w[DENSE + 52] = 1.0
    w[DENSE + 53] = jacobian_9
    w[DENSE + 60] = 1.0
    w[DENSE + 62] = jacobian_10
    w[DENSE + 70] = 1.0
    w[DENSE + 71] = jacobian_11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def aim(t, y, p, w):
    """The section `residual` = -gamma, the section `force` = f: 23 operations."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    p15 = p[15]  # -9.81*crank_mass
    p16 = p[16]  # -9.81*coupler_mass
    p17 = p[17]  # -9.81*rocker_mass
    # intermediate terms
    s0 = v2*v2
    s1 = math.cos(q2)*s0
    s2 = math.sin(q2)*s0
    s3 = v5*v5
    s4 = 4.0*math.cos(q5)*s3
    s5 = 4.0*math.sin(q5)*s3
    s6 = v8*v8
    s7 = 2.5*math.cos(q8)*s6
    s8 = 2.5*math.sin(q8)*s6
    # outputs
    w[RESIDUAL] = s1  # A.x
    w[RESIDUAL + 1] = s2  # A.y
    w[RESIDUAL + 2] = s1 + s4  # B.x
    w[RESIDUAL + 3] = s2 + s5  # B.y
    w[RESIDUAL + 4] = s4 - s7  # C.x
    w[RESIDUAL + 5] = s5 - s8  # C.y
    w[RESIDUAL + 6] = s7  # D.x
    w[RESIDUAL + 7] = s8  # D.y
    w[FORCE] = 0.0
    w[FORCE + 1] = p15
    w[FORCE + 2] = 0.0
    w[FORCE + 3] = 0.0
    w[FORCE + 4] = p16
    w[FORCE + 5] = 0.0
    w[FORCE + 6] = 0.0
    w[FORCE + 7] = p17
    w[FORCE + 8] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def strike(w):
    """The section `residual` = D times `change`: 28 operations."""
    # inputs
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.omega
    jacobian_1 = w[JACOBIAN + 1]  # D A.y, crank.omega
    jacobian_2 = w[JACOBIAN + 2]  # D B.x, crank.omega
    jacobian_3 = w[JACOBIAN + 3]  # D B.x, coupler.omega
    jacobian_4 = w[JACOBIAN + 4]  # D B.y, crank.omega
    jacobian_5 = w[JACOBIAN + 5]  # D B.y, coupler.omega
    jacobian_6 = w[JACOBIAN + 6]  # D C.x, coupler.omega
    jacobian_7 = w[JACOBIAN + 7]  # D C.x, rocker.omega
    jacobian_8 = w[JACOBIAN + 8]  # D C.y, coupler.omega
    jacobian_9 = w[JACOBIAN + 9]  # D C.y, rocker.omega
    jacobian_10 = w[JACOBIAN + 10]  # D D.x, rocker.omega
    jacobian_11 = w[JACOBIAN + 11]  # D D.y, rocker.omega
    change_0 = w[CHANGE]  # crank.vx
    change_1 = w[CHANGE + 1]  # crank.vy
    change_2 = w[CHANGE + 2]  # crank.omega
    change_3 = w[CHANGE + 3]  # coupler.vx
    change_4 = w[CHANGE + 4]  # coupler.vy
    change_5 = w[CHANGE + 5]  # coupler.omega
    change_6 = w[CHANGE + 6]  # rocker.vx
    change_7 = w[CHANGE + 7]  # rocker.vy
    change_8 = w[CHANGE + 8]  # rocker.omega
    # outputs
    w[RESIDUAL] = change_0 + jacobian_0*change_2  # A.x
    w[RESIDUAL + 1] = change_1 + jacobian_1*change_2  # A.y
    w[RESIDUAL + 2] = change_3 + jacobian_2*change_2 - change_0 + jacobian_3*change_5  # B.x
    w[RESIDUAL + 3] = change_4 + jacobian_4*change_2 - change_1 + jacobian_5*change_5  # B.y
    w[RESIDUAL + 4] = change_6 + jacobian_6*change_5 - change_3 + jacobian_7*change_8  # C.x
    w[RESIDUAL + 5] = change_7 + jacobian_8*change_5 - change_4 + jacobian_9*change_8  # C.y
    w[RESIDUAL + 6] = change_6 + jacobian_10*change_8  # D.x
    w[RESIDUAL + 7] = change_7 + jacobian_11*change_8  # D.y
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def weigh(p, w):
    """The section `weighed` = M times `change`: 9 operations."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p18 = p[18]  # 0.3333333333333333*crank_mass
    p19 = p[19]  # 5.333333333333333*coupler_mass
    p20 = p[20]  # 2.083333333333333*rocker_mass
    change_0 = w[CHANGE]  # crank.vx
    change_1 = w[CHANGE + 1]  # crank.vy
    change_2 = w[CHANGE + 2]  # crank.omega
    change_3 = w[CHANGE + 3]  # coupler.vx
    change_4 = w[CHANGE + 4]  # coupler.vy
    change_5 = w[CHANGE + 5]  # coupler.omega
    change_6 = w[CHANGE + 6]  # rocker.vx
    change_7 = w[CHANGE + 7]  # rocker.vy
    change_8 = w[CHANGE + 8]  # rocker.omega
    # outputs
    w[WEIGHED] = p0*change_0
    w[WEIGHED + 1] = p0*change_1
    w[WEIGHED + 2] = p18*change_2
    w[WEIGHED + 3] = p1*change_3
    w[WEIGHED + 4] = p1*change_4
    w[WEIGHED + 5] = p19*change_5
    w[WEIGHED + 6] = p2*change_6
    w[WEIGHED + 7] = p2*change_7
    w[WEIGHED + 8] = p20*change_8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """q', power and multipliers: 163 operations."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p18 = p[18]  # 0.3333333333333333*crank_mass
    p21 = p[21]  # 9.81*crank_mass
    p19 = p[19]  # 5.333333333333333*coupler_mass
    p22 = p[22]  # 9.81*coupler_mass
    p20 = p[20]  # 2.083333333333333*rocker_mass
    p23 = p[23]  # 9.81*rocker_mass
    mask_4 = w[MASK + 4]  # C.x
    mask_5 = w[MASK + 5]  # C.y
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.omega
    jacobian_1 = w[JACOBIAN + 1]  # D A.y, crank.omega
    jacobian_2 = w[JACOBIAN + 2]  # D B.x, crank.omega
    jacobian_3 = w[JACOBIAN + 3]  # D B.x, coupler.omega
    jacobian_4 = w[JACOBIAN + 4]  # D B.y, crank.omega
    jacobian_5 = w[JACOBIAN + 5]  # D B.y, coupler.omega
    jacobian_6 = w[JACOBIAN + 6]  # D C.x, coupler.omega
    jacobian_7 = w[JACOBIAN + 7]  # D C.x, rocker.omega
    jacobian_8 = w[JACOBIAN + 8]  # D C.y, coupler.omega
    jacobian_9 = w[JACOBIAN + 9]  # D C.y, rocker.omega
    jacobian_10 = w[JACOBIAN + 10]  # D D.x, rocker.omega
    jacobian_11 = w[JACOBIAN + 11]  # D D.y, rocker.omega
    gauge_2 = w[GAUGE + 2]  # crank.omega
    gauge_5 = w[GAUGE + 5]  # coupler.omega
    gauge_8 = w[GAUGE + 8]  # rocker.omega
    ydot_9 = ydot[9]  # rate of crank.vx
    ydot_10 = ydot[10]  # rate of crank.vy
    ydot_11 = ydot[11]  # rate of crank.omega
    ydot_12 = ydot[12]  # rate of coupler.vx
    ydot_13 = ydot[13]  # rate of coupler.vy
    ydot_14 = ydot[14]  # rate of coupler.omega
    ydot_15 = ydot[15]  # rate of rocker.vx
    ydot_16 = ydot[16]  # rate of rocker.vy
    ydot_17 = ydot[17]  # rate of rocker.omega
    pivot_4 = w[PIVOT + 4]  # C.x
    pivot_5 = w[PIVOT + 5]  # C.y
    # intermediate terms
    s0 = p0*ydot_9
    s1 = p1*ydot_12
    s2 = p2*ydot_15
    s3 = p21 + p0*ydot_10
    s4 = p22 + p1*ydot_13
    s5 = p23 + p2*ydot_16
    s6 = jacobian_0 + jacobian_2
    s7 = jacobian_1 + jacobian_4
    s8 = jacobian_7 - jacobian_10
    s9 = jacobian_9 - jacobian_11
    s10 = jacobian_3*s6 + jacobian_5*s7
    s11 = 1.0/(1.0/gauge_8 + jacobian_10*jacobian_10 + jacobian_11*jacobian_11)
    s12 = s8*s11
    s13 = s9*s11
    s14 = 1.0/(1.0/gauge_2 + jacobian_0*jacobian_0 + jacobian_1*jacobian_1 + s6*s6 + s7*s7)
    s15 = s10*s14
    s16 = s6*s14
    s17 = s7*s14
    s18 = jacobian_3 + jacobian_6 - s6*s15
    s19 = jacobian_5 + jacobian_8 - s7*s15
    s20 = 1.0/(1.0/gauge_5 + jacobian_3*jacobian_3 + jacobian_5*jacobian_5 - s10*s15)
    s21 = s18*s20
    s22 = s19*s20
    s23 = s9*s12 + s7*s16 + s19*s21
    s24 = 1.0*(pivot_4 > mask_4 + 1e-12)/max(s8*s12 + s6*s16 + s18*s21, 1e-300)
    s25 = s23*s24
    s26 = jacobian_10*s2 - p20*ydot_17 + jacobian_11*s5
    s27 = jacobian_0*s0 - p18*ydot_11 + jacobian_1*s3 + s1*s6 + s4*s7
    s28 = jacobian_3*s1 - p19*ydot_14 + jacobian_5*s4 - s15*s27
    s29 = s12*s26 + s16*s27 + s21*s28
    s30 = 1.0*(pivot_5 > mask_5 + 1e-12)/max(s9*s13 + s7*s17 + s19*s22 - s23*s25, 1e-300)*(s25*s29 - (s13*s26 + s17*s27 + s22*s28))
    s31 = s24*s29 + s25*s30
    s32 = s20*s28 - s21*s31 + s22*s30
    s33 = s14*s27 - s15*s32 - s16*s31 + s17*s30
    s34 = s11*s26 - s12*s31 + s13*s30
    s35 = jacobian_0*s33
    s36 = jacobian_1*s33
    s37 = s31 + s35 + jacobian_2*s33 + jacobian_3*s32
    s38 = s4 + s30 - (s36 + jacobian_4*s33 + jacobian_5*s32)
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
    w[MULTIPLIERS] = -(s0 + s1 - s37 - s35)  # A.x
    w[MULTIPLIERS + 1] = -(s3 + s38 - s36)  # A.y
    w[MULTIPLIERS + 2] = s37 - s1  # B.x
    w[MULTIPLIERS + 3] = -s38  # B.y
    w[MULTIPLIERS + 4] = s31  # C.x
    w[MULTIPLIERS + 5] = -s30  # C.y
    w[MULTIPLIERS + 6] = -(s2 + s31 - jacobian_10*s34)  # D.x
    w[MULTIPLIERS + 7] = s30 + jacobian_11*s34 - s5  # D.y
    ydot[18] = 0.0  # rate of work
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def reduce(w, step, column):
    """Make a column of the dense D a unit vector with its 1 in row `step` (Gauss, Jordan)."""
    pivot = w[DENSE + 9 * step + column]
    for j in range(9):
        w[DENSE + 9 * step + j] /= pivot
    for i in range(8):
        factor = w[DENSE + 9 * i + column]
        if i != step and factor != 0.0:
            for j in range(9):
                w[DENSE + 9 * i + j] -= factor * w[DENSE + 9 * step + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def choose(p, w, iw):
    """Choose the dependent columns of D: by complete pivoting, then by exchange while that enlarges their determinant."""
    for k in range(72):
        w[DENSE + k] = 0.0
    expand(p, w)
    for j in range(9):
        w[DEPENDENT + j] = 0.0
    for i in range(8):  # rows of unequal size must not decide
        total = 0.0
        for j in range(9):
            w[DENSE + 9 * i + j] *= math.sqrt(w[GAUGE + j])
            total += w[DENSE + 9 * i + j] ** 2
        for j in range(9):
            w[DENSE + 9 * i + j] /= math.sqrt(total)
    rank = 0
    for step in range(8):
        largest, row, column = 0.0, -1, -1
        for i in range(step, 8):
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 9 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 9 * i + j]), i, j
        if largest < 1e-6:  # the square root of the threshold at which D D^T skips a row
            break
        w[DEPENDENT + column] = 1.0
        for j in range(9):
            a, b = DENSE + 9 * step + j, DENSE + 9 * row + j
            w[a], w[b] = w[b], w[a]
        reduce(w, step, column)
        rank += 1
    # what is left in the other columns is how fast dependent coordinates follow independent ones, with the sign changed
    for exchange in range(9):
        largest, row, column = 1.01, -1, -1
        for i in range(rank):
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and abs(w[DENSE + 9 * i + j]) > largest:
                    largest, row, column = abs(w[DENSE + 9 * i + j]), i, j
        if row < 0:
            break
        for j in range(9):
            if w[DEPENDENT + j] == 1.0 and w[DENSE + 9 * row + j] != 0.0:
                w[DEPENDENT + j] = 0.0
        w[DEPENDENT + column] = 1.0
        reduce(w, row, column)
    iw[PARTITIONS] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def project(p, w, iw):
    """Basis of the tangent space at the D that `geometry` left: trial = (1 - D^+ D) basis, column by column."""
    for c in range(iw[DEGREES]):
        for j in range(9):
            w[CHANGE + j] = w[BASIS + 9 * c + j]
        strike(w)
        spread(p, w)
        for j in range(9):
            w[TRIAL + 9 * c + j] = w[BASIS + 9 * c + j] + w[CHANGE + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state: v' = b + R z' with D R = 0, D b = gamma and R^T M R z' = R^T (f - M b)."""
    geometry(t, y, p, w)
    aim(t, y, p, w)
    spread(p, w)
    weigh(p, w)
    for j in range(9):
        ydot[9 + j] = w[CHANGE + j]
        w[FORCE + j] -= w[WEIGHED + j]
    degrees = iw[DEGREES]
    project(p, w, iw)
    for c in range(degrees):  # lower triangle of the mass matrix over a basis, and the right-hand side behind it
        for j in range(9):
            w[CHANGE + j] = w[TRIAL + 9 * c + j]
        weigh(p, w)
        for r in range(c, degrees):
            total = 0.0
            for j in range(9):
                total += w[TRIAL + 9 * r + j] * w[WEIGHED + j]
            w[SMALL + 7 * r + c] = total
        total = 0.0
        for j in range(9):
            total += w[TRIAL + 9 * c + j] * w[FORCE + j]
        w[REDUCED + c] = total
    for c in range(degrees):  # L D L^T in place
        for r in range(c + 1, degrees):
            factor = w[SMALL + 7 * r + c] / w[SMALL + 7 * c + c]
            for k in range(r, degrees):
                w[SMALL + 7 * k + r] -= factor * w[SMALL + 7 * k + c]
            w[REDUCED + r] -= factor * w[REDUCED + c]
    for c in range(degrees - 1, -1, -1):
        total = w[REDUCED + c]
        for r in range(c + 1, degrees):
            total -= w[SMALL + 7 * r + c] * w[REDUCED + r]
        w[REDUCED + c] = total / w[SMALL + 7 * c + c]
        for j in range(9):
            ydot[9 + j] += w[REDUCED + c] * w[TRIAL + 9 * c + j]
    finish(t, y, p, w, ydot)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def balance(t, y, p, w, ydot):
    """M v' + D^T lambda - f in the section `change`: 58 operations."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    q2 = y[2]  # crank.theta [rad]
    q5 = y[5]  # coupler.theta [rad]
    q8 = y[8]  # rocker.theta [rad]
    p18 = p[18]  # 0.3333333333333333*crank_mass
    p21 = p[21]  # 9.81*crank_mass
    p19 = p[19]  # 5.333333333333333*coupler_mass
    p22 = p[22]  # 9.81*coupler_mass
    p20 = p[20]  # 2.083333333333333*rocker_mass
    p23 = p[23]  # 9.81*rocker_mass
    ydot_9 = ydot[9]  # rate of crank.vx
    ydot_10 = ydot[10]  # rate of crank.vy
    ydot_11 = ydot[11]  # rate of crank.omega
    ydot_12 = ydot[12]  # rate of coupler.vx
    ydot_13 = ydot[13]  # rate of coupler.vy
    ydot_14 = ydot[14]  # rate of coupler.omega
    ydot_15 = ydot[15]  # rate of rocker.vx
    ydot_16 = ydot[16]  # rate of rocker.vy
    ydot_17 = ydot[17]  # rate of rocker.omega
    multipliers_0 = w[MULTIPLIERS]  # A.x
    multipliers_1 = w[MULTIPLIERS + 1]  # A.y
    multipliers_2 = w[MULTIPLIERS + 2]  # B.x
    multipliers_3 = w[MULTIPLIERS + 3]  # B.y
    multipliers_4 = w[MULTIPLIERS + 4]  # C.x
    multipliers_5 = w[MULTIPLIERS + 5]  # C.y
    multipliers_6 = w[MULTIPLIERS + 6]  # D.x
    multipliers_7 = w[MULTIPLIERS + 7]  # D.y
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 4.0*math.cos(q5)
    s3 = 4.0*math.sin(q5)
    s4 = 2.5*math.cos(q8)
    s5 = 2.5*math.sin(q8)
    # outputs
    w[CHANGE] = p0*ydot_9 + multipliers_0 - multipliers_2  # crank.vx
    w[CHANGE + 1] = p0*ydot_10 + p21 + multipliers_1 - multipliers_3  # crank.vy
    w[CHANGE + 2] = p18*ydot_11 + s1*multipliers_0 - s0*multipliers_1 + s1*multipliers_2 - s0*multipliers_3  # crank.omega
    w[CHANGE + 3] = p1*ydot_12 + multipliers_2 - multipliers_4  # coupler.vx
    w[CHANGE + 4] = p1*ydot_13 + p22 + multipliers_3 - multipliers_5  # coupler.vy
    w[CHANGE + 5] = p19*ydot_14 + s3*multipliers_2 - s2*multipliers_3 + s3*multipliers_4 - s2*multipliers_5  # coupler.omega
    w[CHANGE + 6] = p2*ydot_15 + multipliers_4 + multipliers_6  # rocker.vx
    w[CHANGE + 7] = p2*ydot_16 + p23 + multipliers_5 + multipliers_7  # rocker.vy
    w[CHANGE + 8] = p20*ydot_17 + s4*multipliers_5 - s5*multipliers_4 + s5*multipliers_6 - s4*multipliers_7  # rocker.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def drift(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left: 28 operations."""
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
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.omega
    jacobian_1 = w[JACOBIAN + 1]  # D A.y, crank.omega
    jacobian_2 = w[JACOBIAN + 2]  # D B.x, crank.omega
    jacobian_3 = w[JACOBIAN + 3]  # D B.x, coupler.omega
    jacobian_4 = w[JACOBIAN + 4]  # D B.y, crank.omega
    jacobian_5 = w[JACOBIAN + 5]  # D B.y, coupler.omega
    jacobian_6 = w[JACOBIAN + 6]  # D C.x, coupler.omega
    jacobian_7 = w[JACOBIAN + 7]  # D C.x, rocker.omega
    jacobian_8 = w[JACOBIAN + 8]  # D C.y, coupler.omega
    jacobian_9 = w[JACOBIAN + 9]  # D C.y, rocker.omega
    jacobian_10 = w[JACOBIAN + 10]  # D D.x, rocker.omega
    jacobian_11 = w[JACOBIAN + 11]  # D D.y, rocker.omega
    # outputs
    w[RESIDUAL] = v0 + v2*jacobian_0  # A.x
    w[RESIDUAL + 1] = v1 + v2*jacobian_1  # A.y
    w[RESIDUAL + 2] = v3 + v2*jacobian_2 - v0 + v5*jacobian_3  # B.x
    w[RESIDUAL + 3] = v4 + v2*jacobian_4 - v1 + v5*jacobian_5  # B.y
    w[RESIDUAL + 4] = v6 + v5*jacobian_6 - v3 + v8*jacobian_7  # C.x
    w[RESIDUAL + 5] = v7 + v5*jacobian_8 - v4 + v8*jacobian_9  # C.y
    w[RESIDUAL + 6] = v6 + v8*jacobian_10  # D.x
    w[RESIDUAL + 7] = v7 + v8*jacobian_11  # D.y
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct and measure an accepted state, and carry the tangent basis on to it."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[TOLERANCE] * w[LENGTH_SCALE]
    last = math.inf
    bits = 2
    for round in range(15):
        geometry(t, y, p, w)
        violation = w[POSITION_MEASURE]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        # near a singular position what is left of a violation opens another way: no more than rounding may be left
        near = w[SMALLEST_PIVOT] < 1e-4
        closed = violation <= (0.01 * tolerance if near else tolerance) or stalled or round == 14
        if closed:
            drift(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(9, 18):
                y[j] += w[CHANGE - 9 + j]
            break
        for j in range(9):
            y[j] += w[CHANGE + j]
        last = violation
        iw[ITERATIONS] += 1
    if not violation <= 1e4 * tolerance:
        iw[FAILURES] += 1
        bits |= 1
    if iw[PROBING] == 0:
        if iw[PARTITIONS] == 0:  # the first basis: unit vectors of independent coordinates
            choose(p, w, iw)
            degrees = 0
            for j in range(9):
                if w[DEPENDENT + j] == 0.0 and degrees < 7:
                    for k in range(9):
                        w[BASIS + 9 * degrees + k] = 1.0 if k == j else 0.0
                    degrees += 1
            iw[DEGREES] = degrees
        project(p, w, iw)
        for c in range(iw[DEGREES]):
            for r in range(c + 1):  # orthogonal to the columns before it, then of length 1
                total = 0.0
                for j in range(9):
                    total += w[TRIAL + 9 * c + j] * w[(BASIS if r < c else TRIAL) + 9 * r + j] / w[GAUGE + j]
                if r == c:
                    for j in range(9):
                        w[BASIS + 9 * c + j] = w[TRIAL + 9 * c + j] / math.sqrt(total)
                else:
                    for j in range(9):
                        w[TRIAL + 9 * c + j] -= total * w[BASIS + 9 * r + j]
    measure(t, y, p, w)
    return bits
