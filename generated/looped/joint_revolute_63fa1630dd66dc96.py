"""Kernel `joint_revolute_63fa1630dd66dc96` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
A joint of kind revolute over 1 frame, 5 constants, 0 numbers computed once a run.
Functions go through all instances, whose table begins at `at`: how many, then 11 numbers each.
"""

import math

import numpy as np
from numba import njit

from .machine import GAMMA, JACOBIAN, M, PHI, RECORDS, RESIDUAL


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w, T, at, out):
    """Phi, nu and D: 41 operations an instance."""
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
        c4 = T[here + 10]
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
        k4 = p[c4]
        s0 = r0_5*r0_5 + r0_6*r0_6 - (r0_3*r0_3 + r0_4*r0_4)
        w[residual + row + 0] = k2 - (r0_0 + r0_13*k0 + r0_14*k1)
        w[residual + row + 1] = k3 - (r0_1 + r0_16*k0 + r0_17*k1)
        w[residual + row + 2] = k4 - (r0_2 + r0_19*k0 + r0_20*k1)
        w[residual + row + 3] = -r0_15
        w[residual + row + 4] = r0_14
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 3] = -r0_15*k1
        w[jacobian + entry + 4] = r0_15*k0
        w[jacobian + entry + 5] = r0_13*k1 - r0_14*k0
        w[jacobian + entry + 7] = -1.0
        w[jacobian + entry + 9] = -r0_18*k1
        w[jacobian + entry + 10] = r0_18*k0
        w[jacobian + entry + 11] = r0_16*k1 - r0_17*k0
        w[jacobian + entry + 14] = -1.0
        w[jacobian + entry + 15] = -r0_21*k1
        w[jacobian + entry + 16] = r0_21*k0
        w[jacobian + entry + 17] = r0_19*k1 - r0_20*k0
        w[jacobian + entry + 21] = r0_14
        w[jacobian + entry + 22] = s0
        w[jacobian + entry + 27] = r0_15
        w[jacobian + entry + 29] = s0
        here = np.uint32(here + 11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def motion(t, y, p, w, T, at, out):
    """nu, D and gamma: 74 operations an instance."""
    here = np.uint32(at + 1)
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    gamma = np.int64(T[GAMMA])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        row = T[here + 1]
        entry = T[here + 2]
        c0 = T[here + 6]
        c1 = T[here + 7]
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
        s0 = r0_12*k1
        s1 = r0_12*k0
        s2 = r0_10*k1
        s3 = r0_11*k0
        s4 = r0_11*(s2 - s3) - r0_12*s1
        s5 = r0_10*(s3 - s2) - r0_12*s0
        s6 = r0_10*s1 + r0_11*s0
        s7 = r0_11*r0_12
        s8 = r0_10*r0_10
        s9 = r0_5*r0_5 + r0_6*r0_6 - (r0_3*r0_3 + r0_4*r0_4)
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 3] = -r0_15*k1
        w[jacobian + entry + 4] = r0_15*k0
        w[jacobian + entry + 5] = r0_13*k1 - r0_14*k0
        w[jacobian + entry + 7] = -1.0
        w[jacobian + entry + 9] = -r0_18*k1
        w[jacobian + entry + 10] = r0_18*k0
        w[jacobian + entry + 11] = r0_16*k1 - r0_17*k0
        w[jacobian + entry + 14] = -1.0
        w[jacobian + entry + 15] = -r0_21*k1
        w[jacobian + entry + 16] = r0_21*k0
        w[jacobian + entry + 17] = r0_19*k1 - r0_20*k0
        w[jacobian + entry + 21] = r0_14
        w[jacobian + entry + 22] = s9
        w[jacobian + entry + 27] = r0_15
        w[jacobian + entry + 29] = s9
        w[gamma + row + 0] = r0_13*s4 + r0_14*s5 + r0_15*s6
        w[gamma + row + 1] = r0_16*s4 + r0_17*s5 + r0_18*s6
        w[gamma + row + 2] = r0_19*s4 + r0_20*s5 + r0_21*s6
        w[gamma + row + 3] = r0_13*(r0_10*r0_12) + r0_14*s7 - r0_15*(s8 + r0_11*r0_11)
        w[gamma + row + 4] = -(r0_13*(r0_10*r0_11) - r0_14*(s8 + r0_12*r0_12) + r0_15*s7)
        here = np.uint32(here + 11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def full(t, y, p, w, T, at, out):
    """Phi, nu, D and gamma: 90 operations an instance."""
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
        c4 = T[here + 10]
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
        k4 = p[c4]
        s0 = r0_12*k1
        s1 = r0_12*k0
        s2 = r0_10*k1
        s3 = r0_11*k0
        s4 = r0_11*(s2 - s3) - r0_12*s1
        s5 = r0_10*(s3 - s2) - r0_12*s0
        s6 = r0_10*s1 + r0_11*s0
        s7 = r0_11*r0_12
        s8 = r0_10*r0_10
        s9 = r0_5*r0_5 + r0_6*r0_6 - (r0_3*r0_3 + r0_4*r0_4)
        w[phi + row + 0] = k2 - (r0_0 + r0_13*k0 + r0_14*k1)
        w[phi + row + 1] = k3 - (r0_1 + r0_16*k0 + r0_17*k1)
        w[phi + row + 2] = k4 - (r0_2 + r0_19*k0 + r0_20*k1)
        w[phi + row + 3] = -r0_15
        w[phi + row + 4] = r0_14
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 3] = -r0_15*k1
        w[jacobian + entry + 4] = r0_15*k0
        w[jacobian + entry + 5] = r0_13*k1 - r0_14*k0
        w[jacobian + entry + 7] = -1.0
        w[jacobian + entry + 9] = -r0_18*k1
        w[jacobian + entry + 10] = r0_18*k0
        w[jacobian + entry + 11] = r0_16*k1 - r0_17*k0
        w[jacobian + entry + 14] = -1.0
        w[jacobian + entry + 15] = -r0_21*k1
        w[jacobian + entry + 16] = r0_21*k0
        w[jacobian + entry + 17] = r0_19*k1 - r0_20*k0
        w[jacobian + entry + 21] = r0_14
        w[jacobian + entry + 22] = s9
        w[jacobian + entry + 27] = r0_15
        w[jacobian + entry + 29] = s9
        w[gamma + row + 0] = r0_13*s4 + r0_14*s5 + r0_15*s6
        w[gamma + row + 1] = r0_16*s4 + r0_17*s5 + r0_18*s6
        w[gamma + row + 2] = r0_19*s4 + r0_20*s5 + r0_21*s6
        w[gamma + row + 3] = r0_13*(r0_10*r0_12) + r0_14*s7 - r0_15*(s8 + r0_11*r0_11)
        w[gamma + row + 4] = -(r0_13*(r0_10*r0_11) - r0_14*(s8 + r0_12*r0_12) + r0_15*s7)
        here = np.uint32(here + 11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def report(t, y, p, w, T, at, out):
    """joint coordinates and their rates: 22 operations an instance."""
    here = np.uint32(at + 1)
    m = np.int64(T[M])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        coordinate = 2 * T[here + 3]
        u0 = T[here + 4]
        r0_10 = w[f0 + 10]
        r0_11 = w[f0 + 11]
        r0_12 = w[f0 + 12]
        r0_16 = w[f0 + 16]
        r0_17 = w[f0 + 17]
        r0_18 = w[f0 + 18]
        winding_0 = w[19 + u0]
        s0 = r0_17*r0_17 + r0_18*r0_18
        s1 = r0_17/s0
        s2 = r0_18/s0
        s3 = math.atan2(r0_18, r0_17)
        out[m + coordinate + 0] = s3 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s3))
        out[m + coordinate + 1] = r0_11*(r0_16*s1) - r0_10*(r0_17*s1 + r0_18*s2) + r0_12*(r0_16*s2)
        here = np.uint32(here + 11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def wind(t, y, p, w, T, at, out):
    """angles whose turns are counted: 7 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        u0 = T[here + 4]
        r0_17 = w[f0 + 17]
        r0_18 = w[f0 + 18]
        winding_0 = w[19 + u0]
        s0 = math.atan2(r0_18, r0_17)
        w[19 + u0] = s0 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s0))
        here = np.uint32(here + 11)
    return 0
