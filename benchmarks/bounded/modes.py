"""Forces at rest and impulses: bounded least squares, and enumeration."""

from __future__ import annotations

import itertools
import math

import numpy as np
from scipy.optimize import linprog, lsq_linear

from benchmarks.bounded.tree import Array

#: Bounded least squares are solved to this part of the accelerations.
LACKING = 1e-11


class NoForces(Exception):
    """No forces or impulses satisfy the rules."""


def resting_forces(mass: Array, free: Array, slopes: Array, bias: Array, bounds: tuple[Array, Array]) -> Array:
    """Return the forces within bounds that leave as little acceleration as possible (Gauss's principle).

    Accelerations are ``slopes @ (free + mass^-1 slopes.T @ F) + bias``. A force is within its bounds where its own is
    0, at the lower bound where it is above 0, at the upper one where it is below.

    Parameters
    ----------
    mass : Array, shape (n, n)
        Mass matrix of independent coordinates.
    free : Array, shape (n,)
        Accelerations without these forces.
    slopes, bias : Array
        Rows at rest.
    bounds : pair of Array
        Of their forces.
    """
    root = np.linalg.cholesky(mass)
    columns = np.linalg.solve(root, slopes.T)
    right = -root.T @ free - np.linalg.lstsq(columns.T, bias, rcond=1e-11)[0]
    lower, upper = bounds
    size = max(1.0, float(np.abs(right).max(initial=0.0)))
    found = np.asarray(
        lsq_linear(columns / size, right / size, (lower, upper), method="bvls", tol=1e-16, max_iter=500).x
    )
    square, alone = columns.T @ columns, slopes @ free + bias
    if _lacking(square, alone, found, bounds) <= LACKING * size**2:
        return found
    tried = _enumerated(square, alone, bounds)
    better = _lacking(square, alone, tried, bounds) < _lacking(square, alone, found, bounds)
    return tried if better else found


def _lacking(square: Array, alone: Array, forces: Array, bounds: tuple[Array, Array]) -> float:
    """Return by how much forces miss the rule: by accelerations ``square @ forces + alone``, and by bounds."""
    lower, upper = bounds
    moves = square @ forces + alone
    outer = np.where(forces <= lower, np.maximum(-moves, 0.0), np.maximum(moves, 0.0))
    free = (forces > lower) & (forces < upper)
    beyond = np.maximum(np.maximum(lower - forces, forces - upper), 0.0)
    return float(max(np.abs(np.where(free, moves, outer)).max(), beyond.max()))


def _enumerated(square: Array, alone: Array, bounds: tuple[Array, Array]) -> Array:
    """Return the best of all choices of what is inside, at its lower, or at its upper bound."""
    lower, upper = bounds
    best, least = np.clip(np.zeros(len(lower)), lower, upper), math.inf
    for choice in itertools.product((0, -1, 1), repeat=len(lower)):
        at = np.array(choice)
        forces = np.where(at < 0, lower, np.where(at > 0, upper, 0.0))
        if not np.isfinite(forces).all():
            continue
        inside = np.flatnonzero(at == 0)
        if len(inside):
            right = -(alone + square @ forces)[inside]
            forces[inside] = np.linalg.lstsq(square[np.ix_(inside, inside)], right, rcond=1e-11)[0]
        lacking = _lacking(square, alone, forces, bounds)
        if lacking < least:
            best, least = forces, lacking
    return best


def holding_margin(matrix: Array, needed: Array, bounds: tuple[Array, Array]) -> float:
    """Return by how much forces that hold dependent rows stay within their bounds at best; negative beyond them.

    ``matrix`` has the force of each row as a column, in as many equations as the rows have independent ones.
    """
    lower, upper = bounds
    k = len(lower)
    if len(matrix) == 1:  # one freedom: what all of them together hold at most, in both directions
        row, size = matrix[0], float(np.abs(matrix[0]).sum())
        with np.errstate(invalid="ignore"):
            most = float(np.where(row == 0.0, 0.0, np.maximum(row * lower, row * upper)).sum())
            least = float(np.where(row == 0.0, 0.0, np.minimum(row * lower, row * upper)).sum())
        return min(most - float(needed[0]), float(needed[0]) - least) / size
    rows, right = [], []
    for i in range(k):
        if math.isfinite(upper[i]):
            rows.append([*np.eye(k)[i], 1.0])
            right.append(upper[i])
        if math.isfinite(lower[i]):
            rows.append([*-np.eye(k)[i], 1.0])
            right.append(-lower[i])
    if not rows:
        return math.inf
    found = linprog(
        [*[0.0] * k, -1.0],
        A_ub=rows,
        b_ub=right,
        A_eq=np.column_stack([matrix, np.zeros(len(matrix))]),
        b_eq=needed,
        bounds=[(None, None)] * k + [(None, 1e6)],
        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
    )
    if found.x is None:
        raise NoForces("no forces hold dependent rows")
    return float(found.x[-1])


def impulses(matrix: Array, rates: Array, restitutions: Array) -> Array:
    """Return impulses P >= 0 of gaps that touch: u+ + e min(u-, 0) >= 0, and one of both is 0, with u+ = u- + matrix P.

    Found by trying which of them push.
    """
    n = len(rates)
    wanted = -restitutions * np.minimum(rates, 0.0)
    size = float(np.abs(rates).max(initial=0.0))
    best: tuple[float, Array] | None = None
    for count in range(n + 1):
        for active in itertools.combinations(range(n), count):
            push = np.zeros(n)
            if count:
                a = list(active)
                push[a] = np.linalg.lstsq(matrix[np.ix_(a, a)], (wanted - rates)[a], rcond=1e-12)[0]
            behind = rates + matrix @ push
            pushing = float(np.max(-push * np.sqrt(np.abs(np.diag(matrix))), initial=0.0))
            lacking = float(np.max(wanted - behind, initial=0.0))
            left = float(np.max(np.abs((behind - wanted)[list(active)]), initial=0.0))
            worst = max(pushing, lacking, left)
            if worst <= 1e-10 * size:
                return push
            if best is None or worst < best[0]:
                best = worst, push
    raise NoForces(f"no impulses: {best}")
