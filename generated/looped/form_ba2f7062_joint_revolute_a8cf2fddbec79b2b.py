"""Kernel `form_ba2f7062_joint_revolute_a8cf2fddbec79b2b` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
What a joint of kind revolute adds to a descriptor form.
Functions go through all instances, whose table begins at `at`: how many, then 8 numbers each.
"""

import numpy as np
from numba import njit

from .machine import METHOD_PARAMETERS, NQ, NV, RECORDS, STAGE


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, p, w, T, at, out):
    """its part of F(t, y, k) of the descriptor form, and of the power: 36 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    records = np.int64(T[RECORDS])
    stage = np.int64(T[STAGE])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        v0 = T[here + 2]
        row = T[here + 3]
        c0 = T[here + 5]
        c1 = T[here + 6]
        c2 = T[here + 7]
        r0_0 = w[f0 + 0]
        r0_1 = w[f0 + 1]
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        option0 = p[method_parameters + 0]
        option1 = p[method_parameters + 1]
        status_12 = w[12]
        k_v0 = w[stage + nq + v0 + 0]
        k_v1 = w[stage + nq + v0 + 1]
        k_v2 = w[stage + nq + v0 + 2]
        k_first0 = w[stage + nq + nv + row + 0]
        k_first1 = w[stage + nq + nv + row + 1]
        s0 = r0_6*k2
        s1 = r0_7*k2
        s2 = k2*(r0_5*r0_5)
        s3 = min(option0, option1*(1.0/status_12))
        s4 = 2.0*s3
        s5 = s3*s3
        out[nq + nv + row + 0] += k_v0 - s1*k_v2 - (r0_6*s2 - (r0_3 - r0_5*s1)*s4 - (r0_0 - k0 + s0)*s5)
        out[nq + nv + row + 1] += k_v1 + s0*k_v2 - (r0_7*s2 - (r0_4 + r0_5*s0)*s4 - (r0_1 - k1 + s1)*s5)
        out[nq + v0 + 0] += k_first0
        out[nq + v0 + 1] += k_first1
        out[nq + v0 + 2] += s0*k_first1 - s1*k_first0
        here = np.uint32(here + 8)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, p, w, T, at, out):
    """its entries of dF/dk and dF/dy: 40 operations an instance."""
    here = np.uint32(at + 1)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    records = np.int64(T[RECORDS])
    stage = np.int64(T[STAGE])
    for _ in range(np.int64(T[at])):
        f0 = records + T[here]
        v0 = T[here + 2]
        row = T[here + 3]
        entry = T[here + 4]
        c2 = T[here + 7]
        r0_5 = w[f0 + 5]
        r0_6 = w[f0 + 6]
        r0_7 = w[f0 + 7]
        k2 = p[c2]
        option0 = p[method_parameters + 0]
        option1 = p[method_parameters + 1]
        status_12 = w[12]
        k_v2 = w[stage + nq + v0 + 2]
        k_first0 = w[stage + nq + nv + row + 0]
        k_first1 = w[stage + nq + nv + row + 1]
        s0 = r0_6*k2
        s1 = r0_7*k2
        s2 = -s1
        s3 = k2*(r0_5*r0_5)
        s4 = min(option0, option1*(1.0/status_12))
        s5 = 2.0*s4
        s6 = s4*s4
        s7 = k2*(r0_5 + r0_5)
        out[entry + 0] = 1.0
        out[entry + 1] = s2
        out[entry + 2] = s6
        out[entry + 3] = -(s0*k_v2 + r0_5*s0*s5 - r0_7*s3 + s1*s6)
        out[entry + 4] = s5
        out[entry + 5] = -(r0_6*s7 + s1*s5)
        out[entry + 6] = 1.0
        out[entry + 7] = s0
        out[entry + 8] = s6
        out[entry + 9] = s0*s6 - (r0_6*s3 + r0_5*s1*s5) - s1*k_v2
        out[entry + 10] = s5
        out[entry + 11] = s0*s5 - r0_7*s7
        out[entry + 12] = 1.0
        out[entry + 13] = 1.0
        out[entry + 14] = s2
        out[entry + 15] = s0
        out[entry + 16] = -(s0*k_first0 + s1*k_first1)
        here = np.uint32(here + 8)
    return 0
