"""Kernel `form_d622633c_body_body_f715eb486c2b480a` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
What a body of kind body adds to a descriptor form.
Functions go through all instances, whose table begins at `at`: how many, then 10 numbers each.
"""

import numpy as np
from numba import njit

from .machine import NQ, RECORDS, STAGE


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, p, w, T, at, out):
    """its part of F(t, y, k) of the descriptor form, and of the power: 50 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    records = np.int64(T[RECORDS])
    stage = np.int64(T[STAGE])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        q0 = T[here + 1]
        v0 = T[here + 2]
        c0 = T[here + 5]
        c1 = T[here + 6]
        c2 = T[here + 7]
        c3 = T[here + 8]
        c4 = T[here + 9]
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
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        k3 = p[c3]
        k4 = p[c4]
        k_q0 = w[stage + q0 + 0]
        k_q1 = w[stage + q0 + 1]
        k_q2 = w[stage + q0 + 2]
        k_q3 = w[stage + q0 + 3]
        k_q4 = w[stage + q0 + 4]
        k_q5 = w[stage + q0 + 5]
        k_q6 = w[stage + q0 + 6]
        k_v0 = w[stage + nq + v0 + 0]
        k_v1 = w[stage + nq + v0 + 1]
        k_v2 = w[stage + nq + v0 + 2]
        k_v3 = w[stage + nq + v0 + 3]
        k_v4 = w[stage + nq + v0 + 4]
        k_v5 = w[stage + nq + v0 + 5]
        s0 = 0.5*r0_10
        s1 = 0.5*r0_11
        s2 = 0.5*r0_12
        out[q0 + 0] += k_q0 - r0_7
        out[q0 + 1] += k_q1 - r0_8
        out[q0 + 2] += k_q2 - r0_9
        out[q0 + 3] += r0_4*s0 + r0_5*s1 + r0_6*s2 + k_q3
        out[q0 + 4] += k_q4 - (r0_3*s0 + r0_5*s2 - r0_6*s1)
        out[q0 + 5] += k_q5 - (r0_3*s1 + r0_6*s0 - r0_4*s2)
        out[q0 + 6] += k_q6 - (r0_3*s2 + r0_4*s1 - r0_5*s0)
        out[nq + v0 + 0] += k0*k_v0
        out[nq + v0 + 1] += k0*k_v1 - k0*k4
        out[nq + v0 + 2] += k0*k_v2
        out[nq + v0 + 3] += (k3 - k2)*(r0_11*r0_12) + k1*k_v3
        out[nq + v0 + 4] += (k1 - k3)*(r0_10*r0_12) + k2*k_v4
        out[nq + v0 + 5] += (k2 - k1)*(r0_10*r0_11) + k3*k_v5
        here = np.uint32(here + 10)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, p, w, T, at, out):
    """its entries of dF/dk and dF/dy: 23 operations an instance."""
    here = np.uint32(at + 1)
    records = np.int64(T[RECORDS])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        entry = T[here + 4]
        c0 = T[here + 5]
        c1 = T[here + 6]
        c2 = T[here + 7]
        c3 = T[here + 8]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_10 = w[f0 + 10]
        r0_11 = w[f0 + 11]
        r0_12 = w[f0 + 12]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        k3 = p[c3]
        s0 = k3 - k2
        s1 = k1 - k3
        s2 = k2 - k1
        s3 = 0.5*r0_10
        s4 = 0.5*r0_11
        s5 = 0.5*r0_12
        s6 = 0.5*r0_4
        s7 = 0.5*r0_5
        s8 = 0.5*r0_6
        s9 = -s4
        s10 = -s5
        s11 = -s3
        s12 = -0.5*r0_3
        out[entry + 0] = 1.0
        out[entry + 1] = -1.0
        out[entry + 2] = 1.0
        out[entry + 3] = -1.0
        out[entry + 4] = 1.0
        out[entry + 5] = -1.0
        out[entry + 6] = 1.0
        out[entry + 7] = s3
        out[entry + 8] = s4
        out[entry + 9] = s5
        out[entry + 10] = s6
        out[entry + 11] = s7
        out[entry + 12] = s8
        out[entry + 13] = 1.0
        out[entry + 14] = s11
        out[entry + 15] = s10
        out[entry + 16] = s4
        out[entry + 17] = s12
        out[entry + 18] = s8
        out[entry + 19] = -s7
        out[entry + 20] = 1.0
        out[entry + 21] = s9
        out[entry + 22] = s5
        out[entry + 23] = s11
        out[entry + 24] = -s8
        out[entry + 25] = s12
        out[entry + 26] = s6
        out[entry + 27] = 1.0
        out[entry + 28] = s10
        out[entry + 29] = s9
        out[entry + 30] = s3
        out[entry + 31] = s7
        out[entry + 32] = -s6
        out[entry + 33] = s12
        out[entry + 34] = k0
        out[entry + 35] = k0
        out[entry + 36] = k0
        out[entry + 37] = k1
        out[entry + 38] = r0_12*s0
        out[entry + 39] = r0_11*s0
        out[entry + 40] = k2
        out[entry + 41] = r0_12*s1
        out[entry + 42] = r0_10*s1
        out[entry + 43] = k3
        out[entry + 44] = r0_11*s2
        out[entry + 45] = r0_10*s2
        here = np.uint32(here + 10)
    return 0
