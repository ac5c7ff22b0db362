"""One iteration, and its end, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def iterate(p, w):
    """one iteration: 44 operations, 369 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    kept_factor_0 = w[35]
    kept_factor_1 = w[36]
    kept_factor_2 = w[37]
    kept_penalties_0 = w[38]
    kept_jacobian_0 = w[39]
    kept_jacobian_1 = w[40]
    kept_force_0 = w[41]
    kept_target_0 = w[42]
    kept_acceleration_0 = w[43]
    kept_acceleration_1 = w[44]
    multipliers_0 = w[19]  # link.distance
    status_7 = w[7]  # speed_scale
    status_6 = w[6]  # length_scale
    status_11 = w[11]  # mean_mass
    # intermediate terms
    s0 = kept_penalties_0*(kept_jacobian_0*kept_acceleration_0 + kept_jacobian_1*kept_acceleration_1 - kept_target_0)
    s1 = multipliers_0 + s0
    s2 = p0*kept_acceleration_0 + kept_jacobian_0*s1
    s3 = kept_factor_2*(kept_force_0 - p0*kept_acceleration_1 - kept_jacobian_1*s1 + kept_factor_0*s2)
    s4 = kept_factor_1*s2 + kept_factor_0*s3
    s5 = kept_acceleration_0 - s4
    s6 = kept_acceleration_1 + s3
    s7 = status_7*status_7/status_6
    # outputs
    w[43] = s5
    w[44] = s6
    w[19] = multipliers_0 + kept_penalties_0*(kept_jacobian_0*s5 + kept_jacobian_1*s6 - kept_target_0)  # link.distance
    w[13] = math.sqrt((s4*(p0*s4) + s3*(p0*s3))/(s7*(s7*status_11) + s5*(p0*s5) + s6*(p0*s6)))  # increment
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def finish(t, y, p, w, ydot):
    """rates of the state, and power: 0 operations, 0 before sharing."""
    # inputs
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    kept_acceleration_0 = w[43]
    kept_acceleration_1 = w[44]
    # outputs
    ydot[0] = v0  # rate of bob.x
    ydot[1] = v1  # rate of bob.y
    ydot[2] = kept_acceleration_0  # rate of bob.vx
    ydot[3] = kept_acceleration_1  # rate of bob.vy
    ydot[4] = 0.0  # rate of work
    return 0
