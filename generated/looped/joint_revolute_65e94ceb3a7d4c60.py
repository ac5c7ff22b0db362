"""Kernel `joint_revolute_65e94ceb3a7d4c60` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
A joint of kind revolute over 1 frame, 4 constants, 0 numbers computed once a run.
Functions go through all instances, whose table begins at `at`: how many, then 10 numbers each.
"""

import math

import numpy as np
from numba import njit

from .machine import GAMMA, JACOBIAN, M, PHI, RECORDS, RESIDUAL


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w, T, at, out):
    """Phi, nu and D: 29 operations an instance."""
    here = np.uint32(at + 1)
    residual = np.int64(T[RESIDUAL])
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        row = T[here + 1]
        entry = T[here + 2]
        c0 = T[here + 6]
        c1 = T[here + 7]
        c2 = T[here + 8]
        c3 = T[here + 9]
        r0_0 = w[f0 + 0]
        r0_1 = w[f0 + 1]
        r0_2 = w[f0 + 2]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_13 = w[f0 + 13]
        r0_14 = w[f0 + 14]
        r0_15 = w[f0 + 15]
        r0_16 = w[f0 + 16]
        r0_17 = w[f0 + 17]
        r0_18 = w[f0 + 18]
        r0_19 = w[f0 + 19]
        r0_20 = w[f0 + 20]
        r0_21 = w[f0 + 21]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        k3 = p[c3]
        w[residual + row + 0] = r0_0 + r0_13*k3 - k0
        w[residual + row + 1] = r0_1 + r0_16*k3 - k1
        w[residual + row + 2] = r0_2 + r0_19*k3 - k2
        w[residual + row + 3] = 2.0*(r0_3*r0_6) - 2.0*(r0_4*r0_5)
        w[residual + row + 4] = r0_20
        w[jacobian + entry + 0] = 1.0
        w[jacobian + entry + 4] = -r0_15*k3
        w[jacobian + entry + 5] = r0_14*k3
        w[jacobian + entry + 7] = 1.0
        w[jacobian + entry + 10] = -r0_18*k3
        w[jacobian + entry + 11] = r0_17*k3
        w[jacobian + entry + 14] = 1.0
        w[jacobian + entry + 16] = -r0_21*k3
        w[jacobian + entry + 17] = r0_20*k3
        w[jacobian + entry + 21] = -r0_15
        w[jacobian + entry + 23] = r0_13
        w[jacobian + entry + 27] = r0_21
        w[jacobian + entry + 29] = 2.0*(r0_3*r0_5) - 2.0*(r0_4*r0_6)
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def motion(t, y, p, w, T, at, out):
    """nu, D and gamma: 56 operations an instance."""
    here = np.uint32(at + 1)
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    gamma = np.int64(T[GAMMA])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        row = T[here + 1]
        entry = T[here + 2]
        c3 = T[here + 9]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_10 = w[f0 + 10]
        r0_11 = w[f0 + 11]
        r0_12 = w[f0 + 12]
        r0_13 = w[f0 + 13]
        r0_14 = w[f0 + 14]
        r0_15 = w[f0 + 15]
        r0_16 = w[f0 + 16]
        r0_17 = w[f0 + 17]
        r0_18 = w[f0 + 18]
        r0_19 = w[f0 + 19]
        r0_20 = w[f0 + 20]
        r0_21 = w[f0 + 21]
        k3 = p[c3]
        s0 = r0_12*k3
        s1 = r0_11*k3
        s2 = r0_11*s1 + r0_12*s0
        s3 = r0_10*s1
        s4 = r0_10*s0
        s5 = r0_10*r0_11
        s6 = r0_12*r0_12 + r0_10*r0_10
        s7 = r0_11*r0_12
        w[jacobian + entry + 0] = 1.0
        w[jacobian + entry + 4] = -r0_15*k3
        w[jacobian + entry + 5] = r0_14*k3
        w[jacobian + entry + 7] = 1.0
        w[jacobian + entry + 10] = -r0_18*k3
        w[jacobian + entry + 11] = r0_17*k3
        w[jacobian + entry + 14] = 1.0
        w[jacobian + entry + 16] = -r0_21*k3
        w[jacobian + entry + 17] = r0_20*k3
        w[jacobian + entry + 21] = -r0_15
        w[jacobian + entry + 23] = r0_13
        w[jacobian + entry + 27] = r0_21
        w[jacobian + entry + 29] = 2.0*(r0_3*r0_5) - 2.0*(r0_4*r0_6)
        w[gamma + row + 0] = -(r0_14*s3 - r0_13*s2 + r0_15*s4)
        w[gamma + row + 1] = -(r0_17*s3 - r0_16*s2 + r0_18*s4)
        w[gamma + row + 2] = -(r0_20*s3 - r0_19*s2 + r0_21*s4)
        w[gamma + row + 3] = r0_13*s5 - r0_14*s6 + r0_15*s7
        w[gamma + row + 4] = -(r0_19*s5 - r0_20*s6 + r0_21*s7)
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def full(t, y, p, w, T, at, out):
    """Phi, nu, D and gamma: 70 operations an instance."""
    here = np.uint32(at + 1)
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    gamma = np.int64(T[GAMMA])
    phi = np.int64(T[PHI])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        row = T[here + 1]
        entry = T[here + 2]
        c0 = T[here + 6]
        c1 = T[here + 7]
        c2 = T[here + 8]
        c3 = T[here + 9]
        r0_0 = w[f0 + 0]
        r0_1 = w[f0 + 1]
        r0_2 = w[f0 + 2]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_10 = w[f0 + 10]
        r0_11 = w[f0 + 11]
        r0_12 = w[f0 + 12]
        r0_13 = w[f0 + 13]
        r0_14 = w[f0 + 14]
        r0_15 = w[f0 + 15]
        r0_16 = w[f0 + 16]
        r0_17 = w[f0 + 17]
        r0_18 = w[f0 + 18]
        r0_19 = w[f0 + 19]
        r0_20 = w[f0 + 20]
        r0_21 = w[f0 + 21]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        k3 = p[c3]
        s0 = r0_12*k3
        s1 = r0_11*k3
        s2 = r0_11*s1 + r0_12*s0
        s3 = r0_10*s1
        s4 = r0_10*s0
        s5 = r0_10*r0_11
        s6 = r0_12*r0_12 + r0_10*r0_10
        s7 = r0_11*r0_12
        w[phi + row + 0] = r0_0 + r0_13*k3 - k0
        w[phi + row + 1] = r0_1 + r0_16*k3 - k1
        w[phi + row + 2] = r0_2 + r0_19*k3 - k2
        w[phi + row + 3] = 2.0*(r0_3*r0_6) - 2.0*(r0_4*r0_5)
        w[phi + row + 4] = r0_20
        w[jacobian + entry + 0] = 1.0
        w[jacobian + entry + 4] = -r0_15*k3
        w[jacobian + entry + 5] = r0_14*k3
        w[jacobian + entry + 7] = 1.0
        w[jacobian + entry + 10] = -r0_18*k3
        w[jacobian + entry + 11] = r0_17*k3
        w[jacobian + entry + 14] = 1.0
        w[jacobian + entry + 16] = -r0_21*k3
        w[jacobian + entry + 17] = r0_20*k3
        w[jacobian + entry + 21] = -r0_15
        w[jacobian + entry + 23] = r0_13
        w[jacobian + entry + 27] = r0_21
        w[jacobian + entry + 29] = 2.0*(r0_3*r0_5) - 2.0*(r0_4*r0_6)
        w[gamma + row + 0] = -(r0_14*s3 - r0_13*s2 + r0_15*s4)
        w[gamma + row + 1] = -(r0_17*s3 - r0_16*s2 + r0_18*s4)
        w[gamma + row + 2] = -(r0_20*s3 - r0_19*s2 + r0_21*s4)
        w[gamma + row + 3] = r0_13*s5 - r0_14*s6 + r0_15*s7
        w[gamma + row + 4] = -(r0_19*s5 - r0_20*s6 + r0_21*s7)
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def report(t, y, p, w, T, at, out):
    """joint coordinates and their rates: 26 operations an instance."""
    here = np.uint32(at + 1)
    m = np.int64(T[M])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        coordinate = 2 * T[here + 3]
        u0 = T[here + 4]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_10 = w[f0 + 10]
        r0_11 = w[f0 + 11]
        r0_13 = w[f0 + 13]
        r0_15 = w[f0 + 15]
        r0_19 = w[f0 + 19]
        r0_20 = w[f0 + 20]
        r0_21 = w[f0 + 21]
        winding_0 = w[19 + u0]
        s0 = r0_21*r0_21 + r0_15*r0_15
        s1 = r0_21/s0
        s2 = r0_15/s0
        s3 = math.atan2(r0_15, r0_21)
        out[m + coordinate + 0] = s3 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s3))
        out[m + coordinate + 1] = r0_10*((2.0*(r0_3*r0_6) - 2.0*(r0_4*r0_5))*s1 + r0_20*s2) + r0_11*(r0_13*s1 - r0_19*s2)
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def wind(t, y, p, w, T, at, out):
    """angles whose turns are counted: 7 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        u0 = T[here + 4]
        r0_15 = w[f0 + 15]
        r0_21 = w[f0 + 21]
        winding_0 = w[19 + u0]
        s0 = math.atan2(r0_15, r0_21)
        w[19 + u0] = s0 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s0))
        here = np.uint32(here + 10)
    return 0
