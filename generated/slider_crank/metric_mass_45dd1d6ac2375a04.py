"""Corrections in another metric, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D M^-1 D^T from D, without the rows that depend on others: 109 operations, 1174 before sharing."""
    # inputs
    p16 = p[16]  # 1.0/crank_mass
    p17 = p[17]  # 1.0/(0.001875*crank_mass)
    p18 = p[18]  # 1.0/rod_mass
    p19 = p[19]  # 1.0/(0.016875*rod_mass)
    p20 = p[20]  # 1.0/slider_mass
    reciprocal_2 = w[123]
    reciprocal_4 = w[125]
    reciprocal_5 = w[126]
    reciprocal_6 = w[127]
    jacobian_0 = w[102]  # D O.x, crank.omega
    jacobian_1 = w[103]  # D O.y, crank.omega
    jacobian_2 = w[104]  # D P.x, crank.omega
    jacobian_3 = w[105]  # D P.x, rod.omega
    jacobian_4 = w[106]  # D P.y, crank.omega
    jacobian_5 = w[107]  # D P.y, rod.omega
    jacobian_6 = w[108]  # D Q.x, rod.omega
    jacobian_7 = w[109]  # D Q.y, rod.omega
    p26 = p[26]  # 1.0/(1.0/slider_mass)
    p27 = p[27]
    p28 = p[28]
    # intermediate terms
    s0 = p17*jacobian_0
    s1 = p17*jacobian_1
    s2 = p17*jacobian_2
    s3 = p19*jacobian_3
    s4 = p19*jacobian_5
    s5 = p19*jacobian_6
    s6 = jacobian_1*s0
    s7 = jacobian_2*s0 - p16
    s8 = jacobian_4*s0
    s9 = jacobian_6*s3 - p18
    s10 = jacobian_6*s4
    s11 = jacobian_7*s5
    s12 = 1.0/(p16 + jacobian_0*s0)
    s13 = s6*s12
    s14 = s7*s12
    s15 = s8*s12
    s16 = jacobian_2*s1 - s7*s13
    s17 = jacobian_4*s1 - p16 - s8*s13
    s18 = 1.0*(reciprocal_2 > 0.0)/max(p16 + jacobian_1*s1 - s6*s13, 1e-300)
    s19 = s16*s18
    s20 = s17*s18
    s21 = 1.0/(p20 + p18 + jacobian_6*s5)
    s22 = s11*s21
    s23 = s9*s21
    s24 = s10*s21
    s25 = jacobian_7*s3 - s9*s22
    s26 = jacobian_7*s4 - p18 - s10*s22
    s27 = 1.0*(reciprocal_4 > 0.0)/max(p20 + p18 + jacobian_7*(p19*jacobian_7) - p28 - s11*s22, 1e-300)
    s28 = s25*s27
    s29 = s26*s27
    s30 = jacobian_4*s2 + jacobian_5*s3 - s8*s14 - s17*s19 - s10*s23 - s26*s28
    s31 = p18 + p16 + jacobian_4*(p17*jacobian_4) + jacobian_5*s4 - s8*s15 - s17*s20 - s10*s24 - s26*s29
    s32 = max(p18 + p16 + jacobian_2*s2 + jacobian_3*s3 - s7*s14 - s16*s19 - s9*s23 - s25*s28, 1e-300)
    s33 = 1.0*(reciprocal_5 > 0.0)/s32
    s34 = s30*s33
    # outputs
    w[128] = p27
    w[129] = s13
    w[130] = s14
    w[131] = s15
    w[132] = s19
    w[133] = s20
    w[134] = s22
    w[135] = s23
    w[136] = s24
    w[137] = s28
    w[138] = s29
    w[139] = s34
    w[140] = p26
    w[141] = s12
    w[142] = s18
    w[143] = s21
    w[144] = s27
    w[145] = s33
    w[146] = 1.0*(reciprocal_6 > 0.0)/max(s31 - s30*s34, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 86 operations, 1738 before sharing."""
    # inputs
    p16 = p[16]  # 1.0/crank_mass
    p17 = p[17]  # 1.0/(0.001875*crank_mass)
    p18 = p[18]  # 1.0/rod_mass
    p19 = p[19]  # 1.0/(0.016875*rod_mass)
    p20 = p[20]  # 1.0/slider_mass
    jacobian_0 = w[102]  # D O.x, crank.omega
    jacobian_1 = w[103]  # D O.y, crank.omega
    jacobian_2 = w[104]  # D P.x, crank.omega
    jacobian_3 = w[105]  # D P.x, rod.omega
    jacobian_4 = w[106]  # D P.y, crank.omega
    jacobian_5 = w[107]  # D P.y, rod.omega
    jacobian_6 = w[108]  # D Q.x, rod.omega
    jacobian_7 = w[109]  # D Q.y, rod.omega
    law_lower_0 = w[128]
    law_lower_1 = w[129]
    law_lower_2 = w[130]
    law_lower_3 = w[131]
    law_lower_4 = w[132]
    law_lower_5 = w[133]
    law_lower_6 = w[134]
    law_lower_7 = w[135]
    law_lower_8 = w[136]
    law_lower_9 = w[137]
    law_lower_10 = w[138]
    law_lower_11 = w[139]
    law_reciprocal_0 = w[140]
    law_reciprocal_1 = w[141]
    law_reciprocal_2 = w[142]
    law_reciprocal_3 = w[143]
    law_reciprocal_4 = w[144]
    law_reciprocal_5 = w[145]
    law_reciprocal_6 = w[146]
    residual_0 = w[43]  # O.x
    residual_1 = w[44]  # O.y
    residual_2 = w[45]  # P.x
    residual_3 = w[46]  # P.y
    residual_4 = w[47]  # Q.x
    residual_5 = w[48]  # Q.y
    residual_6 = w[49]  # guide.normal
    residual_7 = w[50]  # guide.angle
    # intermediate terms
    s0 = law_lower_1*residual_0 - residual_1
    s1 = law_lower_0*residual_6 - residual_5 + law_lower_6*residual_4
    s2 = law_lower_2*residual_0 - residual_2 - law_lower_4*s0 + law_lower_7*residual_4 - law_lower_9*s1
    s3 = law_lower_3*residual_0 - residual_3 - law_lower_5*s0 + law_lower_8*residual_4 - law_lower_10*s1
    s4 = law_reciprocal_6*(s3 - law_lower_11*s2)
    s5 = law_reciprocal_5*s2
    s6 = law_lower_11*s4
    s7 = s5 - s6
    s8 = law_reciprocal_4*s1 - law_lower_9*s7
    s9 = law_lower_10*s4
    s10 = s8 - s9
    s11 = law_reciprocal_3*residual_4 + law_lower_6*s10 + law_lower_7*s7 + law_lower_8*s4
    s12 = law_reciprocal_2*s0 - law_lower_4*s7 - law_lower_5*s4
    s13 = law_reciprocal_1*residual_0 + law_lower_1*s12 + law_lower_2*s7 + law_lower_3*s4
    # outputs
    w[67] = p16*(s6 - s5 - s13)  # crank.vx
    w[68] = p16*(s12 - s4)  # crank.vy
    w[69] = p17*(jacobian_1*s12 - jacobian_0*s13 + jacobian_2*s7 + jacobian_4*s4)  # crank.omega
    w[70] = p18*(s7 + s11)  # rod.vx
    w[71] = p18*(s4 + s9 - s8)  # rod.vy
    w[72] = p19*(jacobian_3*s7 + jacobian_5*s4 - jacobian_6*s11 + jacobian_7*s10)  # rod.omega
    w[73] = -p20*s11  # slider.vx
    w[74] = p20*(s10 - (law_reciprocal_0*residual_6 + law_lower_0*s10))  # slider.vy
    w[75] = -residual_7  # slider.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
