"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .iterate_5a501ed751d096bc import finish, iterate


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 307 operations, 18001 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p15 = p[15]  # 0.3333333333333333*crank_mass
    p16 = p[16]  # -9.81*crank_mass
    p17 = p[17]  # 5.333333333333333*coupler_mass
    p18 = p[18]  # -9.81*coupler_mass
    p19 = p[19]  # 2.083333333333333*rocker_mass
    p20 = p[20]  # -9.81*rocker_mass
    mask_0 = w[27]  # A.x
    mask_1 = w[28]  # A.y
    mask_2 = w[29]  # B.x
    mask_3 = w[30]  # B.y
    mask_4 = w[31]  # C.x
    mask_5 = w[32]  # C.y
    mask_6 = w[33]  # D.x
    mask_7 = w[34]  # D.y
    status_11 = w[11]  # mean_mass
    row_weight_0 = w[94]  # A.x
    row_weight_1 = w[95]  # A.y
    row_weight_2 = w[96]  # B.x
    row_weight_3 = w[97]  # B.y
    row_weight_4 = w[98]  # C.x
    row_weight_5 = w[99]  # C.y
    row_weight_6 = w[100]  # D.x
    row_weight_7 = w[101]  # D.y
    p21 = p[21]  # 2.0*alpha
    p22 = p[22]  # beta*beta
    p23 = p[23]  # -9.81*crank_mass*(1.0/crank_mass)
    p24 = p[24]  # -9.81*coupler_mass*(1.0/coupler_mass)
    p25 = p[25]  # -9.81*rocker_mass*(1.0/rocker_mass)
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
    s21 = 100000.0*status_11
    s22 = v2*s1
    s23 = v2*s0
    s24 = v5*s10
    s25 = v5*s8
    s26 = v8*s17
    s27 = v8*s16
    s28 = s21*row_weight_0*(1.0*(1.0 > mask_0))
    s29 = s21*row_weight_1*(1.0*(1.0 > mask_1))
    s30 = s21*row_weight_2*(1.0*(1.0 > mask_2))
    s31 = s21*row_weight_3*(1.0*(1.0 > mask_3))
    s32 = s21*row_weight_4*(1.0*(1.0 > mask_4))
    s33 = s21*row_weight_5*(1.0*(1.0 > mask_5))
    s34 = s21*row_weight_6*(1.0*(1.0 > mask_6))
    s35 = s21*row_weight_7*(1.0*(1.0 > mask_7))
    s36 = s1*s28
    s37 = s0*s29
    s38 = s1*s30
    s39 = s36 - s38
    s40 = s10*s30
    s41 = s0*s31
    s42 = s41 - s37
    s43 = s8*s31
    s44 = s10*s32
    s45 = s17*s32
    s46 = s8*s33
    s47 = s16*s33
    s48 = s17*s34
    s49 = s48 - s45
    s50 = s16*s35
    s51 = s47 - s50
    s52 = 1.0/(s30 + p0 + s28)
    s53 = s39*s52
    s54 = s30*s52
    s55 = s40*s52
    s56 = s38 + s30*s53
    s57 = 1.0/(s31 + p0 + s29)
    s58 = s42*s57
    s59 = s31*s57
    s60 = s43*s57
    s61 = s31*s58 - s41
    s62 = s10*s38 + s8*s41 + s40*s53 - s43*s58
    s63 = 1.0/(s34 + p2 + s32)
    s64 = s49*s63
    s65 = s32*s63
    s66 = s44*s63
    s67 = s45 + s32*s64
    s68 = 1.0/(s35 + p2 + s33)
    s69 = s51*s68
    s70 = s33*s68
    s71 = s46*s68
    s72 = s33*s69 - s47
    s73 = s46*s69 - (s17*s44 + s16*s46 + s44*s64)
    s74 = 1.0/(p15 + s1*s36 + s0*s37 + s1*s38 + s0*s41 - s39*s53 - s42*s58)
    s75 = s56*s74
    s76 = s61*s74
    s77 = s62*s74
    s78 = p17 + s10*s40 + s8*s43 + s10*s44 + s8*s46 - s40*s55 - s43*s60 - s44*s66 - s46*s71 - s62*s77
    s79 = 1.0/(p19 + s17*s45 + s16*s47 + s17*s48 + s16*s50 - s49*s64 - s51*s69)
    s80 = s67*s79
    s81 = s72*s79
    s82 = s73*s79
    s83 = s61*s75 + s72*s80
    s84 = s40 - s44 - s40*s54 + s44*s65 - s62*s75 - s73*s80
    s85 = 1.0/(s32 + p1 + s30 - s30*s54 - s32*s65 - s56*s75 - s67*s80)
    s86 = s83*s85
    s87 = s84*s85
    s88 = s46 - s43 + s43*s59 - s46*s70 - s62*s76 - s73*s81 + s84*s86
    s89 = 1.0/(s33 + p1 + s31 - s31*s59 - s33*s70 - s61*s76 - s72*s81 - s83*s86)
    s90 = s88*s89
    # outputs
    w[138] = s53
    w[139] = -s54
    w[140] = -s55
    w[141] = s58
    w[142] = -s59
    w[143] = s60
    w[144] = s64
    w[145] = -s65
    w[146] = s66
    w[147] = s69
    w[148] = -s70
    w[149] = -s71
    w[150] = s75
    w[151] = s76
    w[152] = s77
    w[153] = s80
    w[154] = s81
    w[155] = s82
    w[156] = -s86
    w[157] = s87
    w[158] = s90
    w[159] = s52
    w[160] = s57
    w[161] = s63
    w[162] = s68
    w[163] = s74
    w[164] = s79
    w[165] = s85
    w[166] = s89
    w[167] = 1.0/(s78 - s73*s82 - s84*s87 - s88*s90)
    w[168] = s28
    w[169] = s29
    w[170] = s30
    w[171] = s31
    w[172] = s32
    w[173] = s33
    w[174] = s34
    w[175] = s35
    w[176] = s1
    w[177] = s3
    w[178] = s1
    w[179] = s10
    w[180] = s3
    w[181] = s9
    w[182] = s10
    w[183] = -s17
    w[184] = s9
    w[185] = s16
    w[186] = s17
    w[187] = -s16
    w[188] = p16
    w[189] = p18
    w[190] = p20
    w[191] = -(s4 + (v0 + s22)*p21 + (q0 - s0)*p22)
    w[192] = -(s5 + (v1 - s23)*p21 + (q1 - s1)*p22)
    w[193] = -(s4 + s12 + (v3 + s22 - v0 + s24)*p21 + (q3 - q0 - s8 - s0)*p22)
    w[194] = -(s5 + s13 + (v4 - (v1 + s23) - s25)*p21 + (q4 - q1 - s10 - s1)*p22)
    w[195] = s19 - s12 - (v6 + s24 - v3 - s26)*p21 - (q6 - q3 + s16 - s8)*p22
    w[196] = s20 - s13 - (v7 - (v4 + s25) + s27)*p21 - (q7 - q4 + s17 - s10)*p22
    w[197] = -(s19 + (v6 + s26)*p21 + (q6 - 10.0 - s16)*p22)
    w[198] = -(s20 + (v7 - s27)*p21 + (q7 - s17)*p22)
    w[199] = 0.0
    w[200] = p23
    w[201] = 0.0
    w[202] = 0.0
    w[203] = p24
    w[204] = 0.0
    w[205] = 0.0
    w[206] = p25
    w[207] = 0.0
    w[19] = 0.0  # A.x
    w[20] = 0.0  # A.y
    w[21] = 0.0  # B.x
    w[22] = 0.0  # B.y
    w[23] = 0.0  # C.x
    w[24] = 0.0  # C.y
    w[25] = 0.0  # D.x
    w[26] = 0.0  # D.y
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state by iteration until v' changes no more, at most 30 times."""
    begin(t, y, p, w)
    last = math.inf
    for _ in range(30):
        iterate(p, w)
        iw[6] += 1
        increment = w[13]
        # increments in the metric of M do not show massless bodies, which the second iteration sets right if no other moves;
        # at the floor of rounding another iteration gains nothing
        if last < math.inf and (increment <= 1e-13 or (increment > 0.5 * last and increment < 1e-6)):
            break
        last = increment
    finish(t, y, p, w, ydot)
    return 0
