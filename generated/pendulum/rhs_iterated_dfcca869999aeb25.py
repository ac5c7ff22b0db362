"""Right-hand side, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit

from .iterate_8ef1d7874c14748c import finish, iterate


@njit(error_model="numpy", fastmath={"contract"})
def rates(t, y, p, w, iw, ydot):
    """q', v' and multipliers for results: 20 operations, 46 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]  # 9.81*bob_mass
    mask_0 = w[20]  # link.distance
    p4 = p[4]  # 1.0/bob_mass
    p5 = p[5]  # 9.81*bob_mass*(1.0/bob_mass)
    # intermediate terms
    s0 = (v0*v0 + v1*v1 - q1*p5)*(1.0/(mask_0 + q0*(q0*p4) + q1*(q1*p4)))
    # outputs
    ydot[0] = v0  # rate of bob.x
    ydot[1] = v1  # rate of bob.y
    ydot[2] = -p4*(q0*s0)  # rate of bob.vx
    ydot[3] = -p4*(p3 + q1*s0)  # rate of bob.vy
    ydot[4] = 0.0  # rate of work
    w[19] = s0  # link.distance
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def begin(t, y, p, w):
    """matrices and start of the iteration: 16 operations, 44 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p6 = p[6]  # penalty
    mask_0 = w[20]  # link.distance
    # intermediate terms
    s0 = p6*(1.0*(1.0 > mask_0))
    s1 = q0*s0
    s2 = q1*s1
    s3 = 1.0/(p0 + q0*s1)
    s4 = s2*s3
    # outputs
    w[35] = s4
    w[36] = s3
    w[37] = 1.0/(p0 + q1*(q1*s0) - s2*s4)
    w[38] = s0
    w[39] = q0
    w[40] = q1
    w[41] = p0*v0
    w[42] = p0*v1
    w[43] = v0
    w[44] = v1
    w[45] = 0.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """Rates of the state by iteration until v' changes no more, at most 30 times."""
    begin(t, y, p, w)
    last = math.inf
    for _ in range(30):
        iterate(p, w)
        iw[6] += 1
        increment = w[13]
        # increments in the metric of M do not show massless bodies, which the second iteration sets right if no other moves;
        # at the floor of rounding another iteration gains nothing
        if last < math.inf and (increment <= p[7] or (increment > 0.5 * last and increment < 1e-6)):
            break
        last = increment
    finish(t, y, p, w, ydot)
    return 0
