"""Method `direct-correction` for model `slider-crank`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 2, templates 06e8f0c6b361de81
option solver = elimination
option weight = identity
p[13] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import geometry, measure, spread

MASK = 23  # sections of w
SAVED = 31
PIVOT = 55
CHANGE = 63


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 15 operations, 30 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # rod_mass [kg]
    p2 = p[2]  # slider_mass [kg]
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
    p[14] = s0
    p[15] = s1
    p[16] = s2
    p[17] = s3
    p[18] = 1.0/(0.001875*p0)
    p[19] = s4
    p[20] = 1.0/(0.016875*p1)
    p[21] = s5
    p[22] = s6
    p[23] = s8
    p[24] = s6 - s7
    p[25] = s7 - s8
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 214 operations, 156132 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # rod.theta [rad]
    v3 = y[12]  # rod.vx [m/s]
    v4 = y[13]  # rod.vy [m/s]
    v5 = y[14]  # rod.omega [rad/s]
    v6 = y[15]  # slider.vx [m/s]
    v7 = y[16]  # slider.vy [m/s]
    v8 = y[17]  # slider.omega [rad/s]
    p14 = p[14]
    p15 = p[15]
    p16 = p[16]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 0.075*s0
    s3 = 0.075*s1
    s4 = 0.075*(v2*v2)
    s5 = s0*s4
    s6 = s1*s4
    s7 = math.cos(q5)
    s8 = math.sin(q5)
    s9 = 0.225*s7
    s10 = 0.225*s8
    s11 = 0.225*(v5*v5)
    s12 = s7*s11
    s13 = s8*s11
    s14 = s3*p18
    s15 = s2*p18
    s16 = s10*p20
    s17 = s9*p20
    s18 = s3*s14
    s19 = p17 + s18
    s20 = s2*s14
    s21 = s18 - p17
    s22 = s2*s15
    s23 = p17 + s22
    s24 = s10*s16
    s25 = p19 + s19 + s24
    s26 = s9*s16
    s27 = s24 - p19
    s28 = s9*s17
    s29 = p19 + s23 + s28
    s30 = s10*s17
    s31 = p21 + p19 + s28
    s32 = 1.0/(mask_6 + p21)
    s33 = p21*s32
    s34 = 1.0/(mask_0 + s19)
    s35 = s20*s34
    s36 = s21*s34
    s37 = s20*s35
    s38 = s21*s35 - s3*s15
    s39 = s22 - p17 - s37
    s40 = mask_1 + s23 - s37
    s41 = 1.0/s40
    s42 = s38*s41
    s43 = s39*s41
    s44 = 1.0/(mask_4 + p21 + p19 + s24)
    s45 = s26*s44
    s46 = s27*s44
    s47 = s30*s44
    s48 = s27*s45 - s26
    s49 = s28 - p19 - s30*s45
    s50 = mask_5 + s31 - p21*s33 - s26*s45
    s51 = 1.0/s50
    s52 = s48*s51
    s53 = s49*s51
    s54 = s20*s36 - (s20 + s26) - s39*s42 + s30*s46 - s49*s52
    s55 = mask_2 + s25 - s21*s36 - s38*s42 - s27*s46 - s48*s52
    s56 = 1.0/s55
    s57 = s54*s56
    s58 = mask_3 + s29 - s37 - s39*s43 - s30*s47 - s49*s53 - s54*s57
    s59 = s5*s35
    s60 = s6 - p22 + s59
    s61 = s13 + p25 + p23*s33 + s12*s45
    s62 = s5 + s12 - s5*s36 - s42*s60 - s12*s46 - s52*s61
    s63 = 1.0/s58*(s6 + s13 + p24 + s59 - s43*s60 + s12*s47 - s53*s61 - s57*s62)
    s64 = s56*s62
    s65 = s57*s63
    s66 = s64 - s65
    s67 = s51*s61 - s52*s66
    s68 = s53*s63
    s69 = s67 - s68
    s70 = s12*s44 + s45*s69 - s46*s66 + s47*s63
    s71 = s41*s60 - s42*s66 - s43*s63
    s72 = s5*s34 + s35*s71 - s36*s66 + s35*s63
    s73 = p23*s32 + s33*s69
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
    ydot[9] = -p17*(s72 + s65 - s64)
    ydot[10] = -p17*(p14 + s71 - s63)
    ydot[11] = p18*(s2*s63 - (s3*s72 - s2*s71 + s3*s66))
    ydot[12] = p19*(s70 - s66)
    ydot[13] = -p19*(p15 + s63 + s68 - s67)
    ydot[14] = p20*(s9*s69 - (s10*s66 - s9*s63 + s10*s70))
    ydot[15] = -p21*s70
    ydot[16] = -p21*(p16 + s69 - s73)
    ydot[17] = 0.0
    ydot[18] = 0.0
    w[15] = s72
    w[16] = s71
    w[17] = s66
    w[18] = s63
    w[19] = s70
    w[20] = s69
    w[21] = -s73
    w[22] = 0.0
    return int(((((s40 < 1e-06*s23) | (s50 < 1e-06*s31)) | (s55 < 1e-06*s25)) | (s58 < 1e-06*s29)))


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
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[13] * w[6]
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
