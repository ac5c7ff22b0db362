"""The way of a rope in space: straight parts between eyelets, and arcs on sheaves whose neighbours are in their planes.

A sheave sees its neighbours in its own plane, where the rope leaves along the tangent; what moves out of the plane
counts in the length of the straight part.
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
from symgen.base.vocabulary.rotations import Matrix, rotate, rotation_matrix_of
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.formulas.start import euler_parameters
from symgen.describe.mechanism import SpatialBody
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import Triad

#: Part of a distance, or angle between axes, up to which sheaves and their neighbours are in one plane at the start.
IN_PLANE = 1e-6
_Vector = tuple[float, float, float]


class Stop(NamedTuple):
    """An end, an eyelet, or a sheave: its radius is below 0 where the rope turns clockwise about the axis."""

    key: str
    centre: Marker
    radius: Expr
    triad: Triad | None = None


class _Placed(NamedTuple):
    """A stop with its numbers as the bodies are described to start; the triad is in axes of the ground."""

    stop: Stop
    place: _Vector
    radius: float
    triad: tuple[_Vector, _Vector, _Vector] | None


class _Leaving(NamedTuple):
    """Direction in the plane of a sheave in which the rope runs to, or comes from, a neighbour: formula and start."""

    direction: Expr
    angle: float


def way_in_space(scope: Scope, stops: list[Stop]) -> tuple[Expr, float]:
    """Return the length of the way over some stops as a formula, and at the start.

    Raises
    ------
    InputError
        With the sheave whose neighbours are not in its plane, or overlap it.
    """
    placed = [_placed(scope, stop) for stop in stops]
    parts, length = list[Expr](), 0.0
    for i, (a, b) in enumerate(pairwise(placed)):
        _check_planes(scope, a, b)
        part, start = _straight(scope, i, a, b)
        parts.append(part)
        length += start
    for i, (before, here, after) in enumerate(zip(placed, placed[1:], placed[2:], strict=False), 1):
        if here.triad is not None:
            arc, start = _arc(scope, i, before, here, after)
            parts.append(arc)
            length += start
    return sum_of_terms(*parts), length


def _placed(scope: Scope, stop: Stop) -> _Placed:
    body = scope.context.bodies.get(stop.centre.body)
    x, y, z = (scope.value(e, stop.key) for e in stop.centre.point)
    turned: Matrix | None = None
    if isinstance(body, SpatialBody):
        if scope.turns(stop.centre.body):
            where = f"{scope.context.source}: bodies.{stop.centre.body}.orientation"
            turned = rotation_matrix_of(euler_parameters(body.orientation, scalar_values(scope.context.values), where))
            x, y, z = rotate(turned, (x, y, z))
        px, py, pz = (scope.value(e, stop.key) for e in body.position)
        x, y, z = px + x, py + y, pz + z
    triad = None
    if stop.triad is not None:
        first, second, axis = (
            _numbers(scope, e, turned) for e in (stop.triad.first, stop.triad.second, stop.triad.axis)
        )
        triad = first, second, axis
    return _Placed(stop, (x, y, z), scope.value(stop.radius, stop.key), triad)


def _numbers(scope: Scope, direction: Direction, turned: Matrix | None) -> _Vector:
    x, y, z = (scope.value(e, "over") for e in direction.vector)
    return (x, y, z) if turned is None else rotate(turned, (x, y, z))


def _check_planes(scope: Scope, a: _Placed, b: _Placed) -> None:
    """Refuse sheaves beside the planes of their neighbours."""
    apart = math.dist(a.place, b.place)
    for here, there in ((a, b), (b, a)):
        if here.triad is None:
            continue
        beside = abs(_product(_between(here, there), here.triad[2]))
        if beside > IN_PLANE * apart:
            expected = "the parts of the rope beside a sheave in its plane, as the bodies start"
            hint = "an eyelet, { body, at } without a radius, turns the rope in any direction"
            raise scope.error(here.stop.key, expected, f"{there.stop.key} that is {beside:.3g} m out of it", hint)
        if there.triad is not None and (cosine := abs(_product(here.triad[2], there.triad[2]))) < 1.0 - IN_PLANE**2:
            expected = f"the axis of {there.stop.key} before or after it, as both are in one plane"
            got = f"one at {math.degrees(math.acos(min(cosine, 1.0))):.3g} degrees to it"
            hint = "an eyelet, { body, at } without a radius, between skew sheaves"
            raise scope.error(f"{here.stop.key}.axis", expected, got, hint)


def _same_way(here: _Placed, there: _Placed) -> float:
    """Return -1 where the axes of two sheaves point against each other, else 1."""
    if here.triad is None or there.triad is None:
        return 1.0
    return math.copysign(1.0, _product(here.triad[2], there.triad[2]))


def _across(here: _Placed, there: _Placed) -> tuple[Expr, float]:
    """Return by how much the neighbour's signed radius is larger, in the plane of the first: formula and number."""
    same = _same_way(here, there)
    other = there.stop.radius if same > 0.0 or there.stop.radius == ZERO else call("neg", there.stop.radius)
    return difference(other, here.stop.radius), same * there.radius - here.radius


