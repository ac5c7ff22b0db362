"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 295 operations, 1659841 before sharing."""
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
    mask_0 = w[27]  # A.x
    mask_1 = w[28]  # A.y
    mask_2 = w[29]  # B.x
    mask_3 = w[30]  # B.y
    mask_4 = w[31]  # C.x
    mask_5 = w[32]  # C.y
    mask_6 = w[33]  # D.x
    mask_7 = w[34]  # D.y
    p15 = p[15]  # 1.0/math.sqrt(crank_mass)
    p16 = p[16]  # 1.0/math.sqrt(0.3333333333333333*crank_mass)
    p17 = p[17]  # 1.0/math.sqrt(coupler_mass)
    p18 = p[18]  # 1.0/math.sqrt(5.333333333333333*coupler_mass)
    p19 = p[19]  # 1.0/math.sqrt(rocker_mass)
    p20 = p[20]  # 1.0/math.sqrt(2.083333333333333*rocker_mass)
    p21 = p[21]  # 9.81*crank_mass*(1.0/crank_mass)
    p22 = p[22]  # 9.81*coupler_mass*(1.0/coupler_mass)
    p23 = p[23]  # 9.81*rocker_mass*(1.0/rocker_mass)
    p24 = p[24]
    p25 = p[25]
    p26 = p[26]
    p27 = p[27]
    p28 = p[28]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = s0*s2
    s4 = s1*s2
    s5 = math.cos(q5)
    s6 = math.sin(q5)
    s7 = 4.0*(v5*v5)
    s8 = s5*s7
    s9 = s6*s7
    s10 = math.cos(q8)
    s11 = math.sin(q8)
    s12 = 2.5*(v8*v8)
    s13 = s10*s12
    s14 = s11*s12
    s15 = s1*p16
    s16 = s0*p16
    s17 = 4.0*s6*p18
    s18 = 4.0*s5*p18
    s19 = 2.5*s11*p20
    s20 = 2.5*s10*p20
    s21 = s15*s15
    s22 = p24 + s21
    s23 = s15*s16
    s24 = s21 - p24
    s25 = s16*s16
    s26 = p24 + s25
    s27 = s17*s17
    s28 = s22 + p25 + s27
    s29 = s17*s18
    s30 = s27 - p25
    s31 = s18*s18
    s32 = s26 + p25 + s31
    s33 = s19*s19
    s34 = p25 + s27 + p26 + s33
    s35 = s19*s20
    s36 = p26 - s33
    s37 = s20*s20
    s38 = p26 + p25 + s31 + s37
    s39 = p26 + s37
    s40 = 1.0/(mask_0 + s22)
    s41 = s23*s40
    s42 = s24*s40
    s43 = s23*s41
    s44 = s24*s41 - s23
    s45 = s25 - p24 - s43
    s46 = mask_1 + s26 - s43
    s47 = 1.0/s46
    s48 = s44*s47
    s49 = s45*s47
    s50 = s23*s42 - (s23 + s29) - s45*s48
    s51 = 1.0/(mask_6 + p26 + s33)
    s52 = s35*s51
    s53 = s36*s51
    s54 = s35*s52
    s55 = s35 + s36*s52
    s56 = p26 - s37 + s54
    s57 = mask_7 + s39 - s54
    s58 = 1.0/s57
    s59 = s55*s58
    s60 = s56*s58
    s61 = mask_2 + s28 - s24*s42 - s44*s48
    s62 = 1.0/s61
    s63 = s50*s62
    s64 = s30*s62
    s65 = s29*s62
    s66 = s29 + s30*s63
    s67 = s31 - p25 + s29*s63
    s68 = mask_3 + s32 - s43 - s45*s49 - s50*s63
    s69 = 1.0/s68
    s70 = s66*s69
    s71 = s67*s69
    s72 = s29*s64 - (s29 + s35 + s35*s53 + s56*s59) + s67*s70
    s73 = mask_4 + s34 - s36*s53 - s55*s59 - s30*s64 - s66*s70
    s74 = 1.0/s73
    s75 = s72*s74
    s76 = mask_5 + s38 - s54 - s56*s60 - s29*s65 - s67*s71 - s72*s75
    s77 = s3*s41
    s78 = s4 - p21 + s77
    s79 = s3 + s8 - s3*s42 - s48*s78
    s80 = s13*s52
    s81 = s14 - p23 + s80
    s82 = s4 + s9 + p27 + s77 - s49*s78 - s63*s79
    s83 = s8 - s13 - s13*s53 - s59*s81 - s64*s79 + s70*s82
    s84 = 1.0/s76*(p28 - (s14 - s9) - s80 - s60*s81 + s65*s79 - s71*s82 - s75*s83)
    s85 = s74*s83 - s75*s84
    s86 = s69*s82 + s70*s85 - s71*s84
    s87 = s62*s79 - s63*s86 - s64*s85 + s65*s84
    s88 = s58*s81 - s59*s85 - s60*s84
    s89 = s13*s51 + s52*s88 - s53*s85 - s52*s84
    s90 = s47*s78 - s48*s87 - s49*s86
    s91 = s3*s40 + s41*s90 - s42*s87 + s41*s86
    s92 = (((((s46 < 1e-06*s26) | (s57 < 1e-06*s39)) | (s61 < 1e-06*s28)) | (s68 < 1e-06*s32)) | (s73 < 1e-06*s34))
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
    ydot[9] = -p15*(p15*s91 - p15*s87)  # rate of crank.vx
    ydot[10] = -(p21 + p15*(p15*s90 - p15*s86))  # rate of crank.vy
    ydot[11] = -p16*(s15*s91 - s16*s90 + s15*s87 - s16*s86)  # rate of crank.omega
    ydot[12] = -p17*(p17*s87 - p17*s85)  # rate of coupler.vx
    ydot[13] = -(p22 + p17*(p17*s86 - p17*s84))  # rate of coupler.vy
    ydot[14] = -p18*(s17*s87 - s18*s86 + s17*s85 - s18*s84)  # rate of coupler.omega
    ydot[15] = -p19*(p19*s85 + p19*s89)  # rate of rocker.vx
    ydot[16] = -(p23 + p19*(p19*s84 + p19*s88))  # rate of rocker.vy
    ydot[17] = -p20*(s20*s84 - s19*s85 + s19*s89 - s20*s88)  # rate of rocker.omega
    ydot[18] = 0.0  # rate of work
    w[19] = s91  # A.x
    w[20] = s90  # A.y
    w[21] = s87  # B.x
    w[22] = s86  # B.y
    w[23] = s85  # C.x
    w[24] = s84  # C.y
    w[25] = s89  # D.x
    w[26] = s88  # D.y
    return int((s92 | (s76 < 1e-06*s38)))
