"""Bodies in the plane with their joints, and pairs of surfaces: gaps, and the rows of their rates.

Coordinates are x, y and the angle of each body. All rows are analytic, so that complex steps differentiate them.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[Any]
#: Number of the body that does not move.
GROUND = -1
#: Step of derivatives, which cancels nothing.
_STEP = 1e-30


def point_of(q: Complex, body: int, at: Any) -> tuple[Complex, Complex]:
    """Return a point of a body, and its arm from the body's place, in the ground's frame."""
    if body == GROUND:
        return np.array(at) + 0.0 * q[:1], np.zeros(2)
    x, y, angle = q[3 * body : 3 * body + 3]
    c, s = np.cos(angle), np.sin(angle)
    arm = np.array([c * at[0] - s * at[1], s * at[0] + c * at[1]])
    return np.array([x, y]) + arm, arm


def turned(q: Complex, body: int, vector: Any) -> Complex:
    """Return a vector of a body in the ground's frame."""
    return point_of(q, body, vector)[1] if body != GROUND else np.array(vector) + 0.0 * q[:1]


def row_along(q: Complex, direction: Complex, points: tuple[tuple[int, Complex], ...]) -> Complex:
    """Return the row of the rate along a direction of material points, the first one's less the second one's."""
    row = 0.0 * q
    for (body, point), sign in zip(points, (1.0, -1.0), strict=True):
        if body != GROUND:
            k = 3 * body
            arm = point - q[k : k + 2]
            row[k : k + 2] += sign * direction
            row[k + 2] += sign * (arm[0] * direction[1] - arm[1] * direction[0])
    return row


@dataclass(frozen=True)
class Surface:
    """A disc (a point of radius 0, a hole below 0) or a line of a body.

    Attributes
    ----------
    body : int
        Its number.
    at : tuple of float
        Centre of the disc, point of the line.
    radius : float or None
        Of the disc; None for a line.
    normal : tuple of float
        Of the line.
    """

    body: int
    at: tuple[float, float] = (0.0, 0.0)
    radius: float | None = None
    normal: tuple[float, float] = (0.0, 1.0)


class Touching:
    """A disc beside another surface, with coefficients."""

    disc: Surface
    other: Surface
    sliding: float
    static: float
    restitution: float

    def look(self, q: Complex) -> tuple[Complex, Complex, Complex]:
        """Return the gap, the direction that pushes the disc, and the point that touches."""
        raise NotImplementedError

    def rows(self, q: Complex) -> tuple[Complex, Complex]:
        """Return the rows of the rates of the gap and along it."""
        _, normal, point = self.look(q)
        points = (self.disc.body, point), (self.other.body, point)
        along = np.array([normal[1], -normal[0]])
        return row_along(q, normal, points), row_along(q, along, points)

    def follow(self, q: Array, closed: bool) -> None:
        """Keep what touches as long as the gap is closed, where the surface has several parts."""

    def ends(self, q: Array) -> dict[str, float]:
        """Return how far the part that touches reaches, both ways."""
        return {}

    def passes(self, q: Array) -> bool:
        """Return whether it touches where a part ends, and not by a gap that closes."""
        return False

    def step(self, way: str) -> bool:
        """Go on to the next part; return whether there is one."""
        return False


@dataclass(frozen=True)
class Contact(Touching):
    """A disc beside another surface.

    Attributes
    ----------
    disc, other : Surface
        The pair.
    sliding, static, restitution : float
        Coefficients.
    """

    disc: Surface
    other: Surface
    sliding: float = 0.0
    static: float = 0.0
    restitution: float = 0.0

    def look(self, q: Complex) -> tuple[Complex, Complex, Complex]:
        """Return the gap, the direction that pushes the disc, and the point that touches."""
        centre, _ = point_of(q, self.disc.body, self.disc.at)
        place, _ = point_of(q, self.other.body, self.other.at)
        radius, apart = self.disc.radius or 0.0, centre - place
        if self.other.radius is None:
            normal = turned(q, self.other.body, self.other.normal)
            return apart @ normal - radius, normal, centre - radius * normal
        far = np.sqrt(apart @ apart)
        sign = 1.0 if self.other.radius >= 0.0 else -1.0
        normal = sign * apart / far if far != 0.0 else np.array([0.0, 1.0]) + 0.0 * q[:1]  # centres that meet
        gap = sign * far - radius - self.other.radius
        return gap, normal, centre - radius * normal


