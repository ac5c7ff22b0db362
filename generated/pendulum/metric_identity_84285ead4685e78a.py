"""Corrections in another metric, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit

from .model import geometry as geometry_of_model


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """the factorisation of D D^T from D, without the rows that depend on others: 4 operations, 4 before sharing."""
    # inputs
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    # outputs
    w[35] = 1.0/(jacobian_0*jacobian_0 + jacobian_1*jacobian_1)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 5 operations, 6 before sharing."""
    # inputs
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    law_reciprocal_0 = w[35]
    residual_0 = w[22]  # link.distance
    # intermediate terms
    s0 = law_reciprocal_0*residual_0
    # outputs
    w[25] = -jacobian_0*s0  # bob.vx
    w[26] = -jacobian_1*s0  # bob.vy
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0
