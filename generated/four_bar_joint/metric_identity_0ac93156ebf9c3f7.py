"""Corrections in another metric, for model `four-bar`. Emitted by symgen; do not edit.

digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D D^T from D, without the rows that depend on others: 24 operations, 51 before sharing."""
    # inputs
    reciprocal_0 = w[49]
    reciprocal_1 = w[50]
    jacobian_0 = w[42]  # D C.x, crank.omega
    jacobian_1 = w[43]  # D C.x, rocker.omega
    jacobian_2 = w[44]  # D C.x, coupler.omega
    jacobian_3 = w[45]  # D C.y, crank.omega
    jacobian_4 = w[46]  # D C.y, rocker.omega
    jacobian_5 = w[47]  # D C.y, coupler.omega
    # intermediate terms
    s0 = jacobian_0*jacobian_3 + jacobian_1*jacobian_4 + jacobian_2*jacobian_5
    s1 = 1.0*(reciprocal_0 > 0.0)/max(jacobian_0*jacobian_0 + jacobian_1*jacobian_1 + jacobian_2*jacobian_2, 1e-300)
    s2 = s0*s1
    s3 = 1.0*(reciprocal_1 > 0.0)/max(jacobian_3*jacobian_3 + jacobian_4*jacobian_4 + jacobian_5*jacobian_5 - s0*s2, 1e-300)
    # outputs
    w[52] = s2
    w[53] = s1
    w[54] = s3
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 15 operations, 36 before sharing."""
    # inputs
    jacobian_0 = w[42]  # D C.x, crank.omega
    jacobian_1 = w[43]  # D C.x, rocker.omega
    jacobian_2 = w[44]  # D C.x, coupler.omega
    jacobian_3 = w[45]  # D C.y, crank.omega
    jacobian_4 = w[46]  # D C.y, rocker.omega
    jacobian_5 = w[47]  # D C.y, coupler.omega
    law_lower_0 = w[52]
    law_reciprocal_0 = w[53]
    law_reciprocal_1 = w[54]
    residual_0 = w[25]  # C.x
    residual_1 = w[26]  # C.y
    # intermediate terms
    s0 = law_reciprocal_1*(law_lower_0*residual_0 - residual_1)
    s1 = law_reciprocal_0*residual_0 + law_lower_0*s0
    # outputs
    w[31] = jacobian_3*s0 - jacobian_0*s1  # crank.omega
    w[32] = jacobian_4*s0 - jacobian_1*s1  # rocker.omega
    w[33] = jacobian_5*s0 - jacobian_2*s1  # coupler.omega
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
