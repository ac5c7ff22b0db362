"""What joints and forces are made of: rows, coordinates, loads, and names resolved to markers and directions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from benchmarks.plain.bodies import GROUND, Body, Marker, State
from benchmarks.plain.document import Document
from benchmarks.plain.moving import Array, Moving, crossed

#: Something that moves, of a state.
Measure = Callable[[State], Moving]


@dataclass(frozen=True, eq=False)
class Row:
    """A constraint: `of` gives Phi with its rates; for a nonholonomic row the rate is what has to vanish."""

    name: str
    of: Measure
    holonomic: bool = True


@dataclass(frozen=True, eq=False)
class Turn:
    """An angle in space, known up to whole turns: of `pointer` from `zero` towards `quarter`."""

    of: Callable[[State, float], Moving]

    def __call__(self, state: State) -> Moving:
        """Return the angle on the branch nearest to the one remembered."""
        if self not in state.motions:
            state.motions[self] = self.of(state, state.turns.get(self, 0.0))
        return state.motions[self]


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint.

    Attributes
    ----------
    bodies : tuple of str
        The bodies it joins; reactions are told on the first.
    rows : list of Row
        Its constraints.
    coordinates : mapping
        What it reports, by label.
    margins : list
        Numbers between 0 and 1 that fall to 0 where the joint becomes singular.
    """

    name: str
    bodies: tuple[str, ...]
    rows: list[Row]
    coordinates: Mapping[str, Measure] = field(default_factory=dict)
    margins: list[Callable[[State], float]] = field(default_factory=list)


@dataclass(frozen=True)
class Load:
    """What a force does in one state.

    Attributes
    ----------
    conservative, other : Array, shape (nv,)
        Generalised forces with a potential and without.
    energy : float
        Potential energy [J].
    """

    conservative: Array
    other: Array
    energy: float


@dataclass(frozen=True)
class Triad:
    """Three perpendicular directions of a body; the third is a joint's axis."""

    first: Marker
    second: Marker
    axis: Marker

    def __iter__(self) -> Any:
        return iter((self.first, self.second, self.axis))


class Parts:
    """Names and numbers of a file as markers, directions and joints."""

    def __init__(
        self,
        document: Document,
        bodies: Mapping[str, Body],
        kinds: Mapping[str, Callable[[Parts, str, Mapping[str, Any]], Joint]],
    ) -> None:
        self.document, self.bodies, self._kinds = document, bodies, kinds
        self._joints: dict[str, Joint] = {}
        q = np.concatenate([b.start for b in bodies.values()])
        self.described = State(bodies, 0.0, q, np.zeros(sum(len(b.velocities) for b in bodies.values())), {})

    def joint(self, name: str) -> Joint:
        """Return a joint, made when it is first asked for: a driver may stand before the joint it drives."""
        if name not in self._joints:
            table = self.document.section("joints")[name]
            self._joints[name] = self._kinds[table["type"]](self, name, table)
        return self._joints[name]

    def marker(self, body: str, point: Any) -> Marker:
        """Return a point: its name, ``"centre"`` or coordinates in the body's frame."""
        if body == GROUND:
            return Marker(body, self.document.array(point))
        described = self.bodies[body]
        if point == "centre":
            return Marker(body, np.zeros(self.document.dimension))
        at = described.points[point] if isinstance(point, str) else self.document.array(point)
        return Marker(body, at - described.centre if described.rigid else np.zeros(self.document.dimension))

    def ends(self, table: Mapping[str, Any]) -> tuple[Marker, Marker]:
        """Return the two points that a joint or force is between."""
        (a, b), (at_a, at_b) = table["between"], table["at"]
        return self.marker(a, at_a), self.marker(b, at_b)

    def unit(self, vector: Any) -> Array:
        """Return a direction of length 1."""
        x = self.document.array(vector)
        unit: Array = x / np.linalg.norm(x)
        return unit

    def triad(self, body: str, axis: Any, reference: Any = None) -> Triad:
        """Return a triad about an axis of one body."""
        along = self.unit(axis)
        first = across_any(along) if reference is None else across(self.unit(reference), along)
        return made(body, first, along)

    def triads(self, a: str, b: str, axis: Any, reference: Any = None) -> tuple[Triad, Triad]:
        """Return triads of two bodies whose axes are one, and whose first directions coincide at angle 0."""
        in_a, in_b = self.described.matrix(a), self.described.matrix(b)
        carry = in_b.T @ in_a
        if isinstance(axis[0], list | tuple):
            along_a, along_b = self.unit(axis[0]), self.unit(axis[1])
        else:
            along_a = self.unit(axis)
            along_b = carry @ along_a
        if reference is not None:
            return made(a, across(self.unit(reference[0]), along_a), along_a), made(
                b, across(self.unit(reference[1]), along_b), along_b
            )
        first = across_any(along_a)
        # as the bodies start, after the shortest turn that brings one axis to the other
        x, old = carry @ first, carry @ along_a
        swung = x - (x @ along_b) / (1.0 + old @ along_b) * (old + along_b)
        return made(a, first, along_a), made(b, across(swung, along_b), along_b)


def across(vector: Array, axis: Array) -> Array:
    """Return the part of a vector across an axis, of length 1."""
    rest = vector - (vector @ axis) * axis
    unit: Array = rest / np.linalg.norm(rest)
    return unit


def across_any(axis: Array) -> Array:
    """Return the frame's axis that comes after the nearest one, made perpendicular."""
    return across(np.eye(3)[(int(np.argmax(np.abs(axis))) + 1) % 3], axis)


def made(body: str, first: Array, axis: Array) -> Triad:
    """Return a right-handed triad."""
    return Triad(Marker(body, first), Marker(body, crossed(axis, first)), Marker(body, axis))
