"""Kernel `body_body_f715eb486c2b480a` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
A body of kind body over 1 frame, 5 constants, 5 numbers computed once a run.
Functions go through all instances, whose table begins at `at`: how many, then 9 numbers each.
"""

import math

import numpy as np
from numba import njit

from .machine import CHANGE, FORCE, INVERSE_MASS, MASS_DIAGONAL, NQ, RECORDS, VECTORS


@njit(error_model="numpy", fastmath={"contract"})
def frame(t, y, p, w, T, at, out):
    """records of bodies: coordinates, velocities, entries of the rotation matrix: 29 operations an instance."""
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
        q_3 = y[q + 3]
        q_4 = y[q + 4]
        q_5 = y[q + 5]
        q_6 = y[q + 6]
        v_0 = y[nq + v + 0]
        v_1 = y[nq + v + 1]
        v_2 = y[nq + v + 2]
        v_3 = y[nq + v + 3]
        v_4 = y[nq + v + 4]
        v_5 = y[nq + v + 5]
        s0 = q_3*q_3
        s1 = q_4*q_4
        s2 = q_5*q_5
        s3 = q_6*q_6
        s4 = s0 - s1
        s5 = s2 - s3
        s6 = 2.0*(q_4*q_5)
        s7 = 2.0*(q_3*q_6)
        s8 = 2.0*(q_4*q_6)
        s9 = 2.0*(q_3*q_5)
        s10 = 2.0*(q_5*q_6)
        s11 = 2.0*(q_3*q_4)
        w[f0 + 0] = q_0
        w[f0 + 1] = q_1
        w[f0 + 2] = q_2
        w[f0 + 3] = q_3
        w[f0 + 4] = q_4
        w[f0 + 5] = q_5
        w[f0 + 6] = q_6
        w[f0 + 7] = v_0
        w[f0 + 8] = v_1
        w[f0 + 9] = v_2
        w[f0 + 10] = v_3
        w[f0 + 11] = v_4
        w[f0 + 12] = v_5
        w[f0 + 13] = s0 + s1 - (s2 + s3)
        w[f0 + 14] = s6 - s7
        w[f0 + 15] = s8 + s9
        w[f0 + 16] = s6 + s7
        w[f0 + 17] = s4 + s5
        w[f0 + 18] = s10 - s11
        w[f0 + 19] = s8 - s9
        w[f0 + 20] = s10 + s11
        w[f0 + 21] = s4 - s5
        here = np.uint32(here + 9)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def speeds(t, y, p, w, T, at, out):
    """velocities in the records: 0 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        v = T[here + 2]
        v_0 = y[nq + v + 0]
        v_1 = y[nq + v + 1]
        v_2 = y[nq + v + 2]
        v_3 = y[nq + v + 3]
        v_4 = y[nq + v + 4]
        v_5 = y[nq + v + 5]
        w[f0 + 7] = v_0
        w[f0 + 8] = v_1
        w[f0 + 9] = v_2
        w[f0 + 10] = v_3
        w[f0 + 11] = v_4
        w[f0 + 12] = v_5
        here = np.uint32(here + 9)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rates(t, y, p, w, T, at, out):
    """q' = N v: 24 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        q = T[here + 1]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        r0_8 = w[f0 + 8]
        r0_9 = w[f0 + 9]
        r0_10 = w[f0 + 10]
        r0_11 = w[f0 + 11]
        r0_12 = w[f0 + 12]
        s0 = 0.5*r0_10
        s1 = 0.5*r0_11
        s2 = 0.5*r0_12
        out[q + 0] = r0_7
        out[q + 1] = r0_8
        out[q + 2] = r0_9
        out[q + 3] = -(r0_4*s0 + r0_5*s1 + r0_6*s2)
        out[q + 4] = r0_3*s0 + r0_5*s2 - r0_6*s1
        out[q + 5] = r0_3*s1 + r0_6*s0 - r0_4*s2
        out[q + 6] = r0_3*s2 + r0_4*s1 - r0_5*s0
        here = np.uint32(here + 9)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def motion(t, y, p, w, T, at, out):
    """weights and inertia forces: 9 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    force = np.int64(T[FORCE])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        v = T[here + 2]
        computed = T[here + 3]
        r0_10 = w[f0 + 10]
        r0_11 = w[f0 + 11]
        r0_12 = w[f0 + 12]
        h0 = p[computed + 0]
        h1 = p[computed + 1]
        h2 = p[computed + 2]
        h3 = p[computed + 3]
        w[force + v + 0] = 0.0
        w[force + v + 1] = h3
        w[force + v + 2] = 0.0
        w[force + v + 3] = -h0*(r0_11*r0_12)
        w[force + v + 4] = -h1*(r0_10*r0_12)
        w[force + v + 5] = -h2*(r0_10*r0_11)
        here = np.uint32(here + 9)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def energy(t, y, p, w, T, at, out):
    """energies: 20 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    kinetic = 0.0
    potential = 0.0
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        computed = T[here + 3]
        c1 = T[here + 5]
        c2 = T[here + 6]
        c3 = T[here + 7]
        r0_1 = w[f0 + 1]
        r0_7 = w[f0 + 7]
        r0_8 = w[f0 + 8]
        r0_9 = w[f0 + 9]
        r0_10 = w[f0 + 10]
        r0_11 = w[f0 + 11]
        r0_12 = w[f0 + 12]
        k1 = p[c1]
        k2 = p[c2]
        k3 = p[c3]
        h4 = p[computed + 4]
        h3 = p[computed + 3]
        s0 = 0.5*(r0_10*(r0_10*k1) + r0_11*(r0_11*k2) + r0_12*(r0_12*k3)) + h4*(r0_7*r0_7) + h4*(r0_8*r0_8)
        kinetic += s0 + h4*(r0_9*r0_9)
        potential += -r0_1*h3
        here = np.uint32(here + 9)
    w[2] += kinetic
    w[3] += potential
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def move(t, y, p, w, T, at, out):
    """q + N times `change`, Euler parameters of length 1: 43 operations an instance."""
    here = np.uint32(at + 1)
    change = np.int64(T[CHANGE])
    for _ in range(np.int64(T[at])):
        q = T[here + 1]
        v = T[here + 2]
        q_0 = y[q + 0]
        q_1 = y[q + 1]
        q_2 = y[q + 2]
        q_3 = y[q + 3]
        q_4 = y[q + 4]
        q_5 = y[q + 5]
        q_6 = y[q + 6]
        change_0 = w[change + v + 0]
        change_1 = w[change + v + 1]
        change_2 = w[change + v + 2]
        change_3 = w[change + v + 3]
        change_4 = w[change + v + 4]
        change_5 = w[change + v + 5]
        s0 = 0.5*change_3
        s1 = 0.5*change_4
        s2 = 0.5*change_5
        s3 = q_3 - (q_4*s0 + q_5*s1 + q_6*s2)
        s4 = q_4 + q_3*s0 + q_5*s2 - q_6*s1
        s5 = q_5 + q_3*s1 + q_6*s0 - q_4*s2
        s6 = q_6 + q_3*s2 + q_4*s1 - q_5*s0
        s7 = 1.0/math.sqrt(s3*s3 + s4*s4 + s5*s5 + s6*s6)
        y[q + 0] = q_0 + change_0
        y[q + 1] = q_1 + change_1
        y[q + 2] = q_2 + change_2
        y[q + 3] = s3*s7
        y[q + 4] = s4*s7
        y[q + 5] = s5*s7
        y[q + 6] = s6*s7
        here = np.uint32(here + 9)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def turn(t, y, p, w, T, at, out):
    """q moved by `change`, bodies turned by its exponential: 69 operations an instance."""
    here = np.uint32(at + 1)
    change = np.int64(T[CHANGE])
    for _ in range(np.int64(T[at])):
        q = T[here + 1]
        v = T[here + 2]
        q_0 = y[q + 0]
        q_1 = y[q + 1]
        q_2 = y[q + 2]
        q_3 = y[q + 3]
        q_4 = y[q + 4]
        q_5 = y[q + 5]
        q_6 = y[q + 6]
        change_0 = w[change + v + 0]
        change_1 = w[change + v + 1]
        change_2 = w[change + v + 2]
        change_3 = w[change + v + 3]
        change_4 = w[change + v + 4]
        change_5 = w[change + v + 5]
        s0 = 0.5*change_3
        s1 = 0.5*change_4
        s2 = 0.5*change_5
        s3 = s0*s0 + s1*s1 + s2*s2
        s4 = (s3 < 0.0001)
        s5 = math.sqrt((1.0 if s4 else s3))
        s6 = (1.0 - s3*(0.16666666666666666 - s3*(0.008333333333333333 - 0.0001984126984126984*s3)) if s4 else math.sin(s5)/s5)
        s7 = math.cos(math.sqrt(s3))
        s8 = s0*s6
        s9 = s1*s6
        s10 = s2*s6
        s11 = q_3*s7 - (q_4*s8 + q_5*s9 + q_6*s10)
        s12 = q_4*s7 + q_3*s8 + q_5*s10 - q_6*s9
        s13 = q_5*s7 + q_3*s9 + q_6*s8 - q_4*s10
        s14 = q_6*s7 + q_3*s10 + q_4*s9 - q_5*s8
        s15 = 1.0/math.sqrt(s11*s11 + s12*s12 + s13*s13 + s14*s14)
        y[q + 0] = q_0 + change_0
        y[q + 1] = q_1 + change_1
        y[q + 2] = q_2 + change_2
        y[q + 3] = s11*s15
        y[q + 4] = s12*s15
        y[q + 5] = s13*s15
        y[q + 6] = s14*s15
        here = np.uint32(here + 9)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def normalise(t, y, p, w, T, at, out):
    """Euler parameters of length 1; 1 where they were not: 16 operations an instance."""
    here = np.uint32(at + 1)
    changed = 0.0
    for _ in range(np.int64(T[at])):
        q = T[here + 1]
        q_3 = y[q + 3]
        q_4 = y[q + 4]
        q_5 = y[q + 5]
        q_6 = y[q + 6]
        s0 = q_6*q_6 + q_5*q_5 + q_3*q_3 + q_4*q_4
        s1 = 1.0/math.sqrt(s0)
        y[q + 3] = q_3*s1
        y[q + 4] = q_4*s1
        y[q + 5] = q_5*s1
        y[q + 6] = q_6*s1
        changed += (1e-13 < abs(s0 - 1.0))
        here = np.uint32(here + 9)
    w[np.int64(T[VECTORS])] += changed
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def prepare(t, y, p, w, T, at, out):
    """numbers that depend on parameters alone: 9 operations an instance."""
    here = np.uint32(at + 1)
    mass_diagonal = np.int64(T[MASS_DIAGONAL])
    inverse_mass = np.int64(T[INVERSE_MASS])
    for _ in range(np.int64(T[at])):
        v = T[here + 2]
        computed = T[here + 3]
        c0 = T[here + 4]
        c1 = T[here + 5]
        c2 = T[here + 6]
        c3 = T[here + 7]
        c4 = T[here + 8]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        k3 = p[c3]
        k4 = p[c4]
        s0 = 1.0/k0
        p[computed + 0] = k3 - k2
        p[computed + 1] = k1 - k3
        p[computed + 2] = k2 - k1
        p[computed + 3] = k0*k4
        p[computed + 4] = 0.5*k0
        p[mass_diagonal + v + 0] = k0
        p[inverse_mass + v + 0] = s0
        p[mass_diagonal + v + 1] = k0
        p[inverse_mass + v + 1] = s0
        p[mass_diagonal + v + 2] = k0
        p[inverse_mass + v + 2] = s0
        p[mass_diagonal + v + 3] = k1
        p[inverse_mass + v + 3] = 1.0/k1
        p[mass_diagonal + v + 4] = k2
        p[inverse_mass + v + 4] = 1.0/k2
        p[mass_diagonal + v + 5] = k3
        p[inverse_mass + v + 5] = 1.0/k3
        here = np.uint32(here + 9)
    return 0
