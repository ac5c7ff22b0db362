"""Right-hand side, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 277 operations, 170110 before sharing."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q3 = y[3]  # rod.x [m]
    q4 = y[4]  # rod.y [m]
    q5 = y[5]  # rod.theta [rad]
    v3 = y[12]  # rod.vx [m/s]
    v4 = y[13]  # rod.vy [m/s]
    v5 = y[14]  # rod.omega [rad/s]
    q6 = y[6]  # slider.x [m]
    q7 = y[7]  # slider.y [m]
    q8 = y[8]  # slider.theta [rad]
    v6 = y[15]  # slider.vx [m/s]
    v7 = y[16]  # slider.vy [m/s]
    v8 = y[17]  # slider.omega [rad/s]
    p13 = p[13]  # 9.81*crank_mass
    p14 = p[14]  # 9.81*rod_mass
    p15 = p[15]  # 9.81*slider_mass
    mask_0 = w[27]  # O.x
    mask_1 = w[28]  # O.y
    mask_2 = w[29]  # P.x
    mask_3 = w[30]  # P.y
    mask_4 = w[31]  # Q.x
    mask_5 = w[32]  # Q.y
    mask_6 = w[33]  # guide.normal
    mask_7 = w[34]  # guide.angle
    p16 = p[16]  # 2.0*alpha
    p17 = p[17]  # beta*beta
    p18 = p[18]  # 1.0/crank_mass
    p19 = p[19]  # 1.0/(0.001875*crank_mass)
    p20 = p[20]  # 1.0/rod_mass
    p21 = p[21]  # 1.0/(0.016875*rod_mass)
    p22 = p[22]  # 1.0/slider_mass
    p23 = p[23]  # 9.81*crank_mass*(1.0/crank_mass)
    p24 = p[24]  # 9.81*slider_mass*(1.0/slider_mass)
    p25 = p[25]
    p26 = p[26]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 0.075*s0
    s3 = 0.075*s1
    s4 = 0.075*(v2*v2)
    s5 = s0*s4
    s6 = s1*s4
    s7 = math.cos(q5)
    s8 = math.sin(q5)
    s9 = 0.225*s7
    s10 = 0.225*s8
    s11 = 0.225*(v5*v5)
    s12 = s7*s11
    s13 = s8*s11
    s14 = v2*s3
    s15 = v2*s2
    s16 = v5*s10
    s17 = v5*s9
    s18 = s5 + (v0 + s14)*p16 + (q0 - s2)*p17
    s19 = s12 + (v6 + s16 - v3)*p16 + (q6 - q3 - s9)*p17
    s20 = v7*p16 + q7*p17 - p24
    s21 = s3*p19
    s22 = s2*p19
    s23 = s10*p21
    s24 = s9*p21
    s25 = s3*s21
    s26 = p18 + s25
    s27 = s2*s21
    s28 = s25 - p18
    s29 = s2*s22
    s30 = p18 + s29
    s31 = s10*s23
    s32 = p20 + s26 + s31
    s33 = s9*s23
    s34 = s31 - p20
    s35 = s9*s24
    s36 = p20 + s30 + s35
    s37 = s10*s24
    s38 = p22 + p20 + s35
    s39 = 1.0/(mask_6 + p22)
    s40 = p22*s39
    s41 = 1.0/(mask_0 + s26)
    s42 = s27*s41
    s43 = s28*s41
    s44 = s27*s42
    s45 = s28*s42 - s3*s22
    s46 = s29 - p18 - s44
    s47 = mask_1 + s30 - s44
    s48 = 1.0/s47
    s49 = s45*s48
    s50 = s46*s48
    s51 = 1.0/(mask_4 + p22 + p20 + s31)
    s52 = s33*s51
    s53 = s34*s51
    s54 = s37*s51
    s55 = s34*s52 - s33
    s56 = s35 - p20 - s37*s52
    s57 = mask_5 + s38 - p22*s40 - s33*s52
    s58 = 1.0/s57
    s59 = s55*s58
    s60 = s56*s58
    s61 = s27*s43 - (s27 + s33) - s46*s49 + s37*s53 - s56*s59
    s62 = mask_2 + s32 - s28*s43 - s45*s49 - s34*s53 - s55*s59
    s63 = 1.0/s62
    s64 = s61*s63
    s65 = mask_3 + s36 - s44 - s46*s50 - s37*s54 - s56*s60 - s61*s64
    s66 = s18*s42
    s67 = s6 + (v1 - s15)*p16 + (q1 - s3)*p17 - p23 + s66
    s68 = s13 + (v7 - (v4 + s17))*p16 + (q7 - q4 - s10)*p17 + p26 - s20*s40 + s19*s52
    s69 = s5 + s12 + (v3 + s14 - v0 + s16)*p16 + (q3 - q0 - s9 - s2)*p17 - s18*s43 - s49*s67 - s19*s53
    s70 = s6 + s13 + (v4 - (v1 + s15) - s17)*p16 + (q4 - q1 - s10 - s3)*p17 + p25 + s66 - s50*s67 + s19*s54
    s71 = s69 - s59*s68
    s72 = 1.0/s65*(s70 - s60*s68 - s64*s71)
    s73 = s63*s71
    s74 = s64*s72
    s75 = s73 - s74
    s76 = s58*s68 - s59*s75
    s77 = s60*s72
    s78 = s76 - s77
    s79 = s19*s51 + s52*s78 - s53*s75 + s54*s72
    s80 = s48*s67 - s49*s75 - s50*s72
    s81 = s18*s41 + s42*s80 - s43*s75 + s42*s72
    s82 = s20*s39 - s40*s78
    s83 = (v8*p16 + q8*p17)*(1.0/(mask_7 + 2000.0))
    # outputs
    ydot[0] = v0  # rate of crank.x
    ydot[1] = v1  # rate of crank.y
    ydot[2] = v2  # rate of crank.theta
    ydot[3] = v3  # rate of rod.x
    ydot[4] = v4  # rate of rod.y
    ydot[5] = v5  # rate of rod.theta
    ydot[6] = v6  # rate of slider.x
    ydot[7] = v7  # rate of slider.y
    ydot[8] = v8  # rate of slider.theta
    ydot[9] = -p18*(s81 + s74 - s73)  # rate of crank.vx
    ydot[10] = -p18*(p13 + s80 - s72)  # rate of crank.vy
    ydot[11] = p19*(s2*s72 - (s3*s81 - s2*s80 + s3*s75))  # rate of crank.omega
    ydot[12] = p20*(s79 - s75)  # rate of rod.vx
    ydot[13] = -p20*(p14 + s72 + s77 - s76)  # rate of rod.vy
    ydot[14] = p21*(s9*s78 - (s10*s75 - s9*s72 + s10*s79))  # rate of rod.omega
    ydot[15] = -p22*s79  # rate of slider.vx
    ydot[16] = -p22*(p15 + s78 + s82)  # rate of slider.vy
    ydot[17] = -2000.0*s83  # rate of slider.omega
    ydot[18] = 0.0  # rate of work
    w[19] = s81  # O.x
    w[20] = s80  # O.y
    w[21] = s75  # P.x
    w[22] = s72  # P.y
    w[23] = s79  # Q.x
    w[24] = s78  # Q.y
    w[25] = s82  # guide.normal
    w[26] = s83  # guide.angle
    return int(((((s47 < 1e-06*s30) | (s57 < 1e-06*s38)) | (s62 < 1e-06*s32)) | (s65 < 1e-06*s36)))
