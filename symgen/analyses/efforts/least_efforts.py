"""Efforts beside forces that are free within limits: closed stops and contacts, friction at rest.

At one time the equations of motion are linear in efforts and in these forces. A stop pushes, friction at a closed
contact is within the cone of its force, dry friction at rest between its bounds. Of all efforts that give the motion
the least are found, by the problem of least distance (Lawson and Hanson, chapter 23), and the lowest and highest of
each by linear programmes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog, nnls

Array = NDArray[np.float64]

#: Singular values below this part of the largest count as zero; so do accelerations by an effort below the second part
#: of the largest.
CUTOFF, SILENT = 1e-9, 1e-13
#: What a force within limits costs beside an effort while the limits are sought that the least efforts reach.
CHEAP = 1e-3
#: Limits below this part of the largest force are reached; limits without any point leave a distance below the second.
REACHED, NOWHERE = 1e-7, 1e-11


@dataclass(frozen=True)
class Limits:
    """Forces at one time as ``turned @ g + fixed`` with ``0 <= g <= width``.

    Attributes
    ----------
    turned : Array, shape (m, r)
        Forces of rows by what is free.
    fixed : Array, shape (m,)
        Their part that is not.
    width : Array, shape (r,)
        Largest value of each free number; infinite where a row pushes.
    """

    turned: Array
    fixed: Array
    width: Array


@dataclass(frozen=True)
class LeastEfforts:
    """Efforts at one time.

    Attributes
    ----------
    efforts, forces : Array, shapes (n,), (m,)
        Of actuators and of rows with bounds.
    lowest, highest : Array, shape (n,)
        Of each effort alone, infinite where nothing limits it.
    missing : float
        Largest acceleration that they do not give.
    """

    efforts: Array
    forces: Array
    lowest: Array
    highest: Array
    missing: float


def efforts_within_limits(
    effects: Array, by_forces: Array, goal: Array, weights: Array, limits: Limits, ranged: bool = True
) -> LeastEfforts:
    """Return the least efforts that give accelerations.

    Parameters
    ----------
    effects, by_forces : Array, shapes (d, n), (d, m)
        Accelerations by efforts and by forces of rows with bounds.
    goal : Array, shape (d,)
        Accelerations of the motion less those without both.
    weights : Array, shape (n,)
        Of efforts: the sum of (weight effort)^2 is least.
    limits : Limits
        Of the forces.
    ranged : bool
        Whether the range of each effort is found too, by two linear programmes; otherwise it is the effort.
    """
    n, free = effects.shape[1], limits.turned.shape[1]
    goal = goal - by_forces @ limits.fixed
    columns = np.hstack([effects, by_forces @ limits.turned])
    sizes = np.linalg.norm(columns, axis=0)
    sizes[sizes <= SILENT * max(sizes.max(initial=0.0), float(np.linalg.norm(goal)))] = 0.0
    columns = np.where(sizes > 0.0, columns, 0.0)
    start, basis = _solutions_of(columns, goal, sizes)
    bound = np.isfinite(limits.width)
    unit = np.eye(n + free)[n:]
    lines, least = np.vstack([unit, -unit[bound]]), np.concatenate([np.zeros(free), -limits.width[bound]])
    costs = np.concatenate([weights, np.full(free, CHEAP * weights.min(initial=1.0))])
    x = _least_within(start, basis, lines, least, costs)
    within = x is not None
    if x is None:
        x = _nearest_within(columns, goal, limits.width, n)
    lowest, highest = _ranges(start, basis, lines, least, n, x) if within and ranged else (x[:n], x[:n])
    missing = float(np.abs(goal - columns @ x).max(initial=0.0))
    return LeastEfforts(x[:n], limits.turned @ x[n:] + limits.fixed, lowest, highest, missing)


def _solutions_of(columns: Array, goal: Array, sizes: Array) -> tuple[Array, Array]:
    """Return a solution of the equations, the nearest one, and a basis of what may be added to it."""
    scale = np.where(sizes > 0.0, sizes, 1.0)
    left, singular, right = np.linalg.svd(columns / scale, full_matrices=True)
    rank = int(np.sum(singular > CUTOFF * singular.max(initial=0.0)))
    start = right[:rank].T @ ((left[:, :rank].T @ goal) / singular[:rank]) / scale
    return start, (right[rank:] / scale).T


def _least_within(start: Array, basis: Array, lines: Array, least: Array, costs: Array) -> Array | None:
    """Return the point ``start + basis @ s`` of the least sum of squared costs within limits; None without any."""
    size = max(float(np.abs(start).max(initial=0.0)), float(np.abs(least).max(initial=0.0)), 1e-300)
    room = lines @ start - least
    if not basis.shape[1]:
        return start if np.all(room >= -REACHED * size) else None
    q, r = np.linalg.qr(costs[:, np.newaxis] * basis)
    offset = q.T @ (costs * start)
    turned = np.linalg.solve(r.T, (lines @ basis).T).T
    heights = (-room + turned @ offset) / size
    reach = np.linalg.norm(turned, axis=1)
    reach[reach == 0.0] = 1.0
    problem = np.vstack([(turned / reach[:, np.newaxis]).T, heights / reach])
    target = np.append(np.zeros(len(problem) - 1), 1.0)
    found, _ = nnls(problem, target)
    gap = problem @ found - target
    if not -gap[-1] > NOWHERE:
        return None
    x = start + basis @ np.linalg.solve(r, -size * gap[:-1] / gap[-1] - offset)
    return _at_limits(x, start, basis, lines, least, costs, size)


def _at_limits(x: Array, start: Array, basis: Array, lines: Array, least: Array, costs: Array, size: float) -> Array:
    """Return the cheapest point on the limits that a point reaches; forces are free of cost if others allow it."""
    reached = lines @ x - least <= REACHED * size
    along = lines[reached] @ basis
    there, rest = _solutions_of(along, least[reached] - lines[reached] @ start, np.ones(basis.shape[1]))
    own, first = basis @ rest, start + basis @ there
    for counted in (np.where(np.any(lines != 0.0, axis=0), 0.0, costs), costs):
        nearest = first
        if own.shape[1]:
            nearest = first - own @ np.linalg.lstsq(counted[:, np.newaxis] * own, counted * first, rcond=CUTOFF)[0]
        if np.all(lines @ nearest - least >= -REACHED * size):
            return nearest
    return x


def _nearest_within(columns: Array, goal: Array, width: Array, n: int) -> Array:
    """Return the point within limits that leaves the least sum of accelerations."""
    d, count = columns.shape
    cost = np.concatenate([np.zeros(count), np.ones(2 * d)])
    limits = [(None, None)] * n + [(0.0, x if np.isfinite(x) else None) for x in width] + [(0.0, None)] * (2 * d)
    found = linprog(cost, A_eq=np.hstack([columns, np.eye(d), -np.eye(d)]), b_eq=goal, bounds=limits)
    assert found.x is not None, "all accelerations may be left"
    return np.asarray(found.x[:count])


def _ranges(start: Array, basis: Array, lines: Array, least: Array, n: int, x: Array) -> tuple[Array, Array]:
    """Return the lowest and highest values of the first `n` numbers within limits."""
    lowest, highest = x[:n].copy(), x[:n].copy()
    if not basis.shape[1]:
        return lowest, highest
    size = max(float(np.abs(x).max(initial=0.0)), float(np.abs(least).max(initial=0.0)), 1e-300)
    room = np.maximum(lines @ x - least, 0.0) / size
    for i in range(n):
        if not np.any(np.abs(basis[i]) > 0.0):
            continue
        for way, ends in ((1.0, lowest), (-1.0, highest)):
            found = linprog(way * basis[i], A_ub=-(lines @ basis), b_ub=room, bounds=(None, None))
            ends[i] = -way * np.inf if found.fun is None else x[i] + size * way * found.fun
    return np.minimum(lowest, x[:n]), np.maximum(highest, x[:n])
