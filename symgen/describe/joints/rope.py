"""Rope: a thread over sheaves, which keeps its length or stretches; in space through eyelets too."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import ClassVar, Literal, NamedTuple

import msgspec

from symgen.base.vocabulary.expressions import (
    ZERO,
    Expr,
    Number,
    Reading,
    call,
    difference,
    literal_of,
    product,
    sum_of_terms,
)
from symgen.base.vocabulary.measures import GROUND, Bearing, Component, FormulaMeasure, Holonomic, Marker, axes
from symgen.describe.joints._giving import force_of_pull, refuse_damping
from symgen.describe.joints._paired import Paired
from symgen.describe.joints._rope_in_space import Stop, way_in_space
from symgen.describe.mechanism import Force, Joint
from symgen.describe.parts.fields import Axis, BodyName, Point, Scalar
from symgen.describe.parts.scope import CENTRE, Scope
from symgen.describe.parts.triads import make_triad


class Sheave(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A sheave on the way of a rope, or an eyelet: a point through which it glides.

    Parameters
    ----------
    body : body name
        The body that carries it; the ground by default.
    at : point
        Its centre.
    radius : scalar
        [m], above 0; without it there is an eyelet.
    turn : {"left", "right"}
        Of a sheave, which way the rope turns round it, from the first end on; in space as seen against the axis.
    axis : direction
        Of a sheave in space, in the frame of the body. Its length does not matter.
    """

    at: Point
    radius: Scalar | None = None
    turn: Literal["left", "right"] | None = None
    axis: Axis | None = None
    body: BodyName = GROUND


class _Straight(NamedTuple):
    """A straight part of the rope: its length and its direction, as formulas and at the start."""

    length: Expr
    direction: Expr
    start: float
    angle: float


