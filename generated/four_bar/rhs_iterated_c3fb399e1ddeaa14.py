"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .iterate_5a501ed751d096bc import finish, iterate


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 236 operations, 17884 before sharing."""
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
    p21 = p[21]  # -9.81*crank_mass*(1.0/crank_mass)
    p22 = p[22]  # -9.81*coupler_mass*(1.0/coupler_mass)
    p23 = p[23]  # -9.81*rocker_mass*(1.0/rocker_mass)
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
    s22 = s21*row_weight_0*(1.0*(1.0 > mask_0))
    s23 = s21*row_weight_1*(1.0*(1.0 > mask_1))
    s24 = s21*row_weight_2*(1.0*(1.0 > mask_2))
    s25 = s21*row_weight_3*(1.0*(1.0 > mask_3))
    s26 = s21*row_weight_4*(1.0*(1.0 > mask_4))
    s27 = s21*row_weight_5*(1.0*(1.0 > mask_5))
    s28 = s21*row_weight_6*(1.0*(1.0 > mask_6))
    s29 = s21*row_weight_7*(1.0*(1.0 > mask_7))
    s30 = s1*s22
    s31 = s0*s23
    s32 = s1*s24
    s33 = s30 - s32
    s34 = s10*s24
    s35 = s0*s25
    s36 = s35 - s31
    s37 = s8*s25
    s38 = s10*s26
    s39 = s17*s26
    s40 = s8*s27
    s41 = s16*s27
    s42 = s17*s28
    s43 = s42 - s39
    s44 = s16*s29
    s45 = s41 - s44
    s46 = 1.0/(s24 + p0 + s22)
    s47 = s33*s46
    s48 = s24*s46
    s49 = s34*s46
    s50 = s32 + s24*s47
    s51 = 1.0/(s25 + p0 + s23)
    s52 = s36*s51
    s53 = s25*s51
    s54 = s37*s51
    s55 = s25*s52 - s35
    s56 = s10*s32 + s8*s35 + s34*s47 - s37*s52
    s57 = 1.0/(s28 + p2 + s26)
    s58 = s43*s57
    s59 = s26*s57
    s60 = s38*s57
    s61 = s39 + s26*s58
    s62 = 1.0/(s29 + p2 + s27)
    s63 = s45*s62
    s64 = s27*s62
    s65 = s40*s62
    s66 = s27*s63 - s41
    s67 = s40*s63 - (s17*s38 + s16*s40 + s38*s58)
    s68 = 1.0/(p15 + s1*s30 + s0*s31 + s1*s32 + s0*s35 - s33*s47 - s36*s52)
    s69 = s50*s68
    s70 = s55*s68
    s71 = s56*s68
    s72 = p17 + s10*s34 + s8*s37 + s10*s38 + s8*s40 - s34*s49 - s37*s54 - s38*s60 - s40*s65 - s56*s71
    s73 = 1.0/(p19 + s17*s39 + s16*s41 + s17*s42 + s16*s44 - s43*s58 - s45*s63)
    s74 = s61*s73
    s75 = s66*s73
    s76 = s67*s73
    s77 = s55*s69 + s66*s74
    s78 = s34 - s38 - s34*s48 + s38*s59 - s56*s69 - s67*s74
    s79 = 1.0/(s26 + p1 + s24 - s24*s48 - s26*s59 - s50*s69 - s61*s74)
    s80 = s77*s79
    s81 = s78*s79
    s82 = s40 - s37 + s37*s53 - s40*s64 - s56*s70 - s67*s75 + s78*s80
    s83 = 1.0/(s27 + p1 + s25 - s25*s53 - s27*s64 - s55*s70 - s66*s75 - s77*s80)
    s84 = s82*s83
    # outputs
    w[138] = s47
    w[139] = -s48
    w[140] = -s49
    w[141] = s52
    w[142] = -s53
    w[143] = s54
    w[144] = s58
    w[145] = -s59
    w[146] = s60
    w[147] = s63
    w[148] = -s64
    w[149] = -s65
    w[150] = s69
    w[151] = s70
    w[152] = s71
    w[153] = s74
    w[154] = s75
    w[155] = s76
    w[156] = -s80
    w[157] = s81
    w[158] = s84
    w[159] = s46
    w[160] = s51
    w[161] = s57
    w[162] = s62
    w[163] = s68
    w[164] = s73
    w[165] = s79
    w[166] = s83
    w[167] = 1.0/(s72 - s67*s76 - s78*s81 - s82*s84)
    w[168] = s22
    w[169] = s23
    w[170] = s24
    w[171] = s25
    w[172] = s26
    w[173] = s27
    w[174] = s28
    w[175] = s29
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
    w[191] = -s4
    w[192] = -s5
    w[193] = -(s4 + s12)
    w[194] = -(s5 + s13)
    w[195] = s19 - s12
    w[196] = s20 - s13
    w[197] = -s19
    w[198] = -s20
    w[199] = 0.0
    w[200] = p21
    w[201] = 0.0
    w[202] = 0.0
    w[203] = p22
    w[204] = 0.0
    w[205] = 0.0
    w[206] = p23
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
