"""Right-hand side, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers: 20 operations, 54 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    mask_0 = w[20]  # link.distance
    p3 = p[3]  # 1.0/math.sqrt(bob_mass)
    p4 = p[4]  # 9.81*bob_mass*(1.0/bob_mass)
    # intermediate terms
    s0 = q0*p3
    s1 = q1*p3
    s2 = 1.0/(mask_0 + s0*s0 + s1*s1)*(v0*v0 + v1*v1 - q1*p4)
    # outputs
    ydot[0] = v0  # rate of bob.x
    ydot[1] = v1  # rate of bob.y
    ydot[2] = -p3*(s0*s2)  # rate of bob.vx
    ydot[3] = -(p4 + p3*(s1*s2))  # rate of bob.vy
    ydot[4] = 0.0  # rate of work
    w[19] = s2  # link.distance
    return 0
