"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .iterate_92af88ce8b8e9fff import finish, iterate


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
    p15 = p[15]  # 9.81*crank_mass
    p16 = p[16]  # 9.81*coupler_mass
    p17 = p[17]  # 9.81*rocker_mass
    mask_0 = w[27]  # A.x
    mask_1 = w[28]  # A.y
    mask_2 = w[29]  # B.x
    mask_3 = w[30]  # B.y
    mask_4 = w[31]  # C.x
    mask_5 = w[32]  # C.y
    mask_6 = w[33]  # D.x
    mask_7 = w[34]  # D.y
    p18 = p[18]  # 1.0/crank_mass
    p19 = p[19]  # 1.0/(0.3333333333333333*crank_mass)
    p20 = p[20]  # 1.0/coupler_mass
    p21 = p[21]  # 1.0/(5.333333333333333*coupler_mass)
    p22 = p[22]  # 1.0/rocker_mass
    p23 = p[23]  # 1.0/(2.083333333333333*rocker_mass)
    p24 = p[24]  # 9.81*crank_mass*(1.0/crank_mass)
    p25 = p[25]  # 9.81*rocker_mass*(1.0/rocker_mass)
    p26 = p[26]
    p27 = p[27]
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
    s19 = s1*p19
    s20 = s0*p19
    s21 = s8*p21
    s22 = s7*p21
    s23 = s15*p23
    s24 = s14*p23
    s25 = s1*s19
    s26 = p18 + s25
    s27 = s0*s19
    s28 = s25 - p18
    s29 = s0*s20
    s30 = p18 + s29
    s31 = s8*s21
    s32 = s7*s21
    s33 = s31 - p20
    s34 = s7*s22
    s35 = s15*s23
    s36 = s14*s23
    s37 = p22 - s35
    s38 = s14*s24
    s39 = s15*s24
    s40 = 1.0/(mask_0 + s26)
    s41 = s27*s40
    s42 = s28*s40
    s43 = s27*s41
    s44 = s28*s41 - s1*s20
    s45 = s29 - p18 - s43
    s46 = 1.0/(mask_1 + s30 - s43)
    s47 = s44*s46
    s48 = s45*s46
    s49 = s27*s42 - (s27 + s32) - s45*s47
    s50 = 1.0/(mask_6 + p22 + s35)
    s51 = s36*s50
    s52 = s37*s50
    s53 = s39*s50
    s54 = s36 + s37*s51
    s55 = p22 - s38 + s39*s51
    s56 = 1.0/(mask_7 + p22 + s38 - s36*s51)
    s57 = s54*s56
    s58 = s55*s56
    s59 = 1.0/(mask_2 + p20 + s26 + s31 - s28*s42 - s44*s47)
    s60 = s49*s59
    s61 = s33*s59
    s62 = s32*s59
    s63 = s8*s22 + s33*s60
    s64 = s34 - p20 + s32*s60
    s65 = 1.0/(mask_3 + p20 + s30 + s34 - s43 - s45*s48 - s49*s60)
    s66 = s63*s65
    s67 = s64*s65
    s68 = s32*s61 - (s32 + s36 + s39*s52 + s55*s57) + s64*s66
    s69 = 1.0/(mask_4 + p22 + p20 + s31 + s35 - s37*s52 - s54*s57 - s33*s61 - s63*s66)
    s70 = s68*s69
    s71 = s3*s41
    s72 = s4 - p24 + s71
    s73 = s3 + s10 - s3*s42 - s47*s72
    s74 = s18 - p25 + s17*s51
    s75 = s4 + s11 + p26 + s71 - s48*s72 - s60*s73
    s76 = s10 - s17 - s17*s52 - s57*s74 - s61*s73 + s66*s75
    s77 = 1.0/(mask_5 + p22 + p20 + s34 + s38 - s39*s53 - s55*s58 - s32*s62 - s64*s67 - s68*s70)*(p27 - (s18 - s11) - s17*s53 - s58*s74 + s62*s73 - s67*s75 - s70*s76)
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
    ydot[0] = v0  # rate of crank.x
    ydot[1] = v1  # rate of crank.y
    ydot[2] = v2  # rate of crank.theta
    ydot[3] = v3  # rate of coupler.x
    ydot[4] = v4  # rate of coupler.y
    ydot[5] = v5  # rate of coupler.theta
    ydot[6] = v6  # rate of rocker.x
    ydot[7] = v7  # rate of rocker.y
    ydot[8] = v8  # rate of rocker.theta
    ydot[9] = p18*(s84 - s88)  # rate of crank.vx
    ydot[10] = -p18*(p15 + s87 + s82 - s81)  # rate of crank.vy
    ydot[11] = p19*(s0*s83 - (s1*s88 - s0*s87 + s1*s84))  # rate of crank.omega
    ydot[12] = -p20*(s84 + s79 - s78)  # rate of coupler.vx
    ydot[13] = -p20*(p16 + s83 - s77)  # rate of coupler.vy
    ydot[14] = p21*(s7*s77 - (s8*s84 - s7*s83 + s8*s80))  # rate of coupler.omega
    ydot[15] = -p22*(s80 + s86)  # rate of rocker.vx
    ydot[16] = -p22*(p17 + s77 + s85)  # rate of rocker.vy
    ydot[17] = p23*(s14*s85 - (s14*s77 - s15*s80 + s15*s86))  # rate of rocker.omega
    ydot[18] = 0.0  # rate of work
    w[19] = s88  # A.x
    w[20] = s87  # A.y
    w[21] = s84  # B.x
    w[22] = s83  # B.y
    w[23] = s80  # C.x
    w[24] = s77  # C.y
    w[25] = s86  # D.x
    w[26] = s85  # D.y
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
    p28 = p[28]  # 0.3333333333333333*crank_mass
    p29 = p[29]  # 5.333333333333333*coupler_mass
    p30 = p[30]  # 2.083333333333333*rocker_mass
    p31 = p[31]  # penalty
    mask_0 = w[27]  # A.x
    mask_1 = w[28]  # A.y
    mask_2 = w[29]  # B.x
    mask_3 = w[30]  # B.y
    mask_4 = w[31]  # C.x
    mask_5 = w[32]  # C.y
    mask_6 = w[33]  # D.x
    mask_7 = w[34]  # D.y
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = 4.0*math.cos(q5)
    s4 = -s3
    s5 = 4.0*math.sin(q5)
    s6 = 2.5*math.cos(q8)
    s7 = 2.5*math.sin(q8)
    s8 = p31*(1.0*(1.0 > mask_0))
    s9 = p31*(1.0*(1.0 > mask_1))
    s10 = p31*(1.0*(1.0 > mask_2))
    s11 = p31*(1.0*(1.0 > mask_3))
    s12 = p31*(1.0*(1.0 > mask_4))
    s13 = p31*(1.0*(1.0 > mask_5))
    s14 = p31*(1.0*(1.0 > mask_6))
    s15 = p31*(1.0*(1.0 > mask_7))
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
    s54 = 1.0/(p28 + s1*s16 + s0*s17 + s1*s18 + s0*s21 - s19*s33 - s22*s38)
    s55 = s36*s54
    s56 = s41*s54
    s57 = s42*s54
    s58 = 1.0/(p30 + s7*s25 + s6*s27 + s7*s28 + s6*s30 - s29*s44 - s31*s49)
    s59 = s47*s58
    s60 = s52*s58
    s61 = s53*s58
    s62 = s41*s55 + s52*s59
    s63 = s20 - s24 - s20*s34 + s24*s45 - s42*s55 - s53*s59
    s64 = p29 + s5*s20 + s3*s23 + s5*s24 + s3*s26 - s20*s35 - s23*s40 - s24*s46 - s26*s51 - s42*s57 - s53*s61
    s65 = 1.0/(s12 + p1 + s10 - s10*s34 - s12*s45 - s36*s55 - s47*s59)
    s66 = s62*s65
    s67 = s63*s65
    s68 = s26 - s23 + s23*s39 - s26*s50 - s42*s56 - s53*s60 + s63*s66
    s69 = 1.0/(s13 + p1 + s11 - s11*s39 - s13*s50 - s41*s56 - s52*s60 - s62*s66)
    s70 = s68*s69
    # outputs
    w[138] = s33
    w[139] = -s34
    w[140] = -s35
    w[141] = s38
    w[142] = -s39
    w[143] = s40
    w[144] = s44
    w[145] = -s45
    w[146] = s46
    w[147] = s49
    w[148] = -s50
    w[149] = -s51
    w[150] = s55
    w[151] = s56
    w[152] = s57
    w[153] = s59
    w[154] = s60
    w[155] = s61
    w[156] = -s66
    w[157] = s67
    w[158] = s70
    w[159] = s32
    w[160] = s37
    w[161] = s43
    w[162] = s48
    w[163] = s54
    w[164] = s58
    w[165] = s65
    w[166] = s69
    w[167] = 1.0/(s64 - s63*s67 - s68*s70)
    w[168] = s8
    w[169] = s9
    w[170] = s10
    w[171] = s11
    w[172] = s12
    w[173] = s13
    w[174] = s14
    w[175] = s15
    w[176] = s1
    w[177] = s2
    w[178] = s1
    w[179] = s5
    w[180] = s2
    w[181] = s4
    w[182] = s5
    w[183] = -s7
    w[184] = s4
    w[185] = s6
    w[186] = s7
    w[187] = -s6
    w[188] = p0*v0
    w[189] = p0*v1
    w[190] = v2*p28
    w[191] = p1*v3
    w[192] = p1*v4
    w[193] = v5*p29
    w[194] = p2*v6
    w[195] = p2*v7
    w[196] = v8*p30
    w[197] = v0
    w[198] = v1
    w[199] = v2
    w[200] = v3
    w[201] = v4
    w[202] = v5
    w[203] = v6
    w[204] = v7
    w[205] = v8
    w[206] = 0.0
    w[207] = 0.0
    w[208] = 0.0
    w[209] = 0.0
    w[210] = 0.0
    w[211] = 0.0
    w[212] = 0.0
    w[213] = 0.0
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
        if last < math.inf and (increment <= p[32] or (increment > 0.5 * last and increment < 1e-6)):
            break
        last = increment
    finish(t, y, p, w, ydot)
    return 0
