"""Right-hand side, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 214 operations, 156132 before sharing."""
    # inputs
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q5 = y[5]  # rod.theta [rad]
    v3 = y[12]  # rod.vx [m/s]
    v4 = y[13]  # rod.vy [m/s]
    v5 = y[14]  # rod.omega [rad/s]
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
    p16 = p[16]  # 1.0/crank_mass
    p17 = p[17]  # 1.0/(0.001875*crank_mass)
    p18 = p[18]  # 1.0/rod_mass
    p19 = p[19]  # 1.0/(0.016875*rod_mass)
    p20 = p[20]  # 1.0/slider_mass
    p21 = p[21]  # 9.81*crank_mass*(1.0/crank_mass)
    p22 = p[22]  # 9.81*slider_mass*(1.0/slider_mass)
    p23 = p[23]
    p24 = p[24]
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
    s14 = s3*p17
    s15 = s2*p17
    s16 = s10*p19
    s17 = s9*p19
    s18 = s3*s14
    s19 = p16 + s18
    s20 = s2*s14
    s21 = s18 - p16
    s22 = s2*s15
    s23 = p16 + s22
    s24 = s10*s16
    s25 = p18 + s19 + s24
    s26 = s9*s16
    s27 = s24 - p18
    s28 = s9*s17
    s29 = p18 + s23 + s28
    s30 = s10*s17
    s31 = p20 + p18 + s28
    s32 = 1.0/(mask_6 + p20)
    s33 = p20*s32
    s34 = 1.0/(mask_0 + s19)
    s35 = s20*s34
    s36 = s21*s34
    s37 = s20*s35
    s38 = s21*s35 - s3*s15
    s39 = s22 - p16 - s37
    s40 = mask_1 + s23 - s37
    s41 = 1.0/s40
    s42 = s38*s41
    s43 = s39*s41
    s44 = 1.0/(mask_4 + p20 + p18 + s24)
    s45 = s26*s44
    s46 = s27*s44
    s47 = s30*s44
    s48 = s27*s45 - s26
    s49 = s28 - p18 - s30*s45
    s50 = mask_5 + s31 - p20*s33 - s26*s45
    s51 = 1.0/s50
    s52 = s48*s51
    s53 = s49*s51
    s54 = s20*s36 - (s20 + s26) - s39*s42 + s30*s46 - s49*s52
    s55 = mask_2 + s25 - s21*s36 - s38*s42 - s27*s46 - s48*s52
    s56 = 1.0/s55
    s57 = s54*s56
    s58 = mask_3 + s29 - s37 - s39*s43 - s30*s47 - s49*s53 - s54*s57
    s59 = s5*s35
    s60 = s6 - p21 + s59
    s61 = s13 + p24 + p22*s33 + s12*s45
    s62 = s5 + s12 - s5*s36 - s42*s60 - s12*s46 - s52*s61
    s63 = 1.0/s58*(s6 + s13 + p23 + s59 - s43*s60 + s12*s47 - s53*s61 - s57*s62)
    s64 = s56*s62
    s65 = s57*s63
    s66 = s64 - s65
    s67 = s51*s61 - s52*s66
    s68 = s53*s63
    s69 = s67 - s68
    s70 = s12*s44 + s45*s69 - s46*s66 + s47*s63
    s71 = s41*s60 - s42*s66 - s43*s63
    s72 = s5*s34 + s35*s71 - s36*s66 + s35*s63
    s73 = p22*s32 + s33*s69
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
    ydot[9] = -p16*(s72 + s65 - s64)  # rate of crank.vx
    ydot[10] = -p16*(p13 + s71 - s63)  # rate of crank.vy
    ydot[11] = p17*(s2*s63 - (s3*s72 - s2*s71 + s3*s66))  # rate of crank.omega
    ydot[12] = p18*(s70 - s66)  # rate of rod.vx
    ydot[13] = -p18*(p14 + s63 + s68 - s67)  # rate of rod.vy
    ydot[14] = p19*(s9*s69 - (s10*s66 - s9*s63 + s10*s70))  # rate of rod.omega
    ydot[15] = -p20*s70  # rate of slider.vx
    ydot[16] = -p20*(p15 + s69 - s73)  # rate of slider.vy
    ydot[17] = 0.0  # rate of slider.omega
    ydot[18] = 0.0  # rate of work
    w[19] = s72  # O.x
    w[20] = s71  # O.y
    w[21] = s66  # P.x
    w[22] = s63  # P.y
    w[23] = s70  # Q.x
    w[24] = s69  # Q.y
    w[25] = -s73  # guide.normal
    w[26] = 0.0  # guide.angle
    return int(((((s40 < 1e-06*s23) | (s50 < 1e-06*s31)) | (s55 < 1e-06*s25)) | (s58 < 1e-06*s29)))
