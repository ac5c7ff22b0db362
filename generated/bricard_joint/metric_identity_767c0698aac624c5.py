"""Corrections in another metric, for model `bricard`. Emitted by symgen; do not edit.

digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D D^T from D, without the rows that depend on others: 180 operations, 5216 before sharing."""
    # inputs
    reciprocal_0 = w[103]
    reciprocal_1 = w[104]
    reciprocal_2 = w[105]
    reciprocal_3 = w[106]
    reciprocal_4 = w[107]
    jacobian_0 = w[70]  # D P3.x, P0.angle.rate
    jacobian_1 = w[71]  # D P3.x, P1.angle.rate
    jacobian_2 = w[72]  # D P3.x, P4.angle.rate
    jacobian_3 = w[73]  # D P3.x, P2.angle.rate
    jacobian_4 = w[74]  # D P3.y, P0.angle.rate
    jacobian_5 = w[75]  # D P3.y, P5.angle.rate
    jacobian_6 = w[76]  # D P3.y, P1.angle.rate
    jacobian_7 = w[77]  # D P3.y, P4.angle.rate
    jacobian_8 = w[78]  # D P3.y, P2.angle.rate
    jacobian_9 = w[79]  # D P3.z, P0.angle.rate
    jacobian_10 = w[80]  # D P3.z, P5.angle.rate
    jacobian_11 = w[81]  # D P3.z, P1.angle.rate
    jacobian_12 = w[82]  # D P3.z, P4.angle.rate
    jacobian_13 = w[83]  # D P3.z, P2.angle.rate
    jacobian_14 = w[84]  # D P3.first, P0.angle.rate
    jacobian_15 = w[85]  # D P3.first, P5.angle.rate
    jacobian_16 = w[86]  # D P3.first, P1.angle.rate
    jacobian_17 = w[87]  # D P3.first, P4.angle.rate
    jacobian_18 = w[88]  # D P3.second, P0.angle.rate
    jacobian_19 = w[89]  # D P3.second, P5.angle.rate
    jacobian_20 = w[90]  # D P3.second, P1.angle.rate
    jacobian_21 = w[91]  # D P3.second, P4.angle.rate
    jacobian_22 = w[92]  # D P3.second, P2.angle.rate
    # intermediate terms
    s0 = jacobian_0*jacobian_0 + jacobian_1*jacobian_1 + jacobian_2*jacobian_2 + jacobian_3*jacobian_3
    s1 = jacobian_0*jacobian_4 + jacobian_1*jacobian_6 + jacobian_2*jacobian_7 + jacobian_3*jacobian_8
    s2 = jacobian_0*jacobian_9 + jacobian_1*jacobian_11 + jacobian_2*jacobian_12 + jacobian_3*jacobian_13
    s3 = jacobian_0*jacobian_14 + jacobian_1*jacobian_16 + jacobian_2*jacobian_17
    s4 = jacobian_0*jacobian_18 + jacobian_1*jacobian_20 + jacobian_2*jacobian_21 + jacobian_3*jacobian_22
    s5 = jacobian_4*jacobian_4 + jacobian_5*jacobian_5 + jacobian_6*jacobian_6 + jacobian_7*jacobian_7
    s6 = jacobian_4*jacobian_9 + jacobian_5*jacobian_10 + jacobian_6*jacobian_11 + jacobian_7*jacobian_12
    s7 = jacobian_4*jacobian_14 + jacobian_5*jacobian_15 + jacobian_6*jacobian_16 + jacobian_7*jacobian_17
    s8 = jacobian_4*jacobian_18 + jacobian_5*jacobian_19 + jacobian_6*jacobian_20 + jacobian_7*jacobian_21
    s9 = jacobian_9*jacobian_9 + jacobian_10*jacobian_10 + jacobian_11*jacobian_11 + jacobian_12*jacobian_12
    s10 = jacobian_9*jacobian_14 + jacobian_10*jacobian_15 + jacobian_11*jacobian_16 + jacobian_12*jacobian_17
    s11 = jacobian_9*jacobian_18 + jacobian_10*jacobian_19 + jacobian_11*jacobian_20 + jacobian_12*jacobian_21
    s12 = jacobian_14*jacobian_14 + jacobian_15*jacobian_15 + jacobian_16*jacobian_16 + jacobian_17*jacobian_17
    s13 = jacobian_14*jacobian_18 + jacobian_15*jacobian_19 + jacobian_16*jacobian_20 + jacobian_17*jacobian_21
    s14 = jacobian_18*jacobian_18 + jacobian_19*jacobian_19 + jacobian_20*jacobian_20 + jacobian_21*jacobian_21
    s15 = 1.0*(reciprocal_0 > 0.0)/max(s0, 1e-300)
    s16 = s1*s15
    s17 = s2*s15
    s18 = s3*s15
    s19 = s4*s15
    s20 = s6 + jacobian_8*jacobian_13 - s2*s16
    s21 = s7 - s3*s16
    s22 = s8 + jacobian_8*jacobian_22 - s4*s16
    s23 = 1.0*(reciprocal_1 > 0.0)/max(s5 + jacobian_8*jacobian_8 - s1*s16, 1e-300)
    s24 = s20*s23
    s25 = s21*s23
    s26 = s22*s23
    s27 = s10 - s3*s17 - s21*s24
    s28 = s11 + jacobian_13*jacobian_22 - s4*s17 - s22*s24
    s29 = 1.0*(reciprocal_2 > 0.0)/max(s9 + jacobian_13*jacobian_13 - s2*s17 - s20*s24, 1e-300)
    s30 = s27*s29
    s31 = s28*s29
    s32 = s13 - s4*s18 - s22*s25 - s28*s30
    s33 = 1.0*(reciprocal_3 > 0.0)/max(s12 - s3*s18 - s21*s25 - s27*s30, 1e-300)
    s34 = s32*s33
    s35 = 1.0*(reciprocal_4 > 0.0)/max(s14 + jacobian_22*jacobian_22 - s4*s19 - s22*s26 - s28*s31 - s32*s34, 1e-300)
    # outputs
    w[113] = s16
    w[114] = s17
    w[115] = s18
    w[116] = s19
    w[117] = s24
    w[118] = s25
    w[119] = s26
    w[120] = s30
    w[121] = s31
    w[122] = s34
    w[123] = s15
    w[124] = s23
    w[125] = s29
    w[126] = s33
    w[127] = s35
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 86 operations, 3152 before sharing."""
    # inputs
    jacobian_0 = w[70]  # D P3.x, P0.angle.rate
    jacobian_1 = w[71]  # D P3.x, P1.angle.rate
    jacobian_2 = w[72]  # D P3.x, P4.angle.rate
    jacobian_3 = w[73]  # D P3.x, P2.angle.rate
    jacobian_4 = w[74]  # D P3.y, P0.angle.rate
    jacobian_5 = w[75]  # D P3.y, P5.angle.rate
    jacobian_6 = w[76]  # D P3.y, P1.angle.rate
    jacobian_7 = w[77]  # D P3.y, P4.angle.rate
    jacobian_8 = w[78]  # D P3.y, P2.angle.rate
    jacobian_9 = w[79]  # D P3.z, P0.angle.rate
    jacobian_10 = w[80]  # D P3.z, P5.angle.rate
    jacobian_11 = w[81]  # D P3.z, P1.angle.rate
    jacobian_12 = w[82]  # D P3.z, P4.angle.rate
    jacobian_13 = w[83]  # D P3.z, P2.angle.rate
    jacobian_14 = w[84]  # D P3.first, P0.angle.rate
    jacobian_15 = w[85]  # D P3.first, P5.angle.rate
    jacobian_16 = w[86]  # D P3.first, P1.angle.rate
    jacobian_17 = w[87]  # D P3.first, P4.angle.rate
    jacobian_18 = w[88]  # D P3.second, P0.angle.rate
    jacobian_19 = w[89]  # D P3.second, P5.angle.rate
    jacobian_20 = w[90]  # D P3.second, P1.angle.rate
    jacobian_21 = w[91]  # D P3.second, P4.angle.rate
    jacobian_22 = w[92]  # D P3.second, P2.angle.rate
    law_lower_0 = w[113]
    law_lower_1 = w[114]
    law_lower_2 = w[115]
    law_lower_3 = w[116]
    law_lower_4 = w[117]
    law_lower_5 = w[118]
    law_lower_6 = w[119]
    law_lower_7 = w[120]
    law_lower_8 = w[121]
    law_lower_9 = w[122]
    law_reciprocal_0 = w[123]
    law_reciprocal_1 = w[124]
    law_reciprocal_2 = w[125]
    law_reciprocal_3 = w[126]
    law_reciprocal_4 = w[127]
    residual_0 = w[35]  # P3.x
    residual_1 = w[36]  # P3.y
    residual_2 = w[37]  # P3.z
    residual_3 = w[38]  # P3.first
    residual_4 = w[39]  # P3.second
    # intermediate terms
    s0 = law_lower_0*residual_0 - residual_1
    s1 = law_lower_1*residual_0 - residual_2 - law_lower_4*s0
    s2 = law_lower_2*residual_0 - residual_3 - law_lower_5*s0 - law_lower_7*s1
    s3 = law_reciprocal_4*(law_lower_3*residual_0 - residual_4 - law_lower_6*s0 - law_lower_8*s1 - law_lower_9*s2)
    s4 = law_reciprocal_3*s2 - law_lower_9*s3
    s5 = law_reciprocal_2*s1 - law_lower_7*s4 - law_lower_8*s3
    s6 = law_reciprocal_1*s0 - law_lower_4*s5 - law_lower_5*s4 - law_lower_6*s3
    s7 = law_reciprocal_0*residual_0 + law_lower_0*s6 + law_lower_1*s5 + law_lower_2*s4 + law_lower_3*s3
    # outputs
    w[50] = jacobian_4*s6 - jacobian_0*s7 + jacobian_9*s5 + jacobian_14*s4 + jacobian_18*s3  # P0.angle.rate
    w[51] = jacobian_5*s6 + jacobian_10*s5 + jacobian_15*s4 + jacobian_19*s3  # P5.angle.rate
    w[52] = jacobian_6*s6 - jacobian_1*s7 + jacobian_11*s5 + jacobian_16*s4 + jacobian_20*s3  # P1.angle.rate
    w[53] = jacobian_7*s6 - jacobian_2*s7 + jacobian_12*s5 + jacobian_17*s4 + jacobian_21*s3  # P4.angle.rate
    w[54] = jacobian_8*s6 - jacobian_3*s7 + jacobian_13*s5 + jacobian_22*s3  # P2.angle.rate
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
