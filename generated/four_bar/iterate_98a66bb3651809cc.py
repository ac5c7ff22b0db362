"""One iteration, and its end, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration: 314 operations, 324356 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p15 = p[15]  # 0.3333333333333333*crank_mass
    p17 = p[17]  # 5.333333333333333*coupler_mass
    p19 = p[19]  # 2.083333333333333*rocker_mass
    kept_factor_0 = w[138]
    kept_factor_1 = w[139]
    kept_factor_2 = w[140]
    kept_factor_3 = w[141]
    kept_factor_4 = w[142]
    kept_factor_5 = w[143]
    kept_factor_6 = w[144]
    kept_factor_7 = w[145]
    kept_factor_8 = w[146]
    kept_factor_9 = w[147]
    kept_factor_10 = w[148]
    kept_factor_11 = w[149]
    kept_factor_12 = w[150]
    kept_factor_13 = w[151]
    kept_factor_14 = w[152]
    kept_factor_15 = w[153]
    kept_factor_16 = w[154]
    kept_factor_17 = w[155]
    kept_factor_18 = w[156]
    kept_factor_19 = w[157]
    kept_factor_20 = w[158]
    kept_factor_21 = w[159]
    kept_factor_22 = w[160]
    kept_factor_23 = w[161]
    kept_factor_24 = w[162]
    kept_factor_25 = w[163]
    kept_factor_26 = w[164]
    kept_factor_27 = w[165]
    kept_factor_28 = w[166]
    kept_factor_29 = w[167]
    kept_penalties_0 = w[168]
    kept_penalties_1 = w[169]
    kept_penalties_2 = w[170]
    kept_penalties_3 = w[171]
    kept_penalties_4 = w[172]
    kept_penalties_5 = w[173]
    kept_penalties_6 = w[174]
    kept_penalties_7 = w[175]
    kept_jacobian_0 = w[176]
    kept_jacobian_1 = w[177]
    kept_jacobian_2 = w[178]
    kept_jacobian_3 = w[179]
    kept_jacobian_4 = w[180]
    kept_jacobian_5 = w[181]
    kept_jacobian_6 = w[182]
    kept_jacobian_7 = w[183]
    kept_jacobian_8 = w[184]
    kept_jacobian_9 = w[185]
    kept_jacobian_10 = w[186]
    kept_jacobian_11 = w[187]
    kept_force_0 = w[188]
    kept_force_1 = w[189]
    kept_force_2 = w[190]
    kept_target_0 = w[191]
    kept_target_1 = w[192]
    kept_target_2 = w[193]
    kept_target_3 = w[194]
    kept_target_4 = w[195]
    kept_target_5 = w[196]
    kept_target_6 = w[197]
    kept_target_7 = w[198]
    kept_acceleration_0 = w[199]
    kept_acceleration_1 = w[200]
    kept_acceleration_2 = w[201]
    kept_acceleration_3 = w[202]
    kept_acceleration_4 = w[203]
    kept_acceleration_5 = w[204]
    kept_acceleration_6 = w[205]
    kept_acceleration_7 = w[206]
    kept_acceleration_8 = w[207]
    multipliers_0 = w[19]  # A.x
    multipliers_1 = w[20]  # A.y
    multipliers_2 = w[21]  # B.x
    multipliers_3 = w[22]  # B.y
    multipliers_4 = w[23]  # C.x
    multipliers_5 = w[24]  # C.y
    multipliers_6 = w[25]  # D.x
    multipliers_7 = w[26]  # D.y
    status_7 = w[7]  # speed_scale
    status_6 = w[6]  # length_scale
    status_11 = w[11]  # mean_mass
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
    s52 = status_7*status_7/status_6
    s53 = s38*(p0*s38) + s37*(p0*s37) + s34*(p15*s34) + s32*(p1*s32) + s31*(p1*s31) + s30*(p17*s30) + s36*(p2*s36)
    s54 = s39*(p0*s39) + s40*(p0*s40) + s41*(p15*s41) + s42*(p1*s42) + s43*(p1*s43) + s44*(p17*s44) + s45*(p2*s45)
    s55 = (s53 + s35*(p2*s35) + s33*(p19*s33))/(s52*(s52*status_11) + s54 + s46*(p2*s46) + s47*(p19*s47))
    # outputs
    w[199] = s39
    w[200] = s40
    w[201] = s41
    w[202] = s42
    w[203] = s43
    w[204] = s44
    w[205] = s45
    w[206] = s46
    w[207] = s47
    w[19] = multipliers_0 + kept_penalties_0*(s39 + kept_jacobian_0*s41 - kept_target_0)  # A.x
    w[20] = multipliers_1 + kept_penalties_1*(s40 + kept_jacobian_1*s41 - kept_target_1)  # A.y
    w[21] = multipliers_2 + kept_penalties_2*s48  # B.x
    w[22] = s49  # B.y
    w[23] = s50  # C.x
    w[24] = s51  # C.y
    w[25] = multipliers_6 + kept_penalties_6*(s45 + kept_jacobian_10*s47 - kept_target_6)  # D.x
    w[26] = multipliers_7 + kept_penalties_7*(s46 + kept_jacobian_11*s47 - kept_target_7)  # D.y
    w[13] = math.sqrt(s55)  # increment
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
    kept_acceleration_0 = w[199]
    kept_acceleration_1 = w[200]
    kept_acceleration_2 = w[201]
    kept_acceleration_3 = w[202]
    kept_acceleration_4 = w[203]
    kept_acceleration_5 = w[204]
    kept_acceleration_6 = w[205]
    kept_acceleration_7 = w[206]
    kept_acceleration_8 = w[207]
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
    ydot[9] = kept_acceleration_0  # rate of crank.vx
    ydot[10] = kept_acceleration_1  # rate of crank.vy
    ydot[11] = kept_acceleration_2  # rate of crank.omega
    ydot[12] = kept_acceleration_3  # rate of coupler.vx
    ydot[13] = kept_acceleration_4  # rate of coupler.vy
    ydot[14] = kept_acceleration_5  # rate of coupler.omega
    ydot[15] = kept_acceleration_6  # rate of rocker.vx
    ydot[16] = kept_acceleration_7  # rate of rocker.vy
    ydot[17] = kept_acceleration_8  # rate of rocker.omega
    ydot[18] = 0.0  # rate of work
    return 0
