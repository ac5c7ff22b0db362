"""Stops on the way of a rope: ends, eyelets and sheaves, with their places as the bodies are described to start.

Places are numbers of one start, or formulas of parameters (`symgen.describe.formulas.formula_numbers`).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from symgen.base.vocabulary.expressions import ZERO, Expr, call, difference
from symgen.base.vocabulary.measures import GROUND, Marker
from symgen.base.vocabulary.rotations import Matrix, rotate, rotation_matrix_of
from symgen.describe.formulas.start import Numbers, euler_parameters
from symgen.describe.mechanism import SpatialBody
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import Triad

#: Part of a distance, or angle between axes, up to which sheaves and their neighbours are in one plane at the start.
IN_PLANE = 1e-6
Place = tuple[Any, Any, Any]
_UNTURNED: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class Stop(NamedTuple):
    """An end, an eyelet, or a sheave: its radius is below 0 where the rope turns clockwise about the axis."""

    key: str
    centre: Marker
    radius: Expr
    triad: Triad | None = None  # of a sheave in space
    wound: bool | None = None  # whether the rope is on it at the start; None where its place says so

    @property
    def is_sheave(self) -> bool:
        """Whether the rope winds round it, and may leave it."""
        return self.radius != ZERO


class Placed(NamedTuple):
    """A stop where the bodies are described to start; the triad is in axes of the ground."""

    stop: Stop
    place: Place
    radius: Any
    triad: tuple[Place, Place, Place]

    @property
    def has_axis(self) -> bool:
        """Whether it is a sheave in space."""
        return self.stop.triad is not None


def placed_stop(scope: Scope, numbers: Numbers, stop: Stop) -> Placed:
    """Return a stop at its place."""
    where = scope.where(stop.key)
    place, turned = _pose_at_start(scope, numbers, stop.centre.body, where)
    point = rotate(turned, _vector(numbers, stop.centre.point, where))
    triad: tuple[Place, Place, Place] = _UNTURNED
    if stop.triad is not None:
        directions = (stop.triad.first, stop.triad.second, stop.triad.axis)
        first, second, axis = (rotate(turned, _vector(numbers, e.vector, where)) for e in directions)
        triad = first, second, axis
    x, y, z = (a + b for a, b in zip(place, point, strict=True))
    return Placed(stop, (x, y, z), numbers.value(stop.radius, where), triad)


def _pose_at_start(scope: Scope, numbers: Numbers, name: str, where: str) -> tuple[Place, Matrix]:
    """Return where a body is described to start, and how it is turned there."""
    if name == GROUND:
        return (0.0, 0.0, 0.0), _UNTURNED
    body = scope.context.bodies[name]
    place = _vector(numbers, body.position, where)
    if not scope.turns(name):
        return place, _UNTURNED
    if isinstance(body, SpatialBody):
        return place, rotation_matrix_of(euler_parameters(body.orientation, numbers, where))
    angle = numbers.value(body.angle, where)
    c, s = (numbers.apply_function(name, angle) for name in ("cos", "sin"))
    return place, ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))


def _vector(numbers: Numbers, components: tuple[Expr, ...], where: str) -> Place:
    """Return three numbers; in the plane the last one is 0."""
    x, y, z = (*(numbers.value(e, where) for e in components), 0.0)[:3]
    return x, y, z


def check_neighbours(scope: Scope, a: Placed, b: Placed) -> None:
    """Refuse stops that overlap, and sheaves in space beside the planes of their neighbours."""
    apart = math.dist(a.place, b.place)
    for here, there in ((a, b), (b, a)):
        if not here.has_axis:
            continue
        beside = abs(product_of_vectors(between(here, there), here.triad[2]))
        if beside > IN_PLANE * apart:
            expected = "the parts of the rope beside a sheave in its plane, as the bodies start"
            hint = "an eyelet, { body, at } without a radius, turns the rope in any direction"
            raise scope.error(here.stop.key, expected, f"{there.stop.key} that is {beside:.3g} m out of it", hint)
        cosine = abs(product_of_vectors(here.triad[2], there.triad[2]))
        if there.has_axis and cosine < 1.0 - IN_PLANE**2:
            expected = f"the axis of {there.stop.key} before or after it, as both are in one plane"
            got = f"one at {math.degrees(math.acos(min(cosine, 1.0))):.3g} degrees to it"
            hint = "an eyelet, { body, at } without a radius, between skew sheaves"
            raise scope.error(f"{here.stop.key}.axis", expected, got, hint)
    if not apart > abs(across(a, a, b)[1]):
        got = f"{a.stop.key} and {b.stop.key} that overlap"
        raise scope.error("over", "sheaves, eyelets and ends apart from each other", got)


def across(here: Placed, a: Placed, b: Placed) -> tuple[Expr, float]:
    """Return the signed radius of `b` without the one of `a`, as `here` sees both: formula and number."""
    first, second = (
        call("neg", x.stop.radius) if sign < 0.0 and x.stop.is_sheave else x.stop.radius
        for sign, x in ((seen_sign(here, x), x) for x in (a, b))
    )
    return difference(second, first), seen_sign(here, b) * b.radius - seen_sign(here, a) * a.radius


def seen_sign(here: Placed, there: Placed) -> float:
    """Return -1 where the axes of two sheaves point against each other, else 1; both are numbers of one start."""
    both = here.has_axis and there.has_axis
    return math.copysign(1.0, product_of_vectors(here.triad[2], there.triad[2])) if both else 1.0


def between(a: Placed, b: Placed) -> Place:
    """Return the vector from one stop to another."""
    (ax, ay, az), (bx, by, bz) = a.place, b.place
    return bx - ax, by - ay, bz - az


def product_of_vectors(a: Place, b: Place) -> Any:
    """Return the scalar product of two vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
