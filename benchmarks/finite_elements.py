"""Small finite elements: quadratic squares and cubes of any shape, and frames of straight bars.

The catalogue's lever is made of them, and tests compare modal bodies with what these meshes do. Nothing here is
symgen's own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Mesh:
    """Nodes, M and K over the unknowns of each node, and the nodes of the first and of the last section."""

    x: Array
    mass: Any
    stiffness: Any
    start: NDArray[np.int64]
    end: NDArray[np.int64]
    density: Any  # of one component; None for frames
    cells: tuple[NDArray[np.int64], ...] = ()  # nodes of each element of a solid
    law: Array | None = None  # stresses of a solid from strains, in the plane times its thickness

    @property
    def ends(self) -> dict[str, NDArray[np.int64]]:
        """Both ends as interfaces."""
        return {"root": self.start, "tip": self.end}

    def stress(self, cell: int, at: tuple[float, ...], along: Array) -> Array:
        """Return a row over all unknowns: the normal stress along a direction, at local coordinates of an element."""
        assert self.law is not None, "frames have no stress here"
        nodes, d = self.cells[cell], self.x.shape[1]
        lagrange = [_quadratic(s) for s in at]
        slopes = np.array([_outer([lagrange[j][i == j] for j in range(d)]) for i in range(d)])
        b = _strains(np.linalg.solve(slopes @ self.x[nodes], slopes))
        pairs = ((0, 0), (1, 1), (0, 1)) if d == 2 else ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
        t = along / np.linalg.norm(along)
        both = np.array([t[i] * t[j] * (1.0 if i == j else 2.0) for i, j in pairs])
        row = np.zeros(d * len(self.x))
        row[(nodes[:, None] * d + np.arange(d)).ravel()] = both @ self.law @ b
        return row


def _quadratic(s: float) -> tuple[Array, Array]:
    return np.array([s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2]), np.array([s - 0.5, -2 * s, s + 0.5])


def solid(
    sizes: tuple[float, ...],
    counts: tuple[int, ...],
    young: float = 2e9,
    poisson: float = 0.3,
    density: float = 1000.0,
    thick: float = 1.0,
    shape: Callable[[Array], Array] = lambda x: x,
) -> Mesh:
    """Return a block of quadratic elements along the first axis, bent by `shape`; in the plane in plane stress."""
    edges = [
        np.linspace(-0.5 * s if i else 0.0, 0.5 * s if i else s, c + 1)
        for i, (s, c) in enumerate(zip(sizes, counts, strict=True))
    ]
    return blocks(edges, None, young, poisson, density, thick, shape)


def blocks(
    edges: list[Array],
    keep: Callable[[Array], Any] | None = None,
    young: float = 2e9,
    poisson: float = 0.3,
    density: float = 1000.0,
    thick: float = 1.0,
    shape: Callable[[Array], Array] = lambda x: x,
    grade: Callable[[Array], tuple[float, float]] = lambda x: (1.0, 1.0),
) -> Mesh:
    """Return quadratic elements between edges along each axis: those whose middles are to be kept.

    `shape` bends them, and `grade` has factors of stiffness and density by the middle of an element.
    """
    d, points, weights = len(edges), *np.polynomial.legendre.leggauss(3)
    lines = [np.sort(np.concatenate([e, 0.5 * (e[1:] + e[:-1])])) for e in edges]
    grid, steps = np.array(list(product(*lines))), [len(line) for line in lines]
    number = np.arange(len(grid)).reshape(steps)
    places = [tuple(slice(2 * c, 2 * c + 3) for c in cell) for cell in product(*(range(len(e) - 1) for e in edges))]
    kept = [number[place].ravel() for place in places]
    kept = [nodes for nodes in kept if keep is None or keep(grid[nodes].mean(axis=0))]
    used = np.unique(np.concatenate(kept))
    own_number = np.full(len(grid), -1)
    own_number[used] = np.arange(len(used))
    x = shape(grid[used])
    if d == 2:
        law = young / (1 - poisson**2) * np.array([[1, poisson, 0], [poisson, 1, 0], [0, 0, (1 - poisson) / 2]]) * thick
    else:
        law = np.full((3, 3), poisson) + (1 - 2 * poisson) * np.eye(3)
        law = (
            young
            / (1 + poisson)
            / (1 - 2 * poisson)
            * np.block([[law, np.zeros((3, 3))], [np.zeros((3, 3)), np.eye(3) * (0.5 - poisson)]])
        )
    rho = density * (thick if d == 2 else 1.0)
    rows, columns, stiff, heavy, plain, cells = [], [], [], [], [], []
    for nodes in (own_number[these] for these in kept):
        cells.append(nodes)
        k, m = np.zeros((d * len(nodes),) * 2), np.zeros((len(nodes),) * 2)
        for at in product(range(3), repeat=d):
            lagrange = [_quadratic(float(points[i])) for i in at]
            n = _outer([v for v, _ in lagrange])
            slopes = np.array([_outer([lagrange[j][i == j] for j in range(d)]) for i in range(d)])
            jacobian = slopes @ x[nodes]
            volume = float(np.linalg.det(jacobian) * np.prod(weights[list(at)]))
            g = np.linalg.solve(jacobian, slopes)
            k += volume * (b := _strains(g)).T @ law @ b
            m += volume * rho * np.outer(n, n)
        stiffer, heavier = grade(x[nodes].mean(axis=0))
        k, m = stiffer * k, heavier * m
        own = (nodes[:, None] * d + np.arange(d)).ravel()
        rows.append(np.repeat(own, len(own)))
        columns.append(np.tile(own, len(own)))
        stiff.append(k.ravel())
        heavy.append(np.kron(m, np.eye(d)).ravel())
        plain.append((np.repeat(nodes, len(nodes)), np.tile(nodes, len(nodes)), m.ravel()))
    place = np.concatenate(rows), np.concatenate(columns)
    size = (d * len(x),) * 2
    i, j, values = (np.concatenate(part) for part in zip(*plain, strict=True))
    return Mesh(
        x,
        sparse.csc_array((np.concatenate(heavy), place), shape=size),
        sparse.csc_array((np.concatenate(stiff), place), shape=size),
        own_number[[n for n in number[0].ravel() if own_number[n] >= 0]],
        own_number[[n for n in number[-1].ravel() if own_number[n] >= 0]],
        sparse.csc_array((values, (i, j)), shape=(len(x),) * 2),
        tuple(cells),
        law / (thick if d == 2 else 1.0),
    )


def _outer(parts: list[Array]) -> Array:
    result = np.ones(1)
    for part in parts:
        result = np.outer(result, part).ravel()
    return result


def _strains(g: Array) -> Array:
    """Return the strains xx, yy, (zz,) and the shears of the displacements of nodes."""
    d, n = g.shape
    b = np.zeros((3 if d == 2 else 6, d * n))
    for a in range(d):
        b[a, a::d] = g[a]
    for row, (a, c) in enumerate(((0, 1),) if d == 2 else ((1, 2), (0, 2), (0, 1)), d):
        b[row, a::d], b[row, c::d] = g[c], g[a]
    return b


def bend_to_arc(radius: float, rise: float = 0.0) -> Callable[[Array], Array]:
    """Return a shape that bends a block downwards, and lets it rise in space."""

    def shape(x: Array) -> Array:
        bent = x.copy()
        bent[:, 0] = (radius + x[:, 1]) * np.sin(x[:, 0] / radius)
        bent[:, 1] = (radius + x[:, 1]) * np.cos(x[:, 0] / radius) - radius
        if x.shape[1] == 3:
            bent[:, 2] += rise * x[:, 0] ** 2
        return bent

    return shape


def bar_frame(
    places: Array,
    young: float,
    area: float,
    inertia: float | tuple[float, float],
    density: float,
    torsion: float = 0.0,
    shear: float = 0.0,
) -> Mesh:
    """Return straight bars from node to node, of Euler and Bernoulli, with consistent masses; nodes have turns.

    In the plane a node has three unknowns, in space six. `inertia` is the second moment of area about each axis, or a
    pair: for bends along the second and along the third axis of the bar.
    """
    n, d = places.shape
    u = 3 if d == 2 else 6
    m, k = np.zeros((n * u,) * 2), np.zeros((n * u,) * 2)
    for i in range(n - 1):
        away = places[i + 1] - places[i]
        length = float(np.linalg.norm(away))
        ke, me = _bar_in_space(length, young, area, inertia, density, torsion, shear)
        axes = _axes_along(away)
        turn: Any = np.kron(np.eye(4), axes)
        if d == 2:
            keep = [0, 1, 5, 6, 7, 11]
            ke, me, turn = ke[np.ix_(keep, keep)], me[np.ix_(keep, keep)], np.kron(np.eye(2), _plane(axes))
        own = np.arange(u * i, u * (i + 2))
        k[np.ix_(own, own)] += turn.T @ ke @ turn
        m[np.ix_(own, own)] += turn.T @ me @ turn
    return Mesh(places, sparse.csc_array(m), sparse.csc_array(k), np.array([0]), np.array([n - 1]), None)


def _plane(turn: Array) -> Array:
    return np.array([[turn[0, 0], turn[0, 1], 0], [turn[1, 0], turn[1, 1], 0], [0, 0, 1]])


def _axes_along(away: Array) -> Array:
    x = np.zeros(3)
    x[: len(away)] = away / np.linalg.norm(away)
    other = np.array([0.0, 0.0, 1.0]) if abs(x[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
    y = np.cross(other, x)
    y /= np.linalg.norm(y)
    return np.array([x, y, np.cross(x, y)])


def _bar_in_space(
    length: float,
    young: float,
    area: float,
    inertia: float | tuple[float, float],
    density: float,
    torsion: float,
    shear: float,
) -> tuple[Array, Array]:
    k, m = np.zeros((12, 12)), np.zeros((12, 12))
    line = np.array([[1, -1], [-1, 1]])
    k[np.ix_([0, 6], [0, 6])] += young * area / length * line
    k[np.ix_([3, 9], [3, 9])] += shear * torsion / length * line
    mass = density * area * length
    m[np.ix_([0, 6], [0, 6])] += mass / 6 * np.array([[2, 1], [1, 2]])
    m[np.ix_([3, 9], [3, 9])] += density * torsion * length / 6 * np.array([[2, 1], [1, 2]])
    both = inertia if isinstance(inertia, tuple) else (inertia, inertia)
    for places, s, second in (([1, 5, 7, 11], 1.0, both[0]), ([2, 4, 8, 10], -1.0, both[1])):
        h = s * length
        bend = np.array(
            [
                [12, 6 * h, -12, 6 * h],
                [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                [-12, -6 * h, 12, -6 * h],
                [6 * h, 2 * h * h, -6 * h, 4 * h * h],
            ]
        )
        heavy = np.array(
            [
                [156, 22 * h, 54, -13 * h],
                [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                [54, 13 * h, 156, -22 * h],
                [-13 * h, -3 * h * h, -22 * h, 4 * h * h],
            ]
        )
        k[np.ix_(places, places)] += young * second / length**3 * bend
        m[np.ix_(places, places)] += mass / 420 * heavy
    return k, m
