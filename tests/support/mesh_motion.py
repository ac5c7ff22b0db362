"""The motion of all nodes of a mesh by d'Alembert's principle, with modes but without any integral of them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from benchmarks.finite_elements import Mesh

Array = NDArray[np.float64]


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
