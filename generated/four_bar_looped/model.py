"""What all methods share, for any mechanism, in the looped shape. Emitted by symgen; do not edit.

format 3, generator of-golden-trees
"""

import math

import numpy as np
from numba import njit

from machine import (
    ANGULAR_ROWS, CHANGE, DIAGONAL, DRIVEN, ENERGY, FRAMES, GAMMA, GAUGE, GEOMETRY, GRAM_FACTOR, LOWER, M,
    EQUATIONS, MOTION, MOVE, NORMALISE, NQ, NU, NV, RANK_FACTOR, REPORT, RESIDUAL, RESIDUALS, ROW_WEIGHT, SLOPES,
    SPEEDS, STAGE, TURN, UNKNOWNS, VECTORS, VECTOR_SIZE, WIND,
    columns_times, factorise, gauge, gram, rows_times, run, solve, tables,
)


@njit(error_model="numpy", fastmath={"contract"})
def violation(T, w, norm, measure):
    """Norm of section `residual`, and what is judged: rows that are no lengths times the mechanism's."""
    residual, at, length = np.int64(T[RESIDUAL]), T[ANGULAR_ROWS], w[6]
    total = angular = 0.0
    for i in range(np.int64(T[M])):
        total += w[residual + i] ** 2
    for k in range(np.int64(T[at])):
        angular += w[residual + T[at + 1 + k]] ** 2
    w[norm] = w[measure] = math.sqrt(total)
    if T[at] > 0:
        lengths = 0.0
        for k in range(np.int64(T[M]) - np.int64(T[at])):
            lengths += w[residual + T[at + 1 + T[at] + k]] ** 2
        w[measure] = math.sqrt(lengths + length * length * angular)


@njit(error_model="numpy", fastmath={"contract"})
def constrain(t, y, p, w, T):
    """Phi as section `residual`, its norm, nu and D."""
    run(FRAMES, t, y, p, w, T, w)
    residual = np.int64(T[RESIDUAL])
    m = np.int64(T[M])
    for i in range(m):  # nonholonomic rows have no Phi
        w[residual + i] = 0.0
    run(GEOMETRY, t, y, p, w, T, w)
    violation(T, w, 0, 8)


@njit(error_model="numpy", fastmath={"contract"})
def decide_rank(T, p, w):
    """Factorise D G D^T, which decides rank."""
    lower = np.int64(T[LOWER])
    gauge(T, p, w)
    gram(T, p, w, 2, lower)
    factorise(T, p, w, GRAM_FACTOR, lower, RANK_FACTOR)
    at, shortest = T[ANGULAR_ROWS], 1.0
    squares, weights = np.int64(T[DIAGONAL]), np.int64(T[ROW_WEIGHT])
    for k in range(np.int64(T[at])):
        row = np.int64(T[at + 1 + k])
        shortest = min(shortest, w[squares + row] * w[weights + row])
    w[10] = shortest


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank."""
    T = tables(w)
    constrain(t, y, p, w, T)
    decide_rank(T, p, w)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """The correction -D^+ times the section `residual`, of v, or of q by N, in the metric that decides rank."""
    T = tables(w)
    residual, x = np.int64(T[RESIDUAL]), np.int64(T[VECTORS])
    change, weights = np.int64(T[CHANGE]), np.int64(T[GAUGE])
    for i in range(np.int64(T[M])):
        w[x + i] = -w[residual + i]
    solve(T, p, w, GRAM_FACTOR, np.int64(T[LOWER]), x)
    columns_times(T, p, w, x, change)
    for j in range(np.int64(T[NV])):
        w[change + j] *= w[weights + j]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def drift(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left."""
    T = tables(w)
    nq, nv, m = np.int64(T[NQ]), np.int64(T[NV]), np.int64(T[M])
    residual, nu, x = np.int64(T[RESIDUAL]), np.int64(T[NU]), np.int64(T[VECTORS])
    for j in range(nv):
        w[x + j] = y[nq + j]
    rows_times(T, p, w, x, residual)
    if T[DRIVEN] != 0:
        for i in range(m):
            w[residual + i] -= w[nu + i]
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu as `drift` leaves it, its norm, and the energies."""
    T = tables(w)
    drift(t, y, p, w)
    violation(T, w, 1, 9)
    run(SPEEDS, t, y, p, w, T, w)
    w[2] = 0.0
    w[3] = 0.0
    run(ENERGY, t, y, p, w, T, w)
    run(WIND, t, y, p, w, T, w)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates."""
    T = tables(w)
    nq, nv, m = np.int64(T[NQ]), np.int64(T[NV]), np.int64(T[M])
    gamma, x = np.int64(T[GAMMA]), np.int64(T[VECTORS])
    run(FRAMES, t, y, p, w, T, w)
    run(MOTION, t, y, p, w, T, w)
    for j in range(nv):
        w[x + j] = ydot[nq + j]
    result = x + np.int64(T[VECTOR_SIZE])
    rows_times(T, p, w, x, result)
    for i in range(m):
        out[i] = w[result + i] - w[gamma + i]
    run(REPORT, t, y, p, w, T, out)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def move(y, w):
    """q + N times section `change`, Euler parameters of length 1."""
    T = tables(w)
    run(MOVE, 0.0, y, w, w, T, w)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def turn(y, w):
    """q moved by section `change`, bodies turned by its exponential."""
    T = tables(w)
    run(TURN, 0.0, y, w, w, T, w)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def normalise(y, w):
    """Euler parameters of length 1; 1 where they were not."""
    T = tables(w)
    x = np.int64(T[VECTORS])
    w[x] = 0.0
    run(NORMALISE, 0.0, y, w, w, T, w)
    return int(w[x] > 0.0)


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, k, p, w, r):
    """F(t, y, k) of the descriptor form, and the power."""
    T = tables(w)
    stage = np.int64(T[STAGE])
    for i in range(np.int64(T[UNKNOWNS])):
        w[stage + i] = k[i]
    for i in range(np.int64(T[EQUATIONS])):
        r[i] = 0.0
    w[18] = 0.0
    run(FRAMES, t, y, p, w, T, w)
    run(RESIDUALS, t, y, p, w, T, r)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """Entries of dF/dk and dF/dy of the descriptor form, element by element."""
    T = tables(w)
    stage = np.int64(T[STAGE])
    for i in range(np.int64(T[UNKNOWNS])):
        w[stage + i] = k[i]
    run(FRAMES, t, y, p, w, T, w)
    run(SLOPES, t, y, p, w, T, j)
    return 0
