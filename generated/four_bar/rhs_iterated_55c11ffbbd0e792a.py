"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .iterate_5a501ed751d096bc import finish, iterate


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 312 operations, 18089 before sharing."""
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
    p24 = p[24]  # gain
    p25 = p[25]  # a
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
    status_12 = w[12]  # step
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
    s22 = min(p24, p25*(1.0/status_12))
    s23 = v2*s1
    s24 = v2*s0
    s25 = v5*s10
    s26 = v5*s8
    s27 = v8*s17
    s28 = v8*s16
    s29 = 2.0*s22
    s30 = s22*s22
    s31 = s21*row_weight_0*(1.0*(1.0 > mask_0))
    s32 = s21*row_weight_1*(1.0*(1.0 > mask_1))
    s33 = s21*row_weight_2*(1.0*(1.0 > mask_2))
    s34 = s21*row_weight_3*(1.0*(1.0 > mask_3))
    s35 = s21*row_weight_4*(1.0*(1.0 > mask_4))
    s36 = s21*row_weight_5*(1.0*(1.0 > mask_5))
    s37 = s21*row_weight_6*(1.0*(1.0 > mask_6))
    s38 = s21*row_weight_7*(1.0*(1.0 > mask_7))
    s39 = s1*s31
    s40 = s0*s32
    s41 = s1*s33
    s42 = s39 - s41
    s43 = s10*s33
    s44 = s0*s34
    s45 = s44 - s40
    s46 = s8*s34
    s47 = s10*s35
    s48 = s17*s35
    s49 = s8*s36
    s50 = s16*s36
    s51 = s17*s37
    s52 = s51 - s48
    s53 = s16*s38
    s54 = s50 - s53
    s55 = 1.0/(s33 + p0 + s31)
    s56 = s42*s55
    s57 = s33*s55
    s58 = s43*s55
    s59 = s41 + s33*s56
    s60 = 1.0/(s34 + p0 + s32)
    s61 = s45*s60
    s62 = s34*s60
    s63 = s46*s60
    s64 = s34*s61 - s44
    s65 = s10*s41 + s8*s44 + s43*s56 - s46*s61
    s66 = 1.0/(s37 + p2 + s35)
    s67 = s52*s66
    s68 = s35*s66
    s69 = s47*s66
    s70 = s48 + s35*s67
    s71 = 1.0/(s38 + p2 + s36)
    s72 = s54*s71
    s73 = s36*s71
    s74 = s49*s71
    s75 = s36*s72 - s50
    s76 = s49*s72 - (s17*s47 + s16*s49 + s47*s67)
    s77 = 1.0/(p15 + s1*s39 + s0*s40 + s1*s41 + s0*s44 - s42*s56 - s45*s61)
    s78 = s59*s77
    s79 = s64*s77
    s80 = s65*s77
    s81 = p17 + s10*s43 + s8*s46 + s10*s47 + s8*s49 - s43*s58 - s46*s63 - s47*s69 - s49*s74 - s65*s80
    s82 = 1.0/(p19 + s17*s48 + s16*s50 + s17*s51 + s16*s53 - s52*s67 - s54*s72)
    s83 = s70*s82
    s84 = s75*s82
    s85 = s76*s82
    s86 = s64*s78 + s75*s83
    s87 = s43 - s47 - s43*s57 + s47*s68 - s65*s78 - s76*s83
    s88 = 1.0/(s35 + p1 + s33 - s33*s57 - s35*s68 - s59*s78 - s70*s83)
    s89 = s86*s88
    s90 = s87*s88
    s91 = s49 - s46 + s46*s62 - s49*s73 - s65*s79 - s76*s84 + s87*s89
    s92 = 1.0/(s36 + p1 + s34 - s34*s62 - s36*s73 - s64*s79 - s75*s84 - s86*s89)
    s93 = s91*s92
    # outputs
    w[138] = s56
    w[139] = -s57
    w[140] = -s58
    w[141] = s61
    w[142] = -s62
    w[143] = s63
    w[144] = s67
    w[145] = -s68
    w[146] = s69
    w[147] = s72
    w[148] = -s73
    w[149] = -s74
    w[150] = s78
    w[151] = s79
    w[152] = s80
    w[153] = s83
    w[154] = s84
    w[155] = s85
    w[156] = -s89
    w[157] = s90
    w[158] = s93
    w[159] = s55
    w[160] = s60
    w[161] = s66
    w[162] = s71
    w[163] = s77
    w[164] = s82
    w[165] = s88
    w[166] = s92
    w[167] = 1.0/(s81 - s76*s85 - s87*s90 - s91*s93)
    w[168] = s31
    w[169] = s32
    w[170] = s33
    w[171] = s34
    w[172] = s35
    w[173] = s36
    w[174] = s37
    w[175] = s38
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
    w[191] = -(s4 + (v0 + s23)*s29 + (q0 - s0)*s30)
    w[192] = -(s5 + (v1 - s24)*s29 + (q1 - s1)*s30)
    w[193] = -(s4 + s12 + (v3 + s23 - v0 + s25)*s29 + (q3 - q0 - s8 - s0)*s30)
    w[194] = -(s5 + s13 + (v4 - (v1 + s24) - s26)*s29 + (q4 - q1 - s10 - s1)*s30)
    w[195] = s19 - s12 - (v6 + s25 - v3 - s27)*s29 - (q6 - q3 + s16 - s8)*s30
    w[196] = s20 - s13 - (v7 - (v4 + s26) + s28)*s29 - (q7 - q4 + s17 - s10)*s30
    w[197] = -(s19 + (v6 + s27)*s29 + (q6 - 10.0 - s16)*s30)
    w[198] = -(s20 + (v7 - s28)*s29 + (q7 - s17)*s30)
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
