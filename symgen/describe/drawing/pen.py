"""A mechanism in its positions, and marks laid out there, fixed to bodies or to frames that bodies carry."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate
from typing import Any

import numpy as np

from symgen.base.vocabulary.measures import GROUND, Direction, Marker, markers_in, nested_parts
from symgen.describe.drawing.scene import (
    COLOURS,
    GREY,
    GROUNDED,
    INK,
    PAPER,
    Array,
    Bent,
    BodyFrame,
    CarriedFrame,
    DrawnCircle,
    Line,
    Look,
    Mark,
    Point,
    Poses,
    Solid,
    Stretch,
    Tube,
)
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import AnyBody, Mechanism


@dataclass(frozen=True)
class BodyPoint:
    """A point of a body: the body's index, and the place on it."""

    body: int
    at: Point


class PlacedMechanism:
    """A mechanism with numbers for its parameters, in the positions that symbols are laid out for.

    Parameters
    ----------
    mechanism : Mechanism
        What is drawn.
    values : mapping of str to float
        Parameters.
    q : Array, shape (k, nq)
        Positions; symbols are laid out for the first, guides long enough for all.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, float], q: Array) -> None:
        self.mechanism, self.values, self.spatial = mechanism, values, mechanism.space == "spatial"
        self._places = dict[Marker, BodyPoint]()  # the same points belong to bodies, joints and forces
        self._markers = dict[object, list[BodyPoint]]()
        self.outlines: dict[str, int] = {}  # modal body -> number of the frame of the first point of its outline
        bodies: tuple[AnyBody, ...] = mechanism.bodies
        self.frames = tuple(self._frames_of_bodies(bodies))
        self.index = {body.name: i for i, body in enumerate(bodies)} | {GROUND: GROUNDED}
        self.centres = {body.name: self.vector(body.centre_of_mass) for body in mechanism.bodies}
        self.centres[GROUND] = np.zeros(3)
        self.rows = q
        self.now = Poses(self.frames, q[0], self.spatial)
        state = {f"{b.name}.{c}" for b in mechanism.bodies for c in (*b.coordinates, *b.speeds)}
        names = [f"{b.name}.{c}" for b in mechanism.bodies for c in b.coordinates]
        self.state = {**dict.fromkeys(state, 0.0), **dict(zip(names, map(float, q[0]), strict=True)), "t": 0.0}

    def _frames_of_bodies(self, bodies: tuple[AnyBody, ...]) -> list[BodyFrame]:
        """Return the frames of bodies, then one for each point of the outlines of modal ones."""
        frames, firsts = list[BodyFrame](), list(accumulate((len(body.coordinates) for body in bodies), initial=0))
        places, modes = {body.name: i for i, body in enumerate(bodies)}, dict[str, int]()
        for body, first in zip(bodies, firsts, strict=False):
            count = 0 if body.modal is None else len(body.modal.stiffness)
            size = len(body.coordinates) - count
            modes[body.name] = first + size
            bent = None
            if (own := body.carried) is not None:
                bent = Bent(
                    places[own.host],
                    modes[own.host],
                    _point(own.place),
                    tuple(map(_point, own.shape)),
                    tuple(_point(turn) if len(turn) == 3 else (0.0, 0.0, turn[0]) for turn in own.turn),
                )
            frames.append(BodyFrame(body.name, first, size, bent))
        for body in bodies:
            if body.modal is None:
                continue
            self.outlines[body.name] = len(frames)
            centre, outline = self.vector(body.centre_of_mass), body.modal.outline
            for point, shape in zip(outline.points, outline.shapes, strict=True):
                x, y, z = np.array(_point(point)) - centre
                still = ((0.0, 0.0, 0.0),) * len(shape)
                at = (float(x), float(y), float(z))
                bent = Bent(places[body.name], modes[body.name], at, tuple(map(_point, shape)), still)
                frames.append(BodyFrame(body.name, 0, 0, bent))
        return frames

    @cached_property
    def all(self) -> list[Poses]:
        """The poses in all positions, which guides alone ask for."""
        return [Poses(self.frames, row, self.spatial) for row in self.rows]

    def number(self, expression: Any) -> float:
        """Return a constant of the mechanism."""
        return evaluate_formula(expression, self.values)

    def value_of_formula(self, expression: Any, further: Mapping[str, float]) -> float:
        """Return the value of a formula of the state in the first positions, at rest."""
        values = {**self.values, **self.state, **further}
        return evaluate_formula(expression, values, tables={table.name: table for table in self.mechanism.tables})

    def vector(self, expressions: Any) -> Array:
        """Return a vector of constants with three components."""
        vector = np.zeros(3)
        vector[: len(expressions)] = [self.number(e) for e in expressions]
        return vector

    def place(self, marker: Marker) -> BodyPoint:
        """Return a marker as a point from the centre of mass of its body."""
        if (found := self._places.get(marker)) is None:
            x, y, z = self.vector(marker.point) - self.centres[marker.body]
            found = self._places[marker] = BodyPoint(self.index[marker.body], (float(x), float(y), float(z)))
        return found

    def in_ground_frame(self, place: BodyPoint) -> Array:
        """Return a point in the ground frame, shape (3,)."""
        return np.asarray(self.now.to_ground(place.body, [place.at])[0])

    def direction(self, direction: Direction) -> Array:
        """Return a direction in the ground frame, of length 1."""
        turned = self.now.turns[self.index[direction.body]] @ self.vector(direction.vector)
        length = float(np.linalg.norm(turned))
        return np.asarray(turned / length if length else turned)

    def markers(self, value: object) -> list[BodyPoint]:
        """Return the different points that a value names, in order."""
        if (found := self._markers.get(value)) is None:
            found = list(dict.fromkeys(map(self.place, markers_in(value))))
            self._markers[value] = found
        return found

    def directions(self, value: object) -> list[Direction]:
        """Return the different directions that a value names, in order."""
        return list(dict.fromkeys(d for d in nested_parts(value) if isinstance(d, Direction)))

    def range_along(self, a: BodyPoint, b: BodyPoint, along: Array) -> tuple[float, float]:
        """Return the range of b along a direction that a's body carries, as seen from a [m].

        The guide of a body that moves begins at the body's own point; that of the ground is only as long as it is used.
        """
        places = [*self.ends_of_travel(a, b, along), *([] if a.body == GROUNDED else [0.0])]
        return min(places), max(places)

    def ends_of_travel(self, a: BodyPoint, b: BodyPoint, along: Array) -> tuple[float, float]:
        """Return the ends of b's displacement from a along a direction that a's body carries [m]."""
        own, places = self.now.turns[a.body].T @ along, list[float]()
        for poses in self.all:
            d = poses.to_ground(b.body, [b.at])[0] - poses.to_ground(a.body, [a.at])[0]
            places.append(float(d @ (poses.turns[a.body] @ own)))
        return min(places), max(places)


def _point(components: tuple[float, ...]) -> Point:
    """Return a point with three components."""
    x, y, z = (*components, 0.0)[:3]
    return (x, y, z)


#: How joints and the ground are drawn.
PLAIN, FILLED, EARTH = Look(INK, "", 1.2), Look(INK, PAPER, 1.2), Look(GREY, "", 1.0)
RIGID = Look(INK, INK, 1.0)


class Pen:
    """Draws at sizes of one unit.

    Parameters
    ----------
    numbers : PlacedMechanism
        The mechanism in its positions.
    unit : float
        Size of a joint's symbol [m].
    up : Point
        Against gravity.

    Attributes
    ----------
    carried : list of CarriedFrame
        Frames requested so far, other than those of the bodies.
    """

    def __init__(self, numbers: PlacedMechanism, unit: float, up: Point) -> None:
        self.numbers, self.unit, self.up = numbers, unit, np.array(up)
        self.carried: list[CarriedFrame] = []

    def colour(self, body: int) -> str:
        """Return the colour of a body; the ground is grey."""
        return GREY if body == GROUNDED else COLOURS[body % len(COLOURS)]

    def add_carried_frame(self, place: BodyPoint, turned: int) -> int:
        """Return the number of a frame that moves with a point and has the directions of a body, or of the ground.

        This is the body's own frame if it always has those directions.
        """
        frames, still = self.numbers.frames, 3 if self.numbers.spatial else 2  # coordinates of a body that is a point
        is_point = frames[place.body].size == still if turned == GROUNDED else False
        if place.body == turned or is_point:
            return place.body
        frame = CarriedFrame(place.body, place.at, turned)
        if frame not in self.carried:
            self.carried.append(frame)
        return len(frames) + self.carried.index(frame)

    def points(self, body: int, points: Sequence[Array] | Array) -> tuple[Point, ...]:
        """Return points of the ground frame as points of a frame."""
        now, places, frames = self.numbers.now, np.asarray(points, dtype=np.float64), self.numbers.frames
        if body < len(frames):
            local = now.to_body(body, places)
        else:
            own = self.carried[body - len(frames)]
            local = (places - now.to_ground(own.body, [own.at])) @ now.turns[own.turned]
        return tuple((float(x), float(y), float(z)) for x, y, z in local)

    def line(self, body: int, points: Sequence[Array] | Array, look: Look = PLAIN, closed: bool = False) -> Line:
        """Return a polyline of a body."""
        return Line(body, self.points(body, points), look, closed)

    def dot(self, place: BodyPoint, radius: float, look: Look = FILLED, mass: bool = False) -> DrawnCircle:
        """Return a circle; its radius is in units."""
        return DrawnCircle(place.body, place.at, radius * self.unit, look, mass)

    def tube(self, body: int, a: Array, b: Array, radius: float, look: Look = FILLED) -> Tube:
        """Return a round bar; its radius is in units."""
        ends = self.points(body, [a, b])
        return Tube(body, ends[0], ends[1], radius * self.unit, look)

    def stretch(self, kind: str, a: BodyPoint, b: BodyPoint, look: Look) -> Stretch:
        """Return the line from one point to another."""
        return Stretch(kind, a.body, a.at, b.body, b.at, self.unit, look)

    def ring(self, body: int, at: Array, axis: Array, radius: float, look: Look = PLAIN) -> Line:
        """Return a circle about an axis; its radius is in metres."""
        first, second = directions_across_axis(axis)
        turn = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)[:, None]
        return self.line(body, at + radius * (np.cos(turn) * first + np.sin(turn) * second), look, closed=True)

    def arrow(self, body: int, points: Array, look: Look) -> list[Mark]:
        """Return a line with a head at its end."""
        end, way = points[-1], points[-1] - points[-2]
        way = way / (float(np.linalg.norm(way)) or 1.0)
        side = np.array([-way[1], way[0], 0.0]) if not self.numbers.spatial else directions_across_axis(way)[0]
        head = np.array([end, end - self.unit * (0.9 * way - 0.35 * side), end - self.unit * (0.9 * way + 0.35 * side)])
        return [self.line(body, points, look), self.line(body, head, Look(look.ink, look.ink, 0.5), closed=True)]

    def turning_arrow(self, body: int, at: Array, axis: Array, radius: float, look: Look) -> list[Mark]:
        """Return an arrow that turns about an axis; its radius is in units."""
        first, second = directions_across_axis(axis)
        turn = np.linspace(0.0, 2.0 * np.pi * 0.72, 20)[:, None]
        points = at + radius * self.unit * (np.cos(turn) * first + np.sin(turn) * second)
        return self.arrow(body, points, look)

    def box(self, body: int, at: Array, frame: Array, size: Array, look: Look) -> Mark:
        """Return a box about a point, its axes the rows of `frame` and its edges in metres."""
        half = 0.5 * size[:, None] * frame
        if not self.numbers.spatial:
            corners = [at + i * half[0] + j * half[1] for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            return self.line(body, corners, look, closed=True)
        faces = []
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            for sign in (1.0, -1.0):
                turn = ((-1, -1), (1, -1), (1, 1), (-1, 1))[:: int(sign)]
                faces.append(self.points(body, [at + sign * half[k] + s * half[i] + t * half[j] for s, t in turn]))
        return Solid(body, tuple(faces), look)

    def ground_hatching(self, at: Array, along: Array, depth: Array) -> list[Mark]:
        """Return a line of the ground with hatches on its far side, three units long."""
        u = self.unit
        marks: list[Mark] = [self.line(GROUNDED, [at - 1.5 * u * along, at + 1.5 * u * along], Look(INK, "", 1.2))]
        for k in range(5):
            foot = at + (-1.2 + 0.6 * k) * u * along
            marks.append(self.line(GROUNDED, [foot, foot + 0.55 * u * (depth - 0.8 * along)], EARTH))
        return marks

    def rail(self, body: int, at: Array, along: Array, span: tuple[float, float], side: Array) -> list[Mark]:
        """Return a guide along a direction: hatched where it is the ground's, else a plain line."""
        u = self.unit
        start, end = span[0] - 2.2 * u, span[1] + 2.2 * u
        marks: list[Mark] = [self.line(body, [at + start * along, at + end * along])]
        if body == GROUNDED:
            count = min(60, max(3, round((end - start) / u)))
            for k in range(count):
                foot = at + (start + (end - start) * (k + 0.5) / count) * along
                marks.append(self.line(body, [foot, foot + 0.5 * u * (side - 0.8 * along)], EARTH))
        return [replace(mark, guide=True) for mark in marks if isinstance(mark, Line)]


def directions_across_axis(axis: Array) -> tuple[Array, Array]:
    """Return two directions across an axis and each other, so that the three make a right-handed frame."""
    axis = axis / (float(np.linalg.norm(axis)) or 1.0)
    first = np.cross(np.eye(3)[int(np.argmin(np.abs(axis)))], axis)
    first = first / (float(np.linalg.norm(first)) or 1.0)
    if abs(axis[2]) > 0.999:  # in the plane angles count from x
        first = np.array([1.0, 0.0, 0.0])
    return first, np.cross(axis, first)
