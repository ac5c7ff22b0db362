"""Small finite elements of our own: quadratic squares and cubes of any shape, and frames of straight bars.

Nothing here is symgen's: tests compare modal bodies with what these meshes do.
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

    @property
    def ends(self) -> dict[str, NDArray[np.int64]]:
        """Both ends as interfaces."""
        return {"root": self.start, "tip": self.end}


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
    d, points, weights = len(sizes), *np.polynomial.legendre.leggauss(3)
    lines = [
        np.linspace(-0.5 * s if i else 0.0, 0.5 * s if i else s, 2 * c + 1)
        for i, (s, c) in enumerate(zip(sizes, counts, strict=True))
    ]
    grid = np.array(list(product(*lines)))
    x, steps = shape(grid), np.array([len(line) for line in lines])
    number = np.arange(len(x)).reshape(steps)
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
    rows, columns, stiff, heavy, plain = [], [], [], [], []
    for cell in product(*(range(c) for c in counts)):
        nodes = number[tuple(slice(2 * c, 2 * c + 3) for c in cell)].ravel()
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
        number[0].ravel(),
        number[-1].ravel(),
        sparse.csc_array((values, (i, j)), shape=(len(x),) * 2),
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
    places: Array, young: float, area: float, inertia: float, density: float, torsion: float = 0.0, shear: float = 0.0
) -> Mesh:
    """Return straight bars from node to node, of Euler and Bernoulli, with consistent masses; nodes have turns.

    In the plane a node has three unknowns, in space six; `inertia` is the second moment of area about each axis.
    """
    n, d = places.shape
    u = 3 if d == 2 else 6
    m, k = np.zeros((n * u,) * 2), np.zeros((n * u,) * 2)
    for i in range(n - 1):
        away = places[i + 1] - places[i]
        length = float(np.linalg.norm(away))
        ke, me = _bar_in_space(length, young, area, inertia, density, torsion, shear)
        turn = _axes_along(away)
        if d == 2:
            keep = [0, 1, 5, 6, 7, 11]
            ke, me, turn = ke[np.ix_(keep, keep)], me[np.ix_(keep, keep)], np.kron(np.eye(2), np.array(_plane(turn)))
        else:
            turn = np.kron(np.eye(4), turn)
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
    length: float, young: float, area: float, inertia: float, density: float, torsion: float, shear: float
) -> tuple[Array, Array]:
    k, m = np.zeros((12, 12)), np.zeros((12, 12))
    line = np.array([[1, -1], [-1, 1]])
    k[np.ix_([0, 6], [0, 6])] += young * area / length * line
    k[np.ix_([3, 9], [3, 9])] += shear * torsion / length * line
    mass = density * area * length
    m[np.ix_([0, 6], [0, 6])] += mass / 6 * np.array([[2, 1], [1, 2]])
    m[np.ix_([3, 9], [3, 9])] += density * torsion * length / 6 * np.array([[2, 1], [1, 2]])
    for places, s in (([1, 5, 7, 11], 1.0), ([2, 4, 8, 10], -1.0)):
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
        k[np.ix_(places, places)] += young * inertia / length**3 * bend
        m[np.ix_(places, places)] += mass / 420 * heavy
    return k, m


class MeshMotion:
    """d'Alembert on all nodes of a mesh: J^T M (J q'' + b) = J^T F - K m, with no integral of shapes.

    Parameters
    ----------
    mesh : Mesh
        A solid.
    shapes : Array, shape (n d, k)
        Modes.
    """

    def __init__(self, mesh: Mesh, shapes: Array) -> None:
        n, d = mesh.x.shape
        heavy = np.asarray(mesh.density.sum(axis=0)).ravel()
        self.centre = heavy @ mesh.x / heavy.sum()
        self.x, self.d, self.mass = mesh.x - self.centre, d, sparse.csr_array(mesh.mass)
        self.psi, self.k = shapes.reshape(n, d, -1), shapes.shape[1]
        self.springs = np.diag(shapes.T @ (mesh.stiffness @ shapes))
        self.turns = 1 if d == 2 else 3

    def axes(self, q: Array) -> Array:
        """Return the rotation matrix of the floating frame."""
        if self.d == 2:
            return np.array([[np.cos(q[2]), -np.sin(q[2])], [np.sin(q[2]), np.cos(q[2])]])
        a, b, c, d = q[3:7]
        return np.array(
            [
                [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
                [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
                [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
            ]
        )

    def at_nodes(self, q: Array, v: Array) -> tuple[Array, Array, Array]:
        """Return places of nodes, J and b of their accelerations J v' + b, rows node by node."""
        axes, n = self.axes(q), len(self.x)
        m, dm, w = q[len(q) - self.k :], v[len(v) - self.k :], v[self.d : self.d + self.turns]
        u, du = self.x + self.psi @ m, self.psi @ dm
        j = np.zeros((n, self.d, len(v)))
        j[:, :, : self.d] = np.eye(self.d)
        if self.d == 2:
            left = np.array([[0.0, -1.0], [1.0, 0.0]])
            j[:, :, 2] = u @ (axes @ left).T
            b = -(w[0] ** 2) * (u @ axes.T) + 2 * w[0] * (du @ (axes @ left).T)
        else:
            for a in range(3):
                j[:, :, 3 + a] = np.cross(np.eye(3)[a], u) @ axes.T
            b = (np.cross(w, np.cross(w, u)) + 2 * np.cross(w, du)) @ axes.T
        j[:, :, self.d + self.turns :] = np.einsum("ab,nbk->nak", axes, self.psi)
        return q[: self.d] + u @ axes.T, j.reshape(n * self.d, -1), b.ravel()

    def momenta(self, q: Array, v: Array) -> tuple[Array, Array, float]:
        """Return momentum, angular momentum about the origin, and kinetic plus strain energy of the mesh."""
        x, j, _ = self.at_nodes(q, v)
        speed = j @ v
        p = (self.mass @ speed).reshape(-1, self.d)
        h = (
            np.atleast_1d(np.cross(x, p).sum(axis=0))
            if self.d == 3
            else np.array([np.sum(x[:, 0] * p[:, 1] - x[:, 1] * p[:, 0])])
        )
        m = q[len(q) - self.k :]
        return p.sum(axis=0), h, float(0.5 * speed @ (self.mass @ speed) + 0.5 * self.springs @ m**2)

    def q_rates(self, q: Array, v: Array) -> Array:
        """Return q'."""
        if self.d == 2:
            return v
        a, b, c, d = q[3:7]
        g = 0.5 * np.array([[-b, a, d, -c], [-c, -d, a, b], [-d, c, -b, a]])
        return np.concatenate([v[:3], g.T @ v[3:6], v[6:]])

    def rate(
        self, y: Array, gravity: Array, held: Callable[[Array, Array], tuple[Array, Array]] | None = None
    ) -> Array:
        """Return (q', v'); `held` gives rows D and gamma of D v' = gamma."""
        nv = self.d + self.turns + self.k
        q, v = y[:-nv], y[-nv:]
        _, j, b = self.at_nodes(q, v)
        weighed = self.mass @ j
        springs = np.concatenate([np.zeros(nv - self.k), self.springs * q[len(q) - self.k :]])
        m, f = j.T @ weighed, weighed.T @ (np.tile(gravity, len(self.x)) - b) - springs
        if held is None:
            return np.concatenate([self.q_rates(q, v), np.linalg.solve(m, f)])
        rows, gamma = held(q, v)
        whole = np.block([[m, rows.T], [rows, np.zeros((len(rows),) * 2)]])
        return np.concatenate([self.q_rates(q, v), np.linalg.solve(whole, np.concatenate([f, gamma]))[:nv]])
