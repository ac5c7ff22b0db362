"""Method `penalty` for model `pendulum`. Emitted by symgen; do not edit.

constraints as stiff elements; the error falls like 1 / penalty
Bayo, Garcia de Jalon, Serna, Comput. Methods Appl. Mech. Eng. 71 (1988) 183-195; Ruzzeh, Kovecses, J. Comput. Nonlinear Dyn. 6 (2011) 021011
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
p[3] penalty (default 1000000000.0)
p[4] omega (default 10.0)
p[5] mu (default 1.0)
"""

import math

from numba import njit

from .model import geometry, measure

CHANGE = 21  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 4 operations, 4 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    p4 = p[4]
    p5 = p[5]
    # outputs
    p[6] = 9.81*p0
    p[7] = 2.0*(p4*p5)
    p[8] = p4*p4
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by penalty: 45 operations, 405 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p6 = p[6]
    p3 = p[3]
    mask_0 = w[16]
    p7 = p[7]
    p8 = p[8]
    # intermediate terms
    s0 = p3*(1.0*(1.0 > mask_0))
    s1 = v0*v0 + v1*v1 + (q0*v0 + q1*v1)*p7 + 0.5*(q0*q0 + q1*q1 - 1.0)*p8
    s2 = s0*s1
    s3 = q0*s2
    s4 = q0*s0
    s5 = q1*s4
    s6 = 1.0/(p0 + q0*s4)
    s7 = s5*s6
    s8 = 1.0/(p0 + q1*(q1*s0) - s5*s7)*(s3*s7 - (p6 + q1*s2))
    s9 = s3*s6 + s7*s8
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = -s9
    ydot[3] = s8
    ydot[4] = 0.0
    w[15] = s0*(s1 + q1*s8 - q0*s9)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
