"""Method `rattle` for model `four-bar`. Emitted by symgen; do not edit.

Index 3, explicit: positions and velocities on their constraints, reversible, energy bounded.
Ryckaert, Ciccotti, Berendsen, J. Comput. Phys. 23 (1977) 327-341
Andersen, J. Comput. Phys. 52 (1983) 24-34, doi 10.1016/0021-9991(83)90014-1
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a1bfe8da2fcb1eac
option solver = elimination

Constraints Phi(q, t) = 0, their rates D v = nu and D v' = gamma; M v' = f - D^T lambda; S = D M^-1 D^T.

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and counters iw. Once: `prepare` of the
model, `prepare`, and `accept` with the start. Then `rhs` gives the rate of a state, `confirm` where `rhs` returns 1,
and `accept` corrects and measures the state at the end of each step.
Implicit integrators solve `residual` = 0 for k = (q', v', multipliers); `tangent` is its derivatives.

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
p[15:27] numbers computed by `prepare`
p[27:30] numbers computed by `prepare` too
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
"""

import math

from numba import njit

from model import geometry, measure

MULTIPLIERS = 19  # sections of w
MASK = 27
SAVED = 35
PIVOT = 59
POWER = 18  # numbers in w
SUSPECTS = 1  # counters in iw
LIGHT = 2


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 23 operations."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 0.3333333333333333*p0
    s1 = 9.81*p0
    s2 = 5.333333333333333*p1
    s3 = 2.083333333333333*p2
    s4 = 1.0/max(p1, p2)
    # outputs
    p[15] = s1  # 9.81*crank_mass
    p[16] = 9.81*p1  # 9.81*coupler_mass
    p[17] = 9.81*p2  # 9.81*rocker_mass
    p[18] = 8.0*p1  # 8.0*coupler_mass
    p[19] = s2 + 16.0*p1
    p[20] = 1.0/(s3 + 6.25*p2)
    p[21] = 1.0/(p0 + s0 + 4.0*p1)
    p[22] = s4  # 1.0/max(coupler_mass, rocker_mass)
    p[23] = 1e-06*s4  # 1e-06*(1.0/max(coupler_mass, rocker_mass))
    p[24] = 24.525000000000002*p2  # 24.525000000000002*rocker_mass
    p[25] = s1 + 19.62*p1  # 9.81*crank_mass + 19.62*coupler_mass
    p[26] = 39.24*p1  # 39.24*coupler_mass
    p[27] = s0  # 0.3333333333333333*crank_mass
    p[28] = s2  # 5.333333333333333*coupler_mass
    p[29] = s3  # 2.083333333333333*rocker_mass
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 174 operations."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
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
    mask_4 = w[MASK + 4]  # C.x
    mask_5 = w[MASK + 5]  # C.y
    p18 = p[18]  # 8.0*coupler_mass
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]  # 1.0/max(coupler_mass, rocker_mass)
    p23 = p[23]  # 1e-06*(1.0/max(coupler_mass, rocker_mass))
    p24 = p[24]  # 24.525000000000002*rocker_mass
    p25 = p[25]  # 9.81*crank_mass + 19.62*coupler_mass
    p26 = p[26]  # 39.24*coupler_mass
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
    s9 = v5*v5
    s10 = math.cos(q8)
    s11 = math.sin(q8)
    s12 = 2.5*s10
    s13 = 2.5*s11
    s14 = v8*v8
    s15 = s1 + s1
    s16 = s0 + s0
    s17 = 5.0*s11
    s18 = 5.0*s10
    s19 = 8.0*s6
    s20 = p18*(s1*s6 + s0*s5)
    s21 = 8.0*s5
    s22 = s17*p20
    s23 = s18*p20
    s24 = s20*p21
    s25 = s15*p21
    s26 = s16*p21
    s27 = s19 - s15*s24
    s28 = s16*s24 - s21
    s29 = 1.0/(p19 - s20*s24)
    s30 = s27*s29
    s31 = s28*s29
    s32 = s18*s22 + s16*s25 - s28*s30
    s33 = s18*s23 + s16*s26 + s28*s31
    s34 = mask_4 + s17*s22 + s15*s25 + s27*s30
    s35 = 1.0/s34
    s36 = s32*s35
    s37 = mask_5 + s33 - s32*s36
    s38 = s10*p24
    s39 = p18*(s0*s6 - s1*s5)
    s40 = s9*s39 - s0*p25
    s41 = s2*s39 + s5*p26 + s24*s40
    s42 = s14*s18 - s9*s21 - s2*(2.0*s0) - s22*s38 - s25*s40 + s30*s41
    s43 = 1.0/s37*(s14*s17 - s9*s19 - s2*(2.0*s1) + s23*s38 + s26*s40 + s31*s41 + s36*s42)
    s44 = s35*s42 + s36*s43
    s45 = s30*s44 - s29*s41 + s31*s43
    s46 = p21*s40 - s24*s45 + s25*s44 - s26*s43
    s47 = s23*s43 - (p20*s38 + s22*s44)
    s48 = s1*s46
    s49 = s3 + s48
    s50 = s0*s46
    s51 = s50 - s4
    s52 = s12*s14 + s13*s47
    s53 = s12*s47 - s13*s14
    s54 = s3 + s7*s9 + s48 + s49 + s8*s45
    s55 = s4 + s8*s9 + s4 - s50 - s50 - s7*s45
    s56 = p1*s54
    s57 = p16 + s43 - p1*s55
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
    ydot[9] = -s49  # rate of crank.vx
    ydot[10] = s51  # rate of crank.vy
    ydot[11] = s46  # rate of crank.omega
    ydot[12] = -s54  # rate of coupler.vx
    ydot[13] = -s55  # rate of coupler.vy
    ydot[14] = s45  # rate of coupler.omega
    ydot[15] = -s52  # rate of rocker.vx
    ydot[16] = s53  # rate of rocker.vy
    ydot[17] = s47  # rate of rocker.omega
    ydot[18] = 0.0  # rate of work
    w[MULTIPLIERS] = p0*s49 - (s44 - s56)  # A.x
    w[MULTIPLIERS + 1] = -(p15 + s57 + p0*s51)  # A.y
    w[MULTIPLIERS + 2] = s56 - s44  # B.x
    w[MULTIPLIERS + 3] = -s57  # B.y
    w[MULTIPLIERS + 4] = -s44  # C.x
    w[MULTIPLIERS + 5] = -s43  # C.y
    w[MULTIPLIERS + 6] = s44 + p2*s52  # D.x
    w[MULTIPLIERS + 7] = -(p17 + p2*s53 - s43)  # D.y
    return int(((s34 < p23) | (s37 < 1e-06*max(s33, p22))))


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


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, k, p, w, r):
    """F(t, y, k) of the descriptor form, and the power: 106 operations."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
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
    p27 = p[27]  # 0.3333333333333333*crank_mass
    p15 = p[15]  # 9.81*crank_mass
    p28 = p[28]  # 5.333333333333333*coupler_mass
    p16 = p[16]  # 9.81*coupler_mass
    p29 = p[29]  # 2.083333333333333*rocker_mass
    p17 = p[17]  # 9.81*rocker_mass
    k0 = k[0]
    k1 = k[1]
    k2 = k[2]
    k3 = k[3]
    k4 = k[4]
    k5 = k[5]
    k6 = k[6]
    k7 = k[7]
    k8 = k[8]
    k9 = k[9]
    k10 = k[10]
    k11 = k[11]
    k12 = k[12]
    k13 = k[13]
    k14 = k[14]
    k15 = k[15]
    k16 = k[16]
    k17 = k[17]
    k18 = k[18]
    k19 = k[19]
    k20 = k[20]
    k21 = k[21]
    k22 = k[22]
    k23 = k[23]
    k24 = k[24]
    k25 = k[25]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 4.0*math.cos(q5)
    s3 = 4.0*math.sin(q5)
    s4 = 2.5*math.cos(q8)
    s5 = 2.5*math.sin(q8)
    s6 = v2*s1
    s7 = v2*s0
    s8 = v5*s3
    s9 = v5*s2
    s10 = v8*s5
    s11 = v8*s4
    # outputs
    r[0] = k0 - v0
    r[1] = k1 - v1
    r[2] = k2 - v2
    r[3] = k3 - v3
    r[4] = k4 - v4
    r[5] = k5 - v5
    r[6] = k6 - v6
    r[7] = k7 - v7
    r[8] = k8 - v8
    r[9] = p0*k9 + k18 - k20
    r[10] = p15 + p0*k10 + k19 - k21
    r[11] = p27*k11 + s1*k18 - s0*k19 + s1*k20 - s0*k21
    r[12] = p1*k12 + k20 - k22
    r[13] = p16 + p1*k13 + k21 - k23
    r[14] = p28*k14 + s3*k20 - s2*k21 + s3*k22 - s2*k23
    r[15] = p2*k15 + k22 + k24
    r[16] = p17 + p2*k16 + k23 + k25
    r[17] = p29*k17 + s4*k23 - s5*k22 + s5*k24 - s4*k25
    r[18] = q0 - s0
    r[19] = q1 - s1
    r[20] = q3 - q0 - s2 - s0
    r[21] = q4 - q1 - s3 - s1
    r[22] = q6 - q3 + s4 - s2
    r[23] = q7 - q4 + s5 - s3
    r[24] = q6 - 10.0 - s4
    r[25] = q7 - s5
    r[26] = v0 + s6
    r[27] = v1 - s7
    r[28] = v3 + s6 - v0 + s8
    r[29] = v4 - (v1 + s7) - s9
    r[30] = v6 + s8 - v3 - s10
    r[31] = v7 - (v4 + s9) + s11
    r[32] = v6 + s10
    r[33] = v7 - s11
    w[POWER] = 0.0  # power
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """Entries of dF/dk and dF/dy of the descriptor form: 14 operations."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    q2 = y[2]  # crank.theta [rad]
    q5 = y[5]  # coupler.theta [rad]
    q8 = y[8]  # rocker.theta [rad]
    p27 = p[27]  # 0.3333333333333333*crank_mass
    p28 = p[28]  # 5.333333333333333*coupler_mass
    p29 = p[29]  # 2.083333333333333*rocker_mass
    # intermediate terms
    s0 = math.sin(q2)
    s1 = -math.cos(q2)
    s2 = -4.0*math.cos(q5)
    s3 = 4.0*math.sin(q5)
    s4 = 2.5*math.cos(q8)
    s5 = 2.5*math.sin(q8)
    # outputs
    j[0] = p0
    j[1] = 1.0
    j[2] = -1.0
    j[3] = p0
    j[4] = 1.0
    j[5] = -1.0
    j[6] = p27
    j[7] = s0
    j[8] = s1
    j[9] = s0
    j[10] = s1
    j[11] = p1
    j[12] = 1.0
    j[13] = -1.0
    j[14] = p1
    j[15] = 1.0
    j[16] = -1.0
    j[17] = p28
    j[18] = s3
    j[19] = s2
    j[20] = s3
    j[21] = s2
    j[22] = p2
    j[23] = 1.0
    j[24] = 1.0
    j[25] = p2
    j[26] = 1.0
    j[27] = 1.0
    j[28] = p29
    j[29] = -s5
    j[30] = s4
    j[31] = s5
    j[32] = -s4
    return 0
