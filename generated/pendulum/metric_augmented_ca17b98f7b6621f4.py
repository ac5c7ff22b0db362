"""Corrections in another metric, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of M + a D^T D from D, without the rows that depend on others: 14 operations, 40 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    p4 = p[4]  # penalty
    mask_0 = w[20]  # link.distance
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    # intermediate terms
    s0 = p4*(1.0*(1.0 > mask_0))
    s1 = jacobian_0*s0
    s2 = jacobian_1*s1
    s3 = 1.0/(p0 + jacobian_0*s1)
    s4 = s2*s3
    # outputs
    w[57] = s4
    w[58] = s3
    w[59] = 1.0/(p0 + jacobian_1*(jacobian_1*s0) - s2*s4)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 20 operations, 135 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    p4 = p[4]  # penalty
    mask_0 = w[20]  # link.distance
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    residual_0 = w[22]  # link.distance
    moved_0 = w[60]
    moved_1 = w[61]
    force_of_constraints_0 = w[62]
    law_lower_0 = w[57]
    law_reciprocal_0 = w[58]
    law_reciprocal_1 = w[59]
    # intermediate terms
    s0 = p4*(1.0*(1.0 > mask_0))*residual_0
    s1 = force_of_constraints_0 + s0
    s2 = s0 + s1
    s3 = p0*moved_0 + jacobian_0*s2
    s4 = law_reciprocal_1*(s3*law_lower_0 - (p0*moved_1 + jacobian_1*s2))
    s5 = s3*law_reciprocal_0 + law_lower_0*s4
    # outputs
    w[25] = -s5  # bob.vx
    w[26] = s4  # bob.vy
    w[60] = moved_0 - s5
    w[61] = moved_1 + s4
    w[62] = s1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
