"""Shapes of contacts in space: spheres, planes, rims of discs, capsules and boxes, and the table of their pairs."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product as combinations
from typing import Any

import msgspec

from symgen.base.registry import Registry
from symgen.base.vocabulary.expressions import Expr, Number, product, sum_of_terms
from symgen.base.vocabulary.measures import Direction, Marker
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.surfaces import Disc, Touch, speed_of_surface, two_tables, word_of_shape
from symgen.describe.parts.fields import Point, Scalar, TimeVector, Vector, read_table
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import directions_across

#: The word for a shape whose table names none.
SPHERE = "sphere"


class SphereTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A sphere: a point where its radius is 0, a hollow one where it is below 0.

    Parameters
    ----------
    body : str
        Its body, or ``"ground"``.
    at : point
        Its centre; the origin of the body by default.
    sphere : scalar
        Its radius [m].
    """

    body: str
    at: Point = (0.0, 0.0, 0.0)
    sphere: Scalar = 0.0


class PlaneTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A plane without edges.

    Parameters
    ----------
    plane : str
        Its body, or ``"ground"``.
    on : point
        A point on it; the origin by default.
    normal : vector
        Its direction towards what it meets; the third axis by default.
    surface_velocity : vector
        Velocity with which its surface moves along it, as a belt does, in the frame of its body [m/s]: numbers or
        formulas of t.
    """

    plane: str
    on: Point = (0.0, 0.0, 0.0)
    normal: Vector = (0.0, 0.0, 1.0)
    surface_velocity: TimeVector | None = None


class RimTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The rim of a thin disc.

    Parameters
    ----------
    body : str
        Its body, or ``"ground"``.
    at : point
        Its centre; the origin of the body by default.
    axis : vector
        Direction across the disc; the third axis by default.
    disc : scalar
        Its radius [m].
    """

    body: str
    at: Point = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    disc: Scalar


class CapsuleTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A capsule: a cylinder with half spheres as its ends.

    Parameters
    ----------
    body : str
        Its body, or ``"ground"``.
    at : point
        Its centre; the origin of the body by default.
    axis : vector
        Direction along it; the third axis by default.
    capsule : list of two scalars
        Its radius, and the distance between the centres of its ends [m].
    """

    body: str
    at: Point = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    capsule: tuple[Scalar, Scalar]


class BoxTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A box along the axes of its body, of which the eight corners touch.

    Parameters
    ----------
    body : str
        Its body, or ``"ground"``.
    at : point
        Its centre; the origin of the body by default.
    box : list of three scalars
        Its edges [m].
    """

    body: str
    at: Point = (0.0, 0.0, 0.0)
    box: tuple[Scalar, Scalar, Scalar]


class Plane(msgspec.Struct, frozen=True):
    """A plane through a point, with its normal towards what it meets, and two directions along it."""

    on: Marker
    normal: Direction
    across: tuple[Direction, Direction]
    speeds: tuple[Expr, ...] = ()  # of its surface, along these

    @property
    def body(self) -> str:
        """Its body."""
        return self.on.body

    @property
    def outline(self) -> Outline:
        """Its outline."""
        return Outline((self.on,), normal=self.normal)


class Solid(msgspec.Struct, frozen=True):
    """A rim, a capsule or a box: the spheres that it touches with, if it has such, and what it is drawn as.

    Parameters
    ----------
    centre : Marker
        Its centre.
    radius : Expr
        Of a rim or a capsule [m].
    ends : tuple of Disc
        Spheres at the ends of a capsule, points at the corners of a box.
    outline : Outline
        What is drawn.
    axis : Direction or None
        Of a rim or a capsule.
    length : Expr
        Between the ends of a capsule [m].
    """

    centre: Marker
    radius: Expr
    ends: tuple[Disc, ...]
    outline: Outline
    axis: Direction | None = None
    length: Expr = Number(0.0)

    @property
    def body(self) -> str:
        """Its body."""
        return self.centre.body


Shape = Disc | Plane | Solid


class PairInSpace(msgspec.Struct, frozen=True):
    """A pair of shapes in space: their words, and scope, key and both shapes in this order -> `Touch`."""

    words: tuple[str, str]
    read: Callable[[Scope, str, Any, Any], Touch]


PAIRS_IN_SPACE: Registry[PairInSpace] = Registry("symgen.describe.contacts.pairs_in_space", "pair of shapes in space")


def _read_sphere(scope: Scope, key: str, table: SphereTable) -> Disc:
    radius = scope.constant(f"{key}.sphere", table.sphere)
    centre = scope.marker(f"{key}.at", scope.body(f"{key}.body", table.body), table.at)
    return Disc(centre, radius, scope.value(radius, f"{key}.sphere"))


