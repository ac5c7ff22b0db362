"""Method `index1-augmented-lagrangian` for model `four-bar`. Emitted by symgen; do not edit.

iterated multipliers for accelerations, mass-orthogonal projections of positions and velocities
Bayo, Ledesma, Nonlinear Dyn. 9 (1996) 113-130; Cuadrado, Cardenal, Bayo, Multibody Syst. Dyn. 1 (1997) 259-280
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
p[15] penalty (default 10000000.0)
p[16] iteration_tolerance (default 1e-13)
p[17] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

MASK = 23  # sections of w
RESIDUAL = 39
CHANGE = 63
MOVED = 217
FORCE_OF_CONSTRAINTS = 226


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 18 operations, 21 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 9.81*p1
    s2 = 9.81*p2
    # outputs
    p[18] = 0.3333333333333333*p0
    p[19] = -s0
    p[20] = 5.333333333333333*p1
    p[21] = -s1
    p[22] = 2.083333333333333*p2
    p[23] = -s2
    p[24] = -s0*(1.0/p0)
    p[25] = -s1*(1.0/p1)
    p[26] = -s2*(1.0/p2)
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
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p15 = p[15]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
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
    s21 = p15*(1.0*(1.0 > mask_0))
    s22 = p15*(1.0*(1.0 > mask_1))
    s23 = p15*(1.0*(1.0 > mask_2))
    s24 = p15*(1.0*(1.0 > mask_3))
    s25 = p15*(1.0*(1.0 > mask_4))
    s26 = p15*(1.0*(1.0 > mask_5))
    s27 = p15*(1.0*(1.0 > mask_6))
    s28 = p15*(1.0*(1.0 > mask_7))
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
    s67 = 1.0/(p18 + s1*s29 + s0*s30 + s1*s31 + s0*s34 - s32*s46 - s35*s51)
    s68 = s49*s67
    s69 = s54*s67
    s70 = s55*s67
    s71 = p20 + s10*s33 + s8*s36 + s10*s37 + s8*s39 - s33*s48 - s36*s53 - s37*s59 - s39*s64 - s55*s70
    s72 = 1.0/(p22 + s17*s38 + s16*s40 + s17*s41 + s16*s43 - s42*s57 - s44*s62)
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
    w[167] = p19
    w[168] = p21
    w[169] = p23
    w[170] = -s4
    w[171] = -s5
    w[172] = -(s4 + s12)
    w[173] = -(s5 + s13)
    w[174] = s19 - s12
    w[175] = s20 - s13
    w[176] = -s19
    w[177] = -s20
    w[178] = 0.0
    w[179] = p24
    w[180] = 0.0
    w[181] = 0.0
    w[182] = p25
    w[183] = 0.0
    w[184] = 0.0
    w[185] = p26
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
    """one iteration of index1-augmented-lagrangian: 292 operations, 324332 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p18 = p[18]
    p20 = p[20]
    p22 = p[22]
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
    s18 = p18*kept_acceleration_2 + kept_jacobian_0*s8 + kept_jacobian_1*s9 + kept_jacobian_2*s10 + kept_jacobian_4*s11
    s19 = p20*kept_acceleration_5 + kept_jacobian_3*s10 + kept_jacobian_5*s11 + kept_jacobian_6*s12 + kept_jacobian_8*s13
    s20 = p2*kept_acceleration_6 + s12 + s14
    s21 = kept_force_2 - p2*kept_acceleration_7 - (s13 + s15)
    s22 = p22*kept_acceleration_8 + kept_jacobian_7*s12 + kept_jacobian_9*s13 + kept_jacobian_10*s14 + kept_jacobian_11*s15
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
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of M + a D^T D: 396 operations, 108909 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
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
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
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
    s16 = p15*(1.0*(1.0 > mask_0))
    s17 = p15*(1.0*(1.0 > mask_1))
    s18 = p15*(1.0*(1.0 > mask_2))
    s19 = p15*(1.0*(1.0 > mask_3))
    s20 = p15*(1.0*(1.0 > mask_4))
    s21 = p15*(1.0*(1.0 > mask_5))
    s22 = p15*(1.0*(1.0 > mask_6))
    s23 = p15*(1.0*(1.0 > mask_7))
    s24 = s1*s16
    s25 = s0*s17
    s26 = s1*s18
    s27 = s24 - s26
    s28 = s8*s18
    s29 = s0*s19
    s30 = s29 - s25
    s31 = s5*s19
    s32 = s8*s20
    s33 = s12*s20
    s34 = s5*s21
    s35 = s10*s21
    s36 = s12*s22
    s37 = s36 - s33
    s38 = s10*s23
    s39 = s35 - s38
    s40 = 1.0/(s18 + p0 + s16)
    s41 = s27*s40
    s42 = s18*s40
    s43 = s28*s40
    s44 = s26 + s18*s41
    s45 = 1.0/(s19 + p0 + s17)
    s46 = s30*s45
    s47 = s19*s45
    s48 = s31*s45
    s49 = s19*s46 - s29
    s50 = s8*s26 + s5*s29 + s28*s41 - s31*s46
    s51 = 1.0/(s22 + p2 + s20)
    s52 = s37*s51
    s53 = s20*s51
    s54 = s32*s51
    s55 = s33 + s20*s52
    s56 = 1.0/(s23 + p2 + s21)
    s57 = s39*s56
    s58 = s21*s56
    s59 = s34*s56
    s60 = s21*s57 - s35
    s61 = s34*s57 - (s12*s32 + s10*s34 + s32*s52)
    s62 = 1.0/(p18 + s1*s24 + s0*s25 + s1*s26 + s0*s29 - s27*s41 - s30*s46)
    s63 = s44*s62
    s64 = s49*s62
    s65 = s50*s62
    s66 = 1.0/(p22 + s12*s33 + s10*s35 + s12*s36 + s10*s38 - s37*s52 - s39*s57)
    s67 = s55*s66
    s68 = s60*s66
    s69 = s61*s66
    s70 = s49*s63 + s60*s67
    s71 = s28 - s32 - s28*s42 + s32*s53 - s50*s63 - s61*s67
    s72 = p20 + s8*s28 + s5*s31 + s8*s32 + s5*s34 - s28*s43 - s31*s48 - s32*s54 - s34*s59 - s50*s65 - s61*s69
    s73 = 1.0/(s20 + p1 + s18 - s18*s42 - s20*s53 - s44*s63 - s55*s67)
    s74 = s70*s73
    s75 = s71*s73
    s76 = s34 - s31 + s31*s47 - s34*s58 - s50*s64 - s61*s68 + s71*s74
    s77 = 1.0/(s21 + p1 + s19 - s19*s47 - s21*s58 - s49*s64 - s60*s68 - s70*s74)
    s78 = s76*s77
    s79 = s1*s1
    s80 = 1.0 + s79
    s81 = s0*s1
    s82 = -1.0 + s79
    s83 = s0*s0
    s84 = 1.0 + s83
    s85 = s8*s8
    s86 = 1.0 + s80 + s85
    s87 = s5*s8
    s88 = -1.0 + s85
    s89 = s5*s5
    s90 = 1.0 + s84 + s89
    s91 = s12*s12
    s92 = 1.0 + 1.0 + s85 + s91
    s93 = s10*s12
    s94 = 1.0 - s91
    s95 = s10*s10
    s96 = 1.0 + 1.0 + s89 + s95
    s97 = 1.0 + s95
    s98 = 1.0/s80
    s99 = s81*s98
    s100 = s82*s98
    s101 = s81*s99
    s102 = s84 - s101
    s103 = s82*s99 - s81
    s104 = -1.0 + s83 - s101
    s105 = 1.0*(s102 > mask_1 + 1e-12*s84)
    s106 = s105/(s102 + 1.0 - s105)
    s107 = s103*s106
    s108 = s86 - s82*s100 - s103*s107
    s109 = s81*s100 - (s81 + s87) - s104*s107
    s110 = 1.0/(1.0 + s91)
    s111 = s93*s110
    s112 = s94*s110
    s113 = s93*s111
    s114 = s97 - s113
    s115 = s93 + s94*s111
    s116 = 1.0 - s95 + s113
    s117 = 1.0*(s114 > mask_7 + 1e-12*s97)
    s118 = s117/(s114 + 1.0 - s117)
    s119 = s115*s118
    s120 = 1.0*(s108 > mask_2 + 1e-12*s86)
    s121 = s120/(s108 + 1.0 - s120)
    s122 = s109*s121
    s123 = s88*s121
    s124 = s90 - s101 - s104*(s104*s106) - s109*s122
    s125 = s87 + s88*s122
    s126 = -1.0 + s89 + s87*s122
    s127 = 1.0*(s124 > mask_3 + 1e-12*s90)
    s128 = s127/(s124 + 1.0 - s127)
    s129 = s125*s128
    s130 = s92 - s94*s112 - s115*s119 - s88*s123 - s125*s129
    s131 = s87*s123 - (s87 + s93 + s93*s112 + s116*s119) + s126*s129
    s132 = 1.0*(s130 > mask_4 + 1e-12*s92)
    s133 = s96 - s113 - s116*(s116*s118) - s87*(s87*s121) - s126*(s126*s128) - s131*(s131*(s132/(s130 + 1.0 - s132)))
    s134 = s102/s84
    s135 = s108/s86
    s136 = s124/s90
    s137 = s130/s92
    s138 = s133/s96
    s139 = min(min(min(min(min(1.0, mask_1 + s134), mask_2 + s135), mask_3 + s136), mask_4 + s137), mask_5 + s138)
    s140 = s114/s97
    # outputs
    w[39] = s3
    w[40] = s4
    w[41] = s7
    w[42] = s9
    w[43] = s11
    w[44] = s13
    w[45] = s14
    w[46] = s15
    w[0] = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15)
    w[81] = s1
    w[82] = s2
    w[83] = s1
    w[84] = s8
    w[85] = s2
    w[86] = s6
    w[87] = s8
    w[88] = -s12
    w[89] = s6
    w[90] = s10
    w[91] = s12
    w[92] = -s10
    w[56] = s134
    w[57] = s135
    w[58] = s136
    w[59] = s137
    w[60] = s138
    w[62] = s140
    w[5] = s117 + 1.0 + 1.0*(s133 > mask_5 + 1e-12*s96) + s132 + s127 + s120 + 1.0 + s105
    w[4] = min(s139, mask_7 + s140)
    w[187] = s41
    w[188] = -s42
    w[189] = -s43
    w[190] = s46
    w[191] = -s47
    w[192] = s48
    w[193] = s52
    w[194] = -s53
    w[195] = s54
    w[196] = s57
    w[197] = -s58
    w[198] = -s59
    w[199] = s63
    w[200] = s64
    w[201] = s65
    w[202] = s67
    w[203] = s68
    w[204] = s69
    w[205] = -s74
    w[206] = s75
    w[207] = s78
    w[208] = s40
    w[209] = s45
    w[210] = s51
    w[211] = s56
    w[212] = s62
    w[213] = s66
    w[214] = s73
    w[215] = s77
    w[216] = 1.0/(s72 - s71*s75 - s76*s78)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 191 operations, 98013 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p18 = p[18]
    p20 = p[20]
    p22 = p[22]
    p15 = p[15]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
    moved_0 = w[217]
    moved_1 = w[218]
    moved_2 = w[219]
    moved_3 = w[220]
    moved_4 = w[221]
    moved_5 = w[222]
    moved_6 = w[223]
    moved_7 = w[224]
    moved_8 = w[225]
    force_of_constraints_0 = w[226]
    force_of_constraints_1 = w[227]
    force_of_constraints_2 = w[228]
    force_of_constraints_3 = w[229]
    force_of_constraints_4 = w[230]
    force_of_constraints_5 = w[231]
    force_of_constraints_6 = w[232]
    force_of_constraints_7 = w[233]
    jacobian_0 = w[81]
    jacobian_1 = w[82]
    jacobian_2 = w[83]
    jacobian_3 = w[84]
    jacobian_4 = w[85]
    jacobian_5 = w[86]
    jacobian_6 = w[87]
    jacobian_7 = w[88]
    jacobian_8 = w[89]
    jacobian_9 = w[90]
    jacobian_10 = w[91]
    jacobian_11 = w[92]
    law_lower_0 = w[187]
    law_lower_1 = w[188]
    law_lower_2 = w[189]
    law_lower_3 = w[190]
    law_lower_4 = w[191]
    law_lower_5 = w[192]
    law_lower_6 = w[193]
    law_lower_7 = w[194]
    law_lower_8 = w[195]
    law_lower_9 = w[196]
    law_lower_10 = w[197]
    law_lower_11 = w[198]
    law_lower_12 = w[199]
    law_lower_13 = w[200]
    law_lower_14 = w[201]
    law_lower_15 = w[202]
    law_lower_16 = w[203]
    law_lower_17 = w[204]
    law_lower_18 = w[205]
    law_lower_19 = w[206]
    law_lower_20 = w[207]
    law_reciprocal_0 = w[208]
    law_reciprocal_1 = w[209]
    law_reciprocal_2 = w[210]
    law_reciprocal_3 = w[211]
    law_reciprocal_4 = w[212]
    law_reciprocal_5 = w[213]
    law_reciprocal_6 = w[214]
    law_reciprocal_7 = w[215]
    law_reciprocal_8 = w[216]
    # intermediate terms
    s0 = p15*(1.0*(1.0 > mask_0))*residual_0
    s1 = p15*(1.0*(1.0 > mask_1))*residual_1
    s2 = p15*(1.0*(1.0 > mask_2))*residual_2
    s3 = p15*(1.0*(1.0 > mask_3))*residual_3
    s4 = p15*(1.0*(1.0 > mask_4))*residual_4
    s5 = p15*(1.0*(1.0 > mask_5))*residual_5
    s6 = p15*(1.0*(1.0 > mask_6))*residual_6
    s7 = p15*(1.0*(1.0 > mask_7))*residual_7
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
    s26 = p2*moved_6 + s20 + s22
    s27 = p2*moved_7 + s21 + s23
    s28 = s24*law_lower_0 - (p18*moved_2 + s16*jacobian_0 + s17*jacobian_1 + s18*jacobian_2 + s19*jacobian_4)
    s29 = s24*law_lower_2 - (p20*moved_5 + s18*jacobian_3 + s19*jacobian_5 + s20*jacobian_6 + s21*jacobian_8)
    s30 = s28 + s25*law_lower_3
    s31 = s26*law_lower_6 - (p22*moved_8 + s20*jacobian_7 + s21*jacobian_9 + s22*jacobian_10 + s23*jacobian_11)
    s32 = s31 + s27*law_lower_9
    s33 = s24*law_lower_1 - (p1*moved_3 + s18 - s20) + s26*law_lower_7 - law_lower_12*s30 - law_lower_15*s32
    s34 = s25*law_lower_4 - (p1*moved_4 + s19 - s21) + s27*law_lower_10 - law_lower_13*s30 - law_lower_16*s32
    s35 = s29 + s25*law_lower_5 + s26*law_lower_8 + s27*law_lower_11 - law_lower_14*s30 - law_lower_17*s32
    s36 = s34 - law_lower_18*s33
    s37 = law_reciprocal_8*(s35 - law_lower_19*s33 - law_lower_20*s36)
    s38 = law_reciprocal_7*s36 - law_lower_20*s37
    s39 = law_reciprocal_6*s33 - law_lower_18*s38 - law_lower_19*s37
    s40 = law_reciprocal_5*s32 - law_lower_15*s39 - law_lower_16*s38 - law_lower_17*s37
    s41 = law_reciprocal_4*s30 - law_lower_12*s39 - law_lower_13*s38 - law_lower_14*s37
    s42 = s27*law_reciprocal_3 + law_lower_9*s40 + law_lower_10*s38 + law_lower_11*s37
    s43 = s26*law_reciprocal_2 + law_lower_6*s40 + law_lower_7*s39 + law_lower_8*s37
    s44 = s25*law_reciprocal_1 + law_lower_3*s41 + law_lower_4*s38 + law_lower_5*s37
    s45 = s24*law_reciprocal_0 + law_lower_0*s41 + law_lower_1*s39 + law_lower_2*s37
    # outputs
    w[63] = -s45
    w[64] = -s44
    w[65] = s41
    w[66] = s39
    w[67] = s38
    w[68] = s37
    w[69] = -s43
    w[70] = -s42
    w[71] = s40
    w[217] = moved_0 - s45
    w[218] = moved_1 - s44
    w[219] = moved_2 + s41
    w[220] = moved_3 + s39
    w[221] = moved_4 + s38
    w[222] = moved_5 + s37
    w[223] = moved_6 - s43
    w[224] = moved_7 - s42
    w[225] = moved_8 + s40
    w[226] = s8
    w[227] = s9
    w[228] = s10
    w[229] = s11
    w[230] = s12
    w[231] = s13
    w[232] = s14
    w[233] = s15
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
                w[FORCE_OF_CONSTRAINTS + i] = -p[15] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
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
                w[FORCE_OF_CONSTRAINTS + i] = -p[15] * w[RESIDUAL + i] if w[MASK + i] == 0.0 else 0.0
        if violation <= tolerance or violation > 0.9 * last:
            break
        last = violation
        spread(p, w)
        for j in range(9):
            y[9 + j] += w[CHANGE + j]
        iw[3] += 1
    return bits
