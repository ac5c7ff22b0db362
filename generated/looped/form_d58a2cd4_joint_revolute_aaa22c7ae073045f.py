"""Kernel `form_d58a2cd4_joint_revolute_aaa22c7ae073045f` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
What a joint of kind revolute adds to a descriptor form.
Functions go through all instances, whose table begins at `at`: how many, then 10 numbers each.
"""

import numpy as np
from numba import njit

from .machine import METHOD_PARAMETERS, NQ, NV, RECORDS, STAGE


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, p, w, T, at, out):
    """its part of F(t, y, k) of the descriptor form, and of the power: 66 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    records = np.int64(T[RECORDS])
    stage = np.int64(T[STAGE])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
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
        option0 = p[method_parameters + 0]
        option1 = p[method_parameters + 1]
        option2 = p[method_parameters + 2]
        k_v0 = w[stage + nq + v0 + 0]
        k_v1 = w[stage + nq + v0 + 1]
        k_v2 = w[stage + nq + v0 + 2]
        k_v3 = w[stage + nq + v1 + 0]
        k_v4 = w[stage + nq + v1 + 1]
        k_v5 = w[stage + nq + v1 + 2]
        k_first0 = w[stage + nq + nv + row + 0]
        k_first1 = w[stage + nq + nv + row + 1]
        s0 = r1_6*k1
        s1 = r0_6*k0
        s2 = r1_7*k1
        s3 = r0_7*k0
        s4 = k0*(r0_5*r0_5)
        s5 = k1*(r1_5*r1_5)
        s6 = 2.0*(option1*option2)
        s7 = option1*option1
        s8 = 1.0/option0
        s9 = k_v3 + s3*k_v2 - k_v0 - s2*k_v5 - (r1_6*s5 - r0_6*s4 - (r1_3 + r0_5*s3 - r0_3 - r1_5*s2)*s6 - (r1_0 - r0_0 + s0 - s1)*s7)
        s10 = k_v4 - (k_v1 + s1*k_v2) + s0*k_v5 - (r1_7*s5 - r0_7*s4 - (r1_4 - (r0_4 + r0_5*s1) + r1_5*s0)*s6 - (r1_1 - r0_1 + s2 - s3)*s7)
        out[nq + nv + row + 0] += s9 - s8*k_first0
        out[nq + nv + row + 1] += s10 - s8*k_first1
        out[nq + v0 + 0] += -k_first0
        out[nq + v0 + 1] += -k_first1
        out[nq + v0 + 2] += s3*k_first0 - s1*k_first1
        out[nq + v1 + 0] += k_first0
        out[nq + v1 + 1] += k_first1
        out[nq + v1 + 2] += s0*k_first1 - s2*k_first0
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, p, w, T, at, out):
    """its entries of dF/dk and dF/dy: 74 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    records = np.int64(T[RECORDS])
    stage = np.int64(T[STAGE])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        f1 = records + T[here + 1]
        v0 = T[here + 4]
        v1 = T[here + 5]
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
        option0 = p[method_parameters + 0]
        option1 = p[method_parameters + 1]
        option2 = p[method_parameters + 2]
        k_v2 = w[stage + nq + v0 + 2]
        k_v5 = w[stage + nq + v1 + 2]
        k_first0 = w[stage + nq + nv + row + 0]
        k_first1 = w[stage + nq + nv + row + 1]
        s0 = r1_6*k1
        s1 = r0_6*k0
        s2 = r1_7*k1
        s3 = r0_7*k0
        s4 = -s2
        s5 = k0*(r0_5*r0_5)
        s6 = k1*(r1_5*r1_5)
        s7 = -s1
        s8 = 2.0*(option1*option2)
        s9 = option1*option1
        s10 = k0*(r0_5 + r0_5)
        s11 = k1*(r1_5 + r1_5)
        s12 = -s8
        s13 = -s9
        s14 = -1.0/option0
        out[entry + 0] = s14
        out[entry + 1] = -1.0
        out[entry + 2] = s3
        out[entry + 3] = 1.0
        out[entry + 4] = s4
        out[entry + 5] = s13
        out[entry + 6] = s1*k_v2 + s3*s9 - (r0_7*s5 - r0_5*s1*s8)
        out[entry + 7] = s9
        out[entry + 8] = -(s0*k_v5 + r1_5*s0*s8 - r1_7*s6 + s2*s9)
        out[entry + 9] = s12
        out[entry + 10] = r0_6*s10 + s3*s8
        out[entry + 11] = s8
        out[entry + 12] = -(r1_6*s11 + s2*s8)
        out[entry + 13] = s14
        out[entry + 14] = -1.0
        out[entry + 15] = s7
        out[entry + 16] = 1.0
        out[entry + 17] = s0
        out[entry + 18] = s13
        out[entry + 19] = s3*k_v2 + r0_6*s5 + r0_5*s3*s8 - s1*s9
        out[entry + 20] = s9
        out[entry + 21] = s0*s9 - (r1_6*s6 + r1_5*s2*s8) - s2*k_v5
        out[entry + 22] = s12
        out[entry + 23] = r0_7*s10 - s1*s8
        out[entry + 24] = s8
        out[entry + 25] = s0*s8 - r1_7*s11
        out[entry + 26] = -1.0
        out[entry + 27] = -1.0
        out[entry + 28] = s3
        out[entry + 29] = s7
        out[entry + 30] = s1*k_first0 + s3*k_first1
        out[entry + 31] = 1.0
        out[entry + 32] = 1.0
        out[entry + 33] = s4
        out[entry + 34] = s0
        out[entry + 35] = -(s0*k_first0 + s2*k_first1)
        here = np.uint32(here + 10)
    return 0
