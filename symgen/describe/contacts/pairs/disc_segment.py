"""A disc beside a segment: its face on either side, and its ends, which are smooth pieces of one gap."""

from __future__ import annotations

import math

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number, Reading, call, difference
from symgen.base.vocabulary.measures import GROUND, Angle, Component, Direction, FormulaMeasure, Marker
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.surfaces import Disc, Pair, Touch
from symgen.describe.parts.fields import Vector
from symgen.describe.parts.scope import Scope


class SegmentTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A segment.

    Parameters
    ----------
    body : str
        Its body, or ``"ground"``.
    segment : list of two vectors
        Its ends.
    """

    body: str
    segment: tuple[Vector, Vector]


def read_segment(scope: Scope, key: str, table: SegmentTable, disc: Disc) -> Touch:
    """Return the distance of the centre from the nearest point of the segment, less the radius, and the slip there.

    Slips of the pieces are one coordinate: where a piece ends, the next one has the same value and rate.

    Raises
    ------
    InputError
        If the segment has no length, or the disc no radius above 0.
    """
    body = scope.body(f"{key}.body", table.body)
    ends = [scope.marker(f"{key}.segment[{i}]", body, point) for i, point in enumerate(table.segment)]
    (x, y), (far_x, far_y) = (tuple(scope.value(e, f"{key}.segment") for e in end.point) for end in ends)
    if not (length := math.hypot(far_x - x, far_y - y)) > 0.0:
        raise scope.error(f"{key}.segment", "a segment with a length above 0", "two equal ends")
    if not disc.size > 0.0:
        raise scope.error(key, "a disc with a radius above 0 beside a segment", f"a radius of {disc.size!r} m")
    along = scope.direction(f"{key}.segment", body, ((far_x - x) / length, (far_y - y) / length))
    across = Direction(body, (call("neg", along.vector[1]), along.vector[0]))
    s, beyond = _readings(scope.name, ends, disc.centre, along)
    height, _ = _readings(f"{scope.name}.across", ends, disc.centre, across)
    side = call("where", call("lt", height, ZERO), Number(-1.0), ONE)
    size = call("abs", height)

    def pieces(first: Expr, face: Expr, last: Expr) -> Expr:
        return call("where", call("lt", s, ZERO), first, call("where", call("gt", beyond, ZERO), last, face))

    gap = pieces(_length(s, size), size, _length(beyond, size))
    arcs = [call("mul", disc.radius, call("atan2", call("mul", side, x), size)) for x in (s, beyond)]
    face = call("mul", side, s)
    slip = pieces(arcs[0], face, call("add", call("mul", side, Number(length)), arcs[1]))
    for of, sign in ((disc.body, "add"), (body, "sub")):
        if of != GROUND and scope.turns(of):
            slip = call(sign, slip, call("mul", disc.radius, Reading(f"{of}.theta", Angle(GROUND, of))))
    outlines = disc.outline, Outline(tuple(ends))
    return Touch(FormulaMeasure(difference(gap, disc.radius)), ZERO, FormulaMeasure(slip), None, outlines)


def _readings(name: str, ends: list[Marker], centre: Marker, along: Direction) -> tuple[Reading, Reading]:
    """Return the way of a centre along a direction from either end."""
    first, last = (Reading(f"{name}.way{i}", Component(end, centre, along)) for i, end in enumerate(ends))
    return first, last


def _length(x: Expr, y: Expr) -> Expr:
    return call("sqrt", call("add", call("mul", x, x), call("mul", y, y)))


KIND = Pair("segment", SegmentTable, read_segment, lambda table: str(table.body))