def _read_plane(scope: Scope, key: str, table: PlaneTable) -> Plane:
    body = scope.body(f"{key}.plane", table.plane, turns=True)
    normal = scope.direction(f"{key}.normal", body, table.normal)
    across = directions_across(scope, f"{key}.normal", normal)
    plane = Plane(scope.marker(f"{key}.on", body, table.on), normal, across)
    if table.surface_velocity is None:
        return plane
    velocity = [speed_of_surface(scope, f"{key}.surface_velocity", x) for x in table.surface_velocity]
    speeds = (sum_of_terms(*map(product, each.vector, velocity)) for each in across)
    return msgspec.structs.replace(plane, speeds=tuple(speeds))


def _read_rim(scope: Scope, key: str, table: RimTable) -> Solid:
    centre, axis = _centre_and_axis(scope, key, table)
    radius = scope.constant(f"{key}.disc", table.disc, positive=True)
    return Solid(centre, radius, (), Outline((centre,), radius, about=axis), axis)


def _read_capsule(scope: Scope, key: str, table: CapsuleTable) -> Solid:
    centre, axis = _centre_and_axis(scope, key, table)
    radius, length = scope.several(f"{key}.capsule", table.capsule, 2, positive=True)
    size = scope.value(radius, f"{key}.capsule")
    ways = (product(Number(sign), length, Number(0.5)) for sign in (-1.0, 1.0))
    moved = (tuple(product(way, x) for x in axis.vector) for way in ways)
    ends = tuple(Disc(_moved(centre, way), radius, size) for way in moved)
    return Solid(centre, radius, ends, Outline((centre,), radius, about=axis, edges=(length,)), axis, length)


def _read_box(scope: Scope, key: str, table: BoxTable) -> Solid:
    body = scope.body(f"{key}.body", table.body, turns=True)
    centre, edges = scope.marker(f"{key}.at", body, table.at), scope.several(f"{key}.box", table.box, 3, positive=True)
    corners = (tuple(map(product, map(Number, signs), edges)) for signs in combinations((-0.5, 0.5), repeat=3))
    ends = tuple(Disc(_moved(centre, way), Number(0.0), 0.0) for way in corners)
    words = "a box of which the corners touch, no edge and no face"
    return Solid(centre, Number(0.0), ends, Outline((centre,), edges=edges, words=words))


def _centre_and_axis(scope: Scope, key: str, table: RimTable | CapsuleTable) -> tuple[Marker, Direction]:
    body = scope.body(f"{key}.body", table.body, turns=True)
    return scope.marker(f"{key}.at", body, table.at), scope.direction(f"{key}.axis", body, table.axis)


def _moved(point: Marker, way: tuple[Expr, ...]) -> Marker:
    return Marker(point.body, tuple(sum_of_terms(a, b) for a, b in zip(point.point, way, strict=True)))


#: Word of a shape -> its table, and how this is read.
_SHAPES: dict[str, tuple[type[msgspec.Struct], Callable[[Scope, str, Any], Shape]]] = {
    SPHERE: (SphereTable, _read_sphere),
    "plane": (PlaneTable, _read_plane),
    "disc": (RimTable, _read_rim),
    "capsule": (CapsuleTable, _read_capsule),
    "box": (BoxTable, _read_box),
}


def read_pair_in_space(scope: Scope, key: str, raw: object, places: tuple[int, int] = (0, 1)) -> Touch:
    """Return the gaps of two shapes in space, whose places in the list of a key are those in a file.

    Raises
    ------
    InputError
        With the shape that is wrong, or the shapes that are no pair.
    """
    tables = two_tables(scope, key, raw, "{ body = BODY, sphere = RADIUS }")
    keys = [f"{key}[{i}]" for i in places]
    words = [word_of_shape(scope, at, e, _SHAPES, SphereTable, SPHERE) for at, e in zip(keys, tables, strict=True)]
    shapes = list[Shape]()
    for at, word, table in zip(keys, words, tables, strict=True):
        kind, read = _SHAPES[word]
        shapes.append(read(scope, at, read_table(kind, table, scope.where(at))))
    if shapes[0].body == shapes[1].body:
        raise scope.error(key, "two different bodies", f"'{shapes[0].body}' twice")
    pairs = {pair.words: pair for _, pair in PAIRS_IN_SPACE.items()}
    for first, second in ((0, 1), (1, 0)):
        if (pair := pairs.get((words[first], words[second]))) is not None:
            planes = [shape for shape in shapes if isinstance(shape, Plane)]
            speeds = next((plane.speeds for plane in planes), ())
            return pair.read(scope, key, shapes[first], shapes[second]).moved(*speeds)
    known = ", ".join(f"{one} and {other}" for one, other in sorted(pairs))
    raise scope.error(key, f"a pair of shapes that may touch ({known})", f"{words[0]} and {words[1]}")


def all_of(touches: tuple[Touch, ...]) -> Touch:
    """Return several touches as parts of one surface, which pictures show once."""
    first, *others = touches
    return msgspec.structs.replace(first, further=tuple(msgspec.structs.replace(e, outlines=()) for e in others))
