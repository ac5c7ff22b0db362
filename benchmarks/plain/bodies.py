"""Bodies of a file, and where their points and directions are in a state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from benchmarks.plain.document import Document
from benchmarks.plain.moving import Array, Moving, constant, crossed, skew
from benchmarks.plain.turning import euler_parameters, inertia, orientation, rotation

GROUND = "ground"


@dataclass(frozen=True, eq=False)
class Marker:
    """A point fixed in a body, from its centre of mass in its frame; of the ground in ground axes [m]."""

    body: str
    at: Array


@dataclass(frozen=True, eq=False)
class Body:
    """A body and where its part of q and v begins.

    Attributes
    ----------
    rigid : bool
        False for a point mass.
    inertia : Array, shape (3, 3) or ()
        About the centre of mass in body axes [kg m^2]; 0 for a point mass.
    centre : Array
        The centre of mass in the body's frame [m].
    start : Array
        The part of q as it is described.
    velocities : list of float or None
        As they are described.
    """

    name: str
    rigid: bool
    mass: float
    inertia: Array
    centre: Array
    points: Mapping[str, Array]
    start: Array
    velocities: list[float | None]
    first_q: int
    first_v: int

    @property
    def coordinates(self) -> list[str]:
        """Names of the coordinates."""
        return [f"{self.name}.{label}" for label in _labels(len(self.centre), self.rigid)[0]]

    @property
    def speeds(self) -> list[str]:
        """Names of the velocities."""
        return [f"{self.name}.{label}" for label in _labels(len(self.centre), self.rigid)[1]]


def _labels(dimension: int, rigid: bool) -> tuple[list[str], list[str]]:
    if dimension == 2:
        return ["x", "y", *["theta"] * rigid], ["vx", "vy", *["omega"] * rigid]
    return ["x", "y", "z", *["e0", "e1", "e2", "e3"] * rigid], ["vx", "vy", "vz", *["wx", "wy", "wz"] * rigid]


def bodies(document: Document) -> dict[str, Body]:
    """Return the bodies of a file in their order."""
    bodies: dict[str, Body] = {}
    nq = nv = 0
    for name, table in document.section("bodies").items():
        body = _body(document, name, table, nq, nv)
        bodies[name] = body
        nq, nv = nq + len(body.start), nv + len(body.velocities)
    return bodies


def _body(document: Document, name: str, table: Mapping[str, Any], nq: int, nv: int) -> Body:
    rigid, d = table.get("type", "rigid") == "rigid", document.dimension
    mass, centre = document.number(table["mass"]), document.vector(table, "centre_of_mass")
    velocity: list[float | None] = [None] * d
    if "velocity" in table:
        velocity = [float(x) for x in document.array(table["velocity"])]
    position = document.vector(table, "position")
    tensor, turn = np.zeros(()), np.zeros(0)
    spin: list[float | None] = []
    if rigid and document.spatial:
        matrix = orientation(document, table.get("orientation"))
        tensor, turn = inertia(document, table, mass, centre), euler_parameters(matrix)
        turning = table.get("angular_velocity")
        spin = [None] * 3 if turning is None else [float(x) for x in document.array(turning)]
        position = position + matrix @ centre
    elif rigid:
        angle = document.number(table.get("angle", 0.0))
        tensor, turn = np.asarray(document.number(table["inertia"])), np.array([angle])
        spin = [document.number(table["angular_velocity"]) if "angular_velocity" in table else None]
        position = position + plane_turn(angle) @ centre
    points = {label: document.array(at) for label, at in table.get("points", {}).items()}
    start = np.concatenate([position, turn])
    return Body(name, rigid, mass, tensor, centre, points, start, velocity + spin, nq, nv)


def plane_turn(angle: float) -> Array:
    """Return the matrix of a turn in the plane."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


