"""Method `lagrange` for model `pendulum`. Emitted by symgen; do not edit.

constraints at acceleration level only; violations grow with time
Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall, 1988
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 1, templates 8f8565515c2742ad
"""

import math

from numba import njit

from .model import drift, energies, geometry

PHI = 11  # sections of w
DRIFT = 13
PIVOT = 14
MASK = 9
SAVED = 10


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 3 operations, 5 before sharing."""
    # inputs
    p0 = p[0]  # bob_mass [kg]
    # intermediate terms
    s0 = 9.81*p0
    s1 = 1.0/p0
    # outputs
    p[3] = s0
    p[4] = s1
    p[5] = s0*s1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by lagrange; 1 where a pivot of S is suspicious: 20 operations, 46 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    v0 = y[2]  # bob.vx [m/s]
    q1 = y[1]  # bob.y [m]
    v1 = y[3]  # bob.vy [m/s]
    p3 = p[3]
    mask_0 = w[9]
    p4 = p[4]
    p5 = p[5]
    # intermediate terms
    s0 = (v0*v0 + v1*v1 - q1*p5)*(1.0/(mask_0 + q0*(q0*p4) + q1*(q1*p4)))
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = -p4*(q0*s0)
    ydot[3] = -p4*(p3 + q1*s0)
    ydot[4] = 0.0
    w[8] = s0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(1):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(1):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def norm(w, first):
    """Euclidean norm of a section of 1 rows."""
    total = 0.0
    for i in range(first, first + 1):
        total += w[i] * w[i]
    return math.sqrt(total)


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    bits = 0
    geometry(t, y, p, w)
    violation = norm(w, PHI)
    drift(y, w)
    energies(t, y, p, w)
    smallest = 1.0
    rank = 0
    for i in range(1):
        pivot = w[PIVOT + i]
        if pivot >= 1e-12:
            rank += 1
        if w[MASK + i] == 0.0 and pivot < smallest:
            smallest = pivot
    w[0] = violation
    w[1] = norm(w, DRIFT)
    w[4] = smallest
    w[5] = rank
    return bits
