"""Method `baumgarte` for model `four-bar`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 1, templates 2b445adb8ae4f174
option solver = augmented
p[15] alpha (default 5.0)
p[16] beta (default 5.0)
"""

import math

from numba import njit

from .model import geometry, measure

CHANGE = 61  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 45 operations, 385 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]
    p16 = p[16]
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
    p[17] = s0
    p[18] = -s1
    p[19] = s2
    p[20] = -s3
    p[21] = s4
    p[22] = -s5
    p[23] = s6
    p[24] = 2.0*p15
    p[25] = p16*p16
    p[26] = s7
    p[27] = s8
    p[28] = -s8
    p[29] = s9
    p[30] = s10
    p[31] = -s10
    p[32] = s6 + p1 + s6 - s6*s8 - s6*s10
    p[33] = -s1*(1.0/p0)
    p[34] = -s3*(1.0/p1)
    p[35] = -s5*(1.0/p2)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 204 operations, 3021 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    v0 = y[9]  # crank.vx [m/s]
    q1 = y[1]  # crank.y [m]
    v1 = y[10]  # crank.vy [m/s]
    q2 = y[2]  # crank.theta [rad]
    v2 = y[11]  # crank.omega [rad/s]
    q3 = y[3]  # coupler.x [m]
    v3 = y[12]  # coupler.vx [m/s]
    q4 = y[4]  # coupler.y [m]
    v4 = y[13]  # coupler.vy [m/s]
    q5 = y[5]  # coupler.theta [rad]
    v5 = y[14]  # coupler.omega [rad/s]
    q6 = y[6]  # rocker.x [m]
    v6 = y[15]  # rocker.vx [m/s]
    q7 = y[7]  # rocker.y [m]
    v7 = y[16]  # rocker.vy [m/s]
    q8 = y[8]  # rocker.theta [rad]
    v8 = y[17]  # rocker.omega [rad/s]
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
    p32 = p[32]
    p33 = p[33]
    p34 = p[34]
    p35 = p[35]
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
    s21 = v2*s1
    s22 = v2*s0
    s23 = v5*s10
    s24 = v5*s8
    s25 = v8*s17
    s26 = v8*s16
    s27 = s1*p23
    s28 = s1*s27
    s29 = s0*p23
    s30 = s0*s29
    s31 = s10*p23
    s32 = s10*s31
    s33 = s8*p23
    s34 = s10*s27 + s8*s29
    s35 = s8*s33
    s36 = s17*p23
    s37 = s17*s36
    s38 = s16*p23
    s39 = s17*s31 + s16*s33
    s40 = s16*s38
    s41 = s31*p26
    s42 = s33*p26
    s43 = s31*p29
    s44 = s33*p29
    s45 = 1.0/(s30 + s28 + p17 + s28 + s30)
    s46 = s27*s45
    s47 = s29*s45
    s48 = s34*s45
    s49 = 1.0/(s40 + s37 + p21 + s37 + s40)
    s50 = s36*s49
    s51 = s38*s49
    s52 = s39*s49
    s53 = s29*s46 + s38*s50
    s54 = s31*p30 - s31*p27 - s34*s46 + s39*s50
    s55 = 1.0/(p32 - s27*s46 - s36*s50)
    s56 = s53*s55
    s57 = s54*s55
    s58 = s33*p27 - s33*p30 + s34*s47 - s39*s51 - s54*s56
    s59 = s35 + s32 + p19 + s32 + s35 - s31*s41 - s33*s42 - s31*s43 - s33*s44 - s34*s48 - s39*s52 - s54*s57
    s60 = 1.0/(p32 - s29*s47 - s38*s51 - s53*s56)
    s61 = s58*s60
    # outputs
    w[115] = p28
    w[116] = -s41
    w[117] = p28
    w[118] = s42
    w[119] = p31
    w[120] = s43
    w[121] = p31
    w[122] = -s44
    w[123] = s46
    w[124] = -s47
    w[125] = s48
    w[126] = s50
    w[127] = -s51
    w[128] = -s52
    w[129] = s56
    w[130] = s57
    w[131] = s61
    w[132] = p26
    w[133] = p26
    w[134] = p29
    w[135] = p29
    w[136] = s45
    w[137] = s49
    w[138] = s55
    w[139] = s60
    w[140] = 1.0/(s59 - s58*s61)
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
    w[153] = p18
    w[154] = p20
    w[155] = p22
    w[156] = -(s4 + (v0 + s21)*p24 + (q0 - s0)*p25)
    w[157] = -(s5 + (v1 - s22)*p24 + (q1 - s1)*p25)
    w[158] = -(s4 + s12 + (v3 + s21 - v0 + s23)*p24 + (q3 - q0 - s8 - s0)*p25)
    w[159] = -(s5 + s13 + (v4 - (v1 + s22) - s24)*p24 + (q4 - q1 - s10 - s1)*p25)
    w[160] = s19 - s12 - (v6 + s23 - v3 - s25)*p24 - (q6 - q3 + s16 - s8)*p25
    w[161] = s20 - s13 - (v7 - (v4 + s24) + s26)*p24 - (q7 - q4 + s17 - s10)*p25
    w[162] = -(s19 + (v6 + s25)*p24 + (q6 - 10.0 - s16)*p25)
    w[163] = -(s20 + (v7 - s26)*p24 + (q7 - s17)*p25)
    w[164] = 0.0
    w[165] = p33
    w[166] = 0.0
    w[167] = 0.0
    w[168] = p34
    w[169] = 0.0
    w[170] = 0.0
    w[171] = p35
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
    """one iteration of baumgarte: 276 operations, 128264 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p17 = p[17]
    p19 = p[19]
    p21 = p[21]
    p23 = p[23]
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
    s4 = multipliers_0 + p23*(kept_acceleration_0 + kept_jacobian_0*kept_acceleration_2 - kept_target_0)
    s5 = multipliers_1 + p23*(kept_acceleration_1 + kept_jacobian_1*kept_acceleration_2 - kept_target_1)
    s6 = multipliers_2 + p23*(s0 - kept_target_2)
    s7 = multipliers_3 + p23*(s1 - kept_target_3)
    s8 = multipliers_4 + p23*(s2 - kept_target_4)
    s9 = multipliers_5 + p23*(s3 - kept_target_5)
    s10 = multipliers_6 + p23*(kept_acceleration_6 + kept_jacobian_10*kept_acceleration_8 - kept_target_6)
    s11 = multipliers_7 + p23*(kept_acceleration_7 + kept_jacobian_11*kept_acceleration_8 - kept_target_7)
    s12 = p0*kept_acceleration_0 + s4 - s6
    s13 = kept_force_0 - p0*kept_acceleration_1 - (s5 - s7)
    s14 = p17*kept_acceleration_2 + kept_jacobian_0*s4 + kept_jacobian_1*s5 + kept_jacobian_2*s6 + kept_jacobian_4*s7
    s15 = p19*kept_acceleration_5 + kept_jacobian_3*s6 + kept_jacobian_5*s7 + kept_jacobian_6*s8 + kept_jacobian_8*s9
    s16 = p2*kept_acceleration_6 + s8 + s10
    s17 = kept_force_2 - p2*kept_acceleration_7 - (s9 + s11)
    s18 = p21*kept_acceleration_8 + kept_jacobian_7*s8 + kept_jacobian_9*s9 + kept_jacobian_10*s10 + kept_jacobian_11*s11
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
    s43 = multipliers_3 + p23*(s37 + kept_jacobian_4*s35 - s34 + kept_jacobian_5*s38 - kept_target_3)
    s44 = multipliers_4 + p23*(s39 + kept_jacobian_6*s38 - s36 + kept_jacobian_7*s41 - kept_target_4)
    s45 = multipliers_5 + p23*(s40 + kept_jacobian_8*s38 - s37 + kept_jacobian_9*s41 - kept_target_5)
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
    w[13] = multipliers_0 + p23*(s33 + kept_jacobian_0*s35 - kept_target_0)
    w[14] = multipliers_1 + p23*(s34 + kept_jacobian_1*s35 - kept_target_1)
    w[15] = multipliers_2 + p23*s42
    w[16] = s43
    w[17] = s44
    w[18] = s45
    w[19] = multipliers_6 + p23*(s39 + kept_jacobian_10*s41 - kept_target_6)
    w[20] = multipliers_7 + p23*(s40 + kept_jacobian_11*s41 - kept_target_7)
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
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
