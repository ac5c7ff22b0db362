"""A mechanism's equations in one state: constraints, forces, accelerations, multipliers, reactions, energies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from benchmarks.plain import forces, joints_plane, joints_space
from benchmarks.plain.bodies import GROUND, State, bodies
from benchmarks.plain.document import Document
from benchmarks.plain.elements import Joint, Parts, Turn
from benchmarks.plain.moving import Array, crossed
from benchmarks.plain.turning import rates

#: Singular values of D with rows of length 1 below this count as zero at a state that satisfies the constraints.
CUTOFF = 1e-7


@dataclass(frozen=True)
class Constraints:
    """Phi, D, nu and gamma of one state."""

    phi: Array
    d: Array
    nu: Array
    gamma: Array


class System:
    """A mechanism that can be evaluated.

    Parameters
    ----------
    document : Document
        The file with values for its parameters.

    Attributes
    ----------
    names_q, names_v, rows : list of str
        Names of coordinates, velocities and multipliers.
    mass : Array, shape (nv, nv)
        The mass matrix.
    turns : dict
        Angles in space as they were at the last accepted state.
    """

    def __init__(self, document: Document) -> None:
        self.document = document
        self.bodies = bodies(document)
        kinds = joints_space.KINDS if document.spatial else joints_plane.KINDS
        self.parts = parts = Parts(document, self.bodies, kinds)
        self.joints: list[Joint] = [parts.joint(name) for name in document.section("joints")]
        self.forces = [forces.KINDS[t["type"]](parts, n, t) for n, t in document.section("forces").items()]
        self.names_q = [name for body in self.bodies.values() for name in body.coordinates]
        self.names_v = [name for body in self.bodies.values() for name in body.speeds]
        self.all_rows = [row for joint in self.joints for row in joint.rows]
        self.rows = [row.name for row in self.all_rows]
        self.holonomic = np.array([row.holonomic for row in self.all_rows], dtype=bool)
        self.turns: dict[Any, float] = {}

    @property
    def nq(self) -> int:
        """Number of coordinates."""
        return len(self.names_q)

    @property
    def nv(self) -> int:
        """Number of velocities."""
        return len(self.names_v)

    @cached_property
    def mass(self) -> Array:
        """The mass matrix, constant with velocities in body axes."""
        m = np.zeros((self.nv, self.nv))
        for body in self.bodies.values():
            k, d = body.first_v, self.document.dimension
            m[k : k + d, k : k + d] = body.mass * np.eye(d)
            if body.rigid:
                n = len(body.velocities)
                m[k + d : k + n, k + d : k + n] = body.inertia
        return m

    @property
    def massless(self) -> bool:
        """Whether a body has no mass or no inertia."""
        return bool(np.any(np.diag(self.mass) == 0.0))

    # -- one state -----------------------------------------------------------------------------------------------------

    def at(self, t: float, q: Array, v: Array) -> State:
        """Return a state."""
        return State(self.bodies, t, q, v, self.turns)

    def follow(self, state: State) -> None:
        """Remember the angles in space of an accepted state."""
        self.constraints(state)
        self.loads(state)
        for joint in self.joints:
            for measure in joint.coordinates.values():
                measure(state)
        self.turns = {**self.turns, **{k: float(x.value) for k, x in state.motions.items() if isinstance(k, Turn)}}

    def constraints(self, state: State) -> Constraints:
        """Return the constraints and their two derivatives."""
        m = len(self.all_rows)
        phi, d, nu, gamma = np.zeros(m), np.zeros((m, self.nv)), np.zeros(m), np.zeros(m)
        for i, row in enumerate(self.all_rows):
            x = row.of(state)
            phi[i], d[i], gamma[i] = (x.value if row.holonomic else 0.0), x.gradient, -x.curve
            nu[i] = x.gradient @ state.v - x.rate
        return Constraints(phi, d, nu, gamma)

    def loads(self, state: State) -> tuple[Array, Array, float]:
        """Return applied and inertia forces, those without a potential among them, and the potential energy."""
        total, other, energy = np.zeros(self.nv), np.zeros(self.nv), 0.0
        gravity = self.document.gravity
        for body in self.bodies.values():
            k, d = body.first_v, self.document.dimension
            total[k : k + d] += body.mass * gravity
            energy -= body.mass * float(gravity @ state.frames[body.name][0])
            if d == 3 and body.rigid:
                spin = state.frames[body.name][2]
                total[k + 3 : k + 6] -= crossed(spin, body.inertia @ spin)
        for force in self.forces:
            load = force(state)
            total += load.conservative + load.other
            other += load.other
            energy += load.energy
        return total, other, energy

    def kinetic(self, v: Array) -> float:
        """Return the kinetic energy [J]."""
        return float(0.5 * v @ self.mass @ v)

    def rates_of(self, q: Array, v: Array) -> Array:
        """Return q'."""
        if not self.document.spatial:
            return v
        speeds = np.zeros(self.nq)
        for body in self.bodies.values():
            i, k = body.first_q, body.first_v
            speeds[i : i + 3] = v[k : k + 3]
            if body.rigid:
                speeds[i + 3 : i + 7] = rates(q[i + 3 : i + 7], v[k + 3 : k + 6])
        return speeds

    def moved(self, q: Array, dv: Array) -> Array:
        """Return q + N dv with Euler parameters of length 1."""
        moved = q + self.rates_of(q, dv)
        if self.document.spatial:
            for body in self.bodies.values():
                if body.rigid:
                    e = moved[body.first_q + 3 : body.first_q + 7]
                    e /= np.linalg.norm(e)
        return moved

    # -- accelerations, multipliers, reactions -------------------------------------------------------------------------

    def rank(self, d: Array) -> int:
        """Return the rank of D at a state that satisfies the constraints."""
        return int(np.sum(np.linalg.svd(scaled(d)[0], compute_uv=False) > CUTOFF)) if len(d) else 0

    def accelerations(self, c: Constraints, f: Array, rank: int) -> tuple[Array, Array]:
        """Return v' and multipliers: v' is nearest in the metric of the masses to M^-1 f with D v' = gamma (Gauss).

        Where rows depend on others the multipliers are some that do; see `multipliers` for those of least norm.
        """
        if not len(c.d):
            return np.asarray(np.linalg.solve(self.mass, f)), np.zeros(0)
        rows, lengths = scaled(c.d)
        gamma = c.gamma / lengths
        if self.massless:
            return self._with_massless(rows, lengths, gamma, f, rank)
        u, sizes, vt = np.linalg.svd(rows @ self._root, full_matrices=False)
        free = self._root @ f
        miss = (u.T @ (gamma - rows @ (self._root @ free)))[:rank] / sizes[:rank]
        return np.asarray(self._root @ (free + vt[:rank].T @ miss)), -(u[:, :rank] @ (miss / sizes[:rank])) / lengths

    @cached_property
    def _root(self) -> Array:
        """The root of M^-1, symmetric."""
        sizes, vectors = np.linalg.eigh(self.mass)
        return np.asarray(vectors @ np.diag(1.0 / np.sqrt(sizes)) @ vectors.T)

    def _with_massless(self, rows: Array, lengths: Array, gamma: Array, f: Array, rank: int) -> tuple[Array, Array]:
        """Return the same from the tangent space, where M is definite although it is not everywhere."""
        u, sizes, vt = np.linalg.svd(rows)
        fixed = vt[:rank].T @ ((u[:, :rank].T @ gamma) / sizes[:rank])
        free = vt[rank:].T
        a = fixed + free @ np.linalg.solve(free.T @ self.mass @ free, free.T @ (f - self.mass @ fixed))
        return np.asarray(a), (u[:, :rank] @ ((vt[:rank] @ (f - self.mass @ a)) / sizes[:rank])) / lengths

    def multipliers(self, c: Constraints, f: Array, a: Array, rank: int) -> tuple[Array, Array]:
        """Return the multipliers of least norm, and an orthonormal basis of what does not determine them."""
        if not len(c.d):
            return np.zeros(0), np.zeros((0, 0))
        u, sizes, vt = np.linalg.svd(c.d, full_matrices=True)
        lam = u[:, :rank] @ ((vt[:rank] @ (f - self.mass @ a)) / sizes[:rank])
        return lam, u[:, rank:]

    def reactions(self, state: State, d: Array, lam: Array) -> dict[str, Array]:
        """Return force and moment of each joint on its first body, -D^T lambda, in ground axes.

        Moments are about the joint's point on that body; where a kind of joint has no point, about the centre of mass,
        on the ground about the origin (docs/results.md).
        """
        places, i = {}, 0
        for joint in self.joints:
            n = len(joint.rows)
            works = -d[i : i + n].T @ lam[i : i + n]
            places[joint.name] = self._moved(state, joint, self._reaction(state, joint.bodies[0], works))
            i += n
        return places

    def _moved(self, state: State, joint: Joint, reaction: Array) -> Array:
        """Return force and moment about the joint's point of those about the centre of mass or the origin."""
        table = self.document.section("joints")[joint.name]
        if "at" not in table:
            return reaction
        d, at = self.document.dimension, table["at"][0] if "between" in table else table["at"]
        marker = self.parts.marker(joint.bodies[0], at)
        arm = marker.at if marker.body == GROUND else state.matrix(marker.body) @ marker.at
        force = reaction[:d]
        lever = crossed(arm, force) if d == 3 else np.array([arm[0] * force[1] - arm[1] * force[0]])
        return np.concatenate([force, reaction[d:] - lever])

    def _reaction(self, state: State, first: str, works: Array) -> Array:
        if first != GROUND:
            return self._on_body(state, first, works)
        d = self.document.dimension
        total = np.zeros(6 if d == 3 else 3)
        for body in self.bodies:
            part, r = self._on_body(state, body, works), state.frames[body][0]
            moment = crossed(r, part[:3]) if d == 3 else np.array([r[0] * part[1] - r[1] * part[0]])
            total -= part + np.concatenate([np.zeros(d), moment])
        return total

    def _on_body(self, state: State, name: str, works: Array) -> Array:
        body, d = self.bodies[name], self.document.dimension
        k = body.first_v
        moment = np.zeros(3 if d == 3 else 1)
        if body.rigid:
            moment = works[k + d : k + len(body.velocities)]
            moment = state.matrix(name) @ moment if d == 3 else moment
        return np.concatenate([works[k : k + d], moment])


def scaled(d: Array) -> tuple[Array, Array]:
    """Return rows of length 1, and their lengths before."""
    lengths = np.linalg.norm(d, axis=1)
    lengths = np.where(lengths > 0.0, lengths, 1.0)
    return d / lengths[:, np.newaxis], lengths


def read(raw: Mapping[str, Any], parameters: Mapping[str, float] | None = None) -> System:
    """Return the system that the tables of a file describe."""
    return System(Document(raw, parameters))