def _straight(scope: Scope, i: int, a: _Placed, b: _Placed) -> tuple[Expr, float]:
    """Return the length of a straight part; centres are apart by l u + (r_b - r_a) n with n across u."""
    components = [
        Reading(f"rope{i}.{k}", Component(a.stop.centre, b.stop.centre, axis))
        for k, axis in zip("xyz", axes(GROUND, 3), strict=True)
    ]
    square = sum_of_terms(*(call("mul", e, e) for e in components))
    across, side = _across(a, b)
    apart = math.dist(a.place, b.place)
    if not apart > abs(side):
        got = f"{a.stop.key} and {b.stop.key} that overlap"
        raise scope.error("over", "sheaves, eyelets and ends apart from each other", got)
    start = math.sqrt(apart**2 - side**2)
    return call("sqrt", square if across == ZERO else call("sub", square, product(across, across))), start


def _leaving(i: int, word: str, here: _Placed, there: _Placed, towards: bool) -> _Leaving:
    """Return the direction of the rope from a sheave `towards` a neighbour, or from there to the sheave.

    The bearing is that of the neighbour; a rope that comes from there runs against it.
    """
    assert here.stop.triad is not None and here.triad is not None, "of a sheave"
    first, second = here.stop.triad.first, here.stop.triad.second
    ends, name = (here.stop.centre, there.stop.centre), f"rope{i}.{word}"
    along = [Reading(f"{name}{k}", Component(*ends, e)) for k, e in (("1", first), ("2", second))]
    across, side = _across(here, there)
    if not towards:  # the sheave's own radius is the one that the part ends on
        across, side = (call("neg", across) if across != ZERO else ZERO), -side
    to = _between(here, there)
    x, y = _product(to, here.triad[0]), _product(to, here.triad[1])
    direction: Expr = Reading(f"{name}.angle", Bearing(*ends, first, second))
    if across != ZERO:
        apart = call("sqrt", sum_of_terms(*(call("mul", e, e) for e in along)))
        direction = call("sub", direction, call("asin", call("div", across, apart)))
    return _Leaving(direction, math.atan2(y, x) - math.asin(side / math.hypot(x, y)))


def _arc(scope: Scope, i: int, before: _Placed, here: _Placed, after: _Placed) -> tuple[Expr, float]:
    """Return the arc on a sheave, by less than a turn at the start, and its length there."""
    come, go = _leaving(i, "from", here, before, False), _leaving(i, "to", here, after, True)
    way, turned = math.copysign(1.0, here.radius), go.angle - come.angle - math.pi
    whole = math.floor(way * turned / math.tau)  # turns that the two directions differ by beyond the arc
    turn = call("sub", call("sub", go.direction, come.direction), Number(math.pi + way * whole * math.tau))
    return product(here.stop.radius, turn), abs(here.radius) * (way * turned % math.tau)


def _between(a: _Placed, b: _Placed) -> _Vector:
    (ax, ay, az), (bx, by, bz) = a.place, b.place
    return bx - ax, by - ay, bz - az


def _product(a: _Vector, b: _Vector) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
