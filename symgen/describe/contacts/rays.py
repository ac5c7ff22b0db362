"""Rays of outputs: how far from a point of a body, along a direction of its frame, the nearest shape is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import reduce

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr, Number, Reading, call, difference, product
from symgen.base.vocabulary.measures import Component, Marker
from symgen.describe.contacts.chains import BodyOutline, OutlinePiece
from symgen.describe.contacts.pairs.disc_line import LineTable
from symgen.describe.contacts.pairs.disc_segment import SegmentTable
from symgen.describe.contacts.surfaces import DISC, DiscTable, OutlineTable, outline_named, word_of_shape
from symgen.describe.parts.fields import read_table
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.sections import OutputSection, RayTable

#: A point as a ray sees it: the way along the ray to the foot of its perpendicular, and how far it is to the left.
Seen = tuple[Expr, Expr]
#: Tables of shapes by their words.
_SHAPES: Mapping[str, type[msgspec.Struct]] = {
    **{DISC: DiscTable, "segment": SegmentTable},
    **{"line": LineTable, "outline": OutlineTable},
}


def value_of_output(scope: Scope, key: str, section: OutputSection) -> Expr:
    """Return the formula of an output, or the distance along its ray.

    Raises
    ------
    InputError
        If it has both or none, or with the key of the ray that is wrong.
    """
    if section.ray is not None and section.value is None:
        return _Ray(scope, section.ray).distance(section.ray)
    if section.ray is not None or section.value is None:
        raise scope.error("", "one of value and ray", "both" if section.ray is not None else "none of them")
    return scope.of_motion(key, section.value)


class _Ray:
    """What a ray meets: each piece of a shape gives its distance, or the reach where the ray misses it."""

    def __init__(self, scope: Scope, table: RayTable) -> None:
        if scope.spatial:
            raise scope.error("ray", "a ray in a mechanism in the plane", "one in space")
        self.scope = scope
        body = scope.body("ray.body", table.body, turns=True)
        self.origin = scope.marker("ray.at", body, table.at)
        self.axes = scope.axis("ray.direction", body, table.direction)
        self.reach = scope.constant("ray.reach", table.reach, positive=True)
        self._seen: dict[Marker, Seen] = {}

    def distance(self, table: RayTable) -> Expr:
        """Return the distance of the nearest shape, at most the reach."""
        if not table.shapes:
            raise self.scope.error("ray.shapes", "one shape or more", "none")
        pieces = (e for i, raw in enumerate(table.shapes) for e in self._pieces(f"ray.shapes[{i}]", raw))
        return reduce(lambda nearest, e: call("min", nearest, e), pieces, self.reach)

    def _pieces(self, key: str, raw: dict[str, object]) -> Iterator[Expr]:
        """Return the distances of the pieces of a shape."""
        scope = self.scope
        word = word_of_shape(scope, key, raw, _SHAPES, DiscTable, DISC)
        table = read_table(_SHAPES[word], raw, scope.where(key))
        if raw.get("surface_speed") is not None:
            raise scope.error(f"{key}.surface_speed", "no such key of what a ray meets", str(raw["surface_speed"]))
        if isinstance(table, OutlineTable):
            outline = outline_named(scope, key, table)
            yield from (self._piece(key, outline, piece) for piece in outline.pieces)
        elif isinstance(table, SegmentTable):
            body = scope.body(f"{key}.body", table.body)
            first, last = (self._see(scope.marker(f"{key}.segment", body, point)) for point in table.segment)
            yield self._crossing(first, last)
        elif isinstance(table, LineTable):
            on = scope.marker(f"{key}.on", scope.body(f"{key}.line", table.line, turns=True), table.on)
            x, y = scope.direction(f"{key}.normal", on.body, table.normal).vector
            further = Marker(on.body, (difference(on.point[0], y), call("add", on.point[1], x)))
            yield self._crossing(self._see(on), self._see(further), ends=False)
        elif isinstance(table, DiscTable):
            body = scope.body(f"{key}.body", table.body)
            radius = scope.constant(f"{key}.disc", table.disc)
            if scope.value(radius, f"{key}.disc") == 0.0:
                raise scope.error(f"{key}.disc", "a radius other than 0", "a point, which no ray meets")
            yield self._circle(self._see(scope.marker(f"{key}.at", body, table.at)), product(radius, radius))

    def _piece(self, key: str, outline: BodyOutline, piece: OutlinePiece) -> Expr:
        """Return the distance of a segment or an arc of an outline."""
        first, last = (self._see(Marker(outline.body, point)) for point in (piece.start, piece.end))
        if not (turn := self.scope.value(piece.curvature, key)):
            return self._crossing(first, last)
        (x, y), (along_x, along_y) = piece.start, piece.first
        centre = (
            call("add", x, call("div", along_y, piece.curvature)),
            difference(y, call("div", along_x, piece.curvature)),
        )
        size = call("div", Number(1.0), product(piece.curvature, piece.curvature))
        chord = (first, last) if turn > 0.0 else (last, first)
        return self._circle(self._see(Marker(outline.body, centre)), size, chord)

    def _crossing(self, first: Seen, last: Seen, ends: bool = True) -> Expr:
        """Return the distance of the segment, or of the line, through two points."""
        (x, y), (far_x, far_y) = first, last
        rise = difference(far_y, y)
        at = difference(x, product(y, call("div", difference(far_x, x), rise)))
        crosses = call("gt", product(rise, rise), ZERO)
        if ends:
            crosses = call("and", crosses, call("le", product(y, far_y), ZERO))
        return self._if(crosses, self._if(call("ge", at, ZERO), at, self.reach), self.reach)

    def _circle(self, centre: Seen, size: Expr, chord: tuple[Seen, Seen] | None = None) -> Expr:
        """Return the distance of a circle, of an arc of its part to the left of a chord; `size` is radius squared."""
        x, y = centre
        depth = difference(size, product(y, y))
        half = call("sqrt", depth)

        def met(at: Expr, otherwise: Expr) -> Expr:
            on = call("ge", at, ZERO)
            if chord is not None:
                (start_x, start_y), (end_x, end_y) = chord
                turned = product(difference(end_y, start_y), difference(at, start_x))
                left = call("add", product(difference(end_x, start_x), start_y), turned)
                on = call("and", on, call("le", left, ZERO))
            return self._if(on, at, otherwise)

        nearest = met(difference(x, half), met(call("add", x, half), self.reach))
        return self._if(call("ge", depth, ZERO), nearest, self.reach)

    @staticmethod
    def _if(condition: Expr, value: Expr, otherwise: Expr) -> Expr:
        return call("where", condition, value, otherwise)

    def _see(self, point: Marker) -> Seen:
        """Return where a point is as seen along the ray."""
        if point not in self._seen:
            name = f"{self.scope.name}.seen{len(self._seen) + 1}"
            along, left = (
                Reading(f"{name}.{word}", Component(self.origin, point, axis))
                for word, axis in zip(("along", "left"), self.axes, strict=True)
            )
            self._seen[point] = along, left
        return self._seen[point]
