"""The way of a rope: straight parts between ends and eyelets, and arcs on sheaves whose neighbours are in their planes.

A sheave sees its neighbours in its own plane, where the rope leaves along the tangent; what moves out of the plane
counts in the length of the straight part. In the plane all sheaves share the directions of the ground.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

from symgen.base.vocabulary.expressions import (
    ZERO,
    Expr,
    Number,
    Reading,
    call,
    difference,
    product,
    sum_of_terms,
)
from symgen.base.vocabulary.measures import GROUND, Bearing, Component, Direction, Marker, axes
from symgen.base.vocabulary.rotations import Matrix, rotate, rotation_matrix_of, scalar_product
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.formulas.start import euler_parameters
from symgen.describe.mechanism import SpatialBody
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import Triad

#: Part of a distance, or angle between axes, up to which sheaves and their neighbours are in one plane at the start.
IN_PLANE = 1e-6
_Vector = tuple[float, float, float]
_UNTURNED: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class Stop(NamedTuple):
    """An end, an eyelet, or a sheave: its radius is below 0 where the rope turns clockwise about the axis."""

    key: str
    centre: Marker
    radius: Expr
    triad: Triad | None = None  # of a sheave in space


class _Placed(NamedTuple):
    """A stop with its numbers as the bodies are described to start; the triad is in axes of the ground."""

    stop: Stop
    place: _Vector
    radius: float
    triad: tuple[_Vector, _Vector, _Vector]

    @property
    def has_axis(self) -> bool:
        """Whether it is a sheave in space."""
        return self.stop.triad is not None


class _Leaving(NamedTuple):
    """Direction of a straight part in the plane of a sheave: formula and start, which are `beyond` it by an angle."""

    direction: Expr
    angle: float
    beyond: float


def way_of_rope(scope: Scope, stops: list[Stop]) -> tuple[Expr, float]:
    """Return the length of the way over some stops as a formula, and at the start.

    Raises
    ------
    InputError
        With the sheave whose neighbours are not in its plane, or with two stops that overlap.
    """
    placed = [_placed(scope, stop) for stop in stops]
    parts, length = list[Expr](), 0.0
    for i, (a, b) in enumerate(pairwise(placed)):
        _check_planes(scope, a, b)
        part, start = _straight(scope, i, a, b)
        parts.append(part)
        length += start
    for i, (before, here, after) in enumerate(zip(placed, placed[1:], placed[2:], strict=False), 1):
        if here.stop.radius != ZERO:
            arc, start = _arc(i, before, here, after)
            parts.append(arc)
            length += start
    return sum_of_terms(*parts), length


def _placed(scope: Scope, stop: Stop) -> _Placed:
    place, turned = _pose_at_start(scope, stop.centre.body)
    point = rotate(turned, _vector(scope, stop.centre.point, stop.key))
    triad = _UNTURNED
    if stop.triad is not None:
        directions = (stop.triad.first, stop.triad.second, stop.triad.axis)
        first, second, axis = (rotate(turned, _vector(scope, e.vector, "over")) for e in directions)
        triad = first, second, axis
    return _Placed(stop, _sum(place, point), scope.value(stop.radius, stop.key), triad)


def _pose_at_start(scope: Scope, name: str) -> tuple[_Vector, Matrix]:
    """Return where a body is described to start, and how it is turned there."""
    if name == GROUND:
        return (0.0, 0.0, 0.0), _UNTURNED
    body = scope.context.bodies[name]
    place, turned = _vector(scope, body.position, "at"), _UNTURNED
    if not scope.turns(name):
        return place, turned
    if isinstance(body, SpatialBody):
        where = f"{scope.context.source}: bodies.{name}.orientation"
        return place, rotation_matrix_of(euler_parameters(body.orientation, scalar_values(scope.context.values), where))
    angle = scope.value(body.angle, "at")
    c, s = math.cos(angle), math.sin(angle)
    return place, ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))


def _vector(scope: Scope, components: tuple[Expr, ...], key: str) -> _Vector:
    """Return three numbers; in the plane the last one is 0."""
    x, y, z = (*(scope.value(e, key) for e in components), 0.0)[:3]
    return x, y, z


def _check_planes(scope: Scope, a: _Placed, b: _Placed) -> None:
    """Refuse sheaves in space beside the planes of their neighbours."""
    apart = math.dist(a.place, b.place)
    for here, there in ((a, b), (b, a)):
        if not here.has_axis:
            continue
        beside = abs(scalar_product(_between(here, there), here.triad[2]))
        if beside > IN_PLANE * apart:
            expected = "the parts of the rope beside a sheave in its plane, as the bodies start"
            hint = "an eyelet, { body, at } without a radius, turns the rope in any direction"
            raise scope.error(here.stop.key, expected, f"{there.stop.key} that is {beside:.3g} m out of it", hint)
        if there.has_axis and (cosine := abs(scalar_product(here.triad[2], there.triad[2]))) < 1.0 - IN_PLANE**2:
            expected = f"the axis of {there.stop.key} before or after it, as both are in one plane"
            got = f"one at {math.degrees(math.acos(min(cosine, 1.0))):.3g} degrees to it"
            hint = "an eyelet, { body, at } without a radius, between skew sheaves"
            raise scope.error(f"{here.stop.key}.axis", expected, got, hint)


def _across(here: _Placed, a: _Placed, b: _Placed) -> tuple[Expr, float]:
    """Return the signed radius of `b` without the one of `a`, as `here` sees both: formula and number.

    The axes of two sheaves may point against each other.
    """
    signs = [
        math.copysign(1.0, scalar_product(here.triad[2], x.triad[2])) if here.has_axis and x.has_axis else 1.0
        for x in (a, b)
    ]
    first, second = (
        call("neg", x.stop.radius) if sign < 0.0 and x.stop.radius != ZERO else x.stop.radius
        for sign, x in zip(signs, (a, b), strict=True)
    )
    return difference(second, first), signs[1] * b.radius - signs[0] * a.radius


def _straight(scope: Scope, i: int, a: _Placed, b: _Placed) -> tuple[Expr, float]:
    """Return the length of a straight part; centres are apart by l u + (r_b - r_a) n with n across u."""
    square = _square(_components(f"rope{i}.", a, b, axes(GROUND, scope.dimension)))
    across, side = _across(a, a, b)
    apart = math.dist(a.place, b.place)
    if not apart > abs(side):
        got = f"{a.stop.key} and {b.stop.key} that overlap"
        raise scope.error("over", "sheaves, eyelets and ends apart from each other", got)
    start = math.sqrt(apart**2 - side**2)
    return call("sqrt", square if across == ZERO else call("sub", square, product(across, across))), start


def _leaving(i: int, here: _Placed, a: _Placed, b: _Placed) -> _Leaving:
    """Return the direction of straight part `i`, from `a` to `b`, as one of them sees it."""
    across, side = _across(here, a, b)
    name, start, end, beyond = f"rope{i}.", a, b, 0.0
    if here.stop.triad is None:
        x, y = axes(GROUND, 2)
    else:  # bearings in space start at the sheave: the rope runs against the one to where it comes from
        x, y = here.stop.triad.first, here.stop.triad.second
        name += "to." if here is a else "from."
        start, end, beyond = (a, b, 0.0) if here is a else (b, a, math.pi)
    direction: Expr = Reading(f"{name}angle", Bearing(start.stop.centre, end.stop.centre, x, y))
    if across != ZERO:
        apart = call("sqrt", _square(_components(name, start, end, (x, y))))
        direction = call("sub", direction, call("asin", call("div", across, apart)))
    to = _between(start, end)
    along = scalar_product(to, here.triad[0]), scalar_product(to, here.triad[1])
    return _Leaving(direction, math.atan2(along[1], along[0]) - math.asin(side / math.hypot(*along)), beyond)


def _arc(i: int, before: _Placed, here: _Placed, after: _Placed) -> tuple[Expr, float]:
    """Return the arc on a sheave, by less than a turn at the start, and its length there."""
    come, go = _leaving(i - 1, here, before, here), _leaving(i, here, here, after)
    way, turned = math.copysign(1.0, here.radius), go.angle - come.angle - come.beyond
    whole = math.floor(way * turned / math.tau)  # turns that the two directions differ by beyond the arc
    turn, more = call("sub", go.direction, come.direction), come.beyond + way * whole * math.tau
    arc = product(here.stop.radius, turn if more == 0.0 else call("sub", turn, Number(more)))
    return arc, abs(here.radius) * (way * turned % math.tau)


def _components(name: str, a: _Placed, b: _Placed, directions: tuple[Direction, ...]) -> list[Expr]:
    """Return the components of the vector between two centres."""
    return [
        Reading(f"{name}{k}", Component(a.stop.centre, b.stop.centre, e))
        for k, e in zip("xyz", directions, strict=False)
    ]


def _square(components: list[Expr]) -> Expr:
    return sum_of_terms(*(call("mul", e, e) for e in components))


def _between(a: _Placed, b: _Placed) -> _Vector:
    (ax, ay, az), (bx, by, bz) = a.place, b.place
    return bx - ax, by - ay, bz - az


def _sum(a: _Vector, b: _Vector) -> _Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]
