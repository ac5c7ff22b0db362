"""One iteration, and its end, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration: 301 operations, 299003 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    p28 = p[28]  # 0.3333333333333333*crank_mass
    p29 = p[29]  # 5.333333333333333*coupler_mass
    p30 = p[30]  # 2.083333333333333*rocker_mass
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
    kept_momentum_0 = w[188]
    kept_momentum_1 = w[189]
    kept_momentum_2 = w[190]
    kept_momentum_3 = w[191]
    kept_momentum_4 = w[192]
    kept_momentum_5 = w[193]
    kept_momentum_6 = w[194]
    kept_momentum_7 = w[195]
    kept_momentum_8 = w[196]
    kept_velocity_0 = w[197]
    kept_velocity_1 = w[198]
    kept_velocity_2 = w[199]
    kept_velocity_3 = w[200]
    kept_velocity_4 = w[201]
    kept_velocity_5 = w[202]
    kept_velocity_6 = w[203]
    kept_velocity_7 = w[204]
    kept_velocity_8 = w[205]
    kept_impulse_0 = w[206]
    kept_impulse_1 = w[207]
    kept_impulse_2 = w[208]
    kept_impulse_3 = w[209]
    kept_impulse_4 = w[210]
    kept_impulse_5 = w[211]
    kept_impulse_6 = w[212]
    kept_impulse_7 = w[213]
    status_7 = w[7]  # speed_scale
    status_11 = w[11]  # mean_mass
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
    s14 = kept_momentum_2 - p28*kept_velocity_2 - (kept_jacobian_0*s4 + kept_jacobian_1*s5 + kept_jacobian_2*s6 + kept_jacobian_4*s7)
    s15 = kept_momentum_5 - p29*kept_velocity_5 - (kept_jacobian_3*s6 + kept_jacobian_5*s7 + kept_jacobian_6*s8 + kept_jacobian_8*s9)
    s16 = kept_momentum_6 - p2*kept_velocity_6 - (s8 + s10)
    s17 = kept_momentum_7 - p2*kept_velocity_7 - (s9 + s11)
    s18 = kept_momentum_8 - p30*kept_velocity_8 - (kept_jacobian_7*s8 + kept_jacobian_9*s9 + kept_jacobian_10*s10 + kept_jacobian_11*s11)
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
    s44 = s34*(p0*s34) + s33*(p0*s33) + s30*(p28*s30) + s28*(p1*s28) + s27*(p1*s27) + s26*(p29*s26) + s32*(p2*s32)
    s45 = s35*(p0*s35) + s36*(p0*s36) + s37*(p28*s37) + s38*(p1*s38) + s39*(p1*s39) + s40*(p29*s40) + s41*(p2*s41)
    s46 = (s44 + s31*(p2*s31) + s29*(p30*s29))/(status_7*(status_7*status_11) + s45 + s42*(p2*s42) + s43*(p30*s43))
    # outputs
    w[197] = s35
    w[198] = s36
    w[199] = s37
    w[200] = s38
    w[201] = s39
    w[202] = s40
    w[203] = s41
    w[204] = s42
    w[205] = s43
    w[206] = kept_impulse_0 + kept_penalties_0*(s35 + kept_jacobian_0*s37)
    w[207] = kept_impulse_1 + kept_penalties_1*(s36 + kept_jacobian_1*s37)
    w[208] = kept_impulse_2 + kept_penalties_2*(s38 + kept_jacobian_2*s37 - s35 + kept_jacobian_3*s40)
    w[209] = kept_impulse_3 + kept_penalties_3*(s39 + kept_jacobian_4*s37 - s36 + kept_jacobian_5*s40)
    w[210] = kept_impulse_4 + kept_penalties_4*(s41 + kept_jacobian_6*s40 - s38 + kept_jacobian_7*s43)
    w[211] = kept_impulse_5 + kept_penalties_5*(s42 + kept_jacobian_8*s40 - s39 + kept_jacobian_9*s43)
    w[212] = kept_impulse_6 + kept_penalties_6*(s41 + kept_jacobian_10*s43)
    w[213] = kept_impulse_7 + kept_penalties_7*(s42 + kept_jacobian_11*s43)
    w[13] = math.sqrt(s46)  # increment
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power: 40 operations, 56 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    q5 = y[5]  # coupler.theta [rad]
    q8 = y[8]  # rocker.theta [rad]
    kept_velocity_0 = w[197]
    kept_velocity_1 = w[198]
    kept_velocity_2 = w[199]
    kept_velocity_3 = w[200]
    kept_velocity_4 = w[201]
    kept_velocity_5 = w[202]
    kept_velocity_6 = w[203]
    kept_velocity_7 = w[204]
    kept_velocity_8 = w[205]
    kept_impulse_0 = w[206]
    kept_impulse_1 = w[207]
    kept_impulse_2 = w[208]
    kept_impulse_3 = w[209]
    kept_impulse_4 = w[210]
    kept_impulse_5 = w[211]
    kept_impulse_6 = w[212]
    kept_impulse_7 = w[213]
    p19 = p[19]  # 1.0/(0.3333333333333333*crank_mass)
    p21 = p[21]  # 1.0/(5.333333333333333*coupler_mass)
    p23 = p[23]  # 1.0/(2.083333333333333*rocker_mass)
    p33 = p[33]  # -9.81*crank_mass*(1.0/crank_mass)
    p34 = p[34]  # -9.81*coupler_mass*(1.0/coupler_mass)
    p35 = p[35]  # -9.81*rocker_mass*(1.0/rocker_mass)
    # intermediate terms
    s0 = math.cos(q2)*kept_velocity_2
    s1 = math.sin(q2)*kept_velocity_2
    s2 = 4.0*math.cos(q5)*kept_velocity_5
    s3 = 4.0*math.sin(q5)*kept_velocity_5
    s4 = 2.5*math.cos(q8)*kept_velocity_8
    s5 = 2.5*math.sin(q8)*kept_velocity_8
    # outputs
    ydot[0] = kept_velocity_0  # rate of crank.x
    ydot[1] = kept_velocity_1  # rate of crank.y
    ydot[2] = kept_velocity_2  # rate of crank.theta
    ydot[3] = kept_velocity_3  # rate of coupler.x
    ydot[4] = kept_velocity_4  # rate of coupler.y
    ydot[5] = kept_velocity_5  # rate of coupler.theta
    ydot[6] = kept_velocity_6  # rate of rocker.x
    ydot[7] = kept_velocity_7  # rate of rocker.y
    ydot[8] = kept_velocity_8  # rate of rocker.theta
    ydot[9] = 0.0  # rate of crank.vx
    ydot[10] = p33  # rate of crank.vy
    ydot[11] = (kept_impulse_0*s0 + kept_impulse_1*s1 + kept_impulse_2*s0 + kept_impulse_3*s1)*p19  # rate of crank.omega
    ydot[12] = 0.0  # rate of coupler.vx
    ydot[13] = p34  # rate of coupler.vy
    ydot[14] = (kept_impulse_2*s2 + kept_impulse_3*s3 + kept_impulse_4*s2 + kept_impulse_5*s3)*p21  # rate of coupler.omega
    ydot[15] = 0.0  # rate of rocker.vx
    ydot[16] = p35  # rate of rocker.vy
    ydot[17] = (kept_impulse_6*s4 - (kept_impulse_4*s4 + kept_impulse_5*s5) + kept_impulse_7*s5)*p23  # rate of rocker.omega
    ydot[18] = 0.0  # rate of work
    return 0
