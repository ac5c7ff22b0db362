"""Method `augmented-hamiltonian` for model `four-bar`. Emitted by symgen; do not edit.

momenta are integrated; velocities satisfy their constraint in every evaluation
Bayo, Avello, Nonlinear Dyn. 5 (1994) 209-231, doi 10.1007/BF00045677
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
p[15] penalty (default 10000000.0)
p[16] iteration_tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

CHANGE = 63  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 20 operations, 47 before sharing."""
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
    s6 = 1.0/p0
    s7 = 1.0/p1
    s8 = 1.0/p2
    s9 = s1*s6
    s10 = s3*s7
    s11 = s5*s8
    # outputs
    p[17] = s1
    p[18] = s3
    p[19] = s5
    p[20] = s6
    p[21] = 1.0/s0
    p[22] = s7
    p[23] = 1.0/s2
    p[24] = s8
    p[25] = 1.0/s4
    p[26] = s9
    p[27] = s11
    p[28] = s9 - s10
    p[29] = s10 - s11
    p[30] = s0
    p[31] = s2
    p[32] = s4
    p[33] = -s9
    p[34] = -s10
    p[35] = -s11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rates(t, y, p, w, iw, ydot):
    """q', v' and multipliers for results: 271 operations, 1436391 before sharing."""
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
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
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
    s19 = s1*p21
    s20 = s0*p21
    s21 = s8*p23
    s22 = s7*p23
    s23 = s15*p25
    s24 = s14*p25
    s25 = s1*s19
    s26 = p20 + s25
    s27 = s0*s19
    s28 = s25 - p20
    s29 = s0*s20
    s30 = p20 + s29
    s31 = s8*s21
    s32 = s7*s21
    s33 = s31 - p22
    s34 = s7*s22
    s35 = s15*s23
    s36 = s14*s23
    s37 = p24 - s35
    s38 = s14*s24
    s39 = s15*s24
    s40 = 1.0/(mask_0 + s26)
    s41 = s27*s40
    s42 = s28*s40
    s43 = s27*s41
    s44 = s28*s41 - s1*s20
    s45 = s29 - p20 - s43
    s46 = 1.0/(mask_1 + s30 - s43)
    s47 = s44*s46
    s48 = s45*s46
    s49 = s27*s42 - (s27 + s32) - s45*s47
    s50 = 1.0/(mask_6 + p24 + s35)
    s51 = s36*s50
    s52 = s37*s50
    s53 = s39*s50
    s54 = s36 + s37*s51
    s55 = p24 - s38 + s39*s51
    s56 = 1.0/(mask_7 + p24 + s38 - s36*s51)
    s57 = s54*s56
    s58 = s55*s56
    s59 = 1.0/(mask_2 + p22 + s26 + s31 - s28*s42 - s44*s47)
    s60 = s49*s59
    s61 = s33*s59
    s62 = s32*s59
    s63 = s8*s22 + s33*s60
    s64 = s34 - p22 + s32*s60
    s65 = 1.0/(mask_3 + p22 + s30 + s34 - s43 - s45*s48 - s49*s60)
    s66 = s63*s65
    s67 = s64*s65
    s68 = s32*s61 - (s32 + s36 + s39*s52 + s55*s57) + s64*s66
    s69 = 1.0/(mask_4 + p24 + p22 + s31 + s35 - s37*s52 - s54*s57 - s33*s61 - s63*s66)
    s70 = s68*s69
    s71 = s3*s41
    s72 = s4 - p26 + s71
    s73 = s3 + s10 - s3*s42 - s47*s72
    s74 = s18 - p27 + s17*s51
    s75 = s4 + s11 + p28 + s71 - s48*s72 - s60*s73
    s76 = s10 - s17 - s17*s52 - s57*s74 - s61*s73 + s66*s75
    s77 = 1.0/(mask_5 + p24 + p22 + s34 + s38 - s39*s53 - s55*s58 - s32*s62 - s64*s67 - s68*s70)*(p29 - (s18 - s11) - s17*s53 - s58*s74 + s62*s73 - s67*s75 - s70*s76)
    s78 = s69*s76
    s79 = s70*s77
    s80 = s78 - s79
    s81 = s65*s75 + s66*s80
    s82 = s67*s77
    s83 = s81 - s82
    s84 = s59*s73 - s60*s83 - s61*s80 + s62*s77
    s85 = s56*s74 - s57*s80 - s58*s77
    s86 = s17*s50 + s51*s85 - s52*s80 - s53*s77
    s87 = s46*s72 - s47*s84 - s48*s83
    s88 = s3*s40 + s41*s87 - s42*s84 + s41*s83
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
    ydot[9] = p20*(s84 - s88)
    ydot[10] = -p20*(p17 + s87 + s82 - s81)
    ydot[11] = p21*(s0*s83 - (s1*s88 - s0*s87 + s1*s84))
    ydot[12] = -p22*(s84 + s79 - s78)
    ydot[13] = -p22*(p18 + s83 - s77)
    ydot[14] = p23*(s7*s77 - (s8*s84 - s7*s83 + s8*s80))
    ydot[15] = -p24*(s80 + s86)
    ydot[16] = -p24*(p19 + s77 + s85)
    ydot[17] = p25*(s14*s85 - (s14*s77 - s15*s80 + s15*s86))
    ydot[18] = 0.0
    w[15] = s88
    w[16] = s87
    w[17] = s84
    w[18] = s83
    w[19] = s80
    w[20] = s77
    w[21] = s86
    w[22] = s85
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 215 operations, 12935 before sharing."""
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
    p30 = p[30]
    p31 = p[31]
    p32 = p[32]
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
    s3 = 4.0*math.cos(q5)
    s4 = -s3
    s5 = 4.0*math.sin(q5)
    s6 = 2.5*math.cos(q8)
    s7 = 2.5*math.sin(q8)
    s8 = p15*(1.0*(1.0 > mask_0))
    s9 = p15*(1.0*(1.0 > mask_1))
    s10 = p15*(1.0*(1.0 > mask_2))
    s11 = p15*(1.0*(1.0 > mask_3))
    s12 = p15*(1.0*(1.0 > mask_4))
    s13 = p15*(1.0*(1.0 > mask_5))
    s14 = p15*(1.0*(1.0 > mask_6))
    s15 = p15*(1.0*(1.0 > mask_7))
    s16 = s1*s8
    s17 = s0*s9
    s18 = s1*s10
    s19 = s16 - s18
    s20 = s5*s10
    s21 = s0*s11
    s22 = s21 - s17
    s23 = s3*s11
    s24 = s5*s12
    s25 = s7*s12
    s26 = s3*s13
    s27 = s6*s13
    s28 = s7*s14
    s29 = s28 - s25
    s30 = s6*s15
    s31 = s27 - s30
    s32 = 1.0/(s10 + p0 + s8)
    s33 = s19*s32
    s34 = s10*s32
    s35 = s20*s32
    s36 = s18 + s10*s33
    s37 = 1.0/(s11 + p0 + s9)
    s38 = s22*s37
    s39 = s11*s37
    s40 = s23*s37
    s41 = s11*s38 - s21
    s42 = s5*s18 + s3*s21 + s20*s33 - s23*s38
    s43 = 1.0/(s14 + p2 + s12)
    s44 = s29*s43
    s45 = s12*s43
    s46 = s24*s43
    s47 = s25 + s12*s44
    s48 = 1.0/(s15 + p2 + s13)
    s49 = s31*s48
    s50 = s13*s48
    s51 = s26*s48
    s52 = s13*s49 - s27
    s53 = s26*s49 - (s7*s24 + s6*s26 + s24*s44)
    s54 = 1.0/(p30 + s1*s16 + s0*s17 + s1*s18 + s0*s21 - s19*s33 - s22*s38)
    s55 = s36*s54
    s56 = s41*s54
    s57 = s42*s54
    s58 = 1.0/(p32 + s7*s25 + s6*s27 + s7*s28 + s6*s30 - s29*s44 - s31*s49)
    s59 = s47*s58
    s60 = s52*s58
    s61 = s53*s58
    s62 = s41*s55 + s52*s59
    s63 = s20 - s24 - s20*s34 + s24*s45 - s42*s55 - s53*s59
    s64 = p31 + s5*s20 + s3*s23 + s5*s24 + s3*s26 - s20*s35 - s23*s40 - s24*s46 - s26*s51 - s42*s57 - s53*s61
    s65 = 1.0/(s12 + p1 + s10 - s10*s34 - s12*s45 - s36*s55 - s47*s59)
    s66 = s62*s65
    s67 = s63*s65
    s68 = s26 - s23 + s23*s39 - s26*s50 - s42*s56 - s53*s60 + s63*s66
    s69 = 1.0/(s13 + p1 + s11 - s11*s39 - s13*s50 - s41*s56 - s52*s60 - s62*s66)
    s70 = s68*s69
    # outputs
    w[117] = s33
    w[118] = -s34
    w[119] = -s35
    w[120] = s38
    w[121] = -s39
    w[122] = s40
    w[123] = s44
    w[124] = -s45
    w[125] = s46
    w[126] = s49
    w[127] = -s50
    w[128] = -s51
    w[129] = s55
    w[130] = s56
    w[131] = s57
    w[132] = s59
    w[133] = s60
    w[134] = s61
    w[135] = -s66
    w[136] = s67
    w[137] = s70
    w[138] = s32
    w[139] = s37
    w[140] = s43
    w[141] = s48
    w[142] = s54
    w[143] = s58
    w[144] = s65
    w[145] = s69
    w[146] = 1.0/(s64 - s63*s67 - s68*s70)
    w[147] = s8
    w[148] = s9
    w[149] = s10
    w[150] = s11
    w[151] = s12
    w[152] = s13
    w[153] = s14
    w[154] = s15
    w[155] = s1
    w[156] = s2
    w[157] = s1
    w[158] = s5
    w[159] = s2
    w[160] = s4
    w[161] = s5
    w[162] = -s7
    w[163] = s4
    w[164] = s6
    w[165] = s7
    w[166] = -s6
    w[167] = p0*v0
    w[168] = p0*v1
    w[169] = v2*p30
    w[170] = p1*v3
    w[171] = p1*v4
    w[172] = v5*p31
    w[173] = p2*v6
    w[174] = p2*v7
    w[175] = v8*p32
    w[176] = v0
    w[177] = v1
    w[178] = v2
    w[179] = v3
    w[180] = v4
    w[181] = v5
    w[182] = v6
    w[183] = v7
    w[184] = v8
    w[185] = 0.0
    w[186] = 0.0
    w[187] = 0.0
    w[188] = 0.0
    w[189] = 0.0
    w[190] = 0.0
    w[191] = 0.0
    w[192] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration of augmented-hamiltonian: 281 operations, 298983 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p30 = p[30]
    p31 = p[31]
    p32 = p[32]
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
    kept_momentum_0 = w[167]
    kept_momentum_1 = w[168]
    kept_momentum_2 = w[169]
    kept_momentum_3 = w[170]
    kept_momentum_4 = w[171]
    kept_momentum_5 = w[172]
    kept_momentum_6 = w[173]
    kept_momentum_7 = w[174]
    kept_momentum_8 = w[175]
    kept_velocity_0 = w[176]
    kept_velocity_1 = w[177]
    kept_velocity_2 = w[178]
    kept_velocity_3 = w[179]
    kept_velocity_4 = w[180]
    kept_velocity_5 = w[181]
    kept_velocity_6 = w[182]
    kept_velocity_7 = w[183]
    kept_velocity_8 = w[184]
    kept_impulse_0 = w[185]
    kept_impulse_1 = w[186]
    kept_impulse_2 = w[187]
    kept_impulse_3 = w[188]
    kept_impulse_4 = w[189]
    kept_impulse_5 = w[190]
    kept_impulse_6 = w[191]
    kept_impulse_7 = w[192]
    # intermediate terms
    s0 = kept_velocity_3 + kept_jacobian_2*kept_velocity_2 - kept_velocity_0 + kept_jacobian_3*kept_velocity_5
    s1 = kept_velocity_4 + kept_jacobian_4*kept_velocity_2 - kept_velocity_1 + kept_jacobian_5*kept_velocity_5
    s2 = kept_velocity_6 + kept_jacobian_6*kept_velocity_5 - kept_velocity_3 + kept_jacobian_7*kept_velocity_8
    s3 = kept_velocity_7 + kept_jacobian_8*kept_velocity_5 - kept_velocity_4 + kept_jacobian_9*kept_velocity_8
    s4 = kept_impulse_0 + kept_penalties_0*(kept_velocity_0 + kept_jacobian_0*kept_velocity_2)
    s5 = kept_impulse_1 + kept_penalties_1*(kept_velocity_1 + kept_jacobian_1*kept_velocity_2)
    s6 = kept_impulse_2 + kept_penalties_2*s0
    s7 = kept_impulse_3 + kept_penalties_3*s1
    s8 = kept_impulse_4 + kept_penalties_4*s2
    s9 = kept_impulse_5 + kept_penalties_5*s3
    s10 = kept_impulse_6 + kept_penalties_6*(kept_velocity_6 + kept_jacobian_10*kept_velocity_8)
    s11 = kept_impulse_7 + kept_penalties_7*(kept_velocity_7 + kept_jacobian_11*kept_velocity_8)
    s12 = kept_momentum_0 - p0*kept_velocity_0 - (s4 - s6)
    s13 = kept_momentum_1 - p0*kept_velocity_1 - (s5 - s7)
    s14 = kept_momentum_2 - p30*kept_velocity_2 - (kept_jacobian_0*s4 + kept_jacobian_1*s5 + kept_jacobian_2*s6 + kept_jacobian_4*s7)
    s15 = kept_momentum_5 - p31*kept_velocity_5 - (kept_jacobian_3*s6 + kept_jacobian_5*s7 + kept_jacobian_6*s8 + kept_jacobian_8*s9)
    s16 = kept_momentum_6 - p2*kept_velocity_6 - (s8 + s10)
    s17 = kept_momentum_7 - p2*kept_velocity_7 - (s9 + s11)
    s18 = kept_momentum_8 - p32*kept_velocity_8 - (kept_jacobian_7*s8 + kept_jacobian_9*s9 + kept_jacobian_10*s10 + kept_jacobian_11*s11)
    s19 = s14 - kept_factor_0*s12 - kept_factor_3*s13
    s20 = s18 - kept_factor_6*s16 - kept_factor_9*s17
    s21 = kept_momentum_3 - p1*kept_velocity_3 - (s6 - s8) - kept_factor_1*s12 - kept_factor_7*s16 - kept_factor_12*s19
    s22 = kept_momentum_4 - p1*kept_velocity_4 - (s7 - s9) - kept_factor_4*s13 - kept_factor_10*s17 - kept_factor_13*s19
    s23 = s15 - kept_factor_2*s12 - kept_factor_5*s13 - kept_factor_8*s16 - kept_factor_11*s17 - kept_factor_14*s19
    s24 = s21 - kept_factor_15*s20
    s25 = s22 - kept_factor_16*s20 - kept_factor_18*s24
    s26 = kept_factor_29*(s23 - kept_factor_17*s20 - kept_factor_19*s24 - kept_factor_20*s25)
    s27 = kept_factor_28*s25 - kept_factor_20*s26
    s28 = kept_factor_27*s24 - kept_factor_18*s27 - kept_factor_19*s26
    s29 = kept_factor_26*s20 - kept_factor_15*s28 - kept_factor_16*s27 - kept_factor_17*s26
    s30 = kept_factor_25*s19 - kept_factor_12*s28 - kept_factor_13*s27 - kept_factor_14*s26
    s31 = kept_factor_24*s17 - kept_factor_9*s29 - kept_factor_10*s27 - kept_factor_11*s26
    s32 = kept_factor_23*s16 - kept_factor_6*s29 - kept_factor_7*s28 - kept_factor_8*s26
    s33 = kept_factor_22*s13 - kept_factor_3*s30 - kept_factor_4*s27 - kept_factor_5*s26
    s34 = kept_factor_21*s12 - kept_factor_0*s30 - kept_factor_1*s28 - kept_factor_2*s26
    s35 = kept_velocity_0 + s34
    s36 = kept_velocity_1 + s33
    s37 = kept_velocity_2 + s30
    s38 = kept_velocity_3 + s28
    s39 = kept_velocity_4 + s27
    s40 = kept_velocity_5 + s26
    s41 = kept_velocity_6 + s32
    s42 = kept_velocity_7 + s31
    s43 = kept_velocity_8 + s29
    s44 = 1.0 + s35*s35 + s36*s36 + s37*s37 + s38*s38 + s39*s39 + s40*s40 + s41*s41 + s42*s42 + s43*s43
    s45 = (s34*s34 + s33*s33 + s30*s30 + s28*s28 + s27*s27 + s26*s26 + s32*s32 + s31*s31 + s29*s29)/s44
    # outputs
    w[176] = s35
    w[177] = s36
    w[178] = s37
    w[179] = s38
    w[180] = s39
    w[181] = s40
    w[182] = s41
    w[183] = s42
    w[184] = s43
    w[185] = kept_impulse_0 + kept_penalties_0*(s35 + kept_jacobian_0*s37)
    w[186] = kept_impulse_1 + kept_penalties_1*(s36 + kept_jacobian_1*s37)
    w[187] = kept_impulse_2 + kept_penalties_2*(s38 + kept_jacobian_2*s37 - s35 + kept_jacobian_3*s40)
    w[188] = kept_impulse_3 + kept_penalties_3*(s39 + kept_jacobian_4*s37 - s36 + kept_jacobian_5*s40)
    w[189] = kept_impulse_4 + kept_penalties_4*(s41 + kept_jacobian_6*s40 - s38 + kept_jacobian_7*s43)
    w[190] = kept_impulse_5 + kept_penalties_5*(s42 + kept_jacobian_8*s40 - s39 + kept_jacobian_9*s43)
    w[191] = kept_impulse_6 + kept_penalties_6*(s41 + kept_jacobian_10*s43)
    w[192] = kept_impulse_7 + kept_penalties_7*(s42 + kept_jacobian_11*s43)
    w[9] = math.sqrt(s45)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power: 40 operations, 56 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    q5 = y[5]  # coupler.theta [rad]
    q8 = y[8]  # rocker.theta [rad]
    kept_velocity_0 = w[176]
    kept_velocity_1 = w[177]
    kept_velocity_2 = w[178]
    kept_velocity_3 = w[179]
    kept_velocity_4 = w[180]
    kept_velocity_5 = w[181]
    kept_velocity_6 = w[182]
    kept_velocity_7 = w[183]
    kept_velocity_8 = w[184]
    kept_impulse_0 = w[185]
    kept_impulse_1 = w[186]
    kept_impulse_2 = w[187]
    kept_impulse_3 = w[188]
    kept_impulse_4 = w[189]
    kept_impulse_5 = w[190]
    kept_impulse_6 = w[191]
    kept_impulse_7 = w[192]
    p21 = p[21]
    p23 = p[23]
    p25 = p[25]
    p33 = p[33]
    p34 = p[34]
    p35 = p[35]
    # intermediate terms
    s0 = math.cos(q2)*kept_velocity_2
    s1 = math.sin(q2)*kept_velocity_2
    s2 = 4.0*math.cos(q5)*kept_velocity_5
    s3 = 4.0*math.sin(q5)*kept_velocity_5
    s4 = 2.5*math.cos(q8)*kept_velocity_8
    s5 = 2.5*math.sin(q8)*kept_velocity_8
    # outputs
    ydot[0] = kept_velocity_0
    ydot[1] = kept_velocity_1
    ydot[2] = kept_velocity_2
    ydot[3] = kept_velocity_3
    ydot[4] = kept_velocity_4
    ydot[5] = kept_velocity_5
    ydot[6] = kept_velocity_6
    ydot[7] = kept_velocity_7
    ydot[8] = kept_velocity_8
    ydot[9] = 0.0
    ydot[10] = p33
    ydot[11] = (kept_impulse_0*s0 + kept_impulse_1*s1 + kept_impulse_2*s0 + kept_impulse_3*s1)*p21
    ydot[12] = 0.0
    ydot[13] = p34
    ydot[14] = (kept_impulse_2*s2 + kept_impulse_3*s3 + kept_impulse_4*s2 + kept_impulse_5*s3)*p23
    ydot[15] = 0.0
    ydot[16] = p35
    ydot[17] = (kept_impulse_6*s4 - (kept_impulse_4*s4 + kept_impulse_5*s5) + kept_impulse_7*s5)*p25
    ydot[18] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D M^-1 D^T: 332 operations, 219464 before sharing."""
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
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_7 = w[30]
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
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
    s16 = s1*p21
    s17 = s0*p21
    s18 = s8*p23
    s19 = s5*p23
    s20 = s12*p25
    s21 = s10*p25
    s22 = s1*s16
    s23 = p20 + s22
    s24 = s0*s16
    s25 = s22 - p20
    s26 = s0*s17
    s27 = p20 + s26
    s28 = s8*s18
    s29 = s5*s18
    s30 = s28 - p22
    s31 = s5*s19
    s32 = s12*s20
    s33 = s10*s20
    s34 = p24 - s32
    s35 = s10*s21
    s36 = s12*s21
    s37 = s1*s1
    s38 = 1.0 + s37
    s39 = s0*s1
    s40 = -1.0 + s37
    s41 = s0*s0
    s42 = 1.0 + s41
    s43 = s8*s8
    s44 = 1.0 + s38 + s43
    s45 = s5*s8
    s46 = -1.0 + s43
    s47 = s5*s5
    s48 = 1.0 + s42 + s47
    s49 = s12*s12
    s50 = 1.0 + 1.0 + s43 + s49
    s51 = s10*s12
    s52 = 1.0 - s49
    s53 = s10*s10
    s54 = 1.0 + 1.0 + s47 + s53
    s55 = 1.0 + s53
    s56 = 1.0/s38
    s57 = s39*s56
    s58 = s40*s56
    s59 = s39*s57
    s60 = s42 - s59
    s61 = s40*s57 - s39
    s62 = -1.0 + s41 - s59
    s63 = 1.0*(s60 > mask_1 + 1e-12*s42)
    s64 = 1.0 - s63
    s65 = s63/(s60 + s64)
    s66 = s61*s65
    s67 = s44 - s40*s58 - s61*s66
    s68 = s39*s58 - (s39 + s45) - s62*s66
    s69 = 1.0/(1.0 + s49)
    s70 = s51*s69
    s71 = s52*s69
    s72 = s51*s70
    s73 = s55 - s72
    s74 = s51 + s52*s70
    s75 = 1.0 - s53 + s72
    s76 = 1.0*(s73 > mask_7 + 1e-12*s55)
    s77 = 1.0 - s76
    s78 = s76/(s73 + s77)
    s79 = s74*s78
    s80 = 1.0*(s67 > mask_2 + 1e-12*s44)
    s81 = 1.0 - s80
    s82 = s80/(s67 + s81)
    s83 = s68*s82
    s84 = s46*s82
    s85 = s48 - s59 - s62*(s62*s65) - s68*s83
    s86 = s45 + s46*s83
    s87 = -1.0 + s47 + s45*s83
    s88 = 1.0*(s85 > mask_3 + 1e-12*s48)
    s89 = 1.0 - s88
    s90 = s88/(s85 + s89)
    s91 = s86*s90
    s92 = s50 - s52*s71 - s74*s79 - s46*s84 - s86*s91
    s93 = s45*s84 - (s45 + s51 + s51*s71 + s75*s79) + s87*s91
    s94 = 1.0*(s92 > mask_4 + 1e-12*s50)
    s95 = 1.0 - s94
    s96 = s54 - s72 - s75*(s75*s78) - s45*(s45*s82) - s87*(s87*s90) - s93*(s93*(s94/(s92 + s95)))
    s97 = 1.0*(s96 > mask_5 + 1e-12*s54)
    s98 = 1.0/s23
    s99 = s24*s98
    s100 = -s99
    s101 = s25*s98
    s102 = s24*s99
    s103 = s25*s99 - s1*s17
    s104 = s26 - p20 - s102
    s105 = s63/(s64 + s27 - s102)
    s106 = s103*s105
    s107 = s104*s105
    s108 = s24*s101 - (s24 + s29) - s104*s106
    s109 = 1.0/(p24 + s32)
    s110 = s33*s109
    s111 = s34*s109
    s112 = s36*s109
    s113 = s33 + s34*s110
    s114 = p24 - s35 + s36*s110
    s115 = s76/(s77 + p24 + s35 - s33*s110)
    s116 = s113*s115
    s117 = s114*s115
    s118 = s80/(s81 + p22 + s23 + s28 - s25*s101 - s103*s106)
    s119 = s108*s118
    s120 = s30*s118
    s121 = s29*s118
    s122 = s8*s19 + s30*s119
    s123 = s31 - p22 + s29*s119
    s124 = s88/(s89 + p22 + s27 + s31 - s102 - s104*s107 - s108*s119)
    s125 = s122*s124
    s126 = s123*s124
    s127 = s29*s120 - (s29 + s33 + s36*s111 + s114*s116) + s123*s125
    s128 = s94/(s95 + p24 + p22 + s28 + s32 - s34*s111 - s113*s116 - s30*s120 - s122*s125)
    s129 = s127*s128
    s130 = 1.0 - s97 + p24 + p22 + s31 + s35 - s36*s112 - s114*s117 - s29*s121 - s123*s126 - s127*s129
    s131 = s60/s42
    s132 = s67/s44
    s133 = s85/s48
    s134 = s92/s50
    s135 = s96/s54
    s136 = min(min(min(min(min(1.0, mask_1 + s131), mask_2 + s132), mask_3 + s133), mask_4 + s134), mask_5 + s135)
    s137 = s73/s55
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
    w[56] = s131
    w[57] = s132
    w[58] = s133
    w[59] = s134
    w[60] = s135
    w[62] = s137
    w[5] = s76 + 1.0 + s97 + s94 + s88 + s80 + 1.0 + s63
    w[4] = min(s136, mask_7 + s137)
    w[193] = s100
    w[194] = s101
    w[195] = s100
    w[196] = s106
    w[197] = s107
    w[198] = -s110
    w[199] = s111
    w[200] = s112
    w[201] = s116
    w[202] = s117
    w[203] = s119
    w[204] = s120
    w[205] = -s121
    w[206] = -s125
    w[207] = s126
    w[208] = s129
    w[209] = s98
    w[210] = s105
    w[211] = s109
    w[212] = s115
    w[213] = s118
    w[214] = s124
    w[215] = s128
    w[216] = s97/s130
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 111 operations, 6990 before sharing."""
    # inputs
    p20 = p[20]
    p21 = p[21]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
    law_lower_0 = w[193]
    law_lower_1 = w[194]
    law_lower_2 = w[195]
    law_lower_3 = w[196]
    law_lower_4 = w[197]
    law_lower_5 = w[198]
    law_lower_6 = w[199]
    law_lower_7 = w[200]
    law_lower_8 = w[201]
    law_lower_9 = w[202]
    law_lower_10 = w[203]
    law_lower_11 = w[204]
    law_lower_12 = w[205]
    law_lower_13 = w[206]
    law_lower_14 = w[207]
    law_lower_15 = w[208]
    law_reciprocal_0 = w[209]
    law_reciprocal_1 = w[210]
    law_reciprocal_2 = w[211]
    law_reciprocal_3 = w[212]
    law_reciprocal_4 = w[213]
    law_reciprocal_5 = w[214]
    law_reciprocal_6 = w[215]
    law_reciprocal_7 = w[216]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
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
    # intermediate terms
    s0 = law_lower_0*residual_0 - residual_1
    s1 = law_lower_1*residual_0 - residual_2 - law_lower_3*s0
    s2 = law_lower_5*residual_6 - residual_7
    s3 = law_lower_2*residual_0 - residual_3 - law_lower_4*s0 - law_lower_10*s1
    s4 = law_lower_6*residual_6 - residual_4 - law_lower_8*s2 - law_lower_11*s1 - law_lower_13*s3
    s5 = law_lower_7*residual_6 - residual_5 - law_lower_9*s2 - law_lower_12*s1 - law_lower_14*s3 - law_lower_15*s4
    s6 = law_reciprocal_7*s5
    s7 = law_reciprocal_6*s4
    s8 = law_lower_15*s6
    s9 = s7 - s8
    s10 = law_reciprocal_5*s3 - law_lower_13*s9
    s11 = law_lower_14*s6
    s12 = s10 - s11
    s13 = law_reciprocal_4*s1 - law_lower_10*s12 - law_lower_11*s9
    s14 = law_lower_12*s6
    s15 = s13 - s14
    s16 = law_reciprocal_3*s2 - law_lower_8*s9 - law_lower_9*s6
    s17 = law_reciprocal_2*residual_6 + law_lower_5*s16 + law_lower_6*s9 + law_lower_7*s6
    s18 = law_reciprocal_1*s0 - law_lower_3*s15 - law_lower_4*s12
    s19 = law_reciprocal_0*residual_0 + law_lower_0*s18 + law_lower_1*s15 + law_lower_2*s12
    # outputs
    w[63] = p20*(s14 - s13 - s19)
    w[64] = p20*(s18 + s11 - s10)
    w[65] = p21*(s18*jacobian_1 - s19*jacobian_0 + s15*jacobian_2 + s12*jacobian_4)
    w[66] = p22*(s15 + s8 - s7)
    w[67] = p22*(s12 - s6)
    w[68] = p23*(s15*jacobian_3 + s12*jacobian_5 + s9*jacobian_6 + s6*jacobian_8)
    w[69] = p24*(s9 - s17)
    w[70] = p24*(s6 + s16)
    w[71] = p25*(s9*jacobian_7 + s6*jacobian_9 - s17*jacobian_10 + s16*jacobian_11)
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
