"""Method `post-stabilization` for model `four-bar`. Emitted by symgen; do not edit.

one correction of positions and velocities after each step, not iterated
Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold, Reich, Mech. Struct. Mach. 23 (1995) 135-157
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = augmented
option weight = identity
"""

import math

from numba import njit

from .model import geometry, measure, spread

CHANGE = 63  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 27 operations, 33 before sharing."""
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
    # outputs
    p[15] = s0
    p[16] = -s1
    p[17] = s2
    p[18] = -s3
    p[19] = s4
    p[20] = -s5
    p[21] = 11111.111111111111*(s4 + p2 + p2 + s2 + p1 + p1 + s0 + p0 + p0)
    p[22] = -s1*(1.0/p0)
    p[23] = -s3*(1.0/p1)
    p[24] = -s5*(1.0/p2)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 227 operations, 12980 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
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
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
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
    s21 = p21*(1.0*(1.0 > mask_0))
    s22 = p21*(1.0*(1.0 > mask_1))
    s23 = p21*(1.0*(1.0 > mask_2))
    s24 = p21*(1.0*(1.0 > mask_3))
    s25 = p21*(1.0*(1.0 > mask_4))
    s26 = p21*(1.0*(1.0 > mask_5))
    s27 = p21*(1.0*(1.0 > mask_6))
    s28 = p21*(1.0*(1.0 > mask_7))
    s29 = s1*s21
    s30 = s0*s22
    s31 = s1*s23
    s32 = s29 - s31
    s33 = s10*s23
    s34 = s0*s24
    s35 = s34 - s30
    s36 = s8*s24
    s37 = s10*s25
    s38 = s17*s25
    s39 = s8*s26
    s40 = s16*s26
    s41 = s17*s27
    s42 = s41 - s38
    s43 = s16*s28
    s44 = s40 - s43
    s45 = 1.0/(s23 + p0 + s21)
    s46 = s32*s45
    s47 = s23*s45
    s48 = s33*s45
    s49 = s31 + s23*s46
    s50 = 1.0/(s24 + p0 + s22)
    s51 = s35*s50
    s52 = s24*s50
    s53 = s36*s50
    s54 = s24*s51 - s34
    s55 = s10*s31 + s8*s34 + s33*s46 - s36*s51
    s56 = 1.0/(s27 + p2 + s25)
    s57 = s42*s56
    s58 = s25*s56
    s59 = s37*s56
    s60 = s38 + s25*s57
    s61 = 1.0/(s28 + p2 + s26)
    s62 = s44*s61
    s63 = s26*s61
    s64 = s39*s61
    s65 = s26*s62 - s40
    s66 = s39*s62 - (s17*s37 + s16*s39 + s37*s57)
    s67 = 1.0/(p15 + s1*s29 + s0*s30 + s1*s31 + s0*s34 - s32*s46 - s35*s51)
    s68 = s49*s67
    s69 = s54*s67
    s70 = s55*s67
    s71 = p17 + s10*s33 + s8*s36 + s10*s37 + s8*s39 - s33*s48 - s36*s53 - s37*s59 - s39*s64 - s55*s70
    s72 = 1.0/(p19 + s17*s38 + s16*s40 + s17*s41 + s16*s43 - s42*s57 - s44*s62)
    s73 = s60*s72
    s74 = s65*s72
    s75 = s66*s72
    s76 = s54*s68 + s65*s73
    s77 = s33 - s37 - s33*s47 + s37*s58 - s55*s68 - s66*s73
    s78 = 1.0/(s25 + p1 + s23 - s23*s47 - s25*s58 - s49*s68 - s60*s73)
    s79 = s76*s78
    s80 = s77*s78
    s81 = s39 - s36 + s36*s52 - s39*s63 - s55*s69 - s66*s74 + s77*s79
    s82 = 1.0/(s26 + p1 + s24 - s24*s52 - s26*s63 - s54*s69 - s65*s74 - s76*s79)
    s83 = s81*s82
    # outputs
    w[117] = s46
    w[118] = -s47
    w[119] = -s48
    w[120] = s51
    w[121] = -s52
    w[122] = s53
    w[123] = s57
    w[124] = -s58
    w[125] = s59
    w[126] = s62
    w[127] = -s63
    w[128] = -s64
    w[129] = s68
    w[130] = s69
    w[131] = s70
    w[132] = s73
    w[133] = s74
    w[134] = s75
    w[135] = -s79
    w[136] = s80
    w[137] = s83
    w[138] = s45
    w[139] = s50
    w[140] = s56
    w[141] = s61
    w[142] = s67
    w[143] = s72
    w[144] = s78
    w[145] = s82
    w[146] = 1.0/(s71 - s66*s75 - s77*s80 - s81*s83)
    w[147] = s21
    w[148] = s22
    w[149] = s23
    w[150] = s24
    w[151] = s25
    w[152] = s26
    w[153] = s27
    w[154] = s28
    w[155] = s1
    w[156] = s3
    w[157] = s1
    w[158] = s10
    w[159] = s3
    w[160] = s9
    w[161] = s10
    w[162] = -s17
    w[163] = s9
    w[164] = s16
    w[165] = s17
    w[166] = -s16
    w[167] = p16
    w[168] = p18
    w[169] = p20
    w[170] = -s4
    w[171] = -s5
    w[172] = -(s4 + s12)
    w[173] = -(s5 + s13)
    w[174] = s19 - s12
    w[175] = s20 - s13
    w[176] = -s19
    w[177] = -s20
    w[178] = 0.0
    w[179] = p22
    w[180] = 0.0
    w[181] = 0.0
    w[182] = p23
    w[183] = 0.0
    w[184] = 0.0
    w[185] = p24
    w[186] = 0.0
    w[15] = 0.0
    w[16] = 0.0
    w[17] = 0.0
    w[18] = 0.0
    w[19] = 0.0
    w[20] = 0.0
    w[21] = 0.0
    w[22] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration of post-stabilization: 292 operations, 324332 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]
    p17 = p[17]
    p19 = p[19]
    kept_factor_0 = w[117]
    kept_factor_1 = w[118]
    kept_factor_2 = w[119]
    kept_factor_3 = w[120]
    kept_factor_4 = w[121]
    kept_factor_5 = w[122]
    kept_factor_6 = w[123]
    kept_factor_7 = w[124]
    kept_factor_8 = w[125]
    kept_factor_9 = w[126]
    kept_factor_10 = w[127]
    kept_factor_11 = w[128]
    kept_factor_12 = w[129]
    kept_factor_13 = w[130]
    kept_factor_14 = w[131]
    kept_factor_15 = w[132]
    kept_factor_16 = w[133]
    kept_factor_17 = w[134]
    kept_factor_18 = w[135]
    kept_factor_19 = w[136]
    kept_factor_20 = w[137]
    kept_factor_21 = w[138]
    kept_factor_22 = w[139]
    kept_factor_23 = w[140]
    kept_factor_24 = w[141]
    kept_factor_25 = w[142]
    kept_factor_26 = w[143]
    kept_factor_27 = w[144]
    kept_factor_28 = w[145]
    kept_factor_29 = w[146]
    kept_penalties_0 = w[147]
    kept_penalties_1 = w[148]
    kept_penalties_2 = w[149]
    kept_penalties_3 = w[150]
    kept_penalties_4 = w[151]
    kept_penalties_5 = w[152]
    kept_penalties_6 = w[153]
    kept_penalties_7 = w[154]
    kept_jacobian_0 = w[155]
    kept_jacobian_1 = w[156]
    kept_jacobian_2 = w[157]
    kept_jacobian_3 = w[158]
    kept_jacobian_4 = w[159]
    kept_jacobian_5 = w[160]
    kept_jacobian_6 = w[161]
    kept_jacobian_7 = w[162]
    kept_jacobian_8 = w[163]
    kept_jacobian_9 = w[164]
    kept_jacobian_10 = w[165]
    kept_jacobian_11 = w[166]
    kept_force_0 = w[167]
    kept_force_1 = w[168]
    kept_force_2 = w[169]
    kept_target_0 = w[170]
    kept_target_1 = w[171]
    kept_target_2 = w[172]
    kept_target_3 = w[173]
    kept_target_4 = w[174]
    kept_target_5 = w[175]
    kept_target_6 = w[176]
    kept_target_7 = w[177]
    kept_acceleration_0 = w[178]
    kept_acceleration_1 = w[179]
    kept_acceleration_2 = w[180]
    kept_acceleration_3 = w[181]
    kept_acceleration_4 = w[182]
    kept_acceleration_5 = w[183]
    kept_acceleration_6 = w[184]
    kept_acceleration_7 = w[185]
    kept_acceleration_8 = w[186]
    multipliers_0 = w[15]
    multipliers_1 = w[16]
    multipliers_2 = w[17]
    multipliers_3 = w[18]
    multipliers_4 = w[19]
    multipliers_5 = w[20]
    multipliers_6 = w[21]
    multipliers_7 = w[22]
    # intermediate terms
    s0 = kept_acceleration_3 + kept_jacobian_2*kept_acceleration_2 - kept_acceleration_0 + kept_jacobian_3*kept_acceleration_5
    s1 = kept_acceleration_4 + kept_jacobian_4*kept_acceleration_2 - kept_acceleration_1 + kept_jacobian_5*kept_acceleration_5
    s2 = kept_acceleration_6 + kept_jacobian_6*kept_acceleration_5 - kept_acceleration_3 + kept_jacobian_7*kept_acceleration_8
    s3 = kept_acceleration_7 + kept_jacobian_8*kept_acceleration_5 - kept_acceleration_4 + kept_jacobian_9*kept_acceleration_8
    s4 = kept_penalties_0*(kept_acceleration_0 + kept_jacobian_0*kept_acceleration_2 - kept_target_0)
    s5 = kept_penalties_1*(kept_acceleration_1 + kept_jacobian_1*kept_acceleration_2 - kept_target_1)
    s6 = kept_penalties_6*(kept_acceleration_6 + kept_jacobian_10*kept_acceleration_8 - kept_target_6)
    s7 = kept_penalties_7*(kept_acceleration_7 + kept_jacobian_11*kept_acceleration_8 - kept_target_7)
    s8 = multipliers_0 + s4
    s9 = multipliers_1 + s5
    s10 = multipliers_2 + kept_penalties_2*(s0 - kept_target_2)
    s11 = multipliers_3 + kept_penalties_3*(s1 - kept_target_3)
    s12 = multipliers_4 + kept_penalties_4*(s2 - kept_target_4)
    s13 = multipliers_5 + kept_penalties_5*(s3 - kept_target_5)
    s14 = multipliers_6 + s6
    s15 = multipliers_7 + s7
    s16 = p0*kept_acceleration_0 + s8 - s10
    s17 = kept_force_0 - p0*kept_acceleration_1 - (s9 - s11)
    s18 = p15*kept_acceleration_2 + kept_jacobian_0*s8 + kept_jacobian_1*s9 + kept_jacobian_2*s10 + kept_jacobian_4*s11
    s19 = p17*kept_acceleration_5 + kept_jacobian_3*s10 + kept_jacobian_5*s11 + kept_jacobian_6*s12 + kept_jacobian_8*s13
    s20 = p2*kept_acceleration_6 + s12 + s14
    s21 = kept_force_2 - p2*kept_acceleration_7 - (s13 + s15)
    s22 = p19*kept_acceleration_8 + kept_jacobian_7*s12 + kept_jacobian_9*s13 + kept_jacobian_10*s14 + kept_jacobian_11*s15
    s23 = kept_factor_0*s16 - s18 - kept_factor_3*s17
    s24 = kept_factor_6*s20 - s22 - kept_factor_9*s21
    s25 = kept_force_1 - p1*kept_acceleration_4 - (s11 - s13) - kept_factor_4*s17 - kept_factor_10*s21
    s26 = kept_factor_1*s16 - (p1*kept_acceleration_3 + s10 - s12) + kept_factor_7*s20 - kept_factor_12*s23
    s27 = kept_factor_2*s16 - s19 - kept_factor_5*s17 + kept_factor_8*s20 - kept_factor_11*s21 - kept_factor_14*s23
    s28 = s26 - kept_factor_15*s24
    s29 = s25 - kept_factor_13*s23 - kept_factor_16*s24 - kept_factor_18*s28
    s30 = kept_factor_29*(s27 - kept_factor_17*s24 - kept_factor_19*s28 - kept_factor_20*s29)
    s31 = kept_factor_28*s29 - kept_factor_20*s30
    s32 = kept_factor_27*s28 - kept_factor_18*s31 - kept_factor_19*s30
    s33 = kept_factor_26*s24 - kept_factor_15*s32 - kept_factor_16*s31 - kept_factor_17*s30
    s34 = kept_factor_25*s23 - kept_factor_12*s32 - kept_factor_13*s31 - kept_factor_14*s30
    s35 = kept_factor_24*s21 - kept_factor_9*s33 - kept_factor_10*s31 - kept_factor_11*s30
    s36 = kept_factor_23*s20 + kept_factor_6*s33 + kept_factor_7*s32 + kept_factor_8*s30
    s37 = kept_factor_22*s17 - kept_factor_3*s34 - kept_factor_4*s31 - kept_factor_5*s30
    s38 = kept_factor_21*s16 + kept_factor_0*s34 + kept_factor_1*s32 + kept_factor_2*s30
    s39 = kept_acceleration_0 - s38
    s40 = kept_acceleration_1 + s37
    s41 = kept_acceleration_2 + s34
    s42 = kept_acceleration_3 + s32
    s43 = kept_acceleration_4 + s31
    s44 = kept_acceleration_5 + s30
    s45 = kept_acceleration_6 - s36
    s46 = kept_acceleration_7 + s35
    s47 = kept_acceleration_8 + s33
    s48 = s42 + s38 - kept_acceleration_0 + kept_jacobian_2*s41 + kept_jacobian_3*s44 - kept_target_2
    s49 = multipliers_3 + kept_penalties_3*(s43 + kept_jacobian_4*s41 - s40 + kept_jacobian_5*s44 - kept_target_3)
    s50 = multipliers_4 + kept_penalties_4*(s45 + kept_jacobian_6*s44 - s42 + kept_jacobian_7*s47 - kept_target_4)
    s51 = multipliers_5 + kept_penalties_5*(s46 + kept_jacobian_8*s44 - s43 + kept_jacobian_9*s47 - kept_target_5)
    s52 = 1.0 + s39*s39 + s40*s40 + s41*s41 + s42*s42 + s43*s43 + s44*s44 + s45*s45 + s46*s46 + s47*s47
    s53 = (s38*s38 + s37*s37 + s34*s34 + s32*s32 + s31*s31 + s30*s30 + s36*s36 + s35*s35 + s33*s33)/s52
    # outputs
    w[178] = s39
    w[179] = s40
    w[180] = s41
    w[181] = s42
    w[182] = s43
    w[183] = s44
    w[184] = s45
    w[185] = s46
    w[186] = s47
    w[15] = multipliers_0 + kept_penalties_0*(s39 + kept_jacobian_0*s41 - kept_target_0)
    w[16] = multipliers_1 + kept_penalties_1*(s40 + kept_jacobian_1*s41 - kept_target_1)
    w[17] = multipliers_2 + kept_penalties_2*s48
    w[18] = s49
    w[19] = s50
    w[20] = s51
    w[21] = multipliers_6 + kept_penalties_6*(s45 + kept_jacobian_10*s47 - kept_target_6)
    w[22] = multipliers_7 + kept_penalties_7*(s46 + kept_jacobian_11*s47 - kept_target_7)
    w[9] = math.sqrt(s53)
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
    kept_acceleration_0 = w[178]
    kept_acceleration_1 = w[179]
    kept_acceleration_2 = w[180]
    kept_acceleration_3 = w[181]
    kept_acceleration_4 = w[182]
    kept_acceleration_5 = w[183]
    kept_acceleration_6 = w[184]
    kept_acceleration_7 = w[185]
    kept_acceleration_8 = w[186]
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
    for round in range(2):
        geometry(t, y, p, w)
        violation = w[0]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        closed = violation <= tolerance or stalled or round == 1
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
