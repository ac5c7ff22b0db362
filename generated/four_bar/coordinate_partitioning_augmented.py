"""Method `coordinate-partitioning` for model `four-bar`. Emitted by symgen; do not edit.

independent coordinates are integrated, dependent ones follow from the constraints
Wehage, Haug, J. Mech. Des. 104 (1982) 247-255, doi 10.1115/1.3256318
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 1, templates 2b445adb8ae4f174
option solver = augmented
p[15] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import measure

CHANGE = 61  # sections of w
DEPENDENT = 173
DENSE = 182


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
    p[16] = s0
    p[17] = -s1
    p[18] = s2
    p[19] = -s3
    p[20] = s4
    p[21] = -s5
    p[22] = s6
    p[23] = s7
    p[24] = s8
    p[25] = -s8
    p[26] = s9
    p[27] = s10
    p[28] = -s10
    p[29] = s6 + p1 + s6 - s6*s8 - s6*s10
    p[30] = -s1*(1.0/p0)
    p[31] = -s3*(1.0/p1)
    p[32] = -s5*(1.0/p2)
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
    p32 = p[32]
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
    s21 = s1*p22
    s22 = s1*s21
    s23 = s0*p22
    s24 = s0*s23
    s25 = s10*p22
    s26 = s10*s25
    s27 = s8*p22
    s28 = s10*s21 + s8*s23
    s29 = s8*s27
    s30 = s17*p22
    s31 = s17*s30
    s32 = s16*p22
    s33 = s17*s25 + s16*s27
    s34 = s16*s32
    s35 = s25*p23
    s36 = s27*p23
    s37 = s25*p26
    s38 = s27*p26
    s39 = 1.0/(s24 + s22 + p16 + s22 + s24)
    s40 = s21*s39
    s41 = s23*s39
    s42 = s28*s39
    s43 = 1.0/(s34 + s31 + p20 + s31 + s34)
    s44 = s30*s43
    s45 = s32*s43
    s46 = s33*s43
    s47 = s23*s40 + s32*s44
    s48 = s25*p27 - s25*p24 - s28*s40 + s33*s44
    s49 = 1.0/(p29 - s21*s40 - s30*s44)
    s50 = s47*s49
    s51 = s48*s49
    s52 = s27*p24 - s27*p27 + s28*s41 - s33*s45 - s48*s50
    s53 = s29 + s26 + p18 + s26 + s29 - s25*s35 - s27*s36 - s25*s37 - s27*s38 - s28*s42 - s33*s46 - s48*s51
    s54 = 1.0/(p29 - s23*s41 - s32*s45 - s47*s50)
    s55 = s52*s54
    # outputs
    w[115] = p25
    w[116] = -s35
    w[117] = p25
    w[118] = s36
    w[119] = p28
    w[120] = s37
    w[121] = p28
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
    w[132] = p23
    w[133] = p23
    w[134] = p26
    w[135] = p26
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
    w[153] = p17
    w[154] = p19
    w[155] = p21
    w[156] = -s4
    w[157] = -s5
    w[158] = -(s4 + s12)
    w[159] = -(s5 + s13)
    w[160] = s19 - s12
    w[161] = s20 - s13
    w[162] = -s19
    w[163] = -s20
    w[164] = 0.0
    w[165] = p30
    w[166] = 0.0
    w[167] = 0.0
    w[168] = p31
    w[169] = 0.0
    w[170] = 0.0
    w[171] = p32
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
    """one iteration of coordinate-partitioning: 276 operations, 128264 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p16 = p[16]
    p18 = p[18]
    p20 = p[20]
    p22 = p[22]
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
    s4 = multipliers_0 + p22*(kept_acceleration_0 + kept_jacobian_0*kept_acceleration_2 - kept_target_0)
    s5 = multipliers_1 + p22*(kept_acceleration_1 + kept_jacobian_1*kept_acceleration_2 - kept_target_1)
    s6 = multipliers_2 + p22*(s0 - kept_target_2)
    s7 = multipliers_3 + p22*(s1 - kept_target_3)
    s8 = multipliers_4 + p22*(s2 - kept_target_4)
    s9 = multipliers_5 + p22*(s3 - kept_target_5)
    s10 = multipliers_6 + p22*(kept_acceleration_6 + kept_jacobian_10*kept_acceleration_8 - kept_target_6)
    s11 = multipliers_7 + p22*(kept_acceleration_7 + kept_jacobian_11*kept_acceleration_8 - kept_target_7)
    s12 = p0*kept_acceleration_0 + s4 - s6
    s13 = kept_force_0 - p0*kept_acceleration_1 - (s5 - s7)
    s14 = p16*kept_acceleration_2 + kept_jacobian_0*s4 + kept_jacobian_1*s5 + kept_jacobian_2*s6 + kept_jacobian_4*s7
    s15 = p18*kept_acceleration_5 + kept_jacobian_3*s6 + kept_jacobian_5*s7 + kept_jacobian_6*s8 + kept_jacobian_8*s9
    s16 = p2*kept_acceleration_6 + s8 + s10
    s17 = kept_force_2 - p2*kept_acceleration_7 - (s9 + s11)
    s18 = p20*kept_acceleration_8 + kept_jacobian_7*s8 + kept_jacobian_9*s9 + kept_jacobian_10*s10 + kept_jacobian_11*s11
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
    s43 = multipliers_3 + p22*(s37 + kept_jacobian_4*s35 - s34 + kept_jacobian_5*s38 - kept_target_3)
    s44 = multipliers_4 + p22*(s39 + kept_jacobian_6*s38 - s36 + kept_jacobian_7*s41 - kept_target_4)
    s45 = multipliers_5 + p22*(s40 + kept_jacobian_8*s38 - s37 + kept_jacobian_9*s41 - kept_target_5)
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
    w[13] = multipliers_0 + p22*(s33 + kept_jacobian_0*s35 - kept_target_0)
    w[14] = multipliers_1 + p22*(s34 + kept_jacobian_1*s35 - kept_target_1)
    w[15] = multipliers_2 + p22*s42
    w[16] = s43
    w[17] = s44
    w[18] = s45
    w[19] = multipliers_6 + p22*(s39 + kept_jacobian_10*s41 - kept_target_6)
    w[20] = multipliers_7 + p22*(s40 + kept_jacobian_11*s41 - kept_target_7)
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
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
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
    # outputs
    w[182] = 1.0
    w[184] = jacobian_0
    w[192] = 1.0
    w[193] = jacobian_1
    w[200] = -1.0
    w[202] = jacobian_2
    w[203] = 1.0
    w[205] = jacobian_3
    w[210] = -1.0
    w[211] = jacobian_4
    w[213] = 1.0
    w[214] = jacobian_5
    w[221] = -1.0
    w[223] = jacobian_6
    w[224] = 1.0
    w[226] = jacobian_7
    w[231] = -1.0
    w[232] = jacobian_8
    w[234] = 1.0
    w[235] = jacobian_9
    w[242] = 1.0
    w[244] = jacobian_10
    w[252] = 1.0
    w[253] = jacobian_11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D D^T that decide rank, and the factorisation of D P D^T: 366 operations, 284401 before sharing."""
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
    mask_1 = w[22]
    mask_2 = w[23]
    mask_3 = w[24]
    mask_4 = w[25]
    mask_5 = w[26]
    mask_7 = w[28]
    dependent_0 = w[173]
    dependent_1 = w[174]
    dependent_2 = w[175]
    dependent_3 = w[176]
    dependent_4 = w[177]
    dependent_5 = w[178]
    dependent_6 = w[179]
    dependent_7 = w[180]
    dependent_8 = w[181]
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
    s43 = 1e-12*s21
    s44 = 1.0*(s40 > mask_1 + s43)
    s45 = 1.0 - s44
    s46 = s44/(s40 + s45)
    s47 = s41*s46
    s48 = s23 - s19*s38 - s41*s47
    s49 = s18*s38 - (s18 + s24) - s42*s47
    s50 = 1.0/s34
    s51 = s30*s50
    s52 = s31*s50
    s53 = s30*s51
    s54 = s35 - s53
    s55 = s30 + s31*s51
    s56 = 1.0 - s32 + s53
    s57 = 1e-12*s35
    s58 = 1.0*(s54 > mask_7 + s57)
    s59 = 1.0 - s58
    s60 = s58/(s54 + s59)
    s61 = s55*s60
    s62 = 1e-12*s23
    s63 = 1.0*(s48 > mask_2 + s62)
    s64 = 1.0 - s63
    s65 = s63/(s48 + s64)
    s66 = s49*s65
    s67 = s25*s65
    s68 = s27 - s39 - s42*(s42*s46) - s49*s66
    s69 = s24 + s25*s66
    s70 = -1.0 + s26 + s24*s66
    s71 = 1e-12*s27
    s72 = 1.0*(s68 > mask_3 + s71)
    s73 = 1.0 - s72
    s74 = s72/(s68 + s73)
    s75 = s69*s74
    s76 = s29 - s31*s52 - s55*s61 - s25*s67 - s69*s75
    s77 = s24*s67 - (s24 + s30 + s30*s52 + s56*s61) + s70*s75
    s78 = 1e-12*s29
    s79 = 1.0*(s76 > mask_4 + s78)
    s80 = 1.0 - s79
    s81 = s33 - s53 - s56*(s56*s60) - s24*(s24*s65) - s70*(s70*s74) - s77*(s77*(s79/(s76 + s80)))
    s82 = 1e-12*s33
    s83 = 1.0*(s81 > mask_5 + s82)
    s84 = s1*dependent_2
    s85 = s0*dependent_2
    s86 = s8*dependent_5
    s87 = s5*dependent_5
    s88 = s12*dependent_8
    s89 = s10*dependent_8
    s90 = s1*s84
    s91 = dependent_0 + s90
    s92 = s0*s84
    s93 = s90 - dependent_0
    s94 = s0*s85
    s95 = dependent_1 + s94
    s96 = s8*s86
    s97 = s5*s86
    s98 = s96 - dependent_3
    s99 = s5*s87
    s100 = s12*s88
    s101 = s10*s88
    s102 = dependent_6 - s100
    s103 = s10*s89
    s104 = s12*s89
    s105 = dependent_6 + s100
    s106 = 1.0/s91
    s107 = s92*s106
    s108 = -s107
    s109 = s93*s106
    s110 = s92*s107
    s111 = s95 - s110
    s112 = s93*s107 - s1*s85
    s113 = s94 - dependent_1 - s110
    s114 = s44/(s45 + s111)
    s115 = s112*s114
    s116 = s113*s114
    s117 = dependent_3 + s91 + s96 - s93*s109 - s112*s115
    s118 = s92*s109 - (s92 + s97) - s113*s115
    s119 = 1.0/s105
    s120 = s101*s119
    s121 = s102*s119
    s122 = s104*s119
    s123 = dependent_7 + s103 - s101*s120
    s124 = s101 + s102*s120
    s125 = dependent_7 - s103 + s104*s120
    s126 = s58/(s59 + s123)
    s127 = s124*s126
    s128 = s125*s126
    s129 = s63/(s64 + s117)
    s130 = s118*s129
    s131 = s98*s129
    s132 = s97*s129
    s133 = dependent_4 + s95 + s99 - s110 - s113*s116 - s118*s130
    s134 = s8*s87 + s98*s130
    s135 = s99 - dependent_4 + s97*s130
    s136 = s72/(s73 + s133)
    s137 = s134*s136
    s138 = s135*s136
    s139 = dependent_6 + dependent_3 + s96 + s100 - s102*s121 - s124*s127 - s98*s131 - s134*s137
    s140 = s97*s131 - (s97 + s101 + s104*s121 + s125*s127) + s135*s137
    s141 = s79/(s80 + s139)
    s142 = s140*s141
    s143 = dependent_7 + dependent_4 + s99 + s103 - s104*s122 - s125*s128 - s97*s132 - s135*s138 - s140*s142
    s144 = min(min(min(1.0, s91/s17 + 1.0*(1e-12*s17 > s17)), s111/s21 + 1.0*(s43 > s40)), s105/s34 + 1.0*(1e-12*s34 > s34))
    s145 = min(min(min(s144, s123/s35 + 1.0*(s57 > s54)), s117/s23 + 1.0*(s62 > s48)), s133/s27 + 1.0*(s71 > s68))
    s146 = s40/s21
    s147 = s48/s23
    s148 = s68/s27
    s149 = s76/s29
    s150 = s81/s33
    s151 = min(min(min(min(min(1.0, mask_1 + s146), mask_2 + s147), mask_3 + s148), mask_4 + s149), mask_5 + s150)
    s152 = s54/s35
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
    w[54] = s146
    w[55] = s147
    w[56] = s148
    w[57] = s149
    w[58] = s150
    w[60] = s152
    w[5] = s58 + 1.0 + s83 + s79 + s72 + s63 + 1.0 + s44
    w[4] = min(s151, mask_7 + s152)
    w[10] = min(min(s145, s139/s29 + 1.0*(s78 > s76)), s143/s33 + 1.0*(s82 > s81))
    w[254] = s108
    w[255] = s109
    w[256] = s108
    w[257] = s115
    w[258] = s116
    w[259] = -s120
    w[260] = s121
    w[261] = s122
    w[262] = s127
    w[263] = s128
    w[264] = s130
    w[265] = s131
    w[266] = -s132
    w[267] = -s137
    w[268] = s138
    w[269] = s142
    w[270] = s106
    w[271] = s114
    w[272] = s119
    w[273] = s126
    w[274] = s129
    w[275] = s136
    w[276] = s141
    w[277] = s83/(1.0 - s83 + s143)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 111 operations, 6990 before sharing."""
    # inputs
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
    dependent_0 = w[173]
    dependent_1 = w[174]
    dependent_2 = w[175]
    dependent_3 = w[176]
    dependent_4 = w[177]
    dependent_5 = w[178]
    dependent_6 = w[179]
    dependent_7 = w[180]
    dependent_8 = w[181]
    law_lower_0 = w[254]
    law_lower_1 = w[255]
    law_lower_2 = w[256]
    law_lower_3 = w[257]
    law_lower_4 = w[258]
    law_lower_5 = w[259]
    law_lower_6 = w[260]
    law_lower_7 = w[261]
    law_lower_8 = w[262]
    law_lower_9 = w[263]
    law_lower_10 = w[264]
    law_lower_11 = w[265]
    law_lower_12 = w[266]
    law_lower_13 = w[267]
    law_lower_14 = w[268]
    law_lower_15 = w[269]
    law_reciprocal_0 = w[270]
    law_reciprocal_1 = w[271]
    law_reciprocal_2 = w[272]
    law_reciprocal_3 = w[273]
    law_reciprocal_4 = w[274]
    law_reciprocal_5 = w[275]
    law_reciprocal_6 = w[276]
    law_reciprocal_7 = w[277]
    residual_0 = w[37]
    residual_1 = w[38]
    residual_2 = w[39]
    residual_3 = w[40]
    residual_4 = w[41]
    residual_5 = w[42]
    residual_6 = w[43]
    residual_7 = w[44]
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
    w[61] = dependent_0*(s14 - s13 - s19)
    w[62] = dependent_1*(s18 + s11 - s10)
    w[63] = dependent_2*(jacobian_1*s18 - jacobian_0*s19 + jacobian_2*s15 + jacobian_4*s12)
    w[64] = dependent_3*(s15 + s8 - s7)
    w[65] = dependent_4*(s12 - s6)
    w[66] = dependent_5*(jacobian_3*s15 + jacobian_5*s12 + jacobian_6*s9 + jacobian_8*s6)
    w[67] = dependent_6*(s9 - s17)
    w[68] = dependent_7*(s6 + s16)
    w[69] = dependent_8*(jacobian_7*s9 + jacobian_9*s6 - jacobian_10*s17 + jacobian_11*s16)
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
def choose(p, w, iw):
    """Choose the dependent columns of D by elimination with complete pivoting."""
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
        for i in range(step + 1, 8):
            factor = w[DENSE + 9 * i + column] / w[DENSE + 9 * step + column]
            if factor != 0.0:
                for j in range(9):
                    w[DENSE + 9 * i + j] -= factor * w[DENSE + 9 * step + j]
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
def accept(t, y, p, w, iw):
    """Close an accepted state, choose another partition where this one has become poor, and measure."""
    if iw[5] == 0:
        geometry(t, y, p, w)
        current = w[10]
        if iw[7] == 0 or current < 0.1 * w[11]:
            choose(p, w, iw)
            geometry(t, y, p, w)
            w[11] = w[10]
    bits = close(t, y, p, w, iw)
    measure(t, y, p, w)
    return bits
