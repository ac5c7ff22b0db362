"""The section ``outlines`` of files: chains of segments and arcs, fixed in bodies."""

from __future__ import annotations

import math
from collections.abc import Iterator

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number, call, product, sum_of_terms
from symgen.describe.contacts.chains import (
    TANGENT,
    BodyOutline,
    OutlinePiece,
    Plane,
    arc,
    crossing_of,
    filleted,
    segment,
    signed_area,
    turn_between,
)
from symgen.describe.contacts.drawings import DRAWN, drawing_given, read_drawing
from symgen.describe.contacts.gear_teeth import teeth_of_gear
from symgen.describe.contacts.outline_sections import OutlineSection, PointTable
from symgen.describe.parts.fields import read_table, value_in_words
from symgen.describe.parts.scope import Scope

#: Lengths below this part of the sum of coordinates are none.
_NONE = 1e-12
#: Keys that say what an outline is.
_SHAPES = ("points", "polygon", "box", "gear_profile", *DRAWN)


def read_outline(scope: Scope, raw: object) -> BodyOutline:
    """Return an outline from its table.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    section = read_table(OutlineSection, raw, scope.where(""))
    if scope.spatial:
        raise scope.error("", "an outline in a mechanism in the plane", "one in space")
    body = scope.body("body", section.body)
    if body in scope.context.bodies and scope.context.bodies[body].is_point:
        raise scope.error("body", "a body with an angle, or the ground", f"the point mass '{body}'")
    given = [key for key in _SHAPES if getattr(section, key) is not None]
    if len(given) != 1:
        expected = f"one of {', '.join(_SHAPES[:-1])} and {_SHAPES[-1]}"
        raise scope.error("points", expected, " and ".join(given) if given else "none of them")
    gear, source, tables = None, "", list[PointTable | None]()
    if drawing_given(section, scope) or section.gear_profile is not None:
        if section.gear_profile is not None:
            closed = True
            gear, corners = teeth_of_gear(scope, section.gear_profile)
        else:
            drawn, closed, source = read_drawing(scope, section)
            corners = [((Number(p.real), Number(p.imag)), bulge) for p, bulge in drawn]
        points = list[PointTable | Plane](_placed(scope, section, [place for place, _ in corners]))
        tables = [PointTable(to=(0.0, 0.0), bulge=bulge) for _, bulge in corners]
    elif section.points is None:
        points, closed = list(_corners_of_shape(scope, section)), True
    else:
        for key in ("at", "angle"):
            if getattr(section, key) is not None:
                raise scope.error(key, "no such key beside points", value_in_words(getattr(section, key)))
        points, closed = [_read_point(scope, i, point) for i, point in enumerate(section.points)], section.closed
    if section.inside and not closed:
        raise scope.error("inside", "the key closed beside it, as a chain with ends has no inside", "an open one")
    reader = _Reader(scope, points, closed, section)
    if tables:
        reader.tables = tables
    if gear is not None:
        at = (ZERO, ZERO) if section.at is None else scope.vector("at", section.at)
        angle = ZERO if section.angle is None else scope.constant("angle", section.angle)
        gear = msgspec.structs.replace(gear, first=angle, centre=(at[0], at[1]))
    outline = BodyOutline(scope.name, body, closed, tuple(reader.read()), gear, source)
    if gear is None and (crossing := crossing_of(outline, reader.value)) is not None:
        got = "pieces {} and {} that cross".format(*crossing)
        raise scope.error(given[0], "a chain that does not cross itself", got)
    return outline


def _read_point(scope: Scope, i: int, raw: object) -> PointTable:
    table = raw if isinstance(raw, dict) else {"to": raw}
    return read_table(PointTable, table, scope.where(f"points[{i}]"))


def _corners_of_shape(scope: Scope, section: OutlineSection) -> Iterator[PointTable | Plane]:
    """Yield the corners of a polygon or a box, counterclockwise."""
    places = list[Plane]()
    if section.polygon is not None:
        sides = section.polygon.sides
        if sides < 3:
            raise scope.error("polygon.sides", "a number of at least 3", repr(sides))
        radius = scope.constant("polygon.radius", section.polygon.radius, positive=True)
        turns = [2.0 * math.pi * i / sides for i in range(sides)]
        places = [(product(Number(math.cos(x)), radius), product(Number(math.sin(x)), radius)) for x in turns]
    elif section.box is not None:
        width, height = (scope.constant(f"box[{i}]", size, positive=True) for i, size in enumerate(section.box))
        signs = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
        places = [(product(Number(x), width), product(Number(y), height)) for x, y in signs]
    yield from _placed(scope, section, places)


def _placed(scope: Scope, section: OutlineSection, places: list[Plane]) -> Iterator[Plane]:
    """Yield points of a shape, turned by its angle about the origin and moved to its place."""
    x, y = (ZERO, ZERO) if section.at is None else scope.vector("at", section.at)
    angle = ZERO if section.angle is None else scope.constant("angle", section.angle)
    cosine, sine = call("cos", angle), call("sin", angle)
    for across, up in places:
        turned = (
            sum_of_terms(x, product(cosine, across), call("neg", product(sine, up))),
            sum_of_terms(y, product(sine, across), product(cosine, up)),
        )
        yield turned


class _Reader:
    """Points of an outline being read."""

    def __init__(self, scope: Scope, points: list[PointTable | Plane], closed: bool, section: OutlineSection) -> None:
        self.scope, self.closed, self.way = scope, closed, -1.0 if section.inside else 1.0
        self.fillet = None if section.fillet is None else scope.constant("fillet", section.fillet, positive=True)
        self.points = list[Plane]()
        self.tables = [point if isinstance(point, PointTable) else None for point in points]
        for i, point in enumerate(points):
            if isinstance(point, PointTable):
                x, y = scope.vector(f"points[{i}].to", point.to)
                self.points.append((x, y))
            else:
                self.points.append(point)
        values = [tuple(map(self.value, point)) for point in self.points]
        self.size = sum(abs(x) for point in values for x in point)
        if closed and len(values) > 2 and math.dist(values[0], values[-1]) <= _NONE * self.size:
            self.points[-1] = self.points[0]  # the last piece leads back to the first point
        elif closed:
            self.points.append(self.points[0])
            self.tables.append(None)
        if len(self.points) < (3 if closed else 2):
            raise scope.error("points", "two points or more", value_in_words(len(values)))

    def value(self, e: Expr) -> float:
        """Return a number with the defaults of parameters."""
        return self.scope.value(e, "points")

    def read(self) -> list[OutlinePiece]:
        """Return the pieces, the free side on their left."""
        for number in range(1, len(self.points)):
            a, b = (tuple(map(self.value, self.points[i])) for i in (number - 1, number))
            if math.dist(a, b) <= _NONE * self.size:
                following = number % (len(self.points) - 1) + 1 if self.closed else number + 1
                got = f"points {number} and {following} at one place"
                raise self.scope.error("points", "points that differ from the ones before them", got)
        stretches = self._stretches(1.0)
        if self.closed and self.way * signed_area(stretches, self.value) > 0.0:
            turned = self._stretches(-1.0)
            if self.way * signed_area(turned, self.value) > 0.0:
                stretches = self._with_fillets(turned)
                return [stretch.back for stretch in reversed(stretches)]
        return self._with_fillets(stretches)

    def _stretches(self, side: float) -> list[OutlinePiece]:
        """Return the pieces; `side` is 1 where the free side is on the left of the way along the points."""
        return [self._stretch(i, side) for i in range(1, len(self.points))]

    def _stretch(self, i: int, side: float) -> OutlinePiece:
        start, end, table, scope = self.points[i - 1], self.points[i], self.tables[i], self.scope
        key = f"points[{i}]"
        if table is None or (table.radius is None and table.bulge is None):
            return segment(start, end)
        if table.radius is not None and table.bulge is not None:
            raise scope.error(key, "radius or bulge", "both")
        if table.bulge is not None:
            bulge = scope.constant(f"{key}.bulge", table.bulge)
            if (size := scope.value(bulge, f"{key}.bulge")) == 0.0:
                return segment(start, end)
            square, sign = product(bulge, bulge), math.copysign(1.0, size)
            over = call("add", ONE, square)
            sine = call("div", product(Number(2.0 * sign), bulge), over)
            return arc(start, end, sine, call("div", call("sub", ONE, square), over), -sign)
        radius = scope.constant(f"{key}.radius", table.radius or 0.0)
        sign = math.copysign(1.0, size := scope.value(radius, f"{key}.radius"))
        chord = segment(start, end).length
        if abs(size) < (half := 0.5 * self.value(chord)):
            got = f"{size!r} m between points {half:.6g} m from their middle"
            raise scope.error(f"{key}.radius", "at least half of the distance of the arc's ends", got)
        sine = call("div", product(Number(0.5 * sign), chord), radius)
        cosine = call("sqrt", call("sub", ONE, product(sine, sine)))
        return arc(start, end, sine, call("neg", cosine) if table.large else cosine, side * sign)

    def _with_fillets(self, pieces: list[OutlinePiece]) -> list[OutlinePiece]:
        """Return pieces with fillets at corners."""
        arcs, pieces = dict[int, OutlinePiece](), list(pieces)
        for i in range(0 if self.closed else 1, len(pieces)):
            table = self.tables[i] or (self.tables[-1] if i == 0 else None)
            own = None if table is None else table.fillet
            radius = self.fillet if own is None else self.scope.constant(f"points[{i}].fillet", own, positive=True)
            turn = turn_between(pieces[i - 1], pieces[i], self.value)
            if radius is None or abs(turn) <= TANGENT:
                continue
            if ZERO != pieces[i - 1].curvature or ZERO != pieces[i].curvature:
                raise self.scope.error(f"points[{i}]", "a fillet between two segments", "an arc beside it")
            pieces[i - 1], arcs[i], pieces[i] = filleted(pieces[i - 1], pieces[i], radius, math.copysign(1.0, turn))
        for i, piece in enumerate(pieces, 1):
            if arcs and self.value(piece.length) < -_NONE * self.size:
                raise self.scope.error(
                    "fillet", "fillets that leave room for each other", f"piece {i}, where they meet"
                )
        whole = [x for i, piece in enumerate(pieces) for x in (arcs.get(i), piece) if x is not None]
        return [piece for piece in whole if self.value(piece.length) > _NONE * self.size]
