"""Right-hand side, for model `pendulum`. Emitted by symgen; do not edit.

digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers: 45 operations, 405 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]  # 9.81*bob_mass
    p6 = p[6]  # penalty
    mask_0 = w[20]  # link.distance
    p4 = p[4]  # 2.0*(omega*mu)
    p5 = p[5]  # omega*omega
    # intermediate terms
    s0 = p6*(1.0*(1.0 > mask_0))
    s1 = v0*v0 + v1*v1 + (q0*v0 + q1*v1)*p4 + 0.5*(q0*q0 + q1*q1 - 1.0)*p5
    s2 = s0*s1
    s3 = q0*s2
    s4 = q0*s0
    s5 = q1*s4
    s6 = 1.0/(p0 + q0*s4)
    s7 = s5*s6
    s8 = 1.0/(p0 + q1*(q1*s0) - s5*s7)*(s3*s7 - (p3 + q1*s2))
    s9 = s3*s6 + s7*s8
    # outputs
    ydot[0] = v0  # rate of bob.x
    ydot[1] = v1  # rate of bob.y
    ydot[2] = -s9  # rate of bob.vx
    ydot[3] = s8  # rate of bob.vy
    ydot[4] = 0.0  # rate of work
    w[19] = s0*(s1 + q1*s8 - q0*s9)  # link.distance
    return 0
