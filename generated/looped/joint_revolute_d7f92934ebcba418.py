"""Kernel `joint_revolute_d7f92934ebcba418` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
A joint of kind revolute over 2 frames, 3 constants, 0 numbers computed once a run.
Functions go through all instances, whose table begins at `at`: how many, then 10 numbers each.
"""

import math

import numpy as np
from numba import njit

from .machine import GAMMA, JACOBIAN, M, PHI, RECORDS, RESIDUAL


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w, T, at, out):
    """Phi, nu and D: 120 operations an instance."""
    here = np.uint32(at + 1)
    residual = np.int64(T[RESIDUAL])
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        row = T[here + 2]
        entry = T[here + 3]
        c0 = T[here + 7]
        c1 = T[here + 8]
        c2 = T[here + 9]
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
        r1_0 = w[f1 + 0]
        r1_1 = w[f1 + 1]
        r1_2 = w[f1 + 2]
        r1_3 = w[f1 + 3]
        r1_4 = w[f1 + 4]
        r1_5 = w[f1 + 5]
        r1_6 = w[f1 + 6]
        r1_13 = w[f1 + 13]
        r1_14 = w[f1 + 14]
        r1_15 = w[f1 + 15]
        r1_16 = w[f1 + 16]
        r1_17 = w[f1 + 17]
        r1_18 = w[f1 + 18]
        r1_19 = w[f1 + 19]
        r1_20 = w[f1 + 20]
        r1_21 = w[f1 + 21]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        s0 = r0_14*r1_15 + r0_17*r1_18 + r0_20*r1_21
        s1 = r0_16*r1_18
        s2 = r0_3*r0_3
        s3 = r0_4*r0_4
        s4 = r0_5*r0_5
        s5 = r0_6*r0_6
        s6 = r0_15*r1_15
        s7 = 2.0*(r1_3*r1_6) - 2.0*(r1_4*r1_5)
        w[residual + row + 0] = r1_0 + r1_13*k1 + r1_14*k2 - (r0_0 + r0_13*k0)
        w[residual + row + 1] = r1_1 + r1_16*k1 + r1_17*k2 - (r0_1 + r0_16*k0)
        w[residual + row + 2] = r1_2 + r1_19*k1 + r1_20*k2 - (r0_2 + r0_19*k0)
        w[residual + row + 3] = -s0
        w[residual + row + 4] = s1 + r0_13*r1_15 + r0_19*r1_21
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 4] = r0_15*k0
        w[jacobian + entry + 5] = -r0_14*k0
        w[jacobian + entry + 6] = 1.0
        w[jacobian + entry + 9] = r1_15*k2
        w[jacobian + entry + 10] = -r1_15*k1
        w[jacobian + entry + 11] = r1_14*k1 - r1_13*k2
        w[jacobian + entry + 13] = -1.0
        w[jacobian + entry + 16] = r0_18*k0
        w[jacobian + entry + 17] = -r0_17*k0
        w[jacobian + entry + 19] = 1.0
        w[jacobian + entry + 21] = r1_18*k2
        w[jacobian + entry + 22] = -r1_18*k1
        w[jacobian + entry + 23] = r1_17*k1 - r1_16*k2
        w[jacobian + entry + 26] = -1.0
        w[jacobian + entry + 28] = r0_21*k0
        w[jacobian + entry + 29] = -r0_20*k0
        w[jacobian + entry + 32] = 1.0
        w[jacobian + entry + 33] = r1_21*k2
        w[jacobian + entry + 34] = -r1_21*k1
        w[jacobian + entry + 35] = r1_20*k1 - r1_19*k2
        w[jacobian + entry + 39] = -(s6 + r0_18*r1_18 + r0_21*r1_21)
        w[jacobian + entry + 41] = -(r1_15*(s4 + s5 - (s2 + s3)) - s1 + r1_21*(2.0*(r0_3*r0_5) - 2.0*(r0_4*r0_6)))
        w[jacobian + entry + 45] = r0_20*r1_20 - (r0_14*s7 - r0_17*r1_17)
        w[jacobian + entry + 46] = -(r0_14*r1_13 + r0_17*r1_16 + r0_20*r1_19)
        w[jacobian + entry + 52] = r1_18*(2.0*(r0_3*r0_4) - 2.0*(r0_5*r0_6)) - s6 + r1_21*(s4 - s5 - (s2 - s3))
        w[jacobian + entry + 53] = s0
        w[jacobian + entry + 57] = r0_13*s7 - r0_16*r1_17 - r0_19*r1_20
        w[jacobian + entry + 58] = r0_13*r1_13 + r0_16*r1_16 + r0_19*r1_19
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def motion(t, y, p, w, T, at, out):
    """nu, D and gamma: 275 operations an instance."""
    here = np.uint32(at + 1)
    jacobian = np.int64(T[JACOBIAN])
    records = np.int64(T[RECORDS])
    gamma = np.int64(T[GAMMA])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        row = T[here + 2]
        entry = T[here + 3]
        c0 = T[here + 7]
        c1 = T[here + 8]
        c2 = T[here + 9]
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
        r1_3 = w[f1 + 3]
        r1_4 = w[f1 + 4]
        r1_5 = w[f1 + 5]
        r1_6 = w[f1 + 6]
        r1_10 = w[f1 + 10]
        r1_11 = w[f1 + 11]
        r1_12 = w[f1 + 12]
        r1_13 = w[f1 + 13]
        r1_14 = w[f1 + 14]
        r1_15 = w[f1 + 15]
        r1_16 = w[f1 + 16]
        r1_17 = w[f1 + 17]
        r1_18 = w[f1 + 18]
        r1_19 = w[f1 + 19]
        r1_20 = w[f1 + 20]
        r1_21 = w[f1 + 21]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        s0 = r0_12*k0
        s1 = r0_11*k0
        s2 = r0_11*s1 + r0_12*s0
        s3 = r0_10*s1
        s4 = r0_10*s0
        s5 = r1_12*k2
        s6 = r1_12*k1
        s7 = r1_10*k2
        s8 = r1_11*k1
        s9 = r1_11*(s7 - s8) - r1_12*s6
        s10 = r1_10*(s8 - s7) - r1_12*s5
        s11 = r1_10*s6 + r1_11*s5
        s12 = r0_10*r0_11
        s13 = r0_12*r0_12
        s14 = s13 + r0_10*r0_10
        s15 = r0_11*r0_12
        s16 = r1_10*r1_12
        s17 = r1_11*r1_12
        s18 = r1_10*r1_10 + r1_11*r1_11
        s19 = r1_11*r1_13 - r1_10*r1_14
        s20 = r1_11*r1_16 - r1_10*r1_17
        s21 = r1_11*r1_19 - r1_10*r1_20
        s22 = r1_13*s16 + r1_14*s17 - r1_15*s18
        s23 = r1_16*s16 + r1_17*s17 - r1_18*s18
        s24 = r1_19*s16 + r1_20*s17 - r1_21*s18
        s25 = r0_14*s22 + r0_17*s23 + r0_20*s24 + r1_15*(r0_13*s12 - r0_14*s14 + r0_15*s15) + r1_18*(r0_16*s12 - r0_17*s14 + r0_18*s15)
        s26 = s25 + r1_21*(r0_19*s12 - r0_20*s14 + r0_21*s15) + s19*(2.0*(r0_10*r0_15 - r0_12*r0_13)) + s20*(2.0*(r0_10*r0_18 - r0_12*r0_16))
        s27 = s13 + r0_11*r0_11
        s28 = r0_10*r0_12
        s29 = r0_13*s22 + r0_16*s23 + r0_19*s24 + r1_15*(r0_14*s12 - r0_13*s27 + r0_15*s28) + r1_18*(r0_17*s12 - r0_16*s27 + r0_18*s28)
        s30 = s29 + r1_21*(r0_20*s12 - r0_19*s27 + r0_21*s28) + s19*(2.0*(r0_12*r0_14 - r0_11*r0_15)) + s20*(2.0*(r0_12*r0_17 - r0_11*r0_18))
        s31 = r0_3*r0_3
        s32 = r0_4*r0_4
        s33 = r0_5*r0_5
        s34 = r0_6*r0_6
        s35 = r0_15*r1_15
        s36 = 2.0*(r1_3*r1_6) - 2.0*(r1_4*r1_5)
        s37 = -(r1_15*(s33 + s34 - (s31 + s32)) - r0_16*r1_18 + r1_21*(2.0*(r0_3*r0_5) - 2.0*(r0_4*r0_6)))
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 4] = r0_15*k0
        w[jacobian + entry + 5] = -r0_14*k0
        w[jacobian + entry + 6] = 1.0
        w[jacobian + entry + 9] = r1_15*k2
        w[jacobian + entry + 10] = -r1_15*k1
        w[jacobian + entry + 11] = r1_14*k1 - r1_13*k2
        w[jacobian + entry + 13] = -1.0
        w[jacobian + entry + 16] = r0_18*k0
        w[jacobian + entry + 17] = -r0_17*k0
        w[jacobian + entry + 19] = 1.0
        w[jacobian + entry + 21] = r1_18*k2
        w[jacobian + entry + 22] = -r1_18*k1
        w[jacobian + entry + 23] = r1_17*k1 - r1_16*k2
        w[jacobian + entry + 26] = -1.0
        w[jacobian + entry + 28] = r0_21*k0
        w[jacobian + entry + 29] = -r0_20*k0
        w[jacobian + entry + 32] = 1.0
        w[jacobian + entry + 33] = r1_21*k2
        w[jacobian + entry + 34] = -r1_21*k1
        w[jacobian + entry + 35] = r1_20*k1 - r1_19*k2
        w[jacobian + entry + 39] = -(s35 + r0_18*r1_18 + r0_21*r1_21)
        w[jacobian + entry + 41] = s37
        w[jacobian + entry + 45] = r0_20*r1_20 - (r0_14*s36 - r0_17*r1_17)
        w[jacobian + entry + 46] = -(r0_14*r1_13 + r0_17*r1_16 + r0_20*r1_19)
        w[jacobian + entry + 52] = r1_18*(2.0*(r0_3*r0_4) - 2.0*(r0_5*r0_6)) - s35 + r1_21*(s33 - s34 - (s31 - s32))
        w[jacobian + entry + 53] = r0_14*r1_15 + r0_17*r1_18 + r0_20*r1_21
        w[jacobian + entry + 57] = r0_13*s36 - r0_16*r1_17 - r0_19*r1_20
        w[jacobian + entry + 58] = r0_13*r1_13 + r0_16*r1_16 + r0_19*r1_19
        w[gamma + row + 0] = r0_14*s3 - r0_13*s2 + r0_15*s4 - (r1_13*s9 + r1_14*s10 + r1_15*s11)
        w[gamma + row + 1] = r0_17*s3 - r0_16*s2 + r0_18*s4 - (r1_16*s9 + r1_17*s10 + r1_18*s11)
        w[gamma + row + 2] = r0_20*s3 - r0_19*s2 + r0_21*s4 - (r1_19*s9 + r1_20*s10 + r1_21*s11)
        w[gamma + row + 3] = s26 + s21*(2.0*(r0_10*r0_21 - r0_12*r0_19))
        w[gamma + row + 4] = -(s30 + s21*(2.0*(r0_12*r0_20 - r0_11*r0_21)))
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def full(t, y, p, w, T, at, out):
    """Phi, nu, D and gamma: 301 operations an instance."""
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
        c0 = T[here + 7]
        c1 = T[here + 8]
        c2 = T[here + 9]
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
        r1_0 = w[f1 + 0]
        r1_1 = w[f1 + 1]
        r1_2 = w[f1 + 2]
        r1_3 = w[f1 + 3]
        r1_4 = w[f1 + 4]
        r1_5 = w[f1 + 5]
        r1_6 = w[f1 + 6]
        r1_10 = w[f1 + 10]
        r1_11 = w[f1 + 11]
        r1_12 = w[f1 + 12]
        r1_13 = w[f1 + 13]
        r1_14 = w[f1 + 14]
        r1_15 = w[f1 + 15]
        r1_16 = w[f1 + 16]
        r1_17 = w[f1 + 17]
        r1_18 = w[f1 + 18]
        r1_19 = w[f1 + 19]
        r1_20 = w[f1 + 20]
        r1_21 = w[f1 + 21]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        s0 = r0_14*r1_15 + r0_17*r1_18 + r0_20*r1_21
        s1 = r0_16*r1_18
        s2 = r0_12*k0
        s3 = r0_11*k0
        s4 = r0_11*s3 + r0_12*s2
        s5 = r0_10*s3
        s6 = r0_10*s2
        s7 = r1_12*k2
        s8 = r1_12*k1
        s9 = r1_10*k2
        s10 = r1_11*k1
        s11 = r1_11*(s9 - s10) - r1_12*s8
        s12 = r1_10*(s10 - s9) - r1_12*s7
        s13 = r1_10*s8 + r1_11*s7
        s14 = r0_10*r0_11
        s15 = r0_12*r0_12
        s16 = s15 + r0_10*r0_10
        s17 = r0_11*r0_12
        s18 = r1_10*r1_12
        s19 = r1_11*r1_12
        s20 = r1_10*r1_10 + r1_11*r1_11
        s21 = r1_11*r1_13 - r1_10*r1_14
        s22 = r1_11*r1_16 - r1_10*r1_17
        s23 = r1_11*r1_19 - r1_10*r1_20
        s24 = r1_13*s18 + r1_14*s19 - r1_15*s20
        s25 = r1_16*s18 + r1_17*s19 - r1_18*s20
        s26 = r1_19*s18 + r1_20*s19 - r1_21*s20
        s27 = r0_14*s24 + r0_17*s25 + r0_20*s26 + r1_15*(r0_13*s14 - r0_14*s16 + r0_15*s17) + r1_18*(r0_16*s14 - r0_17*s16 + r0_18*s17)
        s28 = s27 + r1_21*(r0_19*s14 - r0_20*s16 + r0_21*s17) + s21*(2.0*(r0_10*r0_15 - r0_12*r0_13)) + s22*(2.0*(r0_10*r0_18 - r0_12*r0_16))
        s29 = s15 + r0_11*r0_11
        s30 = r0_10*r0_12
        s31 = r0_13*s24 + r0_16*s25 + r0_19*s26 + r1_15*(r0_14*s14 - r0_13*s29 + r0_15*s30) + r1_18*(r0_17*s14 - r0_16*s29 + r0_18*s30)
        s32 = s31 + r1_21*(r0_20*s14 - r0_19*s29 + r0_21*s30) + s21*(2.0*(r0_12*r0_14 - r0_11*r0_15)) + s22*(2.0*(r0_12*r0_17 - r0_11*r0_18))
        s33 = r0_3*r0_3
        s34 = r0_4*r0_4
        s35 = r0_5*r0_5
        s36 = r0_6*r0_6
        s37 = r0_15*r1_15
        s38 = 2.0*(r1_3*r1_6) - 2.0*(r1_4*r1_5)
        w[phi + row + 0] = r1_0 + r1_13*k1 + r1_14*k2 - (r0_0 + r0_13*k0)
        w[phi + row + 1] = r1_1 + r1_16*k1 + r1_17*k2 - (r0_1 + r0_16*k0)
        w[phi + row + 2] = r1_2 + r1_19*k1 + r1_20*k2 - (r0_2 + r0_19*k0)
        w[phi + row + 3] = -s0
        w[phi + row + 4] = s1 + r0_13*r1_15 + r0_19*r1_21
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 4] = r0_15*k0
        w[jacobian + entry + 5] = -r0_14*k0
        w[jacobian + entry + 6] = 1.0
        w[jacobian + entry + 9] = r1_15*k2
        w[jacobian + entry + 10] = -r1_15*k1
        w[jacobian + entry + 11] = r1_14*k1 - r1_13*k2
        w[jacobian + entry + 13] = -1.0
        w[jacobian + entry + 16] = r0_18*k0
        w[jacobian + entry + 17] = -r0_17*k0
        w[jacobian + entry + 19] = 1.0
        w[jacobian + entry + 21] = r1_18*k2
        w[jacobian + entry + 22] = -r1_18*k1
        w[jacobian + entry + 23] = r1_17*k1 - r1_16*k2
        w[jacobian + entry + 26] = -1.0
        w[jacobian + entry + 28] = r0_21*k0
        w[jacobian + entry + 29] = -r0_20*k0
        w[jacobian + entry + 32] = 1.0
        w[jacobian + entry + 33] = r1_21*k2
        w[jacobian + entry + 34] = -r1_21*k1
        w[jacobian + entry + 35] = r1_20*k1 - r1_19*k2
        w[jacobian + entry + 39] = -(s37 + r0_18*r1_18 + r0_21*r1_21)
        w[jacobian + entry + 41] = -(r1_15*(s35 + s36 - (s33 + s34)) - s1 + r1_21*(2.0*(r0_3*r0_5) - 2.0*(r0_4*r0_6)))
        w[jacobian + entry + 45] = r0_20*r1_20 - (r0_14*s38 - r0_17*r1_17)
        w[jacobian + entry + 46] = -(r0_14*r1_13 + r0_17*r1_16 + r0_20*r1_19)
        w[jacobian + entry + 52] = r1_18*(2.0*(r0_3*r0_4) - 2.0*(r0_5*r0_6)) - s37 + r1_21*(s35 - s36 - (s33 - s34))
        w[jacobian + entry + 53] = s0
        w[jacobian + entry + 57] = r0_13*s38 - r0_16*r1_17 - r0_19*r1_20
        w[jacobian + entry + 58] = r0_13*r1_13 + r0_16*r1_16 + r0_19*r1_19
        w[gamma + row + 0] = r0_14*s5 - r0_13*s4 + r0_15*s6 - (r1_13*s11 + r1_14*s12 + r1_15*s13)
        w[gamma + row + 1] = r0_17*s5 - r0_16*s4 + r0_18*s6 - (r1_16*s11 + r1_17*s12 + r1_18*s13)
        w[gamma + row + 2] = r0_20*s5 - r0_19*s4 + r0_21*s6 - (r1_19*s11 + r1_20*s12 + r1_21*s13)
        w[gamma + row + 3] = s28 + s23*(2.0*(r0_10*r0_21 - r0_12*r0_19))
        w[gamma + row + 4] = -(s32 + s23*(2.0*(r0_12*r0_20 - r0_11*r0_21)))
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def report(t, y, p, w, T, at, out):
    """joint coordinates and their rates: 107 operations an instance."""
    here = np.uint32(at + 1)
    m = np.int64(T[M])
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        coordinate = 2 * T[here + 4]
        u0 = T[here + 5]
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
        r1_3 = w[f1 + 3]
        r1_4 = w[f1 + 4]
        r1_5 = w[f1 + 5]
        r1_6 = w[f1 + 6]
        r1_11 = w[f1 + 11]
        r1_12 = w[f1 + 12]
        r1_13 = w[f1 + 13]
        r1_14 = w[f1 + 14]
        r1_15 = w[f1 + 15]
        r1_16 = w[f1 + 16]
        r1_17 = w[f1 + 17]
        r1_19 = w[f1 + 19]
        r1_20 = w[f1 + 20]
        winding_0 = w[19 + u0]
        s0 = r0_3*r0_3
        s1 = r0_4*r0_4
        s2 = r0_5*r0_5
        s3 = r0_6*r0_6
        s4 = r0_14*r1_13 + r0_17*r1_16 + r0_20*r1_19
        s5 = r0_16*r1_16
        s6 = r0_13*r1_13 + s5 + r0_19*r1_19
        s7 = r0_15*r1_13
        s8 = 2.0*(r1_3*r1_4) - 2.0*(r1_5*r1_6)
        s9 = r1_5*r1_5 - r1_6*r1_6 - (r1_3*r1_3 - r1_4*r1_4)
        s10 = s6*s6 + s4*s4
        s11 = s6/s10
        s12 = s4/s10
        s13 = (r1_13*(s2 + s3 - (s0 + s1)) - s5 + r1_19*(2.0*(r0_3*r0_5) - 2.0*(r0_4*r0_6)))*s11 - s4*s12
        s14 = (r0_20*r1_20 + r0_17*r1_17 + r0_14*r1_14)*s11 - (r0_19*r1_20 + r0_16*r1_17 + r0_13*r1_14)*s12
        s15 = math.atan2(s4, s6)
        s16 = r0_10*((s7 + r0_18*r1_16 + r0_21*r1_19)*s11) - r0_11*((r1_16*(2.0*(r0_3*r0_4) - 2.0*(r0_5*r0_6)) - s7 + r1_19*(s2 - s3 - (s0 - s1)))*s12)
        s17 = s16 + r0_12*s13 + r1_11*((r0_17*s8 - r0_14*r1_15 + r0_20*s9)*s11 - (r0_16*s8 - r0_13*r1_15 + r0_19*s9)*s12)
        out[m + coordinate + 0] = s15 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s15))
        out[m + coordinate + 1] = s17 + r1_12*s14
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def wind(t, y, p, w, T, at, out):
    """angles whose turns are counted: 17 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        u0 = T[here + 5]
        r0_13 = w[f0 + 13]
        r0_14 = w[f0 + 14]
        r0_16 = w[f0 + 16]
        r0_17 = w[f0 + 17]
        r0_19 = w[f0 + 19]
        r0_20 = w[f0 + 20]
        r1_13 = w[f1 + 13]
        r1_16 = w[f1 + 16]
        r1_19 = w[f1 + 19]
        winding_0 = w[19 + u0]
        s0 = math.atan2(r0_14*r1_13 + r0_17*r1_16 + r0_20*r1_19, r0_13*r1_13 + r0_16*r1_16 + r0_19*r1_19)
        w[19 + u0] = s0 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s0))
        here = np.uint32(here + 10)
    return 0
