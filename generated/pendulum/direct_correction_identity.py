"""Method `direct-correction` for model `pendulum`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 71af6a48b0bdb32fd18695a62bdcf1e89d0317d2a254daca133e6779d6b0e73c, format 1, templates 8f8565515c2742ad
option weight = identity
p[3] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import drift, energies, geometry, spread

PHI = 11  # sections of w
DRIFT = 13
PIVOT = 14
MASK = 9
RIGHT = 15
CHANGE = 16
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
    p[4] = s0
    p[5] = s1
    p[6] = s0*s1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 20 operations, 46 before sharing."""
    # inputs
    q0 = y[0]  # bob.x [m]
    v0 = y[2]  # bob.vx [m/s]
    q1 = y[1]  # bob.y [m]
    v1 = y[3]  # bob.vy [m/s]
    p4 = p[4]
    mask_0 = w[9]
    p5 = p[5]
    p6 = p[6]
    # intermediate terms
    s0 = (v0*v0 + v1*v1 - q1*p6)*(1.0/(mask_0 + q0*(q0*p5) + q1*(q1*p5)))
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = -p5*(q0*s0)
    ydot[3] = -p5*(p4 + q1*s0)
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
    tolerance = p[3] * w[6]
    last = math.inf
    for _ in range(12):
        # at the floor of rounding another iteration gains nothing
        if violation <= tolerance or (violation > 0.5 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        for i in range(1):
            w[RIGHT + i] = -w[PHI + i]
        spread(p, w)
        for j in range(2):
            y[j] += w[CHANGE + j]
        iw[3] += 1
        bits |= 2
        geometry(t, y, p, w)
        violation = norm(w, PHI)
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    drift(y, w)
    for i in range(1):
        w[RIGHT + i] = -w[DRIFT + i]
    spread(p, w)
    for j in range(2):
        y[2 + j] += w[CHANGE + j]
    drift(y, w)
    bits |= 2
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
