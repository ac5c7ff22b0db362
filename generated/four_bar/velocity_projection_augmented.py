"""Method `velocity-projection` for model `four-bar`. Emitted by symgen; do not edit.

velocities are projected after each step; positions are left
Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 1, templates 2b445adb8ae4f174
option solver = augmented
option weight = identity
"""

import math

from numba import njit

from .model import geometry, measure, spread

CHANGE = 61  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 43 operations, 383 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 0.3333333333333333*p0
    s1 = 9.81*p0
    s2 = 5.333333333333333*p1
    s3 = 9.81*p1
    s4 = 2.083333333333333*p2
    s5 = 9.81*p2
    s6 = 11111.111111111111*(s4 + p2 + p2 + s2 + p1 + p1 + s0 + p0 + p0)
    s7 = 1.0/(s6 + p0 + s6)
    s8 = s6*s7
    s9 = 1.0/(s6 + p2 + s6)
    s10 = s6*s9
    # outputs
    p[15] = s0
    p[16] = -s1
    p[17] = s2
    p[18] = -s3
    p[19] = s4
    p[20] = -s5
    p[21] = s6
    p[22] = s7
    p[23] = s8
    p[24] = -s8
    p[25] = s9
    p[26] = s10
    p[27] = -s10
    p[28] = s6 + p1 + s6 - s6*s8 - s6*s10
    p[29] = -s1*(1.0/p0)
    p[30] = -s3*(1.0/p1)
    p[31] = -s5*(1.0/p2)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 133 operations, 2904 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
    p15 = p[15]
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    p29 = p[29]
    p30 = p[30]
    p31 = p[31]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = -s0
    s4 = s0*s2
    s5 = s1*s2
    s6 = math.cos(q5)
    s7 = math.sin(q5)
    s8 = 4.0*s6
    s9 = -s8
    s10 = 4.0*s7
    s11 = 4.0*(v5*v5)
    s12 = s6*s11
    s13 = s7*s11
    s14 = math.cos(q8)
    s15 = math.sin(q8)
    s16 = 2.5*s14
    s17 = 2.5*s15
    s18 = 2.5*(v8*v8)
    s19 = s14*s18
    s20 = s15*s18
    s21 = s1*p21
    s22 = s1*s21
    s23 = s0*p21
    s24 = s0*s23
    s25 = s10*p21
    s26 = s10*s25
    s27 = s8*p21
    s28 = s10*s21 + s8*s23
    s29 = s8*s27
    s30 = s17*p21
    s31 = s17*s30
    s32 = s16*p21
    s33 = s17*s25 + s16*s27
    s34 = s16*s32
    s35 = s25*p22
    s36 = s27*p22
    s37 = s25*p25
    s38 = s27*p25
    s39 = 1.0/(s24 + s22 + p15 + s22 + s24)
    s40 = s21*s39
    s41 = s23*s39
    s42 = s28*s39
    s43 = 1.0/(s34 + s31 + p19 + s31 + s34)
    s44 = s30*s43
    s45 = s32*s43
    s46 = s33*s43
    s47 = s23*s40 + s32*s44
    s48 = s25*p26 - s25*p23 - s28*s40 + s33*s44
    s49 = 1.0/(p28 - s21*s40 - s30*s44)
    s50 = s47*s49
    s51 = s48*s49
    s52 = s27*p23 - s27*p26 + s28*s41 - s33*s45 - s48*s50
    s53 = s29 + s26 + p17 + s26 + s29 - s25*s35 - s27*s36 - s25*s37 - s27*s38 - s28*s42 - s33*s46 - s48*s51
    s54 = 1.0/(p28 - s23*s41 - s32*s45 - s47*s50)
    s55 = s52*s54
    # outputs
    w[115] = p24
    w[116] = -s35
    w[117] = p24
    w[118] = s36
    w[119] = p27
    w[120] = s37
    w[121] = p27
    w[122] = -s38
    w[123] = s40
    w[124] = -s41
    w[125] = s42
    w[126] = s44
    w[127] = -s45
    w[128] = -s46
    w[129] = s50
    w[130] = s51
    w[131] = s55
    w[132] = p22
    w[133] = p22
    w[134] = p25
    w[135] = p25
    w[136] = s39
    w[137] = s43
    w[138] = s49
    w[139] = s54
    w[140] = 1.0/(s53 - s52*s55)
    w[141] = s1
    w[142] = s3
    w[143] = s1
    w[144] = s10
    w[145] = s3
    w[146] = s9
    w[147] = s10
    w[148] = -s17
    w[149] = s9
    w[150] = s16
    w[151] = s17
    w[152] = -s16
    w[153] = p16
    w[154] = p18
    w[155] = p20
    w[156] = -s4
    w[157] = -s5
    w[158] = -(s4 + s12)
    w[159] = -(s5 + s13)
    w[160] = s19 - s12
    w[161] = s20 - s13
    w[162] = -s19
    w[163] = -s20
    w[164] = 0.0
    w[165] = p29
    w[166] = 0.0
    w[167] = 0.0
    w[168] = p30
    w[169] = 0.0
    w[170] = 0.0
    w[171] = p31
    w[172] = 0.0
    w[13] = 0.0
    w[14] = 0.0
    w[15] = 0.0
    w[16] = 0.0
    w[17] = 0.0
    w[18] = 0.0
    w[19] = 0.0
    w[20] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration of velocity-projection: 276 operations, 128264 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]
    p17 = p[17]
    p19 = p[19]
    p21 = p[21]
    kept_factor_0 = w[115]
    kept_factor_1 = w[116]
    kept_factor_2 = w[117]
    kept_factor_3 = w[118]
    kept_factor_4 = w[119]
    kept_factor_5 = w[120]
    kept_factor_6 = w[121]
    kept_factor_7 = w[122]
    kept_factor_8 = w[123]
    kept_factor_9 = w[124]
    kept_factor_10 = w[125]
    kept_factor_11 = w[126]
    kept_factor_12 = w[127]
    kept_factor_13 = w[128]
    kept_factor_14 = w[129]
    kept_factor_15 = w[130]
    kept_factor_16 = w[131]
    kept_factor_17 = w[132]
    kept_factor_18 = w[133]
    kept_factor_19 = w[134]
    kept_factor_20 = w[135]
    kept_factor_21 = w[136]
    kept_factor_22 = w[137]
    kept_factor_23 = w[138]
    kept_factor_24 = w[139]
    kept_factor_25 = w[140]
    kept_jacobian_0 = w[141]
    kept_jacobian_1 = w[142]
    kept_jacobian_2 = w[143]
    kept_jacobian_3 = w[144]
    kept_jacobian_4 = w[145]
    kept_jacobian_5 = w[146]
    kept_jacobian_6 = w[147]
    kept_jacobian_7 = w[148]
    kept_jacobian_8 = w[149]
    kept_jacobian_9 = w[150]
    kept_jacobian_10 = w[151]
    kept_jacobian_11 = w[152]
    kept_force_0 = w[153]
    kept_force_1 = w[154]
    kept_force_2 = w[155]
    kept_target_0 = w[156]
    kept_target_1 = w[157]
    kept_target_2 = w[158]
    kept_target_3 = w[159]
    kept_target_4 = w[160]
    kept_target_5 = w[161]
    kept_target_6 = w[162]
    kept_target_7 = w[163]
    kept_acceleration_0 = w[164]
    kept_acceleration_1 = w[165]
    kept_acceleration_2 = w[166]
    kept_acceleration_3 = w[167]
    kept_acceleration_4 = w[168]
    kept_acceleration_5 = w[169]
    kept_acceleration_6 = w[170]
    kept_acceleration_7 = w[171]
    kept_acceleration_8 = w[172]
    multipliers_0 = w[13]
    multipliers_1 = w[14]
    multipliers_2 = w[15]
    multipliers_3 = w[16]
    multipliers_4 = w[17]
    multipliers_5 = w[18]
    multipliers_6 = w[19]
    multipliers_7 = w[20]
    # intermediate terms
    s0 = kept_acceleration_3 + kept_jacobian_2*kept_acceleration_2 - kept_acceleration_0 + kept_jacobian_3*kept_acceleration_5
    s1 = kept_acceleration_4 + kept_jacobian_4*kept_acceleration_2 - kept_acceleration_1 + kept_jacobian_5*kept_acceleration_5
    s2 = kept_acceleration_6 + kept_jacobian_6*kept_acceleration_5 - kept_acceleration_3 + kept_jacobian_7*kept_acceleration_8
    s3 = kept_acceleration_7 + kept_jacobian_8*kept_acceleration_5 - kept_acceleration_4 + kept_jacobian_9*kept_acceleration_8
    s4 = multipliers_0 + p21*(kept_acceleration_0 + kept_jacobian_0*kept_acceleration_2 - kept_target_0)
    s5 = multipliers_1 + p21*(kept_acceleration_1 + kept_jacobian_1*kept_acceleration_2 - kept_target_1)
    s6 = multipliers_2 + p21*(s0 - kept_target_2)
    s7 = multipliers_3 + p21*(s1 - kept_target_3)
    s8 = multipliers_4 + p21*(s2 - kept_target_4)
    s9 = multipliers_5 + p21*(s3 - kept_target_5)
    s10 = multipliers_6 + p21*(kept_acceleration_6 + kept_jacobian_10*kept_acceleration_8 - kept_target_6)
    s11 = multipliers_7 + p21*(kept_acceleration_7 + kept_jacobian_11*kept_acceleration_8 - kept_target_7)
    s12 = p0*kept_acceleration_0 + s4 - s6
    s13 = kept_force_0 - p0*kept_acceleration_1 - (s5 - s7)
    s14 = p15*kept_acceleration_2 + kept_jacobian_0*s4 + kept_jacobian_1*s5 + kept_jacobian_2*s6 + kept_jacobian_4*s7
    s15 = p17*kept_acceleration_5 + kept_jacobian_3*s6 + kept_jacobian_5*s7 + kept_jacobian_6*s8 + kept_jacobian_8*s9
    s16 = p2*kept_acceleration_6 + s8 + s10
    s17 = kept_force_2 - p2*kept_acceleration_7 - (s9 + s11)
    s18 = p19*kept_acceleration_8 + kept_jacobian_7*s8 + kept_jacobian_9*s9 + kept_jacobian_10*s10 + kept_jacobian_11*s11
    s19 = kept_factor_0*s12 - (p1*kept_acceleration_3 + s6 - s8) + kept_factor_4*s16 + kept_factor_8*s14
    s20 = kept_force_1 - p1*kept_acceleration_4 - (s7 - s9) - kept_factor_2*s13 - kept_factor_6*s17 + kept_factor_9*s14
    s21 = kept_factor_1*s12 - s15 - kept_factor_3*s13 + kept_factor_5*s16 - kept_factor_7*s17 + kept_factor_10*s14
    s22 = s19 + kept_factor_11*s18
    s23 = s20 + kept_factor_12*s18 - kept_factor_14*s22
    s24 = kept_factor_25*(s21 + kept_factor_13*s18 - kept_factor_15*s22 - kept_factor_16*s23)
    s25 = kept_factor_24*s23 - kept_factor_16*s24
    s26 = kept_factor_23*s22 - kept_factor_14*s25 - kept_factor_15*s24
    s27 = kept_factor_22*s18 + kept_factor_11*s26 + kept_factor_12*s25 + kept_factor_13*s24
    s28 = kept_factor_21*s14 + kept_factor_8*s26 + kept_factor_9*s25 + kept_factor_10*s24
    s29 = kept_factor_20*s17 - kept_factor_6*s25 - kept_factor_7*s24
    s30 = kept_factor_19*s16 + kept_factor_4*s26 + kept_factor_5*s24
    s31 = kept_factor_18*s13 - kept_factor_2*s25 - kept_factor_3*s24
    s32 = kept_factor_17*s12 + kept_factor_0*s26 + kept_factor_1*s24
    s33 = kept_acceleration_0 - s32
    s34 = kept_acceleration_1 + s31
    s35 = kept_acceleration_2 - s28
    s36 = kept_acceleration_3 + s26
    s37 = kept_acceleration_4 + s25
    s38 = kept_acceleration_5 + s24
    s39 = kept_acceleration_6 - s30
    s40 = kept_acceleration_7 + s29
    s41 = kept_acceleration_8 - s27
    s42 = s36 + s32 - kept_acceleration_0 + kept_jacobian_2*s35 + kept_jacobian_3*s38 - kept_target_2
    s43 = multipliers_3 + p21*(s37 + kept_jacobian_4*s35 - s34 + kept_jacobian_5*s38 - kept_target_3)
    s44 = multipliers_4 + p21*(s39 + kept_jacobian_6*s38 - s36 + kept_jacobian_7*s41 - kept_target_4)
    s45 = multipliers_5 + p21*(s40 + kept_jacobian_8*s38 - s37 + kept_jacobian_9*s41 - kept_target_5)
    s46 = 1.0 + s33*s33 + s34*s34 + s35*s35 + s36*s36 + s37*s37 + s38*s38 + s39*s39 + s40*s40 + s41*s41
    s47 = (s32*s32 + s31*s31 + s28*s28 + s26*s26 + s25*s25 + s24*s24 + s30*s30 + s29*s29 + s27*s27)/s46
    # outputs
    w[164] = s33
    w[165] = s34
    w[166] = s35
    w[167] = s36
    w[168] = s37
    w[169] = s38
    w[170] = s39
    w[171] = s40
    w[172] = s41
    w[13] = multipliers_0 + p21*(s33 + kept_jacobian_0*s35 - kept_target_0)
    w[14] = multipliers_1 + p21*(s34 + kept_jacobian_1*s35 - kept_target_1)
    w[15] = multipliers_2 + p21*s42
    w[16] = s43
    w[17] = s44
    w[18] = s45
    w[19] = multipliers_6 + p21*(s39 + kept_jacobian_10*s41 - kept_target_6)
    w[20] = multipliers_7 + p21*(s40 + kept_jacobian_11*s41 - kept_target_7)
    w[9] = math.sqrt(s47)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power: 0 operations, 0 before sharing."""
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
    kept_acceleration_0 = w[164]
    kept_acceleration_1 = w[165]
    kept_acceleration_2 = w[166]
    kept_acceleration_3 = w[167]
    kept_acceleration_4 = w[168]
    kept_acceleration_5 = w[169]
    kept_acceleration_6 = w[170]
    kept_acceleration_7 = w[171]
    kept_acceleration_8 = w[172]
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
    ydot[9] = kept_acceleration_0
    ydot[10] = kept_acceleration_1
    ydot[11] = kept_acceleration_2
    ydot[12] = kept_acceleration_3
    ydot[13] = kept_acceleration_4
    ydot[14] = kept_acceleration_5
    ydot[15] = kept_acceleration_6
    ydot[16] = kept_acceleration_7
    ydot[17] = kept_acceleration_8
    ydot[18] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state by iteration until v' changes no more, at most 30 times."""
    begin(t, y, p, w)
    last = math.inf
    for _ in range(30):
        iterate(p, w)
        iw[6] += 1
        increment = w[9]
        # at the floor of rounding another iteration gains nothing
        if increment <= 1e-13 or (increment > 0.5 * last and increment < 1e-6):
            break
        last = increment
    finish(t, y, p, w, ydot)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = 0.0
    last = math.inf
    bits = 2
    for round in range(1):
        geometry(t, y, p, w)
        violation = w[0]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        closed = violation <= tolerance or stalled or round == 0
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
    measure(t, y, p, w)
    return bits
