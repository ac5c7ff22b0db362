"""Method `direct-correction`, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

Positions and velocities are projected after each step with the pseudoinverse of D.
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076; Yoon, Howe, Greenwood, J. Mech. D...
format 3, generator of-golden-trees
option solver = elimination
option weight = identity
option when = step
parameter 0: tolerance (default 1e-13)
"""

import math

import numpy as np
from numba import njit

from machine import (
    CHANGE, DRIVEN, FORCE, FRAMES, GAMMA, GRAM_FACTOR, KEPT_FACTOR, M, MASK, MASKED_FACTOR, METHOD_PARAMETERS,
    MOTION, MULTIPLIERS, NQ, NU, NV, PIVOT, RATES, RESIDUAL, SAVED, VECTORS, VECTOR_SIZE, columns_times,
    factorise, factorise_forward, gram, inverse_mass_times, rows_times, run, solve, solve_rest, tables, weigh,
)
from model import drift, geometry as geometry_of_model, measure, move, normalise

POWER = 18  # places in w and T
SCHUR_LOWER = 62
LAW_LOWER = 63
SUSPECTS = 1  # counters in iw
LIGHT = 2
ITERATIONS = 3
FAILURES = 4


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Nothing depends on parameters of the method alone."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious."""
    T = tables(w)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    m = np.int64(T[M])
    multipliers = np.int64(T[MULTIPLIERS])
    nu = np.int64(T[NU])
    force = np.int64(T[FORCE])
    gamma = np.int64(T[GAMMA])
    schur_lower = np.int64(T[SCHUR_LOWER])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    x3 = vectors + 3 * vector_size
    x4 = vectors + 4 * vector_size
    x5 = vectors + 5 * vector_size
    x6 = vectors + 6 * vector_size
    w[POWER] = 0.0
    run(FRAMES, t, y, p, w, T, w)
    run(MOTION, t, y, p, w, T, w)
    inverse_mass_times(T, p, w, force, x2)
    rows_times(T, p, w, x2, x3)
    for j in range(m):
        w[multipliers + j] = w[x3 + j] - w[gamma + j]
    weigh(T, p, w)
    gram(T, p, w, 1, schur_lower)
    suspicious = factorise_forward(T, p, w, GRAM_FACTOR, schur_lower, MASKED_FACTOR, multipliers)
    solve_rest(T, p, w, GRAM_FACTOR, schur_lower, multipliers)
    columns_times(T, p, w, multipliers, x4)
    for j in range(nv):
        w[x5 + j] = w[force + j] - w[x4 + j]
    inverse_mass_times(T, p, w, x5, x6)
    a0 = 0.0
    if T[DRIVEN] != 0:
        for j in range(m):
            a0 += w[nu + j]*w[multipliers + j]
    run(RATES, t, y, p, w, T, ydot)
    ydot[nq + nv] = w[POWER] - a0
    for j in range(nv):
        ydot[nq + j] = w[x6 + j]
    return int(suspicious)


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """The factorisation of D D^T from D, without the rows that depend on others."""
    T = tables(w)
    law_lower = np.int64(T[LAW_LOWER])
    gram(T, p, w, 0, law_lower)
    factorise(T, p, w, GRAM_FACTOR, law_lower, KEPT_FACTOR)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """The correction -D^+ times the section `residual`, of v, or of q by N."""
    T = tables(w)
    m = np.int64(T[M])
    residual = np.int64(T[RESIDUAL])
    change = np.int64(T[CHANGE])
    law_lower = np.int64(T[LAW_LOWER])
    vectors, vector_size = np.int64(T[VECTORS]), np.int64(T[VECTOR_SIZE])
    x2 = vectors + 2 * vector_size
    for j in range(m):
        w[x2 + j] = -w[residual + j]
    solve(T, p, w, GRAM_FACTOR, law_lower, x2)
    columns_times(T, p, w, x2, change)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    T = tables(w)
    nq = np.int64(T[NQ])
    nv = np.int64(T[NV])
    method_parameters = np.int64(T[METHOD_PARAMETERS])
    change = np.int64(T[CHANGE])
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[method_parameters + 0] * w[6]
    last = math.inf
    bits = 2
    normalise(y, w)
    for round in range(15):
        geometry(t, y, p, w)
        violation = w[8]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        # near a singular position what is left of a violation opens another way: no more than rounding may be left
        near = w[4] < 1e-4
        closed = violation <= (0.01 * tolerance if near else tolerance) or stalled or round == 14
        if closed:
            drift(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(nq, nq + nv):
                y[j] += w[change - nq + j]
            break
        move(y, w)
        last = violation
        iw[ITERATIONS] += 1
    if not violation <= 1e4 * tolerance:
        iw[FAILURES] += 1
        bits |= 1
    measure(t, y, p, w)
    return bits


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    T = tables(w)
    m = np.int64(T[M])
    mask = np.int64(T[MASK])
    saved = np.int64(T[SAVED])
    pivot = np.int64(T[PIVOT])
    geometry(t, y, p, w)
    skipped = 0
    for i in range(m):
        w[saved + i] = w[mask + i]
        if w[pivot + i] < 1e-12:
            w[mask + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(m):
        w[mask + i] = w[saved + i]
    iw[SUSPECTS] += 1
    if skipped == 0:
        iw[LIGHT] += 1
    return 0
