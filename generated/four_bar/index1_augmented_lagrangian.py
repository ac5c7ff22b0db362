"""Method `index1-augmented-lagrangian` for model `four-bar`. Emitted by symgen; do not edit.

iterated multipliers for accelerations, mass-orthogonal projections of positions and velocities
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130; Cuadrado, Cardenal, Bayo, Multibody Syst. Dyn. 1 (1997) 259-280
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 1, templates 2b445adb8ae4f174
p[15] penalty (default 10000000.0)
p[16] iteration_tolerance (default 1e-13)
p[17] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

RESIDUAL = 37  # sections of w
CHANGE = 61
MOVED = 199
FORCE_OF_CONSTRAINTS = 208


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 34 operations, 59 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    s3 = 1.0/(p15 + p0 + p15)
    s4 = p15*s3
    s5 = 1.0/(p15 + p2 + p15)
    s6 = p15*s5
    # outputs
    p[18] = 0.3333333333333333*p0
    p[19] = -s0
    p[20] = 5.333333333333333*p1
    p[21] = -s1
    p[22] = 2.083333333333333*p2
    p[23] = -s2
    p[24] = s3
    p[25] = s4
    p[26] = -s4
    p[27] = s5
    p[28] = s6
    p[29] = -s6
    p[30] = p15 + p1 + p15 - p15*s4 - p15*s6
    p[31] = -s0*(1.0/p0)
    p[32] = -s1*(1.0/p1)
    p[33] = -s2*(1.0/p2)
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
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p15 = p[15]
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
    s21 = s1*p15
    s22 = s1*s21
    s23 = s0*p15
    s24 = s0*s23
    s25 = s10*p15
    s26 = s10*s25
    s27 = s8*p15
    s28 = s10*s21 + s8*s23
    s29 = s8*s27
    s30 = s17*p15
    s31 = s17*s30
    s32 = s16*p15
    s33 = s17*s25 + s16*s27
    s34 = s16*s32
    s35 = s25*p24
    s36 = s27*p24
    s37 = s25*p27
    s38 = s27*p27
    s39 = 1.0/(s24 + s22 + p18 + s22 + s24)
    s40 = s21*s39
    s41 = s23*s39
    s42 = s28*s39
    s43 = 1.0/(s34 + s31 + p22 + s31 + s34)
    s44 = s30*s43
    s45 = s32*s43
    s46 = s33*s43
    s47 = s23*s40 + s32*s44
    s48 = s25*p28 - s25*p25 - s28*s40 + s33*s44
    s49 = 1.0/(p30 - s21*s40 - s30*s44)
    s50 = s47*s49
    s51 = s48*s49
    s52 = s27*p25 - s27*p28 + s28*s41 - s33*s45 - s48*s50
    s53 = s29 + s26 + p20 + s26 + s29 - s25*s35 - s27*s36 - s25*s37 - s27*s38 - s28*s42 - s33*s46 - s48*s51
    s54 = 1.0/(p30 - s23*s41 - s32*s45 - s47*s50)
    s55 = s52*s54
    # outputs
    w[115] = p26
    w[116] = -s35
    w[117] = p26
    w[118] = s36
    w[119] = p29
    w[120] = s37
    w[121] = p29
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
    w[132] = p24
    w[133] = p24
    w[134] = p27
    w[135] = p27
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
    w[153] = p19
    w[154] = p21
    w[155] = p23
    w[156] = -s4
    w[157] = -s5
    w[158] = -(s4 + s12)
    w[159] = -(s5 + s13)
    w[160] = s19 - s12
    w[161] = s20 - s13
    w[162] = -s19
    w[163] = -s20
    w[164] = 0.0
    w[165] = p31
    w[166] = 0.0
    w[167] = 0.0
    w[168] = p32
    w[169] = 0.0
    w[170] = 0.0
    w[171] = p33
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
    """one iteration of index1-augmented-lagrangian: 276 operations, 128264 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p18 = p[18]
    p20 = p[20]
    p22 = p[22]
    p15 = p[15]
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
    s4 = multipliers_0 + p15*(kept_acceleration_0 + kept_jacobian_0*kept_acceleration_2 - kept_target_0)
    s5 = multipliers_1 + p15*(kept_acceleration_1 + kept_jacobian_1*kept_acceleration_2 - kept_target_1)
    s6 = multipliers_2 + p15*(s0 - kept_target_2)
    s7 = multipliers_3 + p15*(s1 - kept_target_3)
    s8 = multipliers_4 + p15*(s2 - kept_target_4)
    s9 = multipliers_5 + p15*(s3 - kept_target_5)
    s10 = multipliers_6 + p15*(kept_acceleration_6 + kept_jacobian_10*kept_acceleration_8 - kept_target_6)
    s11 = multipliers_7 + p15*(kept_acceleration_7 + kept_jacobian_11*kept_acceleration_8 - kept_target_7)
    s12 = p0*kept_acceleration_0 + s4 - s6
    s13 = kept_force_0 - p0*kept_acceleration_1 - (s5 - s7)
    s14 = p18*kept_acceleration_2 + kept_jacobian_0*s4 + kept_jacobian_1*s5 + kept_jacobian_2*s6 + kept_jacobian_4*s7
    s15 = p20*kept_acceleration_5 + kept_jacobian_3*s6 + kept_jacobian_5*s7 + kept_jacobian_6*s8 + kept_jacobian_8*s9
    s16 = p2*kept_acceleration_6 + s8 + s10
    s17 = kept_force_2 - p2*kept_acceleration_7 - (s9 + s11)
    s18 = p22*kept_acceleration_8 + kept_jacobian_7*s8 + kept_jacobian_9*s9 + kept_jacobian_10*s10 + kept_jacobian_11*s11
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
    s43 = multipliers_3 + p15*(s37 + kept_jacobian_4*s35 - s34 + kept_jacobian_5*s38 - kept_target_3)
    s44 = multipliers_4 + p15*(s39 + kept_jacobian_6*s38 - s36 + kept_jacobian_7*s41 - kept_target_4)
    s45 = multipliers_5 + p15*(s40 + kept_jacobian_8*s38 - s37 + kept_jacobian_9*s41 - kept_target_5)
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
    w[13] = multipliers_0 + p15*(s33 + kept_jacobian_0*s35 - kept_target_0)
    w[14] = multipliers_1 + p15*(s34 + kept_jacobian_1*s35 - kept_target_1)
    w[15] = multipliers_2 + p15*s42
    w[16] = s43
    w[17] = s44
    w[18] = s45
    w[19] = multipliers_6 + p15*(s39 + kept_jacobian_10*s41 - kept_target_6)
    w[20] = multipliers_7 + p15*(s40 + kept_jacobian_11*s41 - kept_target_7)
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
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of M + a D^T D: 302 operations, 98849 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    p18 = p[18]
    p20 = p[20]
    p22 = p[22]
    p15 = p[15]
    mask_1 = w[22]
    mask_2 = w[23]
    mask_3 = w[24]
    mask_4 = w[25]
    mask_5 = w[26]
    mask_7 = w[28]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    p29 = p[29]
    p30 = p[30]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = q0 - s0
    s4 = q1 - s1
    s5 = 4.0*math.cos(q5)
    s6 = -s5
    s7 = q3 - q0 - s5 - s0
    s8 = 4.0*math.sin(q5)
    s9 = q4 - q1 - s8 - s1
    s10 = 2.5*math.cos(q8)
    s11 = q6 - q3 + s10 - s5
    s12 = 2.5*math.sin(q8)
    s13 = q7 - q4 + s12 - s8
    s14 = q6 - 10.0 - s10
    s15 = q7 - s12
    s16 = s1*p15
    s17 = s1*s16
    s18 = s0*p15
    s19 = s0*s18
    s20 = s8*p15
    s21 = s8*s20
    s22 = s5*p15
    s23 = s8*s16 + s5*s18
    s24 = s5*s22
    s25 = s12*p15
    s26 = s12*s25
    s27 = s10*p15
    s28 = s12*s20 + s10*s22
    s29 = s10*s27
    s30 = s20*p24
    s31 = s22*p24
    s32 = s20*p27
    s33 = s22*p27
    s34 = 1.0/(s19 + s17 + p18 + s17 + s19)
    s35 = s16*s34
    s36 = s18*s34
    s37 = s23*s34
    s38 = 1.0/(s29 + s26 + p22 + s26 + s29)
    s39 = s25*s38
    s40 = s27*s38
    s41 = s28*s38
    s42 = s18*s35 + s27*s39
    s43 = s20*p28 - s20*p25 - s23*s35 + s28*s39
    s44 = 1.0/(p30 - s16*s35 - s25*s39)
    s45 = s42*s44
    s46 = s43*s44
    s47 = s22*p25 - s22*p28 + s23*s36 - s28*s40 - s43*s45
    s48 = s24 + s21 + p20 + s21 + s24 - s20*s30 - s22*s31 - s20*s32 - s22*s33 - s23*s37 - s28*s41 - s43*s46
    s49 = 1.0/(p30 - s18*s36 - s27*s40 - s42*s45)
    s50 = s47*s49
    s51 = s1*s1
    s52 = 1.0 + s51
    s53 = s0*s1
    s54 = -1.0 + s51
    s55 = s0*s0
    s56 = 1.0 + s55
    s57 = s8*s8
    s58 = 1.0 + s52 + s57
    s59 = s5*s8
    s60 = -1.0 + s57
    s61 = s5*s5
    s62 = 1.0 + s56 + s61
    s63 = s12*s12
    s64 = 1.0 + 1.0 + s57 + s63
    s65 = s10*s12
    s66 = 1.0 - s63
    s67 = s10*s10
    s68 = 1.0 + 1.0 + s61 + s67
    s69 = 1.0 + s67
    s70 = 1.0/s52
    s71 = s53*s70
    s72 = s54*s70
    s73 = s53*s71
    s74 = s56 - s73
    s75 = s54*s71 - s53
    s76 = -1.0 + s55 - s73
    s77 = 1.0*(s74 > mask_1 + 1e-12*s56)
    s78 = s77/(s74 + 1.0 - s77)
    s79 = s75*s78
    s80 = s58 - s54*s72 - s75*s79
    s81 = s53*s72 - (s53 + s59) - s76*s79
    s82 = 1.0/(1.0 + s63)
    s83 = s65*s82
    s84 = s66*s82
    s85 = s65*s83
    s86 = s69 - s85
    s87 = s65 + s66*s83
    s88 = 1.0 - s67 + s85
    s89 = 1.0*(s86 > mask_7 + 1e-12*s69)
    s90 = s89/(s86 + 1.0 - s89)
    s91 = s87*s90
    s92 = 1.0*(s80 > mask_2 + 1e-12*s58)
    s93 = s92/(s80 + 1.0 - s92)
    s94 = s81*s93
    s95 = s60*s93
    s96 = s62 - s73 - s76*(s76*s78) - s81*s94
    s97 = s59 + s60*s94
    s98 = -1.0 + s61 + s59*s94
    s99 = 1.0*(s96 > mask_3 + 1e-12*s62)
    s100 = s99/(s96 + 1.0 - s99)
    s101 = s97*s100
    s102 = s64 - s66*s84 - s87*s91 - s60*s95 - s97*s101
    s103 = s59*s95 - (s59 + s65 + s65*s84 + s88*s91) + s98*s101
    s104 = 1.0*(s102 > mask_4 + 1e-12*s64)
    s105 = s68 - s85 - s88*(s88*s90) - s59*(s59*s93) - s98*(s98*s100) - s103*(s103*(s104/(s102 + 1.0 - s104)))
    s106 = s74/s56
    s107 = s80/s58
    s108 = s96/s62
    s109 = s102/s64
    s110 = s105/s68
    s111 = min(min(min(min(min(1.0, mask_1 + s106), mask_2 + s107), mask_3 + s108), mask_4 + s109), mask_5 + s110)
    s112 = s86/s69
    # outputs
    w[37] = s3
    w[38] = s4
    w[39] = s7
    w[40] = s9
    w[41] = s11
    w[42] = s13
    w[43] = s14
    w[44] = s15
    w[0] = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15)
    w[79] = s1
    w[80] = s2
    w[81] = s1
    w[82] = s8
    w[83] = s2
    w[84] = s6
    w[85] = s8
    w[86] = -s12
    w[87] = s6
    w[88] = s10
    w[89] = s12
    w[90] = -s10
    w[54] = s106
    w[55] = s107
    w[56] = s108
    w[57] = s109
    w[58] = s110
    w[60] = s112
    w[5] = s89 + 1.0 + 1.0*(s105 > mask_5 + 1e-12*s68) + s104 + s99 + s92 + 1.0 + s77
    w[4] = min(s111, mask_7 + s112)
    w[173] = p26
    w[174] = -s30
    w[175] = p26
    w[176] = s31
    w[177] = p29
    w[178] = s32
    w[179] = p29
    w[180] = -s33
    w[181] = s35
    w[182] = -s36
    w[183] = s37
    w[184] = s39
    w[185] = -s40
    w[186] = -s41
    w[187] = s45
    w[188] = s46
    w[189] = s50
    w[190] = p24
    w[191] = p24
    w[192] = p27
    w[193] = p27
    w[194] = s34
    w[195] = s38
    w[196] = s44
    w[197] = s49
    w[198] = 1.0/(s48 - s47*s50)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 161 operations, 23071 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p18 = p[18]
    p20 = p[20]
    p22 = p[22]
    p15 = p[15]
    residual_0 = w[37]
    residual_1 = w[38]
    residual_2 = w[39]
    residual_3 = w[40]
    residual_4 = w[41]
    residual_5 = w[42]
    residual_6 = w[43]
    residual_7 = w[44]
    moved_0 = w[199]
    moved_1 = w[200]
    moved_2 = w[201]
    moved_3 = w[202]
    moved_4 = w[203]
    moved_5 = w[204]
    moved_6 = w[205]
    moved_7 = w[206]
    moved_8 = w[207]
    force_of_constraints_0 = w[208]
    force_of_constraints_1 = w[209]
    force_of_constraints_2 = w[210]
    force_of_constraints_3 = w[211]
    force_of_constraints_4 = w[212]
    force_of_constraints_5 = w[213]
    force_of_constraints_6 = w[214]
    force_of_constraints_7 = w[215]
    jacobian_0 = w[79]
    jacobian_1 = w[80]
    jacobian_2 = w[81]
    jacobian_3 = w[82]
    jacobian_4 = w[83]
    jacobian_5 = w[84]
    jacobian_6 = w[85]
    jacobian_7 = w[86]
    jacobian_8 = w[87]
    jacobian_9 = w[88]
    jacobian_10 = w[89]
    jacobian_11 = w[90]
    law_lower_0 = w[173]
    law_lower_1 = w[174]
    law_lower_2 = w[175]
    law_lower_3 = w[176]
    law_lower_4 = w[177]
    law_lower_5 = w[178]
    law_lower_6 = w[179]
    law_lower_7 = w[180]
    law_lower_8 = w[181]
    law_lower_9 = w[182]
    law_lower_10 = w[183]
    law_lower_11 = w[184]
    law_lower_12 = w[185]
    law_lower_13 = w[186]
    law_lower_14 = w[187]
    law_lower_15 = w[188]
    law_lower_16 = w[189]
    law_reciprocal_0 = w[190]
    law_reciprocal_1 = w[191]
    law_reciprocal_2 = w[192]
    law_reciprocal_3 = w[193]
    law_reciprocal_4 = w[194]
    law_reciprocal_5 = w[195]
    law_reciprocal_6 = w[196]
    law_reciprocal_7 = w[197]
    law_reciprocal_8 = w[198]
    # intermediate terms
    s0 = p15*residual_0
    s1 = p15*residual_1
    s2 = p15*residual_2
    s3 = p15*residual_3
    s4 = p15*residual_4
    s5 = p15*residual_5
    s6 = p15*residual_6
    s7 = p15*residual_7
    s8 = force_of_constraints_0 + s0
    s9 = force_of_constraints_1 + s1
    s10 = force_of_constraints_2 + s2
    s11 = force_of_constraints_3 + s3
    s12 = force_of_constraints_4 + s4
    s13 = force_of_constraints_5 + s5
    s14 = force_of_constraints_6 + s6
    s15 = force_of_constraints_7 + s7
    s16 = s0 + s8
    s17 = s1 + s9
    s18 = s2 + s10
    s19 = s3 + s11
    s20 = s4 + s12
    s21 = s5 + s13
    s22 = s6 + s14
    s23 = s7 + s15
    s24 = p0*moved_0 + s16 - s18
    s25 = p0*moved_1 + s17 - s19
    s26 = p18*moved_2 + s16*jacobian_0 + s17*jacobian_1 + s18*jacobian_2 + s19*jacobian_4
    s27 = p2*moved_6 + s20 + s22
    s28 = p2*moved_7 + s21 + s23
    s29 = p22*moved_8 + s20*jacobian_7 + s21*jacobian_9 + s22*jacobian_10 + s23*jacobian_11
    s30 = s24*law_lower_1 - (p20*moved_5 + s18*jacobian_3 + s19*jacobian_5 + s20*jacobian_6 + s21*jacobian_8)
    s31 = s24*law_lower_0 - (p1*moved_3 + s18 - s20) + s27*law_lower_4 + s26*law_lower_8 + s29*law_lower_11
    s32 = s25*law_lower_2 - (p1*moved_4 + s19 - s21) + s28*law_lower_6 + s26*law_lower_9 + s29*law_lower_12
    s33 = s30 + s25*law_lower_3 + s27*law_lower_5 + s28*law_lower_7 + s26*law_lower_10 + s29*law_lower_13
    s34 = s32 - law_lower_14*s31
    s35 = law_reciprocal_8*(s33 - law_lower_15*s31 - law_lower_16*s34)
    s36 = law_reciprocal_7*s34 - law_lower_16*s35
    s37 = law_reciprocal_6*s31 - law_lower_14*s36 - law_lower_15*s35
    s38 = s29*law_reciprocal_5 + law_lower_11*s37 + law_lower_12*s36 + law_lower_13*s35
    s39 = s26*law_reciprocal_4 + law_lower_8*s37 + law_lower_9*s36 + law_lower_10*s35
    s40 = s28*law_reciprocal_3 + law_lower_6*s36 + law_lower_7*s35
    s41 = s27*law_reciprocal_2 + law_lower_4*s37 + law_lower_5*s35
    s42 = s25*law_reciprocal_1 + law_lower_2*s36 + law_lower_3*s35
    s43 = s24*law_reciprocal_0 + law_lower_0*s37 + law_lower_1*s35
    # outputs
    w[61] = -s43
    w[62] = -s42
    w[63] = -s39
    w[64] = s37
    w[65] = s36
    w[66] = s35
    w[67] = -s41
    w[68] = -s40
    w[69] = -s38
    w[199] = moved_0 - s43
    w[200] = moved_1 - s42
    w[201] = moved_2 - s39
    w[202] = moved_3 + s37
    w[203] = moved_4 + s36
    w[204] = moved_5 + s35
    w[205] = moved_6 - s41
    w[206] = moved_7 - s40
    w[207] = moved_8 - s38
    w[208] = s8
    w[209] = s9
    w[210] = s10
    w[211] = s11
    w[212] = s12
    w[213] = s13
    w[214] = s14
    w[215] = s15
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
        if increment <= p[16] or (increment > 0.5 * last and increment < 1e-6):
            break
        last = increment
    finish(t, y, p, w, ydot)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state by mass-orthogonal projections and measure it; bits as for other corrections."""
    bits = 2
    tolerance = p[17] * w[6]
    last = math.inf
    for j in range(9):
        w[MOVED + j] = 0.0
    for round in range(20):
        geometry(t, y, p, w)
        violation = w[0]
        if round == 0:
            for i in range(8):
                w[FORCE_OF_CONSTRAINTS + i] = -p[15] * w[RESIDUAL + i]
        if violation <= tolerance or (violation > 0.9 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        spread(p, w)
        for j in range(9):
            y[j] += w[CHANGE + j]
        iw[3] += 1
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    tolerance = p[17] * w[7]
    last = math.inf
    for j in range(9):
        w[MOVED + j] = 0.0
    for round in range(20):
        measure(t, y, p, w)
        violation = w[1]
        if round == 0:
            for i in range(8):
                w[FORCE_OF_CONSTRAINTS + i] = -p[15] * w[RESIDUAL + i]
        if violation <= tolerance or violation > 0.9 * last:
            break
        last = violation
        spread(p, w)
        for j in range(9):
            y[9 + j] += w[CHANGE + j]
        iw[3] += 1
    return bits
