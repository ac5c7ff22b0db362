"""Kernel `joint_revolute` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
A joint of kind revolute over 1 frame, 3 constants, 0 numbers computed once a run.
Functions go through all instances, whose table begins at `at`: how many, then 8 numbers each.
"""

import numpy as np
from numba import njit

from machine import GAMMA, JACOBIAN, M, PHI, RECORDS, RESIDUAL


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w, T, at, out):
    """Phi, nu and D: 7 operations an instance."""
    here = np.uint32(at + 1)
    residual = np.int64(T[RESIDUAL])
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        row = T[here + 1]
        entry = T[here + 2]
        c0 = T[here + 5]
        c1 = T[here + 6]
        c2 = T[here + 7]
        r0_0 = w[f0 + 0]
        r0_1 = w[f0 + 1]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        s0 = r0_6*k2
        s1 = r0_7*k2
        w[residual + row + 0] = r0_0 - k0 + s0
        w[residual + row + 1] = r0_1 - k1 + s1
        w[jacobian + entry + 0] = 1.0
        w[jacobian + entry + 2] = -s1
        w[jacobian + entry + 4] = 1.0
        w[jacobian + entry + 5] = s0
        here = np.uint32(here + 8)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def motion(t, y, p, w, T, at, out):
    """Nu, D and gamma: 6 operations an instance."""
    here = np.uint32(at + 1)
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    gamma = np.int64(T[GAMMA])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        row = T[here + 1]
        entry = T[here + 2]
        c2 = T[here + 7]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        k2 = p[c2]
        s0 = r0_6*k2
        s1 = r0_7*k2
        s2 = r0_5*r0_5
        w[jacobian + entry + 0] = 1.0
        w[jacobian + entry + 2] = -s1
        w[jacobian + entry + 4] = 1.0
        w[jacobian + entry + 5] = s0
        w[gamma + row + 0] = s0*s2
        w[gamma + row + 1] = s1*s2
        here = np.uint32(here + 8)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def full(t, y, p, w, T, at, out):
    """Phi, nu, D and gamma: 10 operations an instance."""
    here = np.uint32(at + 1)
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    gamma = np.int64(T[GAMMA])
    phi = np.int64(T[PHI])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        row = T[here + 1]
        entry = T[here + 2]
        c0 = T[here + 5]
        c1 = T[here + 6]
        c2 = T[here + 7]
        r0_0 = w[f0 + 0]
        r0_1 = w[f0 + 1]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        s0 = r0_6*k2
        s1 = r0_7*k2
        s2 = r0_5*r0_5
        w[phi + row + 0] = r0_0 - k0 + s0
        w[phi + row + 1] = r0_1 - k1 + s1
        w[jacobian + entry + 0] = 1.0
        w[jacobian + entry + 2] = -s1
        w[jacobian + entry + 4] = 1.0
        w[jacobian + entry + 5] = s0
        w[gamma + row + 0] = s0*s2
        w[gamma + row + 1] = s1*s2
        here = np.uint32(here + 8)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def report(t, y, p, w, T, at, out):
    """Joint coordinates and their rates: 0 operations an instance."""
    here = np.uint32(at + 1)
    m = np.int64(T[M])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        coordinate = 2 * T[here + 3]
        r0_2 = w[f0 + 2]
        r0_5 = w[f0 + 5]
        out[m + coordinate + 0] = r0_2
        out[m + coordinate + 1] = r0_5
        here = np.uint32(here + 8)
    return 0
