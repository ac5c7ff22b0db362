"""Method `baumgarte` for model `pendulum`. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
option solver = elimination
p[3] alpha (default 5.0)
p[4] beta (default 5.0)
"""

import math

from numba import njit

from .model import geometry, measure

CHANGE = 21  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 5 operations, 7 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    p3 = p[3]
    p4 = p[4]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 1.0/p0
    # outputs
    p[5] = s0
    p[6] = 2.0*p3
    p[7] = p4*p4
    p[8] = s1
    p[9] = s0*s1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by baumgarte: 32 operations, 82 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    p5 = p[5]
    mask_0 = w[16]
    p6 = p[6]
    p7 = p[7]
    p8 = p[8]
    p9 = p[9]
    # intermediate terms
    s0 = (v0*v0 + v1*v1 + (q0*v0 + q1*v1)*p6 + 0.5*(q0*q0 + q1*q1 - 1.0)*p7 - q1*p9)*(1.0/(mask_0 + q0*(q0*p8) + q1*(q1*p8)))
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = -p8*(q0*s0)
    ydot[3] = -p8*(p5 + q1*s0)
    ydot[4] = 0.0
    w[15] = s0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
