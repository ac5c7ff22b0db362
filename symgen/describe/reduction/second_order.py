"""What linear modes of a body leave out: stretches between interfaces, couples, and how its own weight softens it.

A step t along elements that turns by a small angle theta gets shorter by theta^2 t / 2. Between two interfaces that
joints hold, the sum over the way is a stretch, whose thrust acts against bending. Along ways to heavy nodes, the
weight does work on the sum, which takes stiffness away. A couple M between two interfaces in space turns with neither,
so that bending about one axis across it bends the body about the other as well.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy import linalg
from scipy.sparse.csgraph import dijkstra

from symgen.describe.reduction.basis import ModeBasis
from symgen.describe.reduction.finite_elements import Array, FiniteElements
from symgen.describe.reduction.ways import graph_of, middles_of, shortest_ways


@dataclass(frozen=True)
class PathStretch:
    """How a body stretches between two interfaces that are held: by ``m . growth m``.

    Attributes
    ----------
    ends : tuple of int
        Numbers of the interfaces.
    growth : Array, shape (k, k)
        By coordinates of modes [1/m].
    stiffness : float
        Along the line between the two [N/m].
    """

    ends: tuple[int, int]
    growth: Array
    stiffness: float


def stretches_of(
    elements: FiniteElements, x: Array, modes: ModeBasis, sets: Mapping[str, NDArray[np.int64]]
) -> list[PathStretch]:
    """Return the stretches between all pairs of interfaces that elements join and that are apart."""
    d, motions = elements.dimension, elements.dimension + elements.rotations
    stiffness = modes.static.T @ (elements.stiffness @ modes.static)
    field = modes.shapes.T.reshape(modes.shapes.shape[1], len(x), -1)[:, :, :d]
    middles, stretches = middles_of(x, sets), list[PathStretch]()
    for i, start in enumerate(middles[:-1]):
        places = np.delete(np.arange(len(stiffness)), motions * i + np.arange(motions))
        gives = np.linalg.inv(stiffness[np.ix_(places, places)])
        for way in shortest_ways(elements, start, middles[i + 1 :]):
            j = middles.index(int(way[-1]), i + 1)
            chord = x[way[-1]] - x[start]
            length = float(np.linalg.norm(chord))
            if length == 0.0:
                continue
            along, at = chord / length, motions * (j - 1) + np.arange(d)
            steps, moved = np.diff(x[way], axis=0), np.diff(field[:, way], axis=1)
            apart = field[:, way[-1]] - field[:, start]
            apart = apart - np.outer(apart @ along, along)
            # less the turn of the line between the two, which the body may make as a whole
            moved = moved - (np.einsum("s,ka->ksa", steps @ along, apart) - (apart @ steps.T)[:, :, None] * along) / (
                length
            )
            turned = _across(moved, steps)
            growth = 0.5 * np.einsum("ksa,lsa,s->kl", turned, turned, steps @ along)
            stretches.append(PathStretch((i, j), growth, 1.0 / float(along @ gives[np.ix_(at, at)] @ along)))
    return stretches


@dataclass(frozen=True)
class PairCouple:
    """The couple that acts along a body from one interface to another, over the stiffness against what it couples.

    Attributes
    ----------
    ends : tuple of int
        Numbers of the interfaces.
    share : Array, shape (3, k)
        By coordinates of modes; its length is M over the root of the angular stiffnesses about axes across M [1/m].
    """

    ends: tuple[int, int]
    share: Array


def couples_of(elements: FiniteElements, modes: ModeBasis) -> list[PairCouple]:
    """Return the couples between all pairs of interfaces of a body in space; in the plane a couple bends nothing else.

    A couple M does the work ``M . (a x b) / 2`` on a turn a that b follows: over the angular stiffness C, this is the
    share ``sqrt(M . C M / det C)``. Where the couples at the two ends differ, their mean acts along the body.
    """
    if elements.dimension == 2:
        return []
    stiffness = modes.static.T @ (elements.stiffness @ modes.static)
    elastic, couples = modes.static.T @ (elements.stiffness @ modes.shapes), list[PairCouple]()
    for i, j in combinations(range(len(modes.seats)), 2):
        places = np.delete(np.arange(len(stiffness)), 6 * i + np.arange(6))
        first = 6 * (j - 1) + 3
        gives = np.linalg.inv(stiffness[np.ix_(places, places)])[first : first + 3, first : first + 3]
        weight = np.linalg.det(gives) * np.linalg.inv(gives)
        mean = (elastic[6 * j + 3 : 6 * j + 6] - elastic[6 * i + 3 : 6 * i + 6]) / 2.0
        couples.append(PairCouple((i, j), np.linalg.cholesky(weight).T @ mean))
    return couples


def softening_of(elements: FiniteElements, x: Array, modes: ModeBasis, sets: Mapping[str, NDArray[np.int64]]) -> Array:
    """Return the largest share of the stiffness that accelerations take away or add, all interfaces held.

    The shapes are what weight along each axis bends the body to. A body with one interface has none of it, as its frame
    turns along, and the force on the interface is judged.

    Returns
    -------
    Array, shape (d,)
        By the components of the acceleration less gravity, in body axes [s^2/m].
    """
    d, u = elements.dimension, elements.unknowns
    if len(sets) < 2 or modes.factor is None:
        return np.zeros(d)
    weights = np.zeros((elements.mass.shape[0], d))
    for a in range(d):
        weights[a::u, a] = 1.0
    weights = np.asarray(elements.mass @ weights)
    sag = np.zeros_like(weights)
    sag[modes.inside] = modes.factor.solve(weights[modes.inside])
    energy = sag.T @ (elements.stiffness @ sag)
    reach, before, _ = dijkstra(graph_of(elements), True, np.concatenate([*sets.values()]), True, min_only=True)
    carried = np.asarray(elements.density.sum(axis=0)).ravel().copy()
    ends = [n for n in np.argsort(-reach) if before[n] >= 0]
    for n in ends:  # what is farther is carried by what is nearer
        carried[before[n]] += carried[n]
    nodes = np.array(ends, dtype=np.int64)
    if not len(nodes):
        return np.zeros(d)
    steps = x[nodes] - x[before[nodes]]
    field = sag.T.reshape(d, len(x), u)[:, :, :d]
    turned = _across(field[:, nodes] - field[:, before[nodes]], steps)
    works = np.einsum("ksa,lsa,sc,s->ckl", turned, turned, steps, carried[nodes])
    return np.array([np.abs(linalg.eigh(work, (energy + energy.T) / 2.0, eigvals_only=True)).max() for work in works])


def _across(moved: Array, steps: Array) -> Array:
    """Return by how much steps turn, of what their ends move by, shape (k, s, d)."""
    lengths = np.linalg.norm(steps, axis=1)[:, None]
    unit = steps / lengths
    return np.asarray((moved - np.sum(moved * unit, axis=2)[:, :, None] * unit) / lengths)