@dataclass(frozen=True)
class Pin:
    """A point of one body on a point of another one."""

    one: int
    other: int
    at: tuple[float, float]
    on: tuple[float, float]

    def look(self, q: Complex) -> tuple[Complex, Complex]:
        """Return what is to be zero, and its rows."""
        first, second = point_of(q, self.other, self.on)[0], point_of(q, self.one, self.at)[0]
        points = (self.other, first), (self.one, second)
        return first - second, np.array([row_along(q, axis, points) for axis in np.eye(2)])


@dataclass(frozen=True)
class Rail:
    """A body that moves along a line of the ground, at angle 0."""

    body: int
    on: tuple[float, float]
    axis: tuple[float, float]

    def look(self, q: Complex) -> tuple[Complex, Complex]:
        """Return what is to be zero, and its rows."""
        k, (x, y) = 3 * self.body, self.axis
        row, turn = 0.0 * q, 0.0 * q
        row[k], row[k + 1], turn[k + 2] = -y, x, 1.0
        off = -y * (q[k] - self.on[0]) + x * (q[k + 1] - self.on[1])
        return np.array([off, q[k + 2]]), np.array([row, turn])


@dataclass(frozen=True)
class Spring:
    """A force on the place of a body towards a point: stiffness and damping for each axis."""

    body: int
    to: tuple[float, float]
    stiffness: tuple[float, float]
    damping: tuple[float, float]


@dataclass
class Scene:
    """Bodies, joints, springs and contacts.

    `longest`, `near`, `slow` and `turns`: longest step [s], gaps that count as zero [m], rates of impacts that do not
    spring back, and rates of gaps that open after such impacts in turn below which all come to rest [m/s].
    """

    masses: Array
    gravity: tuple[float, float]
    joints: list[Pin | Rail] = field(default_factory=list)
    springs: list[Spring] = field(default_factory=list)
    contacts: list[Touching] = field(default_factory=list)
    longest: float = 4e-3
    near: float = 1e-11
    slow: float = 1e-7
    turns: float = 3e-7

    def forces(self, q: Array, v: Array) -> Array:
        """Return applied forces."""
        force = np.zeros(len(q))
        force[0::3], force[1::3] = self.masses[0::3] * self.gravity[0], self.masses[1::3] * self.gravity[1]
        for spring in self.springs:
            for axis in range(2):
                k = 3 * spring.body + axis
                force[k] -= spring.stiffness[axis] * (q[k] - spring.to[axis]) + spring.damping[axis] * v[k]
        return force

    def held(self, q: Complex) -> Complex:
        """Return the rows of all joints."""
        rows = [joint.look(q)[1] for joint in self.joints]
        return np.concatenate(rows) if rows else np.zeros((0, len(q)))

    def off(self, q: Array) -> Array:
        """Return what joints leave."""
        parts = [joint.look(q)[0] for joint in self.joints]
        return np.concatenate(parts) if parts else np.zeros(0)

    def touching(self, q: Complex, which: Collection[int] | None = None) -> tuple[Complex, Complex]:
        """Return the rows of all contacts, of their gaps and along them; 0 of others than asked for."""
        none = 0.0 * q, 0.0 * q
        rows = [c.rows(q) if which is None or i in which else none for i, c in enumerate(self.contacts)]
        return np.array([row for row, _ in rows]), np.array([row for _, row in rows])

    def gaps(self, q: Array) -> Array:
        """Return all gaps."""
        return np.array([float(np.real(contact.look(q)[0])) for contact in self.contacts])

    def all_rows(self, q: Array, v: Array, which: Collection[int] | None = None) -> tuple[Array, Array, Array]:
        """Return the rows of joints, gaps and slips, what their rates gain without accelerations, and masses."""
        rows = np.concatenate([self.held(q + _STEP * 1j * v), *self.touching(q + _STEP * 1j * v, which)])
        return np.real(rows), np.imag(rows) @ v / _STEP, self.masses

    def closed(self, q: Array) -> Array:
        """Return a place at which joints are closed."""
        for _ in range(4):
            rows = np.real(self.held(q))
            if len(rows):
                q = q - np.linalg.pinv(rows) @ np.real(self.off(q))
        return q
