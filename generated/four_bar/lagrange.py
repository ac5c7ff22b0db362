"""Method `lagrange` for model `four-bar`. Emitted by symgen; do not edit.

Constraints at acceleration level only; violations grow with time.
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 2f2faf4a02ce3130
option solver = elimination

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
p[15:28] numbers computed by `prepare`
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
w[114:130]  lower: L of the factorisation of D G D^T, below the diagonal
w[130:138]  reciprocal: reciprocals of the pivots of D G D^T, 0 for rows left out
"""

import math

from numba import njit

from model import geometry, measure

MULTIPLIERS = 19  # sections of w
MASK = 27
SAVED = 35
PIVOT = 59
SUSPECTS = 1  # counters in iw
LIGHT = 2


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 17 operations, 32 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    s3 = 1.0/p0
    s4 = 1.0/p1
    s5 = 1.0/p2
    s6 = s0*s3
    s7 = s1*s4
    s8 = s2*s5
    # outputs
    p[15] = s0  # 9.81*crank_mass
    p[16] = s1  # 9.81*coupler_mass
    p[17] = s2  # 9.81*rocker_mass
    p[18] = s3  # 1.0/crank_mass
    p[19] = 1.0/(0.3333333333333333*p0)  # 1.0/(0.3333333333333333*crank_mass)
    p[20] = s4  # 1.0/coupler_mass
    p[21] = 1.0/(5.333333333333333*p1)  # 1.0/(5.333333333333333*coupler_mass)
    p[22] = s5  # 1.0/rocker_mass
    p[23] = 1.0/(2.083333333333333*p2)  # 1.0/(2.083333333333333*rocker_mass)
    p[24] = s6  # 9.81*crank_mass*(1.0/crank_mass)
    p[25] = s8  # 9.81*rocker_mass*(1.0/rocker_mass)
    p[26] = s6 - s7
    p[27] = s7 - s8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 288 operations, 1442826 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p15 = p[15]  # 9.81*crank_mass
    p16 = p[16]  # 9.81*coupler_mass
    p17 = p[17]  # 9.81*rocker_mass
    mask_0 = w[MASK]  # A.x
    mask_1 = w[MASK + 1]  # A.y
    mask_2 = w[MASK + 2]  # B.x
    mask_3 = w[MASK + 3]  # B.y
    mask_4 = w[MASK + 4]  # C.x
    mask_5 = w[MASK + 5]  # C.y
    mask_6 = w[MASK + 6]  # D.x
    mask_7 = w[MASK + 7]  # D.y
    p18 = p[18]  # 1.0/crank_mass
    p19 = p[19]  # 1.0/(0.3333333333333333*crank_mass)
    p20 = p[20]  # 1.0/coupler_mass
    p21 = p[21]  # 1.0/(5.333333333333333*coupler_mass)
    p22 = p[22]  # 1.0/rocker_mass
    p23 = p[23]  # 1.0/(2.083333333333333*rocker_mass)
    p24 = p[24]  # 9.81*crank_mass*(1.0/crank_mass)
    p25 = p[25]  # 9.81*rocker_mass*(1.0/rocker_mass)
    p26 = p[26]
    p27 = p[27]
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
    s19 = s1*p19
    s20 = s0*p19
    s21 = s8*p21
    s22 = s7*p21
    s23 = s15*p23
    s24 = s14*p23
    s25 = s1*s19
    s26 = p18 + s25
    s27 = s0*s19
    s28 = s25 - p18
    s29 = s0*s20
    s30 = p18 + s29
    s31 = s8*s21
    s32 = p20 + s26 + s31
    s33 = s7*s21
    s34 = s31 - p20
    s35 = s7*s22
    s36 = p20 + s30 + s35
    s37 = s15*s23
    s38 = p22 + p20 + s31 + s37
    s39 = s14*s23
    s40 = p22 - s37
    s41 = s14*s24
    s42 = p22 + p20 + s35 + s41
    s43 = s15*s24
    s44 = p22 + s41
    s45 = 1.0/(mask_0 + s26)
    s46 = s27*s45
    s47 = s28*s45
    s48 = s27*s46
    s49 = s28*s46 - s1*s20
    s50 = s29 - p18 - s48
    s51 = mask_1 + s30 - s48
    s52 = 1.0/s51
    s53 = s49*s52
    s54 = s50*s52
    s55 = s27*s47 - (s27 + s33) - s50*s53
    s56 = 1.0/(mask_6 + p22 + s37)
    s57 = s39*s56
    s58 = s40*s56
    s59 = s43*s56
    s60 = s39 + s40*s57
    s61 = p22 - s41 + s43*s57
    s62 = mask_7 + s44 - s39*s57
    s63 = 1.0/s62
    s64 = s60*s63
    s65 = s61*s63
    s66 = mask_2 + s32 - s28*s47 - s49*s53
    s67 = 1.0/s66
    s68 = s55*s67
    s69 = s34*s67
    s70 = s33*s67
    s71 = s8*s22 + s34*s68
    s72 = s35 - p20 + s33*s68
    s73 = mask_3 + s36 - s48 - s50*s54 - s55*s68
    s74 = 1.0/s73
    s75 = s71*s74
    s76 = s72*s74
    s77 = s33*s69 - (s33 + s39 + s43*s58 + s61*s64) + s72*s75
    s78 = mask_4 + s38 - s40*s58 - s60*s64 - s34*s69 - s71*s75
    s79 = 1.0/s78
    s80 = s77*s79
    s81 = mask_5 + s42 - s43*s59 - s61*s65 - s33*s70 - s72*s76 - s77*s80
    s82 = s3*s46
    s83 = s4 - p24 + s82
    s84 = s3 + s10 - s3*s47 - s53*s83
    s85 = s18 - p25 + s17*s57
    s86 = s4 + s11 + p26 + s82 - s54*s83 - s68*s84
    s87 = s10 - s17 - s17*s58 - s64*s85 - s69*s84 + s75*s86
    s88 = 1.0/s81*(p27 - (s18 - s11) - s17*s59 - s65*s85 + s70*s84 - s76*s86 - s80*s87)
    s89 = s79*s87
    s90 = s80*s88
    s91 = s89 - s90
    s92 = s74*s86 + s75*s91
    s93 = s76*s88
    s94 = s92 - s93
    s95 = s67*s84 - s68*s94 - s69*s91 + s70*s88
    s96 = s63*s85 - s64*s91 - s65*s88
    s97 = s17*s56 + s57*s96 - s58*s91 - s59*s88
    s98 = s52*s83 - s53*s95 - s54*s94
    s99 = s3*s45 + s46*s98 - s47*s95 + s46*s94
    s100 = (((((s51 < 1e-06*s30) | (s62 < 1e-06*s44)) | (s66 < 1e-06*s32)) | (s73 < 1e-06*s36)) | (s78 < 1e-06*s38))
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
    ydot[9] = p18*(s95 - s99)  # rate of crank.vx
    ydot[10] = -p18*(p15 + s98 + s93 - s92)  # rate of crank.vy
    ydot[11] = p19*(s0*s94 - (s1*s99 - s0*s98 + s1*s95))  # rate of crank.omega
    ydot[12] = -p20*(s95 + s90 - s89)  # rate of coupler.vx
    ydot[13] = -p20*(p16 + s94 - s88)  # rate of coupler.vy
    ydot[14] = p21*(s7*s88 - (s8*s95 - s7*s94 + s8*s91))  # rate of coupler.omega
    ydot[15] = -p22*(s91 + s97)  # rate of rocker.vx
    ydot[16] = -p22*(p17 + s88 + s96)  # rate of rocker.vy
    ydot[17] = p23*(s14*s96 - (s14*s88 - s15*s91 + s15*s97))  # rate of rocker.omega
    ydot[18] = 0.0  # rate of work
    w[MULTIPLIERS] = s99  # A.x
    w[MULTIPLIERS + 1] = s98  # A.y
    w[MULTIPLIERS + 2] = s95  # B.x
    w[MULTIPLIERS + 3] = s94  # B.y
    w[MULTIPLIERS + 4] = s91  # C.x
    w[MULTIPLIERS + 5] = s88  # C.y
    w[MULTIPLIERS + 6] = s97  # D.x
    w[MULTIPLIERS + 7] = s96  # D.y
    return int((s100 | (s81 < 1e-06*s42)))


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(8):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(8):
        w[MASK + i] = w[SAVED + i]
    iw[SUSPECTS] += 1
    if skipped == 0:
        iw[LIGHT] += 1
    return 0