@dataclass(eq=False)
class State:
    """One state of a mechanism, in which whatever moves is evaluated once.

    Attributes
    ----------
    bodies : mapping
        The bodies.
    t : float
        Time [s].
    q, v : Array
        Coordinates and velocities.
    turns : mapping
        Element -> the angle it had last, for angles that are known up to whole turns only.
    """

    bodies: Mapping[str, Body]
    t: float
    q: Array
    v: Array
    turns: Mapping[Any, float]
    frames: dict[str, tuple[Array, Array, Array]] = field(default_factory=dict)
    motions: dict[Any, Moving] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for body in self.bodies.values():
            d, i, k = len(body.centre), body.first_q, body.first_v
            matrix, spin = np.eye(d), np.zeros(3 if d == 3 else 1)
            if body.rigid:
                matrix = rotation(self.q[i + 3 : i + 7]) if d == 3 else plane_turn(float(self.q[i + 2]))
                spin = self.v[k + d : k + len(body.velocities)]
            self.frames[body.name] = self.q[i : i + d], matrix, spin

    @property
    def nv(self) -> int:
        """Number of velocities."""
        return len(self.v)

    def matrix(self, body: str) -> Array:
        """Return the rotation matrix from body to ground axes."""
        d = len(next(iter(self.bodies.values())).centre)
        return np.eye(d) if body == GROUND else self.frames[body][1]

    def fixed(self, body: str, vector: Array) -> Moving:
        """Return a vector fixed in a body, in ground axes."""
        if body == GROUND or not self.bodies[body].rigid:
            return constant(vector, self.nv)
        _, matrix, spin = self.frames[body]
        d, k = len(vector), self.bodies[body].first_v
        gradient = np.zeros((d, self.nv))
        value = matrix @ vector
        if d == 2:
            left = np.array([-value[1], value[0]])
            gradient[:, k + 2] = left
            return Moving(value, gradient, spin[0] * left, -(spin[0] ** 2) * value)
        gradient[:, k + 3 : k + 6] = -matrix @ skew(vector)
        once = crossed(spin, vector)
        return Moving(value, gradient, matrix @ once, matrix @ crossed(spin, once))

    def point(self, marker: Marker) -> Moving:
        """Return where a marker is."""
        if marker not in self.motions:
            moving = self.fixed(marker.body, marker.at)
            if marker.body != GROUND:
                body, d = self.bodies[marker.body], len(marker.at)
                moving.value = moving.value + self.frames[marker.body][0]
                moving.gradient[:, body.first_v : body.first_v + d] += np.eye(d)
                moving.rate = moving.rate + self.v[body.first_v : body.first_v + d]
            self.motions[marker] = moving
        return self.motions[marker]

    def between(self, a: Marker, b: Marker) -> Moving:
        """Return the vector from a to b."""
        if (a, b) not in self.motions:
            self.motions[a, b] = self.point(b) - self.point(a)
        return self.motions[a, b]

    def along(self, direction: Marker) -> Moving:
        """Return a direction, kept as a marker whose coordinates are the direction's components."""
        key = ("direction", direction)
        if key not in self.motions:
            self.motions[key] = self.fixed(direction.body, direction.at)
        return self.motions[key]

    def angle(self, body: str) -> Moving:
        """Return the angle of a body in the plane."""
        if body == GROUND:
            return constant(0.0, self.nv)
        k, i = self.bodies[body].first_v + 2, self.bodies[body].first_q + 2
        number = constant(self.q[i], self.nv)
        number.gradient[k] = 1.0
        number.rate = np.asarray(self.v[k])
        return number

    def spin(self, body: str) -> Moving:
        """Return the angular velocity in ground axes as if it were a rate: its `rate` is it, its `curve` its rate."""
        vector = constant(np.zeros(3), self.nv)
        if body != GROUND and self.bodies[body].rigid:
            k = self.bodies[body].first_v + 3
            vector.gradient[:, k : k + 3] = self.frames[body][1]
            vector.rate = self.frames[body][1] @ self.frames[body][2]
        return vector