class Rope(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A rope between points of two bodies over sheaves, on which it glides freely.

    Parameters
    ----------
    between : pair of body names
        The bodies at its ends.
    at : pair of points
        The ends.
    over : list of tables
        The sheaves on its way, each ``{ body, at, radius, turn }``, in space with an `axis`; the rope turns round each
        by less than a turn at the start. In space what is before and after a sheave starts in its plane. Without
        `radius` there is an eyelet.
    length : scalar
        Length [m]; that of the way as the bodies are described to start by default.
    stiffness : scalar
        Of a rope that stretches, tension over stretch [N/m], above 0: it may go slack. Without it the rope keeps its
        length, and would push where its tension is below 0.
    damping : scalar
        Beside it, tension over the rate of the stretch [N s/m]; 0 by default. It adds or takes at most what the
        stiffness gives, so that the rope never pushes.

    Notes
    -----
    One row. Multiplier ``NAME.tension`` [N]. With `stiffness` there is a force in its place, which reports
    ``NAME.length`` [m] and ``NAME.force`` [N], below 0 where it pulls, as springs do; the joint then reports
    ``NAME.stretch`` [m], below 0 where the rope is slack.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    over: tuple[Sheave, ...] = ()
    length: Scalar | None = None
    stiffness: Scalar | None = None
    damping: Scalar | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the sum of straight parts and arcs."""
        refuse_damping(scope, self.stiffness, self.damping)
        bodies, way, length = self._way(scope)
        if self.stiffness is None:
            return Joint(scope.name, scope.kind, bodies, (Holonomic("tension", FormulaMeasure(way), length),))
        stretch = FormulaMeasure(call("sub", way, length))
        return Joint(scope.name, scope.kind, bodies, (), (("stretch", stretch),))

    def give(self, scope: Scope) -> Force | None:
        """Return the force in place of the row, None where there is a row."""
        if self.stiffness is None:
            return None
        bodies, way, length = self._way(scope)
        return force_of_pull(scope, bodies, "force", FormulaMeasure(way), length, self.stiffness, self.damping)

    def _way(self, scope: Scope) -> tuple[tuple[str, ...], Expr, Expr]:
        """Return the bodies, the length of the way as a formula, and the length of the rope."""
        (a, b), ends = self.ends(scope, turns=(False, False))
        stops = [Stop("at[0]", ends[0], ZERO), *(_stop(scope, i, x) for i, x in enumerate(self.over))]
        stops.append(Stop("at[1]", ends[1], ZERO))
        way, start = way_in_space(scope, stops) if scope.spatial else _way_in_plane(scope, stops)
        length: Expr = literal_of(start)
        if self.length is not None:
            length = scope.constant("length", self.length, positive=True)
        carried = (stop.centre.body for stop in stops[1:-1] if stop.centre.body != GROUND)
        return tuple(dict.fromkeys((a, b, *carried))), way, length


def _stop(scope: Scope, i: int, sheave: Sheave) -> Stop:
    """Return a sheave, or an eyelet."""
    key = f"over[{i}]"
    axial = (("axis", sheave.axis),) if scope.spatial else ()
    if sheave.axis is not None and not scope.spatial:
        raise scope.error(f"{key}.axis", "no such key in the plane", "a direction")
    body = scope.body(f"{key}.body", sheave.body, turns=sheave.axis is not None)
    centre = scope.marker(f"{key}.at", body, CENTRE if sheave.at == CENTRE else sheave.at)
    for name, value in (("turn", sheave.turn), *axial):
        if (value is None) != (sheave.radius is None):
            expected, got = "the key of a sheave with a radius", "no such key"
            if value is not None:
                expected, got = "no such key without a radius", "one"
            raise scope.error(f"{key}.{name}", expected, got, "an eyelet has neither radius nor turn nor axis")
    if sheave.radius is None:
        return Stop(key, centre, ZERO)
    radius = scope.constant(f"{key}.radius", sheave.radius, positive=True)
    signed = radius if sheave.turn == "left" else call("neg", radius)
    triad = None if sheave.axis is None else make_triad(scope, body, sheave.axis, keys=(f"{key}.axis", ""))
    return Stop(key, centre, signed, triad)


def _way_in_plane(scope: Scope, stops: list[Stop]) -> tuple[Expr, float]:
    """Return the length of the way over some stops as a formula, and at the start."""
    straights = [_straight(scope, i, *pair) for i, pair in enumerate(pairwise(stops))]
    bends = zip(stops[1:], straights, straights[1:], strict=False)
    arcs = [_arc(scope, stop, before, after) for stop, before, after in bends if stop.radius != ZERO]
    way = sum_of_terms(*(straight.length for straight in straights), *(arc for arc, _ in arcs))
    return way, sum([straight.start for straight in straights] + [start for _, start in arcs])


def _straight(scope: Scope, i: int, a: Stop, b: Stop) -> _Straight:
    """Return the straight part between two sheaves or ends.

    With u along it, n to its left and signed radii r, the centres are apart by l u + (r_b - r_a) n.
    """
    x, y = axes(GROUND, 2)
    components = [Reading(f"rope{i}.{k}", Component(a.centre, b.centre, axis)) for k, axis in (("x", x), ("y", y))]
    square = sum_of_terms(*(call("mul", e, e) for e in components))
    across = difference(b.radius, a.radius)
    bearing = Reading(f"rope{i}.angle", Bearing(a.centre, b.centre, x, y))
    (ax, ay), (bx, by) = (_place_at_start(scope, stop.centre) for stop in (a, b))
    apart, side = math.hypot(bx - ax, by - ay), scope.value(across, "over")
    if not apart > abs(side):
        raise scope.error("over", "sheaves and ends apart from each other", f"parts {i + 1} and {i + 2} that overlap")
    start, angle = math.sqrt(apart**2 - side**2), math.atan2(by - ay, bx - ax) - math.asin(side / apart)
    if across == ZERO:
        return _Straight(call("sqrt", square), bearing, start, angle)
    length = call("sqrt", call("sub", square, product(across, across)))
    direction = call("sub", bearing, call("asin", call("div", across, call("sqrt", square))))
    return _Straight(length, direction, start, angle)


def _arc(scope: Scope, stop: Stop, before: _Straight, after: _Straight) -> tuple[Expr, float]:
    """Return the arc on a sheave, by less than a turn at the start, and its length there."""
    radius = scope.value(stop.radius, "over")
    way, turned = math.copysign(1.0, radius), after.angle - before.angle
    whole = math.floor(way * turned / math.tau)  # turns that the two directions differ by beyond the arc
    turn = call("sub", after.direction, before.direction)
    arc = product(stop.radius, turn if whole == 0 else call("sub", turn, Number(way * whole * math.tau)))
    return arc, abs(radius) * (way * turned % math.tau)


def _place_at_start(scope: Scope, marker: Marker) -> tuple[float, float]:
    """Return where a point is as the bodies are described to start."""
    x, y = (scope.value(e, "at") for e in marker.point)
    if marker.body == GROUND:
        return x, y
    body = scope.context.bodies[marker.body]
    px, py = (scope.value(e, "at") for e in body.position)
    angle = scope.value(body.angle, "at") if scope.turns(marker.body) else 0.0  # type: ignore[union-attr]  # planar
    c, s = math.cos(angle), math.sin(angle)
    return px + c * x - s * y, py + s * x + c * y


KIND = Rope
