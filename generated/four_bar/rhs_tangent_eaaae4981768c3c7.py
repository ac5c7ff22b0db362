"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .model import geometry, spread

CHANGE = 67  # sections of w
GAUGE = 85
DEPENDENT = 138
DENSE = 147
BASIS = 219
TRIAL = 282
SMALL = 345
REDUCED = 394
FORCE = 401
WEIGHED = 410


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
    """the section `residual` = -gamma, the section `force` = f: 21 operations, 48 before sharing."""
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
    s3 = 4.0*(v5*v5)
    s4 = math.cos(q5)*s3
    s5 = math.sin(q5)*s3
    s6 = 2.5*(v8*v8)
    s7 = math.cos(q8)*s6
    s8 = math.sin(q8)*s6
    # outputs
    w[43] = s1  # A.x
    w[44] = s2  # A.y
    w[45] = s1 + s4  # B.x
    w[46] = s2 + s5  # B.y
    w[47] = s4 - s7  # C.x
    w[48] = s5 - s8  # C.y
    w[49] = s7  # D.x
    w[50] = s8  # D.y
    w[401] = 0.0
    w[402] = p15
    w[403] = 0.0
    w[404] = 0.0
    w[405] = p16
    w[406] = 0.0
    w[407] = 0.0
    w[408] = p17
    w[409] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def strike(w):
    """the section `residual` = D times `change`: 28 operations, 28 before sharing."""
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
    w[43] = change_0 + jacobian_0*change_2  # A.x
    w[44] = change_1 + jacobian_1*change_2  # A.y
    w[45] = change_3 + jacobian_2*change_2 - change_0 + jacobian_3*change_5  # B.x
    w[46] = change_4 + jacobian_4*change_2 - change_1 + jacobian_5*change_5  # B.y
    w[47] = change_6 + jacobian_6*change_5 - change_3 + jacobian_7*change_8  # C.x
    w[48] = change_7 + jacobian_8*change_5 - change_4 + jacobian_9*change_8  # C.y
    w[49] = change_6 + jacobian_10*change_8  # D.x
    w[50] = change_7 + jacobian_11*change_8  # D.y
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
    w[410] = p0*change_0
    w[411] = p0*change_1
    w[412] = p18*change_2
    w[413] = p1*change_3
    w[414] = p1*change_4
    w[415] = p19*change_5
    w[416] = p2*change_6
    w[417] = p2*change_7
    w[418] = p20*change_8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """q', power and multipliers: 117 operations, 12266 before sharing."""
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
    gauge_2 = w[87]  # crank.omega
    gauge_5 = w[90]  # coupler.omega
    gauge_8 = w[93]  # rocker.omega
    lower_0 = w[114]
    lower_1 = w[115]
    lower_2 = w[116]
    lower_3 = w[117]
    lower_4 = w[118]
    lower_5 = w[119]
    lower_6 = w[120]
    lower_7 = w[121]
    lower_8 = w[122]
    lower_9 = w[123]
    lower_10 = w[124]
    lower_11 = w[125]
    lower_12 = w[126]
    lower_13 = w[127]
    lower_14 = w[128]
    lower_15 = w[129]
    reciprocal_0 = w[130]
    reciprocal_1 = w[131]
    reciprocal_2 = w[132]
    reciprocal_3 = w[133]
    reciprocal_4 = w[134]
    reciprocal_5 = w[135]
    reciprocal_6 = w[136]
    reciprocal_7 = w[137]
    ydot_9 = ydot[9]  # rate of crank.vx
    ydot_10 = ydot[10]  # rate of crank.vy
    ydot_11 = ydot[11]  # rate of crank.omega
    ydot_12 = ydot[12]  # rate of coupler.vx
    ydot_13 = ydot[13]  # rate of coupler.vy
    ydot_14 = ydot[14]  # rate of coupler.omega
    ydot_15 = ydot[15]  # rate of rocker.vx
    ydot_16 = ydot[16]  # rate of rocker.vy
    ydot_17 = ydot[17]  # rate of rocker.omega
    # intermediate terms
    s0 = p0*ydot_9
    s1 = p1*ydot_12
    s2 = p2*ydot_15
    s3 = p21 + p0*ydot_10
    s4 = p22 + p1*ydot_13
    s5 = p23 + p2*ydot_16
    s6 = gauge_2*(p18*ydot_11)
    s7 = gauge_5*(p19*ydot_14)
    s8 = gauge_8*(p20*ydot_17)
    s9 = s0 + jacobian_0*s6
    s10 = s2 + jacobian_10*s8
    s11 = lower_0*s9 - (s3 + jacobian_1*s6)
    s12 = s0 - jacobian_2*s6 - s1 - jacobian_3*s7 + lower_1*s9 - lower_3*s11
    s13 = lower_5*s10 - (s5 + jacobian_11*s8)
    s14 = s3 - jacobian_4*s6 - s4 - jacobian_5*s7 + lower_2*s9 - lower_4*s11 - lower_10*s12
    s15 = s1 - jacobian_6*s7 - s2 - jacobian_7*s8 + lower_6*s10 - lower_8*s13 - lower_11*s12 - lower_13*s14
    s16 = s4 - jacobian_8*s7 - s5 - jacobian_9*s8 + lower_7*s10 - lower_9*s13 - lower_12*s12 - lower_14*s14
    s17 = reciprocal_7*(s16 - lower_15*s15)
    s18 = reciprocal_6*s15 - lower_15*s17
    s19 = reciprocal_5*s14 - lower_13*s18 - lower_14*s17
    s20 = reciprocal_4*s12 - lower_10*s19 - lower_11*s18 - lower_12*s17
    s21 = reciprocal_3*s13 - lower_8*s18 - lower_9*s17
    s22 = reciprocal_1*s11 - lower_3*s20 - lower_4*s19
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
    w[19] = -(reciprocal_0*s9 + lower_0*s22 + lower_1*s20 + lower_2*s19)  # A.x
    w[20] = s22  # A.y
    w[21] = s20  # B.x
    w[22] = s19  # B.y
    w[23] = s18  # C.x
    w[24] = s17  # C.y
    w[25] = -(reciprocal_2*s10 + lower_5*s21 + lower_6*s18 + lower_7*s17)  # D.x
    w[26] = s21  # D.y
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
    iw[7] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def project(p, w, iw):
    """Basis of the tangent space at the D that `geometry` left: trial = (1 - D^+ D) basis, column by column."""
    for c in range(iw[8]):
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
    degrees = iw[8]
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
