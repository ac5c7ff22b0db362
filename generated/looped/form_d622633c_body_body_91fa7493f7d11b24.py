"""Kernel `form_d622633c_body_body_91fa7493f7d11b24` of the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
What a body of kind body adds to a descriptor form.
Functions go through all instances, whose table begins at `at`: how many, then 8 numbers each.
"""

import numpy as np
from numba import njit

from .machine import NQ, RECORDS, STAGE


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, p, w, T, at, out):
    """its part of F(t, y, k) of the descriptor form, and of the power: 8 operations an instance."""
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
        r0_3 = w[f0 + 3]
        r0_4 = w[f0 + 4]
        r0_5 = w[f0 + 5]
        k0 = p[c0]
        k1 = p[c1]
        k2 = p[c2]
        k_q0 = w[stage + q0 + 0]
        k_q1 = w[stage + q0 + 1]
        k_q2 = w[stage + q0 + 2]
        k_v0 = w[stage + nq + v0 + 0]
        k_v1 = w[stage + nq + v0 + 1]
        k_v2 = w[stage + nq + v0 + 2]
        out[q0 + 0] += k_q0 - r0_3
        out[q0 + 1] += k_q1 - r0_4
        out[q0 + 2] += k_q2 - r0_5
        out[nq + v0 + 0] += k0*k_v0
        out[nq + v0 + 1] += k0*k_v1 - k0*k2
        out[nq + v0 + 2] += k1*k_v2
        here = np.uint32(here + 8)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, p, w, T, at, out):
    """its entries of dF/dk and dF/dy: 0 operations an instance."""
    here = np.uint32(at + 1)
    for _ in range(np.int64(T[at])):
        entry = T[here + 4]
        c0 = T[here + 5]
        c1 = T[here + 6]
        k0 = p[c0]
        k1 = p[c1]
        out[entry + 0] = 1.0
        out[entry + 1] = -1.0
        out[entry + 2] = 1.0
        out[entry + 3] = -1.0
        out[entry + 4] = 1.0
        out[entry + 5] = -1.0
        out[entry + 6] = k0
        out[entry + 7] = k0
        out[entry + 8] = k1
        here = np.uint32(here + 8)
    return 0
