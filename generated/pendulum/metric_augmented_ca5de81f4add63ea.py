"""Corrections in another metric, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates a360905d90dcc4fd
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, the pivots of D G D^T that decide rank, and the factorisation of M + a D^T D: 21 operations, 69 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    p6 = p[6]
    mask_0 = w[20]
    # intermediate terms
    s0 = 0.5*(q0*q0 + q1*q1 - 1.0)
    s1 = p6*(1.0*(1.0 > mask_0))
    s2 = q0*s1
    s3 = q1*s2
    s4 = 1.0/(p0 + q0*s2)
    s5 = s3*s4
    s6 = math.sqrt(s0*s0)
    # outputs
    w[22] = s0
    w[0] = s6
    w[8] = s6
    w[32] = q0
    w[33] = q1
    w[5] = 1.0
    w[4] = 1.0
    w[10] = 1.0
    w[35] = s5
    w[36] = s4
    w[37] = 1.0/(p0 + q1*(q1*s1) - s3*s5)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """one iteration of the mass-orthogonal projection: 20 operations, 135 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    p6 = p[6]
    mask_0 = w[20]
    residual_0 = w[22]
    moved_0 = w[38]
    moved_1 = w[39]
    force_of_constraints_0 = w[40]
    jacobian_0 = w[32]
    jacobian_1 = w[33]
    law_lower_0 = w[35]
    law_reciprocal_0 = w[36]
    law_reciprocal_1 = w[37]
    # intermediate terms
    s0 = p6*(1.0*(1.0 > mask_0))*residual_0
    s1 = force_of_constraints_0 + s0
    s2 = s0 + s1
    s3 = p0*moved_0 + s2*jacobian_0
    s4 = law_reciprocal_1*(s3*law_lower_0 - (p0*moved_1 + s2*jacobian_1))
    s5 = s3*law_reciprocal_0 + law_lower_0*s4
    # outputs
    w[25] = -s5
    w[26] = s4
    w[38] = moved_0 - s5
    w[39] = moved_1 + s4
    w[40] = s1
    return 0
