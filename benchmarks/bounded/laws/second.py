"""A second solver of drawn problems: Newton's method on the distance to each law, from drawn beginnings, in NumPy."""

from __future__ import annotations

import numpy as np

from benchmarks.bounded.laws.problems import Array, Problem

#: Steps of one beginning, halvings of a step, and what is missing at a solution.
_STEPS, _HALVINGS, _SOLVED = 80, 14, 1e-9


def find_another_way(problem: Problem, numbers: np.random.Generator, beginnings: int = 60) -> Array | None:
    """Return forces that obey all laws; None where no beginning leads to any."""
    size = float(np.abs(problem.offset).max())
    for beginning in range(beginnings):
        scale = size / np.diag(problem.matrix) * (0.0 if beginning == 0 else float(numbers.choice([0.1, 1.0, 3.0])))
        c = _from(problem, scale * numbers.normal(size=len(problem.rows)))
        if c is not None and problem.miss(c) < _SOLVED:
            return c
    return None


def _from(problem: Problem, c: Array) -> Array | None:
    """Return where one beginning leads to; None where no step makes less of what is missing."""
    missing, slopes = _missing(problem, c)
    for _ in range(_STEPS):
        if np.abs(missing).max() < 1e-13 * (1.0 + np.abs(c).max()):
            break
        step = np.linalg.lstsq(slopes, -missing, rcond=1e-11)[0]
        part, now = 1.0, float(missing @ missing)
        for _ in range(_HALVINGS):
            there, steeper = _missing(problem, c + part * step)
            if float(there @ there) < now * (1.0 - 1e-4 * part):
                break
            part *= 0.5
        else:
            return c
        c, missing, slopes = c + part * step, there, steeper
    return c


def _missing(problem: Problem, c: Array) -> tuple[Array, Array]:
    """Return how far each force is from the point of its law nearest to force and acceleration, and its slopes."""
    own, k = np.diag(problem.matrix), len(problem.rows)
    wants = c + (problem.offset - problem.matrix @ c) / own
    turns = np.eye(k) - problem.matrix / own[:, None]
    missing, slopes = np.zeros(k), np.zeros((k, k))
    for i, row in enumerate(problem.rows):
        if i > 0 and problem.rows[i - 1].flat:
            continue
        bound, by = problem.bound(i, c), _slope_of_bound(problem, i, c)
        if row.flat:
            both, mean = slice(i, i + 2), 0.5 * (own[i] + own[i + 1])
            want = c[both] + (problem.offset - problem.matrix @ c)[both] / mean
            turn = np.eye(k)[both] - problem.matrix[both] / mean
            length = float(np.hypot(*want))
            if length > bound and length > 0.0:
                way = want / length
                across = np.eye(2) - np.outer(way, way)
                missing[both] = c[both] - bound * way
                slopes[both] = np.eye(k)[both] - np.outer(way, by) - bound / length * across @ turn
            else:
                missing[both], slopes[both] = c[both] - want, np.eye(k)[both] - turn
            continue
        to, along = wants[i], turns[i]
        if row.pushes and wants[i] > 0.0:
            to, along = 0.0, np.zeros(k)
        elif row.way:
            to, along = row.way * bound, row.way * by
        elif not row.pushes and abs(wants[i]) > bound:
            sign = float(np.sign(wants[i]))
            to, along = sign * bound, sign * by
        missing[i], slopes[i] = c[i] - to, np.eye(k)[i] - along
    return missing, slopes


def _slope_of_bound(problem: Problem, i: int, c: Array) -> Array:
    """Return the derivative of a bound by all forces."""
    row, by = problem.rows[i], np.zeros(len(c))
    if row.presser >= 0:
        by[row.presser] = -row.kappa if c[row.presser] < 0.0 else 0.0
    elif row.apart.size:
        load = row.apart - row.parts @ c
        by = -row.kappa * load @ row.parts / max(float(np.linalg.norm(load)), 1e-300)
    return by
