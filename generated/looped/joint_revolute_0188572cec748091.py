"""Kernel `joint_revolute_0188572cec748091` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
A joint of kind revolute over 2 frames, 4 constants, 0 numbers computed once a run.
Functions go through all instances, whose table begins at `at`: how many, then 11 numbers each.
"""

import math

import numpy as np
from numba import njit

from .machine import GAMMA, JACOBIAN, M, PHI, RECORDS, RESIDUAL


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w, T, at, out):
    """Phi, nu and D: 139 operations an instance."""
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
        c3 = T[here + 10]
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
        k3 = p[c3]
        s0 = r0_13*r1_14 + r0_16*r1_17 + r0_19*r1_20
        s1 = r0_15*r1_14
        s2 = r1_17*(2.0*(r0_3*r0_4) - 2.0*(r0_5*r0_6)) - s1 + r1_20*(r0_5*r0_5 - r0_6*r0_6 - (r0_3*r0_3 - r0_4*r0_4))
        s3 = r0_17*r1_17
        s4 = r0_20*r1_20
        s5 = r1_5*r1_5 + r1_6*r1_6 - (r1_3*r1_3 + r1_4*r1_4)
        s6 = 2.0*(r1_3*r1_5) - 2.0*(r1_4*r1_6)
        w[residual + row + 0] = r1_0 + r1_13*k3 - (r0_0 + r0_13*k0 + r0_14*k1 + r0_15*k2)
        w[residual + row + 1] = r1_1 + r1_16*k3 - (r0_1 + r0_16*k0 + r0_17*k1 + r0_18*k2)
        w[residual + row + 2] = r1_2 + r1_19*k3 - (r0_2 + r0_19*k0 + r0_20*k1 + r0_21*k2)
        w[residual + row + 3] = -s0
        w[residual + row + 4] = s1 + r0_18*r1_17 + r0_21*r1_20
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 3] = r0_14*k2 - r0_15*k1
        w[jacobian + entry + 4] = r0_15*k0 - r0_13*k2
        w[jacobian + entry + 5] = r0_13*k1 - r0_14*k0
        w[jacobian + entry + 6] = 1.0
        w[jacobian + entry + 10] = -r1_15*k3
        w[jacobian + entry + 11] = r1_14*k3
        w[jacobian + entry + 13] = -1.0
        w[jacobian + entry + 15] = r0_17*k2 - r0_18*k1
        w[jacobian + entry + 16] = r0_18*k0 - r0_16*k2
        w[jacobian + entry + 17] = r0_16*k1 - r0_17*k0
        w[jacobian + entry + 19] = 1.0
        w[jacobian + entry + 22] = -r1_18*k3
        w[jacobian + entry + 23] = r1_17*k3
        w[jacobian + entry + 26] = -1.0
        w[jacobian + entry + 27] = r0_20*k2 - r0_21*k1
        w[jacobian + entry + 28] = r0_21*k0 - r0_19*k2
        w[jacobian + entry + 29] = r0_19*k1 - r0_20*k0
        w[jacobian + entry + 32] = 1.0
        w[jacobian + entry + 34] = -r1_21*k3
        w[jacobian + entry + 35] = r1_20*k3
        w[jacobian + entry + 40] = -s2
        w[jacobian + entry + 41] = -(r0_14*r1_14 + s3 + s4)
        w[jacobian + entry + 45] = -(r0_13*r1_15 + r0_16*r1_18 + r0_19*r1_21)
        w[jacobian + entry + 47] = -(r0_13*s5 - r0_16*r1_16 + r0_19*s6)
        w[jacobian + entry + 51] = r1_14*(2.0*(r0_3*r0_6) - 2.0*(r0_4*r0_5)) - s3 - s4
        w[jacobian + entry + 52] = s0
        w[jacobian + entry + 57] = r0_15*r1_15 + r0_18*r1_18 + r0_21*r1_21
        w[jacobian + entry + 59] = r0_15*s5 - r0_18*r1_16 + r0_21*s6
        here = np.uint32(here + 11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def motion(t, y, p, w, T, at, out):
    """nu, D and gamma: 294 operations an instance."""
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
        c3 = T[here + 10]
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
        k3 = p[c3]
        s0 = r0_11*k2
        s1 = r0_12*k1
        s2 = r0_12*k0
        s3 = r0_10*k2
        s4 = r0_10*k1
        s5 = r0_11*k0
        s6 = r0_11*(s4 - s5) + r0_12*(s3 - s2)
        s7 = r0_12*(s0 - s1) + r0_10*(s5 - s4)
        s8 = r0_10*(s2 - s3) + r0_11*(s1 - s0)
        s9 = r1_12*k3
        s10 = r1_11*k3
        s11 = r1_11*s10 + r1_12*s9
        s12 = r1_10*s10
        s13 = r1_10*s9
        s14 = r0_11*r0_11
        s15 = s14 + r0_12*r0_12
        s16 = r0_10*r0_11
        s17 = r0_10*r0_12
        s18 = r1_10*r1_11
        s19 = r1_12*r1_12 + r1_10*r1_10
        s20 = r1_11*r1_12
        s21 = r1_10*r1_15 - r1_12*r1_13
        s22 = r1_10*r1_18 - r1_12*r1_16
        s23 = r1_10*r1_21 - r1_12*r1_19
        s24 = r1_13*s18 - r1_14*s19 + r1_15*s20
        s25 = r1_16*s18 - r1_17*s19 + r1_18*s20
        s26 = r1_19*s18 - r1_20*s19 + r1_21*s20
        s27 = r0_13*s24 + r0_16*s25 + r0_19*s26 + r1_14*(r0_14*s16 - r0_13*s15 + r0_15*s17) + r1_17*(r0_17*s16 - r0_16*s15 + r0_18*s17)
        s28 = s27 + r1_20*(r0_20*s16 - r0_19*s15 + r0_21*s17) + s21*(2.0*(r0_12*r0_14 - r0_11*r0_15)) + s22*(2.0*(r0_12*r0_17 - r0_11*r0_18))
        s29 = r0_11*r0_12
        s30 = s14 + r0_10*r0_10
        s31 = r0_15*s24 + r0_18*s25 + r0_21*s26 + r1_14*(r0_13*s17 + r0_14*s29 - r0_15*s30) + r1_17*(r0_16*s17 + r0_17*s29 - r0_18*s30)
        s32 = s31 + r1_20*(r0_19*s17 + r0_20*s29 - r0_21*s30) + s21*(2.0*(r0_11*r0_13 - r0_10*r0_14)) + s22*(2.0*(r0_11*r0_16 - r0_10*r0_17))
        s33 = r1_17*(2.0*(r0_3*r0_4) - 2.0*(r0_5*r0_6)) - r0_15*r1_14 + r1_20*(r0_5*r0_5 - r0_6*r0_6 - (r0_3*r0_3 - r0_4*r0_4))
        s34 = r0_17*r1_17
        s35 = r0_20*r1_20
        s36 = r1_5*r1_5 + r1_6*r1_6 - (r1_3*r1_3 + r1_4*r1_4)
        s37 = 2.0*(r1_3*r1_5) - 2.0*(r1_4*r1_6)
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 3] = r0_14*k2 - r0_15*k1
        w[jacobian + entry + 4] = r0_15*k0 - r0_13*k2
        w[jacobian + entry + 5] = r0_13*k1 - r0_14*k0
        w[jacobian + entry + 6] = 1.0
        w[jacobian + entry + 10] = -r1_15*k3
        w[jacobian + entry + 11] = r1_14*k3
        w[jacobian + entry + 13] = -1.0
        w[jacobian + entry + 15] = r0_17*k2 - r0_18*k1
        w[jacobian + entry + 16] = r0_18*k0 - r0_16*k2
        w[jacobian + entry + 17] = r0_16*k1 - r0_17*k0
        w[jacobian + entry + 19] = 1.0
        w[jacobian + entry + 22] = -r1_18*k3
        w[jacobian + entry + 23] = r1_17*k3
        w[jacobian + entry + 26] = -1.0
        w[jacobian + entry + 27] = r0_20*k2 - r0_21*k1
        w[jacobian + entry + 28] = r0_21*k0 - r0_19*k2
        w[jacobian + entry + 29] = r0_19*k1 - r0_20*k0
        w[jacobian + entry + 32] = 1.0
        w[jacobian + entry + 34] = -r1_21*k3
        w[jacobian + entry + 35] = r1_20*k3
        w[jacobian + entry + 40] = -s33
        w[jacobian + entry + 41] = -(r0_14*r1_14 + s34 + s35)
        w[jacobian + entry + 45] = -(r0_13*r1_15 + r0_16*r1_18 + r0_19*r1_21)
        w[jacobian + entry + 47] = -(r0_13*s36 - r0_16*r1_16 + r0_19*s37)
        w[jacobian + entry + 51] = r1_14*(2.0*(r0_3*r0_6) - 2.0*(r0_4*r0_5)) - s34 - s35
        w[jacobian + entry + 52] = r0_13*r1_14 + r0_16*r1_17 + r0_19*r1_20
        w[jacobian + entry + 57] = r0_15*r1_15 + r0_18*r1_18 + r0_21*r1_21
        w[jacobian + entry + 59] = r0_15*s36 - r0_18*r1_16 + r0_21*s37
        w[gamma + row + 0] = r0_13*s6 + r0_14*s7 + r0_15*s8 - (r1_14*s12 - r1_13*s11 + r1_15*s13)
        w[gamma + row + 1] = r0_16*s6 + r0_17*s7 + r0_18*s8 - (r1_17*s12 - r1_16*s11 + r1_18*s13)
        w[gamma + row + 2] = r0_19*s6 + r0_20*s7 + r0_21*s8 - (r1_20*s12 - r1_19*s11 + r1_21*s13)
        w[gamma + row + 3] = s28 + s23*(2.0*(r0_12*r0_20 - r0_11*r0_21))
        w[gamma + row + 4] = -(s32 + s23*(2.0*(r0_11*r0_19 - r0_10*r0_20)))
        here = np.uint32(here + 11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def full(t, y, p, w, T, at, out):
    """Phi, nu, D and gamma: 326 operations an instance."""
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
        c3 = T[here + 10]
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
        k3 = p[c3]
        s0 = r0_13*r1_14 + r0_16*r1_17 + r0_19*r1_20
        s1 = r0_15*r1_14
        s2 = r0_11*k2
        s3 = r0_12*k1
        s4 = r0_12*k0
        s5 = r0_10*k2
        s6 = r0_10*k1
        s7 = r0_11*k0
        s8 = r0_11*(s6 - s7) + r0_12*(s5 - s4)
        s9 = r0_12*(s2 - s3) + r0_10*(s7 - s6)
        s10 = r0_10*(s4 - s5) + r0_11*(s3 - s2)
        s11 = r1_12*k3
        s12 = r1_11*k3
        s13 = r1_11*s12 + r1_12*s11
        s14 = r1_10*s12
        s15 = r1_10*s11
        s16 = r0_11*r0_11
        s17 = s16 + r0_12*r0_12
        s18 = r0_10*r0_11
        s19 = r0_10*r0_12
        s20 = r1_10*r1_11
        s21 = r1_12*r1_12 + r1_10*r1_10
        s22 = r1_11*r1_12
        s23 = r1_10*r1_15 - r1_12*r1_13
        s24 = r1_10*r1_18 - r1_12*r1_16
        s25 = r1_10*r1_21 - r1_12*r1_19
        s26 = r1_13*s20 - r1_14*s21 + r1_15*s22
        s27 = r1_16*s20 - r1_17*s21 + r1_18*s22
        s28 = r1_19*s20 - r1_20*s21 + r1_21*s22
        s29 = r0_13*s26 + r0_16*s27 + r0_19*s28 + r1_14*(r0_14*s18 - r0_13*s17 + r0_15*s19) + r1_17*(r0_17*s18 - r0_16*s17 + r0_18*s19)
        s30 = s29 + r1_20*(r0_20*s18 - r0_19*s17 + r0_21*s19) + s23*(2.0*(r0_12*r0_14 - r0_11*r0_15)) + s24*(2.0*(r0_12*r0_17 - r0_11*r0_18))
        s31 = r0_11*r0_12
        s32 = s16 + r0_10*r0_10
        s33 = r0_15*s26 + r0_18*s27 + r0_21*s28 + r1_14*(r0_13*s19 + r0_14*s31 - r0_15*s32) + r1_17*(r0_16*s19 + r0_17*s31 - r0_18*s32)
        s34 = s33 + r1_20*(r0_19*s19 + r0_20*s31 - r0_21*s32) + s23*(2.0*(r0_11*r0_13 - r0_10*r0_14)) + s24*(2.0*(r0_11*r0_16 - r0_10*r0_17))
        s35 = r1_17*(2.0*(r0_3*r0_4) - 2.0*(r0_5*r0_6)) - s1 + r1_20*(r0_5*r0_5 - r0_6*r0_6 - (r0_3*r0_3 - r0_4*r0_4))
        s36 = r0_17*r1_17
        s37 = r0_20*r1_20
        s38 = r1_5*r1_5 + r1_6*r1_6 - (r1_3*r1_3 + r1_4*r1_4)
        s39 = 2.0*(r1_3*r1_5) - 2.0*(r1_4*r1_6)
        w[phi + row + 0] = r1_0 + r1_13*k3 - (r0_0 + r0_13*k0 + r0_14*k1 + r0_15*k2)
        w[phi + row + 1] = r1_1 + r1_16*k3 - (r0_1 + r0_16*k0 + r0_17*k1 + r0_18*k2)
        w[phi + row + 2] = r1_2 + r1_19*k3 - (r0_2 + r0_19*k0 + r0_20*k1 + r0_21*k2)
        w[phi + row + 3] = -s0
        w[phi + row + 4] = s1 + r0_18*r1_17 + r0_21*r1_20
        w[jacobian + entry + 0] = -1.0
        w[jacobian + entry + 3] = r0_14*k2 - r0_15*k1
        w[jacobian + entry + 4] = r0_15*k0 - r0_13*k2
        w[jacobian + entry + 5] = r0_13*k1 - r0_14*k0
        w[jacobian + entry + 6] = 1.0
        w[jacobian + entry + 10] = -r1_15*k3
        w[jacobian + entry + 11] = r1_14*k3
        w[jacobian + entry + 13] = -1.0
        w[jacobian + entry + 15] = r0_17*k2 - r0_18*k1
        w[jacobian + entry + 16] = r0_18*k0 - r0_16*k2
        w[jacobian + entry + 17] = r0_16*k1 - r0_17*k0
        w[jacobian + entry + 19] = 1.0
        w[jacobian + entry + 22] = -r1_18*k3
        w[jacobian + entry + 23] = r1_17*k3
        w[jacobian + entry + 26] = -1.0
        w[jacobian + entry + 27] = r0_20*k2 - r0_21*k1
        w[jacobian + entry + 28] = r0_21*k0 - r0_19*k2
        w[jacobian + entry + 29] = r0_19*k1 - r0_20*k0
        w[jacobian + entry + 32] = 1.0
        w[jacobian + entry + 34] = -r1_21*k3
        w[jacobian + entry + 35] = r1_20*k3
        w[jacobian + entry + 40] = -s35
        w[jacobian + entry + 41] = -(r0_14*r1_14 + s36 + s37)
        w[jacobian + entry + 45] = -(r0_13*r1_15 + r0_16*r1_18 + r0_19*r1_21)
        w[jacobian + entry + 47] = -(r0_13*s38 - r0_16*r1_16 + r0_19*s39)
        w[jacobian + entry + 51] = r1_14*(2.0*(r0_3*r0_6) - 2.0*(r0_4*r0_5)) - s36 - s37
        w[jacobian + entry + 52] = s0
        w[jacobian + entry + 57] = r0_15*r1_15 + r0_18*r1_18 + r0_21*r1_21
        w[jacobian + entry + 59] = r0_15*s38 - r0_18*r1_16 + r0_21*s39
        w[gamma + row + 0] = r0_13*s8 + r0_14*s9 + r0_15*s10 - (r1_14*s14 - r1_13*s13 + r1_15*s15)
        w[gamma + row + 1] = r0_16*s8 + r0_17*s9 + r0_18*s10 - (r1_17*s14 - r1_16*s13 + r1_18*s15)
        w[gamma + row + 2] = r0_19*s8 + r0_20*s9 + r0_21*s10 - (r1_20*s14 - r1_19*s13 + r1_21*s15)
        w[gamma + row + 3] = s30 + s25*(2.0*(r0_12*r0_20 - r0_11*r0_21))
        w[gamma + row + 4] = -(s34 + s25*(2.0*(r0_11*r0_19 - r0_10*r0_20)))
        here = np.uint32(here + 11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def report(t, y, p, w, T, at, out):
    """joint coordinates and their rates: 96 operations an instance."""
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
        r1_10 = w[f1 + 10]
        r1_11 = w[f1 + 11]
        r1_13 = w[f1 + 13]
        r1_15 = w[f1 + 15]
        r1_16 = w[f1 + 16]
        r1_17 = w[f1 + 17]
        r1_18 = w[f1 + 18]
        r1_19 = w[f1 + 19]
        r1_20 = w[f1 + 20]
        r1_21 = w[f1 + 21]
        winding_0 = w[19 + u0]
        s0 = r0_13*r1_15 + r0_16*r1_18 + r0_19*r1_21
        s1 = r0_15*r1_15
        s2 = s1 + r0_18*r1_18 + r0_21*r1_21
        s3 = r1_18*(2.0*(r0_3*r0_4) - 2.0*(r0_5*r0_6)) - s1 + r1_21*(r0_5*r0_5 - r0_6*r0_6 - (r0_3*r0_3 - r0_4*r0_4))
        s4 = r0_17*r1_18
        s5 = r0_20*r1_21
        s6 = 2.0*(r1_3*r1_6) - 2.0*(r1_4*r1_5)
        s7 = s2*s2 + s0*s0
        s8 = s2/s7
        s9 = s0/s7
        s10 = (r0_16*r1_16 + r0_13*r1_13 + r0_19*r1_19)*s8 - (r0_18*r1_16 + r0_15*r1_13 + r0_21*r1_19)*s9
        s11 = math.atan2(s0, s2)
        s12 = r0_11*(s3*s8 - s0*s9) - r0_10*((r1_15*(2.0*(r0_3*r0_6) - 2.0*(r0_4*r0_5)) - s4 - s5)*s9) + r0_12*((r0_14*r1_15 + s4 + s5)*s8)
        s13 = r1_10*((r0_13*s6 - r0_16*r1_17 - r0_19*r1_20)*s8 - (r0_15*s6 - r0_18*r1_17 - r0_21*r1_20)*s9)
        out[m + coordinate + 0] = s11 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s11))
        out[m + coordinate + 1] = s12 + s13 + r1_11*s10
        here = np.uint32(here + 11)
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
        r0_15 = w[f0 + 15]
        r0_16 = w[f0 + 16]
        r0_18 = w[f0 + 18]
        r0_19 = w[f0 + 19]
        r0_21 = w[f0 + 21]
        r1_15 = w[f1 + 15]
        r1_18 = w[f1 + 18]
        r1_21 = w[f1 + 21]
        winding_0 = w[19 + u0]
        s0 = math.atan2(r0_13*r1_15 + r0_16*r1_18 + r0_19*r1_21, r0_15*r1_15 + r0_18*r1_18 + r0_21*r1_21)
        w[19 + u0] = s0 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s0))
        here = np.uint32(here + 11)
    return 0
