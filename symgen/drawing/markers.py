"""What a joint or force is made of, found in its measures: points, directions, radii, as numbers of one run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np

from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Mechanism
from symgen.drawing.scene import GROUNDED, Array, BodyFrame, Point, Poses, frames_of, is_spatial
from symgen.vocabulary.measures import GROUND, Direction, Marker


def parts(value: Any) -> Iterator[Any]:
    """Yield a value and everything inside it."""
    yield value
    if isinstance(value, msgspec.Struct):
        for field in value.__struct_fields__:
            yield from parts(getattr(value, field))
    elif isinstance(value, tuple):
        for item in value:
            yield from parts(item)


@dataclass(frozen=True)
class BodyPoint:
    """A point of a body: its index, and where it is on it."""

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
        self.mechanism, self.values, self.spatial = mechanism, values, is_spatial(mechanism)
        self.frames: tuple[BodyFrame, ...] = frames_of(mechanism)
        self.index = {frame.name: i for i, frame in enumerate(self.frames)} | {GROUND: GROUNDED}
        self.centres = {body.name: self.vector(body.centre_of_mass) for body in mechanism.bodies}
        self.centres[GROUND] = np.zeros(3)
        self.all = [Poses(self.frames, row, self.spatial) for row in q]
        self.now = self.all[0]
        state = {f"{b.name}.{c}" for b in mechanism.bodies for c in (*b.coordinates, *b.speeds)}
        names = [f"{b.name}.{c}" for b in mechanism.bodies for c in b.coordinates]
        self.state = {**dict.fromkeys(state, 0.0), **dict(zip(names, map(float, q[0]), strict=True)), "t": 0.0}

    def number(self, expression: Any) -> float:
        """Return a constant of the mechanism."""
        return evaluate(expression, self.values)

    def at(self, expression: Any, further: Mapping[str, float]) -> float:
        """Return what a formula of the state is in the first positions, at rest."""
        known = {**self.values, **self.state, **further}
        return evaluate(expression, known, tables={table.name: table for table in self.mechanism.tables})

    def vector(self, expressions: Any) -> Array:
        """Return a vector of constants with three components."""
        found = np.zeros(3)
        found[: len(expressions)] = [self.number(e) for e in expressions]
        return found

    def place(self, marker: Marker) -> BodyPoint:
        """Return a marker as a point from the centre of mass of its body."""
        x, y, z = self.vector(marker.point) - self.centres[marker.body]
        return BodyPoint(self.index[marker.body], (float(x), float(y), float(z)))

    def out(self, place: BodyPoint) -> Array:
        """Return where a point is, shape (3,)."""
        return np.asarray(self.now.out(place.body, [place.at])[0])

    def direction(self, direction: Direction) -> Array:
        """Return a direction in the ground frame, of length 1."""
        found = self.now.turns[self.index[direction.body]] @ self.vector(direction.vector)
        length = float(np.linalg.norm(found))
        return np.asarray(found / length if length else found)

    def markers(self, value: Any) -> list[BodyPoint]:
        """Return the different points that a value names, in order."""
        return list(dict.fromkeys(self.place(m) for m in parts(value) if isinstance(m, Marker)))

    def directions(self, value: Any) -> list[Direction]:
        """Return the different directions that a value names, in order."""
        return list(dict.fromkeys(d for d in parts(value) if isinstance(d, Direction)))

    def span(self, a: BodyPoint, b: BodyPoint, along: Array) -> tuple[float, float]:
        """Return from where to where b moves along a direction, which a's body carries, as seen from a [m].

        The guide of a body that moves begins at the body's own point; that of the ground is only as long as it is used.
        """
        own = self.now.turns[a.body].T @ along
        found = [] if a.body == GROUNDED else [0.0]
        for poses in self.all:
            d = poses.out(b.body, [b.at])[0] - poses.out(a.body, [a.at])[0]
            found.append(float(d @ (poses.turns[a.body] @ own)))
        return min(found), max(found)
