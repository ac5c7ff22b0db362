"""Kernel `joint_revolute_2` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
A joint of kind revolute over 2 frames, 2 constants, 0 numbers computed once a run.
Functions go through all instances, whose table begins at `at`: how many, then 8 numbers each.
"""

import numpy as np
from numba import njit

from machine import GAMMA, JACOBIAN, M, PHI, RECORDS, RESIDUAL


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w, T, at, out):
    """Phi, nu and D: 12 operations an instance."""
    here = np.uint32(at + 1)
    residual = np.int64(T[RESIDUAL])
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        row = T[here + 2]
        entry = T[here + 3]
        c0 = T[here + 6]
        c1 = T[here + 7]
        r0_0 = w[f0 + 0]
        r0_1 = w[f0 + 1]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        r1_0 = w[f1 + 0]
        r1_1 = w[f1 + 1]
        r1_6 = w[f1 + 6]
        r1_7 = w[f1 + 7]
        k0 = p[c0]
        k1 = p[c1]
        s0 = r1_6*k1
        s1 = r0_6*k0
        s2 = r1_7*k1
        s3 = r0_7*k0
        w[residual + row + 0] = r1_0 - r0_0 + s0 - s1
        w[residual + row + 1] = r1_1 - r0_1 + s2 - s3
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 2] = s3
        w[jacobian + entry + 3] = 1.0
        w[jacobian + entry + 5] = -s2
        w[jacobian + entry + 7] = -1.0
        w[jacobian + entry + 8] = -s1
        w[jacobian + entry + 10] = 1.0
        w[jacobian + entry + 11] = s0
        here = np.uint32(here + 8)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def motion(t, y, p, w, T, at, out):
    """Nu, D and gamma: 14 operations an instance."""
    here = np.uint32(at + 1)
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    gamma = np.int64(T[GAMMA])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        row = T[here + 2]
        entry = T[here + 3]
        c0 = T[here + 6]
        c1 = T[here + 7]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        r1_5 = w[f1 + 5]
        r1_6 = w[f1 + 6]
        r1_7 = w[f1 + 7]
        k0 = p[c0]
        k1 = p[c1]
        s0 = r1_6*k1
        s1 = r0_6*k0
        s2 = r1_7*k1
        s3 = r0_7*k0
        s4 = r0_5*r0_5
        s5 = r1_5*r1_5
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 2] = s3
        w[jacobian + entry + 3] = 1.0
        w[jacobian + entry + 5] = -s2
        w[jacobian + entry + 7] = -1.0
        w[jacobian + entry + 8] = -s1
        w[jacobian + entry + 10] = 1.0
        w[jacobian + entry + 11] = s0
        w[gamma + row + 0] = s0*s5 - s1*s4
        w[gamma + row + 1] = s2*s5 - s3*s4
        here = np.uint32(here + 8)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def full(t, y, p, w, T, at, out):
    """Phi, nu, D and gamma: 20 operations an instance."""
    here = np.uint32(at + 1)
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    gamma = np.int64(T[GAMMA])
    phi = np.int64(T[PHI])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        row = T[here + 2]
        entry = T[here + 3]
        c0 = T[here + 6]
        c1 = T[here + 7]
        r0_0 = w[f0 + 0]
        r0_1 = w[f0 + 1]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        r1_0 = w[f1 + 0]
        r1_1 = w[f1 + 1]
        r1_5 = w[f1 + 5]
        r1_6 = w[f1 + 6]
        r1_7 = w[f1 + 7]
        k0 = p[c0]
        k1 = p[c1]
        s0 = r1_6*k1
        s1 = r0_6*k0
        s2 = r1_7*k1
        s3 = r0_7*k0
        s4 = r0_5*r0_5
        s5 = r1_5*r1_5
        w[phi + row + 0] = r1_0 - r0_0 + s0 - s1
        w[phi + row + 1] = r1_1 - r0_1 + s2 - s3
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 2] = s3
        w[jacobian + entry + 3] = 1.0
        w[jacobian + entry + 5] = -s2
        w[jacobian + entry + 7] = -1.0
        w[jacobian + entry + 8] = -s1
        w[jacobian + entry + 10] = 1.0
        w[jacobian + entry + 11] = s0
        w[gamma + row + 0] = s0*s5 - s1*s4
        w[gamma + row + 1] = s2*s5 - s3*s4
        here = np.uint32(here + 8)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def report(t, y, p, w, T, at, out):
    """Joint coordinates and their rates: 2 operations an instance."""
    here = np.uint32(at + 1)
    m = np.int64(T[M])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        coordinate = 2 * T[here + 4]
        r0_2 = w[f0 + 2]
        r0_5 = w[f0 + 5]
        r1_2 = w[f1 + 2]
        r1_5 = w[f1 + 5]
        out[m + coordinate + 0] = r1_2 - r0_2
        out[m + coordinate + 1] = r1_5 - r0_5
        here = np.uint32(here + 8)
    return 0
