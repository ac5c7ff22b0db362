"""Corrections in another metric, for model `bricard`. Emitted by symgen; do not edit.

digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D M^-1 D^T from D, without the rows that depend on others: 230 operations, 20436 before sharing."""
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
    mass_entry_0 = w[108]
    mass_entry_1 = w[109]
    mass_entry_2 = w[110]
    mass_entry_3 = w[111]
    mass_entry_4 = w[112]
    # intermediate terms
    s0 = 2.9925187032418954*jacobian_2
    s1 = 2.9925187032418954*jacobian_3
    s2 = 2.9925187032418954*jacobian_7
    s3 = 2.9925187032418954*jacobian_8
    s4 = 2.9925187032418954*jacobian_12
    s5 = 2.9925187032418954*jacobian_13
    s6 = 2.9925187032418954*jacobian_17
    s7 = 1.0/mass_entry_4
    s8 = 1.0/mass_entry_3
    s9 = mass_entry_1*s8
    s10 = 2.9925187032418954*mass_entry_2
    s11 = 1.0/(mass_entry_0 - mass_entry_1*s9 - mass_entry_2*s10)
    s12 = jacobian_0 - jacobian_1*s9 - jacobian_3*s10
    s13 = jacobian_4 - jacobian_6*s9 - jacobian_8*s10
    s14 = jacobian_9 - jacobian_11*s9 - jacobian_13*s10
    s15 = jacobian_14 - jacobian_16*s9
    s16 = jacobian_18 - jacobian_20*s9 - jacobian_22*s10
    s17 = s11*s12
    s18 = jacobian_1*s8
    s19 = s11*s13
    s20 = jacobian_5*s7
    s21 = jacobian_6*s8
    s22 = s11*s14
    s23 = jacobian_10*s7
    s24 = jacobian_11*s8
    s25 = s11*s15
    s26 = jacobian_15*s7
    s27 = jacobian_16*s8
    s28 = jacobian_8*s1 + jacobian_7*s0 + s13*s17 + jacobian_6*s18
    s29 = jacobian_13*s1 + jacobian_12*s0 + s14*s17 + jacobian_11*s18
    s30 = jacobian_17*s0 + s15*s17 + jacobian_16*s18
    s31 = jacobian_22*s1 + jacobian_21*s0 + s16*s17 + jacobian_20*s18
    s32 = jacobian_21*(2.9925187032418954*jacobian_21) + s16*(s11*s16) + jacobian_19*(jacobian_19*s7) + jacobian_20*(jacobian_20*s8)
    s33 = 1.0*(reciprocal_0 > 0.0)/max(jacobian_3*s1 + jacobian_2*s0 + s12*s17 + jacobian_1*s18, 1e-300)
    s34 = s28*s33
    s35 = s29*s33
    s36 = s30*s33
    s37 = s31*s33
    s38 = jacobian_13*s3 + jacobian_12*s2 + s14*s19 + jacobian_10*s20 + jacobian_11*s21 - s29*s34
    s39 = jacobian_17*s2 + s15*s19 + jacobian_15*s20 + jacobian_16*s21 - s30*s34
    s40 = jacobian_22*s3 + jacobian_21*s2 + s16*s19 + jacobian_19*s20 + jacobian_20*s21 - s31*s34
    s41 = max(jacobian_8*s3 + jacobian_7*s2 + s13*s19 + jacobian_5*s20 + jacobian_6*s21 - s28*s34, 1e-300)
    s42 = 1.0*(reciprocal_1 > 0.0)/s41
    s43 = s38*s42
    s44 = s39*s42
    s45 = s40*s42
    s46 = jacobian_13*s5 + jacobian_12*s4 + s14*s22 + jacobian_10*s23 + jacobian_11*s24 - s29*s35 - s38*s43
    s47 = jacobian_17*s4 + s15*s22 + jacobian_15*s23 + jacobian_16*s24 - s30*s35 - s39*s43
    s48 = jacobian_22*s5 + jacobian_21*s4 + s16*s22 + jacobian_19*s23 + jacobian_20*s24 - s31*s35 - s40*s43
    s49 = 1.0*(reciprocal_2 > 0.0)/max(s46, 1e-300)
    s50 = s47*s49
    s51 = s48*s49
    s52 = jacobian_21*s6 + s16*s25 + jacobian_19*s26 + jacobian_20*s27 - s31*s36 - s40*s44 - s48*s50
    s53 = max(jacobian_17*s6 + s15*s25 + jacobian_15*s26 + jacobian_16*s27 - s30*s36 - s39*s44 - s47*s50, 1e-300)
    s54 = 1.0*(reciprocal_3 > 0.0)/s53
    s55 = s52*s54
    s56 = max(jacobian_22*(2.9925187032418954*jacobian_22) + s32 - s31*s37 - s40*s45 - s48*s51 - s52*s55, 1e-300)
    # outputs
    w[113] = s34
    w[114] = s35
    w[115] = s36
    w[116] = s37
    w[117] = s43
    w[118] = s44
    w[119] = s45
    w[120] = s50
    w[121] = s51
    w[122] = s55
    w[123] = s33
    w[124] = s42
    w[125] = s49
    w[126] = s54
    w[127] = 1.0*(reciprocal_4 > 0.0)/s56
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 108 operations, 8759 before sharing."""
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
    mass_entry_0 = w[108]
    mass_entry_1 = w[109]
    mass_entry_2 = w[110]
    mass_entry_3 = w[111]
    mass_entry_4 = w[112]
    # intermediate terms
    s0 = law_lower_0*residual_0 - residual_1
    s1 = law_lower_1*residual_0 - residual_2 - law_lower_4*s0
    s2 = law_lower_2*residual_0 - residual_3 - law_lower_5*s0 - law_lower_7*s1
    s3 = law_reciprocal_4*(law_lower_3*residual_0 - residual_4 - law_lower_6*s0 - law_lower_8*s1 - law_lower_9*s2)
    s4 = law_reciprocal_3*s2 - law_lower_9*s3
    s5 = law_reciprocal_2*s1 - law_lower_7*s4 - law_lower_8*s3
    s6 = law_reciprocal_1*s0 - law_lower_4*s5 - law_lower_5*s4 - law_lower_6*s3
    s7 = law_reciprocal_0*residual_0 + law_lower_0*s6 + law_lower_1*s5 + law_lower_2*s4 + law_lower_3*s3
    s8 = jacobian_6*s6 - jacobian_1*s7 + jacobian_11*s5 + jacobian_16*s4 + jacobian_20*s3
    s9 = jacobian_8*s6 - jacobian_3*s7 + jacobian_13*s5 + jacobian_22*s3
    s10 = 2.9925187032418954*(jacobian_7*s6 - jacobian_2*s7 + jacobian_12*s5 + jacobian_17*s4 + jacobian_21*s3)
    s11 = 1.0/mass_entry_3
    s12 = mass_entry_1*s11
    s13 = 2.9925187032418954*mass_entry_2
    s14 = jacobian_4*s6 - jacobian_0*s7 + jacobian_9*s5 + jacobian_14*s4 + jacobian_18*s3 - s8*s12 - s9*s13
    s15 = 1.0/(mass_entry_0 - mass_entry_1*s12 - mass_entry_2*s13)*s14
    # outputs
    w[50] = s15  # P0.angle.rate
    w[51] = (jacobian_5*s6 + jacobian_10*s5 + jacobian_15*s4 + jacobian_19*s3)*(1.0/mass_entry_4)  # P5.angle.rate
    w[52] = s8*s11 - s12*s15  # P1.angle.rate
    w[53] = s10  # P4.angle.rate
    w[54] = 2.9925187032418954*s9 - s13*s15  # P2.angle.rate
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
