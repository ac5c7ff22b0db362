"""One iteration, and its end, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration: 41 operations, 352 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    kept_factor_0 = w[35]
    kept_factor_1 = w[36]
    kept_factor_2 = w[37]
    kept_penalties_0 = w[38]
    kept_jacobian_0 = w[39]
    kept_jacobian_1 = w[40]
    kept_momentum_0 = w[41]
    kept_momentum_1 = w[42]
    kept_velocity_0 = w[43]
    kept_velocity_1 = w[44]
    kept_impulse_0 = w[45]
    status_7 = w[7]  # speed_scale
    status_11 = w[11]  # mean_mass
    # intermediate terms
    s0 = kept_impulse_0 + kept_penalties_0*(kept_jacobian_0*kept_velocity_0 + kept_jacobian_1*kept_velocity_1)
    s1 = kept_momentum_0 - p0*kept_velocity_0 - kept_jacobian_0*s0
    s2 = kept_factor_2*(kept_momentum_1 - p0*kept_velocity_1 - kept_jacobian_1*s0 - kept_factor_0*s1)
    s3 = kept_factor_1*s1 - kept_factor_0*s2
    s4 = kept_velocity_0 + s3
    s5 = kept_velocity_1 + s2
    s6 = math.sqrt((s3*(p0*s3) + s2*(p0*s2))/(status_7*(status_7*status_11) + s4*(p0*s4) + s5*(p0*s5)))
    # outputs
    w[43] = s4
    w[44] = s5
    w[45] = kept_impulse_0 + kept_penalties_0*(kept_jacobian_0*s4 + kept_jacobian_1*s5)
    w[13] = s6  # increment
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power: 5 operations, 5 before sharing."""
    # inputs
    p3 = p[3]  # 9.81*bob_mass
    kept_velocity_0 = w[43]
    kept_velocity_1 = w[44]
    kept_impulse_0 = w[45]
    p4 = p[4]  # 1.0/bob_mass
    # outputs
    ydot[0] = kept_velocity_0  # rate of bob.x
    ydot[1] = kept_velocity_1  # rate of bob.y
    ydot[2] = kept_velocity_0*kept_impulse_0*p4  # rate of bob.vx
    ydot[3] = (kept_velocity_1*kept_impulse_0 - p3)*p4  # rate of bob.vy
    ydot[4] = 0.0  # rate of work
    return 0
