"""Corrections in another metric, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def expand(p, w):
    """D as a dense matrix: 0 operations, 0 before sharing."""
    # inputs
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    # outputs
    w[37] = jacobian_0
    w[38] = jacobian_1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D G D^T that decide rank, and the factorisation of D P D^T: 18 operations, 55 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    dependent_0 = w[35]
    dependent_1 = w[36]
    # intermediate terms
    s0 = q0*q0 + q1*q1
    s1 = 0.5*(s0 - 1.0)
    s2 = 1.0/s0
    s3 = q0*(q0*dependent_0) + q1*(q1*dependent_1)
    s4 = math.sqrt(s1*s1)
    # outputs
    w[22] = s1  # link.distance
    w[0] = s4  # position_violation
    w[8] = s4  # position_measure
    w[32] = q0  # D link.distance, bob.vx
    w[33] = q1  # D link.distance, bob.vy
    w[5] = 1.0  # rank
    w[4] = 1.0  # smallest_pivot
    w[10] = 1.0  # shortest_row
    w[14] = s2*s3 + 1.0 - s0*s2  # partition_quality
    w[39] = 1.0/s3
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """the correction -D^+ times the section `residual`, of v, or of q by N: 7 operations, 8 before sharing."""
    # inputs
    jacobian_0 = w[32]  # D link.distance, bob.vx
    jacobian_1 = w[33]  # D link.distance, bob.vy
    dependent_0 = w[35]
    dependent_1 = w[36]
    law_reciprocal_0 = w[39]
    residual_0 = w[22]  # link.distance
    # intermediate terms
    s0 = law_reciprocal_0*residual_0
    # outputs
    w[25] = -dependent_0*(jacobian_0*s0)  # bob.vx
    w[26] = -dependent_1*(jacobian_1*s0)  # bob.vy
    return 0
