"""Corrections in another metric, for model `slider-crank`. Emitted by symgen; do not edit.

digest 6d92fc815bd77693475e0af9134199a5c8bbd4aa101da1c6d382d77c4d1faf26, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D D^T from D, without the rows that depend on others: 101 operations, 896 before sharing."""
    # inputs
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
    # intermediate terms
    s0 = jacobian_0*jacobian_1
    s1 = -1.0 + jacobian_0*jacobian_2
    s2 = jacobian_0*jacobian_4
    s3 = -1.0 + jacobian_3*jacobian_6
    s4 = jacobian_5*jacobian_6
    s5 = jacobian_6*jacobian_7
    s6 = 1.0/(1.0 + jacobian_0*jacobian_0)
    s7 = s0*s6
    s8 = s1*s6
    s9 = s2*s6
    s10 = jacobian_1*jacobian_2 - s1*s7
    s11 = -1.0 + jacobian_1*jacobian_4 - s2*s7
    s12 = 1.0*(reciprocal_2 > 0.0)/max(1.0 + jacobian_1*jacobian_1 - s0*s7, 1e-300)
    s13 = s10*s12
    s14 = s11*s12
    s15 = 1.0/(1.0 + 1.0 + jacobian_6*jacobian_6)
    s16 = s5*s15
    s17 = s3*s15
    s18 = s4*s15
    s19 = jacobian_3*jacobian_7 - s3*s16
    s20 = -1.0 + jacobian_5*jacobian_7 - s4*s16
    s21 = 1.0*(reciprocal_4 > 0.0)/max(1.0 + 1.0 + jacobian_7*jacobian_7 - 1.0 - s5*s16, 1e-300)
    s22 = s19*s21
    s23 = s20*s21
    s24 = 1.0 + 1.0 + jacobian_2*jacobian_2 + jacobian_3*jacobian_3 - s1*s8 - s10*s13 - s3*s17 - s19*s22
    s25 = jacobian_2*jacobian_4 + jacobian_3*jacobian_5 - s2*s8 - s11*s13 - s4*s17 - s20*s22
    s26 = 1.0 + 1.0 + jacobian_4*jacobian_4 + jacobian_5*jacobian_5 - s2*s9 - s11*s14 - s4*s18 - s20*s23
    s27 = 1.0*(reciprocal_5 > 0.0)/max(s24, 1e-300)
    s28 = s25*s27
    # outputs
    w[128] = s7
    w[129] = s8
    w[130] = s9
    w[131] = s13
    w[132] = s14
    w[133] = s16
    w[134] = s17
    w[135] = s18
    w[136] = s22
    w[137] = s23
    w[138] = s28
    w[139] = s6
    w[140] = s12
    w[141] = s15
    w[142] = s21
    w[143] = s27
    w[144] = 1.0*(reciprocal_6 > 0.0)/max(s26 - s25*s28, 1e-300)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 75 operations, 1621 before sharing."""
    # inputs
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
    law_reciprocal_0 = w[139]
    law_reciprocal_1 = w[140]
    law_reciprocal_2 = w[141]
    law_reciprocal_3 = w[142]
    law_reciprocal_4 = w[143]
    law_reciprocal_5 = w[144]
    residual_0 = w[43]  # O.x
    residual_1 = w[44]  # O.y
    residual_2 = w[45]  # P.x
    residual_3 = w[46]  # P.y
    residual_4 = w[47]  # Q.x
    residual_5 = w[48]  # Q.y
    residual_6 = w[49]  # guide.normal
    residual_7 = w[50]  # guide.angle
    # intermediate terms
    s0 = law_lower_0*residual_0 - residual_1
    s1 = residual_6 - residual_5 + law_lower_5*residual_4
    s2 = law_lower_1*residual_0 - residual_2 - law_lower_3*s0 + law_lower_6*residual_4 - law_lower_8*s1
    s3 = law_lower_2*residual_0 - residual_3 - law_lower_4*s0 + law_lower_7*residual_4 - law_lower_9*s1
    s4 = law_reciprocal_5*(s3 - law_lower_10*s2)
    s5 = law_reciprocal_4*s2
    s6 = law_lower_10*s4
    s7 = s5 - s6
    s8 = law_reciprocal_3*s1 - law_lower_8*s7
    s9 = law_lower_9*s4
    s10 = s8 - s9
    s11 = law_reciprocal_2*residual_4 + law_lower_5*s10 + law_lower_6*s7 + law_lower_7*s4
    s12 = law_reciprocal_1*s0 - law_lower_3*s7 - law_lower_4*s4
    s13 = law_reciprocal_0*residual_0 + law_lower_0*s12 + law_lower_1*s7 + law_lower_2*s4
    # outputs
    w[67] = s6 - s5 - s13  # crank.vx
    w[68] = s12 - s4  # crank.vy
    w[69] = jacobian_1*s12 - jacobian_0*s13 + jacobian_2*s7 + jacobian_4*s4  # crank.omega
    w[70] = s7 + s11  # rod.vx
    w[71] = s4 + s9 - s8  # rod.vy
    w[72] = jacobian_3*s7 + jacobian_5*s4 - jacobian_6*s11 + jacobian_7*s10  # rod.omega
    w[73] = -s11  # slider.vx
    w[74] = s10 - (residual_6 + s10)  # slider.vy
    w[75] = -residual_7  # slider.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
