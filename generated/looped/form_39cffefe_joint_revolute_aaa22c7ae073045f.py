"""Kernel `form_39cffefe_joint_revolute_aaa22c7ae073045f` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
What a joint of kind revolute adds to a descriptor form.
Functions go through all instances, whose table begins at `at`: how many, then 10 numbers each.
"""

import numpy as np
from numba import njit

from .machine import M, NQ, NV, RECORDS, STAGE


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, p, w, T, at, out):
    """its part of F(t, y, k) of the descriptor form, and of the power: 36 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    records = np.int64(T[RECORDS])
    stage = np.int64(T[STAGE])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        q0 = T[here + 2]
        q1 = T[here + 3]
        v0 = T[here + 4]
        v1 = T[here + 5]
        row = T[here + 6]
        c0 = T[here + 8]
        c1 = T[here + 9]
        r0_0 = w[f0 + 0]
        r0_1 = w[f0 + 1]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        r1_0 = w[f1 + 0]
        r1_1 = w[f1 + 1]
        r1_3 = w[f1 + 3]
        r1_4 = w[f1 + 4]
        r1_5 = w[f1 + 5]
        r1_6 = w[f1 + 6]
        r1_7 = w[f1 + 7]
        k0 = p[c0]
        k1 = p[c1]
        k_first0 = w[stage + nq + nv + row + 0]
        k_first1 = w[stage + nq + nv + row + 1]
        k_second0 = w[stage + nq + nv + m + row + 0]
        k_second1 = w[stage + nq + nv + m + row + 1]
        s0 = r1_6*k1
        s1 = r0_6*k0
        s2 = r1_7*k1
        s3 = r0_7*k0
        out[nq + nv + row + 0] += r1_3 + r0_5*s3 - r0_3 - r1_5*s2
        out[nq + nv + row + 1] += r1_4 - (r0_4 + r0_5*s1) + r1_5*s0
        out[nq + nv + m + row + 0] += r1_0 - r0_0 + s0 - s1
        out[nq + nv + m + row + 1] += r1_1 - r0_1 + s2 - s3
        out[nq + v0 + 0] += -k_first0
        out[nq + v0 + 1] += -k_first1
        out[nq + v0 + 2] += s3*k_first0 - s1*k_first1
        out[nq + v1 + 0] += k_first0
        out[nq + v1 + 1] += k_first1
        out[nq + v1 + 2] += s0*k_first1 - s2*k_first0
        out[q0 + 0] += -k_second0
        out[q0 + 1] += -k_second1
        out[q0 + 2] += s3*k_second0 - s1*k_second1
        out[q1 + 0] += k_second0
        out[q1 + 1] += k_second1
        out[q1 + 2] += s0*k_second1 - s2*k_second0
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, p, w, T, at, out):
    """its entries of dF/dk and dF/dy: 26 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    records = np.int64(T[RECORDS])
    stage = np.int64(T[STAGE])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        row = T[here + 6]
        entry = T[here + 7]
        c0 = T[here + 8]
        c1 = T[here + 9]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        r1_5 = w[f1 + 5]
        r1_6 = w[f1 + 6]
        r1_7 = w[f1 + 7]
        k0 = p[c0]
        k1 = p[c1]
        k_first0 = w[stage + nq + nv + row + 0]
        k_first1 = w[stage + nq + nv + row + 1]
        k_second0 = w[stage + nq + nv + m + row + 0]
        k_second1 = w[stage + nq + nv + m + row + 1]
        s0 = r1_6*k1
        s1 = r0_6*k0
        s2 = r1_7*k1
        s3 = r0_7*k0
        s4 = -s2
        s5 = -s1
        out[entry + 0] = r0_5*s1
        out[entry + 1] = -r1_5*s0
        out[entry + 2] = -1.0
        out[entry + 3] = s3
        out[entry + 4] = 1.0
        out[entry + 5] = s4
        out[entry + 6] = r0_5*s3
        out[entry + 7] = -r1_5*s2
        out[entry + 8] = -1.0
        out[entry + 9] = s5
        out[entry + 10] = 1.0
        out[entry + 11] = s0
        out[entry + 12] = -1.0
        out[entry + 13] = s3
        out[entry + 14] = 1.0
        out[entry + 15] = s4
        out[entry + 16] = -1.0
        out[entry + 17] = s5
        out[entry + 18] = 1.0
        out[entry + 19] = s0
        out[entry + 20] = -1.0
        out[entry + 21] = -1.0
        out[entry + 22] = s3
        out[entry + 23] = s5
        out[entry + 24] = s1*k_first0 + s3*k_first1
        out[entry + 25] = 1.0
        out[entry + 26] = 1.0
        out[entry + 27] = s4
        out[entry + 28] = s0
        out[entry + 29] = -(s0*k_first0 + s2*k_first1)
        out[entry + 30] = -1.0
        out[entry + 31] = -1.0
        out[entry + 32] = s3
        out[entry + 33] = s5
        out[entry + 34] = s1*k_second0 + s3*k_second1
        out[entry + 35] = 1.0
        out[entry + 36] = 1.0
        out[entry + 37] = s4
        out[entry + 38] = s0
        out[entry + 39] = -(s0*k_second0 + s2*k_second1)
        here = np.uint32(here + 10)
    return 0
