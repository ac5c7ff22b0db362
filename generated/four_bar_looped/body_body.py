"""Kernel `body_body` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
A body of kind body over 1 frame, 3 constants, 3 numbers computed once a run.
Functions go through all instances, whose table begins at `at`: how many, then 7 numbers each.
"""

import math

import numpy as np
from numba import njit

from machine import CHANGE, FORCE, INVERSE_MASS, MASS_DIAGONAL, NQ, RECORDS


@njit(error_model="numpy", fastmath={"contract"})
def frame(t, y, p, w, T, at, out):
    """Records of bodies: coordinates, velocities, entries of the rotation matrix: 2 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        q = T[here + 1]
        v = T[here + 2]
        q_0 = y[q + 0]
        q_1 = y[q + 1]
        q_2 = y[q + 2]
        v_0 = y[nq + v + 0]
        v_1 = y[nq + v + 1]
        v_2 = y[nq + v + 2]
        w[f0 + 0] = q_0
        w[f0 + 1] = q_1
        w[f0 + 2] = q_2
        w[f0 + 3] = v_0
        w[f0 + 4] = v_1
        w[f0 + 5] = v_2
        w[f0 + 6] = math.cos(q_2)
        w[f0 + 7] = math.sin(q_2)
        here = np.uint32(here + 7)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def speeds(t, y, p, w, T, at, out):
    """Velocities in the records: 0 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        v = T[here + 2]
        v_0 = y[nq + v + 0]
        v_1 = y[nq + v + 1]
        v_2 = y[nq + v + 2]
        w[f0 + 3] = v_0
        w[f0 + 4] = v_1
        w[f0 + 5] = v_2
        here = np.uint32(here + 7)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rates(t, y, p, w, T, at, out):
    """q' = N v: 0 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        q = T[here + 1]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        out[q + 0] = r0_3
        out[q + 1] = r0_4
        out[q + 2] = r0_5
        here = np.uint32(here + 7)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def move(t, y, p, w, T, at, out):
    """q += N change: 3 operations an instance."""
    here = np.uint32(at + 1)
    change = np.int64(T[CHANGE])
    for _ in range(np.int64(T[at])):
        q = T[here + 1]
        v = T[here + 2]
        q_0 = y[q + 0]
        q_1 = y[q + 1]
        q_2 = y[q + 2]
        change_0 = w[change + v + 0]
        change_1 = w[change + v + 1]
        change_2 = w[change + v + 2]
        y[q + 0] = q_0 + change_0
        y[q + 1] = q_1 + change_1
        y[q + 2] = q_2 + change_2
        here = np.uint32(here + 7)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def motion(t, y, p, w, T, at, out):
    """Weights and inertia forces: 0 operations an instance."""
    here = np.uint32(at + 1)
    force = np.int64(T[FORCE])
    for _ in range(np.int64(T[at])):
        v = T[here + 2]
        computed = T[here + 3]
        h0 = p[computed + 0]
        w[force + v + 0] = 0.0
        w[force + v + 1] = h0
        w[force + v + 2] = 0.0
        here = np.uint32(here + 7)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def energy(t, y, p, w, T, at, out):
    """Energies: 10 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    kinetic = 0.0
    potential = 0.0
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        computed = T[here + 3]
        r0_1 = w[f0 + 1]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        h1 = p[computed + 1]
        h0 = p[computed + 0]
        h2 = p[computed + 2]
        kinetic += h1*(r0_3*r0_3) + h1*(r0_4*r0_4) + h2*(r0_5*r0_5)
        potential += -r0_1*h0
        here = np.uint32(here + 7)
    w[2] += kinetic
    w[3] += potential
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def prepare(t, y, p, w, T, at, out):
    """Numbers that depend on parameters alone: 5 operations an instance."""
    here = np.uint32(at + 1)
    mass_diagonal = np.int64(T[MASS_DIAGONAL])
    inverse_mass = np.int64(T[INVERSE_MASS])
    for _ in range(np.int64(T[at])):
        v = T[here + 2]
        computed = T[here + 3]
        c0 = T[here + 4]
        c1 = T[here + 5]
        c2 = T[here + 6]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        s0 = 1.0/k0
        p[computed + 0] = k0*k2
        p[computed + 1] = 0.5*k0
        p[computed + 2] = 0.5*k1
        p[mass_diagonal + v + 0] = k0
        p[inverse_mass + v + 0] = s0
        p[mass_diagonal + v + 1] = k0
        p[inverse_mass + v + 1] = s0
        p[mass_diagonal + v + 2] = k1
        p[inverse_mass + v + 2] = 1.0/k1
        here = np.uint32(here + 7)
    return 0
