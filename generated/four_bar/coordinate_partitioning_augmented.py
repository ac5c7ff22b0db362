"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 2, templates 06e8f0c6b361de81
option solver = augmented
p[15] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

CHANGE = 63  # sections of w
MASS = 72
DEPENDENT = 187
DENSE = 196


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
    p[16] = s0
    p[17] = -s1
    p[18] = s2
    p[19] = -s3
    p[20] = s4
    p[21] = -s5
    p[22] = 11111.111111111111*(s4 + p2 + p2 + s2 + p1 + p1 + s0 + p0 + p0)
    p[23] = -s1*(1.0/p0)
    p[24] = -s3*(1.0/p1)
    p[25] = -s5*(1.0/p2)
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
    p16 = p[16]
    p17 = p[17]
    p18 = p[18]
    p19 = p[19]
    p20 = p[20]
    p21 = p[21]
    mask_0 = w[23]
    mask_1 = w[24]
    mask_2 = w[25]
    mask_3 = w[26]
    mask_4 = w[27]
    mask_5 = w[28]
    mask_6 = w[29]
    mask_7 = w[30]
    p22 = p[22]
    p23 = p[23]
    p24 = p[24]
    p25 = p[25]
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
    s21 = p22*(1.0*(1.0 > mask_0))
    s22 = p22*(1.0*(1.0 > mask_1))
    s23 = p22*(1.0*(1.0 > mask_2))
    s24 = p22*(1.0*(1.0 > mask_3))
    s25 = p22*(1.0*(1.0 > mask_4))
    s26 = p22*(1.0*(1.0 > mask_5))
    s27 = p22*(1.0*(1.0 > mask_6))
    s28 = p22*(1.0*(1.0 > mask_7))
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
    s67 = 1.0/(p16 + s1*s29 + s0*s30 + s1*s31 + s0*s34 - s32*s46 - s35*s51)
    s68 = s49*s67
    s69 = s54*s67
    s70 = s55*s67
    s71 = p18 + s10*s33 + s8*s36 + s10*s37 + s8*s39 - s33*s48 - s36*s53 - s37*s59 - s39*s64 - s55*s70
    s72 = 1.0/(p20 + s17*s38 + s16*s40 + s17*s41 + s16*s43 - s42*s57 - s44*s62)
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
    w[167] = p17
    w[168] = p19
    w[169] = p21
    w[170] = -s4
    w[171] = -s5
    w[172] = -(s4 + s12)
    w[173] = -(s5 + s13)
    w[174] = s19 - s12
    w[175] = s20 - s13
    w[176] = -s19
    w[177] = -s20
    w[178] = 0.0
    w[179] = p23
    w[180] = 0.0
    w[181] = 0.0
    w[182] = p24
    w[183] = 0.0
    w[184] = 0.0
    w[185] = p25
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
    """one iteration of coordinate-partitioning: 292 operations, 324332 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p16 = p[16]
    p18 = p[18]
    p20 = p[20]
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
    s18 = p16*kept_acceleration_2 + kept_jacobian_0*s8 + kept_jacobian_1*s9 + kept_jacobian_2*s10 + kept_jacobian_4*s11
    s19 = p18*kept_acceleration_5 + kept_jacobian_3*s10 + kept_jacobian_5*s11 + kept_jacobian_6*s12 + kept_jacobian_8*s13
    s20 = p2*kept_acceleration_6 + s12 + s14
    s21 = kept_force_2 - p2*kept_acceleration_7 - (s13 + s15)
    s22 = p20*kept_acceleration_8 + kept_jacobian_7*s12 + kept_jacobian_9*s13 + kept_jacobian_10*s14 + kept_jacobian_11*s15
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
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
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
    # outputs
    w[196] = 1.0
    w[198] = jacobian_0
    w[206] = 1.0
    w[207] = jacobian_1
    w[214] = -1.0
    w[216] = jacobian_2
    w[217] = 1.0
    w[219] = jacobian_3
    w[224] = -1.0
    w[225] = jacobian_4
    w[227] = 1.0
    w[228] = jacobian_5
    w[235] = -1.0
    w[237] = jacobian_6
    w[238] = 1.0
    w[240] = jacobian_7
    w[245] = -1.0
    w[246] = jacobian_8
    w[248] = 1.0
    w[249] = jacobian_9
    w[256] = 1.0
    w[258] = jacobian_10
    w[266] = 1.0
    w[267] = jacobian_11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D P D^T: 373 operations, 475926 before sharing."""
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
    dependent_0 = w[187]
    dependent_1 = w[188]
    dependent_2 = w[189]
    dependent_3 = w[190]
    dependent_4 = w[191]
    dependent_5 = w[192]
    dependent_6 = w[193]
    dependent_7 = w[194]
    dependent_8 = w[195]
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
    s16 = s1*s1
    s17 = 1.0 + s16
    s18 = s0*s1
    s19 = -1.0 + s16
    s20 = s0*s0
    s21 = 1.0 + s20
    s22 = s8*s8
    s23 = 1.0 + s17 + s22
    s24 = s5*s8
    s25 = -1.0 + s22
    s26 = s5*s5
    s27 = 1.0 + s21 + s26
    s28 = s12*s12
    s29 = 1.0 + 1.0 + s22 + s28
    s30 = s10*s12
    s31 = 1.0 - s28
    s32 = s10*s10
    s33 = 1.0 + 1.0 + s26 + s32
    s34 = 1.0 + s28
    s35 = 1.0 + s32
    s36 = 1.0/s17
    s37 = s18*s36
    s38 = s19*s36
    s39 = s18*s37
    s40 = s21 - s39
    s41 = s19*s37 - s18
    s42 = -1.0 + s20 - s39
    s43 = 1.0*(s40 > mask_1 + 1e-12*s21)
    s44 = 1.0 - s43
    s45 = s43/(s40 + s44)
    s46 = s41*s45
    s47 = s23 - s19*s38 - s41*s46
    s48 = s18*s38 - (s18 + s24) - s42*s46
    s49 = 1.0/s34
    s50 = s30*s49
    s51 = s31*s49
    s52 = s30*s50
    s53 = s35 - s52
    s54 = s30 + s31*s50
    s55 = 1.0 - s32 + s52
    s56 = 1.0*(s53 > mask_7 + 1e-12*s35)
    s57 = 1.0 - s56
    s58 = s56/(s53 + s57)
    s59 = s54*s58
    s60 = 1.0*(s47 > mask_2 + 1e-12*s23)
    s61 = 1.0 - s60
    s62 = s60/(s47 + s61)
    s63 = s48*s62
    s64 = s25*s62
    s65 = s27 - s39 - s42*(s42*s45) - s48*s63
    s66 = s24 + s25*s63
    s67 = -1.0 + s26 + s24*s63
    s68 = 1.0*(s65 > mask_3 + 1e-12*s27)
    s69 = 1.0 - s68
    s70 = s68/(s65 + s69)
    s71 = s66*s70
    s72 = s29 - s31*s51 - s54*s59 - s25*s64 - s66*s71
    s73 = s24*s64 - (s24 + s30 + s30*s51 + s55*s59) + s67*s71
    s74 = 1.0*(s72 > mask_4 + 1e-12*s29)
    s75 = 1.0 - s74
    s76 = s74/(s72 + s75)
    s77 = s33 - s52 - s55*(s55*s58) - s24*(s24*s62) - s67*(s67*s70) - s73*(s73*s76)
    s78 = 1.0*(s77 > mask_5 + 1e-12*s33)
    s79 = 1.0 - s78
    s80 = s78/(s77 + s79)
    s81 = s1*dependent_2
    s82 = s0*dependent_2
    s83 = s8*dependent_5
    s84 = s5*dependent_5
    s85 = s12*dependent_8
    s86 = s10*dependent_8
    s87 = s1*s81
    s88 = dependent_0 + s87
    s89 = s0*s81
    s90 = s87 - dependent_0
    s91 = s0*s82
    s92 = dependent_1 + s91
    s93 = s8*s83
    s94 = s5*s83
    s95 = s93 - dependent_3
    s96 = s5*s84
    s97 = s12*s85
    s98 = s10*s85
    s99 = dependent_6 - s97
    s100 = s10*s86
    s101 = s12*s86
    s102 = dependent_6 + s97
    s103 = 1.0/s88
    s104 = s89*s103
    s105 = -s104
    s106 = s90*s103
    s107 = s89*s104
    s108 = s92 - s107
    s109 = s90*s104 - s1*s82
    s110 = s91 - dependent_1 - s107
    s111 = s43/(s44 + s108)
    s112 = s109*s111
    s113 = s110*s111
    s114 = dependent_3 + s88 + s93 - s90*s106 - s109*s112
    s115 = s89*s106 - (s89 + s94) - s110*s112
    s116 = 1.0/s102
    s117 = s98*s116
    s118 = s99*s116
    s119 = s101*s116
    s120 = dependent_7 + s100 - s98*s117
    s121 = s98 + s99*s117
    s122 = dependent_7 - s100 + s101*s117
    s123 = s56/(s57 + s120)
    s124 = s121*s123
    s125 = s122*s123
    s126 = s60/(s61 + s114)
    s127 = s115*s126
    s128 = s95*s126
    s129 = s94*s126
    s130 = dependent_4 + s92 + s96 - s107 - s110*s113 - s115*s127
    s131 = s8*s84 + s95*s127
    s132 = s96 - dependent_4 + s94*s127
    s133 = s68/(s69 + s130)
    s134 = s131*s133
    s135 = s132*s133
    s136 = dependent_6 + dependent_3 + s93 + s97 - s99*s118 - s121*s124 - s95*s128 - s131*s134
    s137 = s94*s128 - (s94 + s98 + s101*s118 + s122*s124) + s132*s134
    s138 = s74/(s75 + s136)
    s139 = s137*s138
    s140 = dependent_7 + dependent_4 + s96 + s100 - s101*s119 - s122*s125 - s94*s129 - s132*s135 - s137*s139
    s141 = (s36*s88 + 1.0 - s17*s36)*(s45*s108 + 1.0 - s40*s45)*(s49*s102 + 1.0 - s34*s49)*(s58*s120 + 1.0 - s53*s58)
    s142 = s141*(s62*s114 + 1.0 - s47*s62)*(s70*s130 + 1.0 - s65*s70)*(s76*s136 + 1.0 - s72*s76)*(s80*s140 + 1.0 - s77*s80)
    s143 = s40/s21
    s144 = s47/s23
    s145 = s65/s27
    s146 = s72/s29
    s147 = s77/s33
    s148 = min(min(min(min(min(1.0, mask_1 + s143), mask_2 + s144), mask_3 + s145), mask_4 + s146), mask_5 + s147)
    s149 = s53/s35
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
    w[56] = s143
    w[57] = s144
    w[58] = s145
    w[59] = s146
    w[60] = s147
    w[62] = s149
    w[5] = s56 + 1.0 + s78 + s74 + s68 + s60 + 1.0 + s43
    w[4] = min(s148, mask_7 + s149)
    w[10] = s142
    w[268] = s105
    w[269] = s106
    w[270] = s105
    w[271] = s112
    w[272] = s113
    w[273] = -s117
    w[274] = s118
    w[275] = s119
    w[276] = s124
    w[277] = s125
    w[278] = s127
    w[279] = s128
    w[280] = -s129
    w[281] = -s134
    w[282] = s135
    w[283] = s139
    w[284] = s103
    w[285] = s111
    w[286] = s116
    w[287] = s123
    w[288] = s126
    w[289] = s133
    w[290] = s138
    w[291] = s78/(s79 + s140)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 111 operations, 6990 before sharing."""
    # inputs
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
    dependent_0 = w[187]
    dependent_1 = w[188]
    dependent_2 = w[189]
    dependent_3 = w[190]
    dependent_4 = w[191]
    dependent_5 = w[192]
    dependent_6 = w[193]
    dependent_7 = w[194]
    dependent_8 = w[195]
    law_lower_0 = w[268]
    law_lower_1 = w[269]
    law_lower_2 = w[270]
    law_lower_3 = w[271]
    law_lower_4 = w[272]
    law_lower_5 = w[273]
    law_lower_6 = w[274]
    law_lower_7 = w[275]
    law_lower_8 = w[276]
    law_lower_9 = w[277]
    law_lower_10 = w[278]
    law_lower_11 = w[279]
    law_lower_12 = w[280]
    law_lower_13 = w[281]
    law_lower_14 = w[282]
    law_lower_15 = w[283]
    law_reciprocal_0 = w[284]
    law_reciprocal_1 = w[285]
    law_reciprocal_2 = w[286]
    law_reciprocal_3 = w[287]
    law_reciprocal_4 = w[288]
    law_reciprocal_5 = w[289]
    law_reciprocal_6 = w[290]
    law_reciprocal_7 = w[291]
    residual_0 = w[39]
    residual_1 = w[40]
    residual_2 = w[41]
    residual_3 = w[42]
    residual_4 = w[43]
    residual_5 = w[44]
    residual_6 = w[45]
    residual_7 = w[46]
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
    w[63] = dependent_0*(s14 - s13 - s19)
    w[64] = dependent_1*(s18 + s11 - s10)
    w[65] = dependent_2*(jacobian_1*s18 - jacobian_0*s19 + jacobian_2*s15 + jacobian_4*s12)
    w[66] = dependent_3*(s15 + s8 - s7)
    w[67] = dependent_4*(s12 - s6)
    w[68] = dependent_5*(jacobian_3*s15 + jacobian_5*s12 + jacobian_6*s9 + jacobian_8*s6)
    w[69] = dependent_6*(s9 - s17)
    w[70] = dependent_7*(s6 + s16)
    w[71] = dependent_8*(jacobian_7*s9 + jacobian_9*s6 - jacobian_10*s17 + jacobian_11*s16)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accelerate(t, y, p, w, iw, ydot):
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
def close(t, y, p, w, iw):
    """Dependent coordinates from Phi = 0 and dependent velocities from D v = nu, the independent ones kept."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[15] * w[6]
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
    return bits


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state, whose dependent part is closed first."""
    close(t, y, p, w, iw)
    return accelerate(t, y, p, w, iw, ydot)


@njit(error_model="numpy", fastmath={"contract"})
def release(w):
    """Make all coordinates dependent, weighted by M^-1: near a singular position no partition determines the motion."""
    largest = 0.0
    for j in range(9):
        largest = max(largest, w[MASS + j])
    for j in range(9):
        w[DEPENDENT + j] = 1.0 / max(w[MASS + j], 1e-6 * largest)  # massless bodies give way, within reason
    w[11] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Close an accepted state, choose another partition where this one has become poor, and measure."""
    poor = False
    if iw[5] == 0:
        geometry(t, y, p, w)
        # the root of the smallest pivot is the sine of an angle: it says whether the next step meets a singular position
        sine = math.sqrt(max(w[4], 0.0))
        fall = max(w[13] - sine, 0.0)
        w[13] = sine
        first = iw[7] == 0
        released = w[11] == 0.0 and not first
        if sine - fall < 0.01:
            if not released:
                release(w)
                iw[7] += 1
        else:
            quality = w[10]
            w[11] = max(w[11], quality)
            ahead = quality - max(w[12] - quality, 0.0)
            poor = released or ahead < 0.3 * w[11]
            w[12] = quality
            if first:
                choose(p, w, iw)
                geometry(t, y, p, w)
                w[11] = w[10]
    bits = close(t, y, p, w, iw)
    if poor:  # after closing: the partition that was integrated with is better for it than one from a singular position
        choose(p, w, iw)
        geometry(t, y, p, w)
        w[11] = w[10]
        w[12] = w[10]
    measure(t, y, p, w)
    return bits
