"""Method `udwadia-kalaba` for model `pendulum`. Emitted by symgen; do not edit.

accelerations closest to the free ones in the metric of M, by a pseudoinverse
Udwadia, Kalaba, Proc. R. Soc. Lond. A 439 (1992) 407-410, doi 10.1098/rspa.1992.0158
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 2, templates 06e8f0c6b361de81
"""

import math

from numba import njit

from .model import geometry, measure

CHANGE = 21  # sections of w


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 5 operations, 5 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # outputs
    p[3] = 1.0/math.sqrt(p0)
    p[4] = 9.81*p0*(1.0/p0)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by udwadia-kalaba: 20 operations, 54 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    q1 = y[1]  # bob.y [m]
    v0 = y[2]  # bob.vx [m/s]
    v1 = y[3]  # bob.vy [m/s]
    mask_0 = w[16]
    p3 = p[3]
    p4 = p[4]
    # intermediate terms
    s0 = q0*p3
    s1 = q1*p3
    s2 = 1.0/(mask_0 + s0*s0 + s1*s1)*(v0*v0 + v1*v1 - q1*p4)
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = -p3*(s0*s2)
    ydot[3] = -(p4 + p3*(s1*s2))
    ydot[4] = 0.0
    w[15] = s2
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Measure an accepted state; nothing is corrected."""
    geometry(t, y, p, w)
    measure(t, y, p, w)
    return 0
