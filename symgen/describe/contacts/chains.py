"""Outlines of bodies: segments and arcs from the points of a table, and the chains that discs beside them have.

A disc touches an outline where its centre is on the outline offset by its radius: a smooth chain, in which convex
corners are arcs of that radius. At a concave corner the outline is cut into runs, each with a chain of its own.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number, call, difference, product, sum_of_terms
from symgen.base.vocabulary.measures import ChainPiece
from symgen.describe.contacts.gear import Gear

#: Turn of the direction below which two pieces are tangent [rad].
TANGENT = 1e-9
#: Largest turn of a piece [rad]: a marker is between the normals at its ends only if these differ by less than pi.
_LARGEST_TURN = 0.55 * math.pi

#: Radius that takes the place of 0 at corners and ends, over the size of an outline: of a point, and of corners of
#: other outlines. Two corners that pass each other while faces lie on each other would strike at a smaller one.
EDGE_OF_POINT, EDGE_OF_FEET = 1e-9, 1e-7
#: How far a run goes on beyond a hollow corner for a point, over the length of its last piece.
_BEYOND = 1e-2
#: Parts of a side in which what is beyond a piece is looked for, what counts as on it over the size of all, and the
#: depth over that size if nothing is beyond.
_PARTS, _ON, _ANY = 16, 1e-9, 10.0

#: A point or a direction in the frame of a body.
Plane = tuple[Expr, Expr]
#: The number that a formula is with the defaults of parameters.
Value = Callable[[Expr], float]


class OutlinePiece(msgspec.Struct, frozen=True):
    """A segment or an arc of an outline.

    Parameters
    ----------
    start, end : Plane
        Its ends [m].
    first, last : Plane
        Its directions there.
    curvature : Expr
        Above 0 where it turns to the right [1/m], 0 of a segment.
    length : Expr
        Its length [m].
    """

    start: Plane
    end: Plane
    first: Plane
    last: Plane
    curvature: Expr
    length: Expr

    @property
    def back(self) -> OutlinePiece:
        """The same from its end to its start."""
        first, last = (_scaled(Number(-1.0), e) for e in (self.last, self.first))
        return OutlinePiece(self.end, self.start, first, last, call("neg", self.curvature), self.length)


class BodyOutline(msgspec.Struct, frozen=True):
    """An outline of a body: its pieces in order, the free side on their left."""

    name: str
    body: str
    closed: bool
    pieces: tuple[OutlinePiece, ...]
    gear: Gear | None = None
    source: str = ""  # words on the drawing of which it is


# -- pieces ------------------------------------------------------------------------------------------------------------


def segment(start: Plane, end: Plane) -> OutlinePiece:
    """Return the segment between two points."""
    length = _length(_less(end, start))
    along = _over(_less(end, start), length)
    return OutlinePiece(start, end, along, along, ZERO, length)


def arc(start: Plane, end: Plane, sine: Expr, cosine: Expr, side: float) -> OutlinePiece:
    """Return the arc between two points.

    Parameters
    ----------
    start, end : Plane
        Its ends [m].
    sine, cosine : Expr
        Of half of its angle.
    side : float
        1 where it turns to the right, -1 to the left.
    """
    chord = segment(start, end)
    size = product(Number(2.0), call("div", sine, chord.length))
    turned = product(Number(side), sine)
    angle = product(Number(2.0), call("atan2", sine, cosine))
    first, last = turned_by(chord.first, cosine, turned), turned_by(chord.first, cosine, call("neg", turned))
    return OutlinePiece(start, end, first, last, product(Number(side), size), call("div", angle, size))


def filleted(
    one: OutlinePiece, other: OutlinePiece, radius: Expr, side: float
) -> tuple[OutlinePiece, OutlinePiece, OutlinePiece]:
    """Return two segments, shortened, and the arc of a radius between them; `side` as of `arc`."""
    cosine, sine = _dot(one.last, other.first), product(Number(-side), _cross(one.last, other.first))
    cut = product(radius, call("div", sine, call("add", ONE, cosine)))
    start = _plus(one.end, _scaled(call("neg", cut), one.last))
    end = _plus(other.start, _scaled(cut, other.first))
    length = product(radius, call("atan2", sine, cosine))
    between = OutlinePiece(start, end, one.last, other.first, call("div", Number(side), radius), length)
    shorter = (
        msgspec.structs.replace(one, end=start, length=difference(one.length, cut)),
        msgspec.structs.replace(other, start=end, length=difference(other.length, cut)),
    )
    return shorter[0], between, shorter[1]


def angle_between(one: Plane, other: Plane) -> Expr:
    """Return how far a direction turns to the right to another one, a formula [rad]."""
    return call("atan2", call("neg", _cross(one, other)), _dot(one, other))


def turn_between(one: OutlinePiece, other: OutlinePiece, value: Value) -> float:
    """Return how far the direction turns to the right between two pieces, from -pi to pi [rad]."""
    return math.atan2(-value(_cross(one.last, other.first)), value(_dot(one.last, other.first)))


def signed_area(stretches: Sequence[OutlinePiece], value: Value) -> float:
    """Return the area within closed pieces with the defaults of parameters, below 0 where they go clockwise [m^2]."""
    points = [point for stretch in stretches for point in points_on(stretch, value)]
    pairs = zip(points, points[1:] + points[:1], strict=True)
    return 0.5 * sum(x * far_y - y * far_x for (x, y), (far_x, far_y) in pairs)


def points_on(stretch: OutlinePiece, value: Value) -> list[tuple[float, float]]:
    """Return points of a piece with the defaults of parameters, without its end: of an arc one every three degrees."""
    (x, y), (tx, ty) = (tuple(map(value, pair)) for pair in (stretch.start, stretch.first))
    k, length = value(stretch.curvature), value(stretch.length)
    count = 1 if k == 0.0 else max(8, math.ceil(abs(k) * length * 60.0 / math.pi))
    turns = [k * length * i / count for i in range(count)]
    return [
        (
            x + (tx * math.sin(turn) + ty * (1.0 - math.cos(turn))) / k,
            y + (ty * math.sin(turn) - tx * (1.0 - math.cos(turn))) / k,
        )
        if k
        else (x, y)
        for turn in turns
    ]


def crossing_of(outline: BodyOutline, value: Value) -> tuple[int, int] | None:
    """Return the numbers, counted from 1, of two pieces of an outline that cross; None where none do."""
    sides = list[tuple[int, tuple[float, float], tuple[float, float]]]()
    for number, stretch in enumerate(outline.pieces, 1):
        end = value(stretch.end[0]), value(stretch.end[1])
        points = [*points_on(stretch, value), end]
        sides += [(number, a, b) for a, b in pairwise(points)]
    for i, (one, a, b) in enumerate(sides):
        for j in range(i + 2, len(sides)):
            other, c, d = sides[j]
            neighbours = outline.closed and (i, j) == (0, len(sides) - 1)
            if not neighbours and _cross_each_other(a, b, c, d):
                return one, other
    return None


def _cross_each_other(*ends: tuple[float, float]) -> bool:
    """Return whether two segments have a point in common that is no end of theirs."""
    a, b, c, d = ends

    def side(p: tuple[float, float], q: tuple[float, float], r: tuple[float, float]) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    return side(a, b, c) * side(a, b, d) < 0.0 and side(c, d, a) * side(c, d, b) < 0.0


def centre_of(stretch: OutlinePiece) -> Plane:
    """Return the centre of an arc."""
    return _plus(stretch.start, _scaled(call("div", Number(-1.0), stretch.curvature), _left(stretch.first)))


# -- chains ------------------------------------------------------------------------------------------------------------


def hollow_corners(outline: BodyOutline, value: Value) -> list[int]:
    """Return the places of the pieces before which an outline has a hollow corner, counted from 0."""
    pieces = outline.pieces
    return [
        i
        for i in range(0 if outline.closed else 1, len(pieces))
        if turn_between(pieces[i - 1], pieces[i], value) < -TANGENT
    ]


def runs_of(outline: BodyOutline, value: Value) -> tuple[tuple[OutlinePiece, ...], ...]:
    """Return the pieces of an outline between its concave corners; all of them where it has none."""
    pieces, closed, hollow = outline.pieces, outline.closed, hollow_corners(outline, value)
    if not hollow:
        return (pieces,)
    if closed:
        pieces = pieces[hollow[0] :] + pieces[: hollow[0]]
        hollow = [i - hollow[0] for i in hollow[1:]]
    starts = [0, *hollow, len(pieces)]
    return tuple(pieces[a:b] for a, b in pairwise(starts))


def depths_of(outline: BodyOutline, value: Value) -> dict[OutlinePiece, float]:
    """Return how deep places on the right of each piece are nearer to it than to what is beyond them [m].

    A disc that a long step has taken into the body is still seen there.
    """
    points = list[complex]()
    for stretch in outline.pieces:
        ends = [complex(*point) for point in points_on(stretch, value)] + [_number(stretch.end, value)]
        parts = _PARTS if len(ends) == 2 else 1
        points += [a + (b - a) * i / parts for a, b in pairwise(ends) for i in range(parts + 1)]
    far = _ANY * max(map(abs, points))
    return {stretch: 0.5 * _nearest_behind(stretch, points, far, value) for stretch in outline.pieces}


def _nearest_behind(stretch: OutlinePiece, points: Sequence[complex], far: float, value: Value) -> float:
    """Return the distance of the nearest of some points on the right of a piece; `far` without any."""
    start, end, first, last = (_number(x, value) for x in (stretch.start, stretch.end, stretch.first, stretch.last))
    k, near = value(stretch.curvature), far
    for point in points:
        u = (point - start) * first.conjugate()
        height = 2.0 * u.imag + k * abs(u) ** 2
        gap = height / (1.0 + math.sqrt(max(0.0, 1.0 + k * height)))
        if u.real >= 0.0 and ((point - end) * last.conjugate()).real <= 0.0 and gap < -far * _ON / _ANY:
            near = min(near, -gap)
    return near if k <= 0.0 else min(near, 2.0 / k)


def _number(a: Plane, value: Value) -> complex:
    return complex(value(a[0]), value(a[1]))


def edged(outline: BodyOutline, value: Value, part: float) -> tuple[BodyOutline, Expr]:
    """Return an outline with the edges that a point meets in place of corners, and the radius of its ends.

    A distance from a corner has no direction at the corner. Fillets of a small part of the outline's size have one.
    """
    size = max(abs(value(x)) for piece in outline.pieces for x in (*piece.start, *piece.end))
    radius, pieces, between = Number(part * size), list(outline.pieces), dict[int, OutlinePiece]()
    for i in range(0 if outline.closed else 1, len(pieces)):
        if turn_between(pieces[i - 1], pieces[i], value) > TANGENT:
            pieces[i - 1], between[i], pieces[i] = filleted(pieces[i - 1], pieces[i], radius, 1.0)
    whole = (x for i, piece in enumerate(pieces) for x in (between.get(i), piece) if x is not None)
    return msgspec.structs.replace(outline, pieces=tuple(whole)), radius


def continued(stretch: OutlinePiece) -> OutlinePiece:
    """Return a segment that goes on beyond its end, under what follows a hollow corner; an arc as it is."""
    if stretch.curvature != ZERO:
        return stretch
    length = product(Number(1.0 + _BEYOND), stretch.length)
    end = _plus(stretch.start, _scaled(length, stretch.first))
    return msgspec.structs.replace(stretch, end=end, length=length)


def offset_pieces(
    stretches: Sequence[OutlinePiece],
    closed: bool,
    radius: Expr,
    depths: Sequence[float],
    value: Value,
    edge: Expr = ZERO,
) -> tuple[ChainPiece, ...]:
    """Return the chain on which the centre of a disc lies that touches pieces without a concave corner.

    An open chain begins and ends with a half circle about its end, of the radius of the disc and the `edge`. A closed
    one has an even number of pieces, so that what is 0 at their junctions changes its sign at each.
    """
    pieces, rounding = list[_Piece](), sum_of_terms(radius, edge)
    if not closed:
        first = stretches[0]
        end = _plus(first.start, _scaled(call("neg", edge), _left(first.first)))
        pieces.append(_about(end, _scaled(Number(-1.0), first.first), rounding, Number(math.pi)))
    for i, stretch in enumerate(stretches):
        before = stretches[i - 1]
        if (i or closed) and (turn := turn_between(before, stretch, value)) > TANGENT:
            angle = call("atan2", call("neg", _cross(before.last, stretch.first)), _dot(before.last, stretch.first))
            pieces += _about(stretch.start, before.last, radius, angle).split(math.ceil(turn / _LARGEST_TURN))
        growth = call("add", ONE, product(stretch.curvature, radius))
        start = _plus(stretch.start, _scaled(radius, _left(stretch.first)))
        curvature, length = call("div", stretch.curvature, growth), product(stretch.length, growth)
        depth = sum_of_terms(radius, Number(depths[i]))
        whole = _Piece(start, stretch.first, ZERO if stretch.curvature == ZERO else curvature, length, depth)
        turn = abs(value(stretch.curvature) * value(stretch.length))
        pieces += whole.split(max(1, math.ceil(turn / _LARGEST_TURN)))
    if not closed:
        last = stretches[-1]
        end = _plus(last.end, _scaled(call("neg", edge), _left(last.last)))
        pieces.append(_about(end, last.last, rounding, Number(math.pi)))
    elif len(pieces) % 2:
        longest = max(range(len(pieces)), key=lambda i: value(pieces[i].length))
        pieces[longest : longest + 1] = pieces[longest].split(2)
    return tuple(_with_ways(pieces))


def stretches_left(pieces: Sequence[ChainPiece], left: Sequence[bool], closed: bool) -> tuple[tuple[Expr, Expr], ...]:
    """Return of each piece of a chain the ways at the ends of the stretch of pieces that are left; equal of others."""
    count, round_trip = len(pieces), sum_of_terms(pieces[-1].before, pieces[-1].length)
    found: list[tuple[Expr, Expr]] = [(ZERO, ZERO)] * count
    for i in range(count):
        if not left[i] or (left[i - 1] and (i or closed)):
            continue
        following = next(j for j in range(i + 1, i + count + 1) if not left[j % count] or (j == count and not closed))
        end = pieces[(following - 1) % count]
        first, last = pieces[i].before, sum_of_terms(end.before, end.length)
        for j in range(i, following):
            ways = [(first, last), (first, sum_of_terms(last, round_trip)), (difference(first, round_trip), last)]
            found[j % count] = ways[0 if following <= count else 1 + (j >= count)]
    return tuple(found)


class _Piece(msgspec.Struct, frozen=True):
    """A piece of a chain, as a `ChainPiece` without the way before it."""

    start: Plane
    along: Plane
    curvature: Expr
    length: Expr
    depth: Expr

    def split(self, count: int) -> list[_Piece]:
        """Return equal parts of it."""
        part = product(Number(1.0 / count), self.length)
        return [
            _Piece(*self._at(product(Number(float(i)), part)), self.curvature, part, self.depth) for i in range(count)
        ]

    def _at(self, way: Expr) -> tuple[Plane, Plane]:
        """Return the point at a way from its start, and its direction there."""
        if way == ZERO:
            return self.start, self.along
        if self.curvature == ZERO:
            return _plus(self.start, _scaled(way, self.along)), self.along
        turn = product(self.curvature, way)
        sine, cosine = call("sin", turn), call("cos", turn)
        ahead, left = call("div", sine, self.curvature), call("div", call("sub", cosine, ONE), self.curvature)
        point = _plus(_plus(self.start, _scaled(ahead, self.along)), _scaled(left, _left(self.along)))
        return point, turned_by(self.along, cosine, call("neg", sine))


def _about(corner: Plane, along: Plane, radius: Expr, angle: Expr) -> _Piece:
    """Return the arc about a corner that begins in a direction and turns to the right by an angle."""
    start = _plus(corner, _scaled(radius, _left(along)))
    return _Piece(start, along, call("div", ONE, radius), product(radius, angle), radius)


def _with_ways(pieces: Sequence[_Piece]) -> Iterator[ChainPiece]:
    before: Expr = ZERO
    for piece in pieces:
        yield ChainPiece(piece.start, piece.along, piece.curvature, piece.length, piece.depth, before)
        before = sum_of_terms(before, piece.length)


# -- the plane ---------------------------------------------------------------------------------------------------------


def _plus(a: Plane, b: Plane) -> Plane:
    return sum_of_terms(a[0], b[0]), sum_of_terms(a[1], b[1])


def _less(a: Plane, b: Plane) -> Plane:
    return difference(a[0], b[0]), difference(a[1], b[1])


def _scaled(factor: Expr, a: Plane) -> Plane:
    return product(factor, a[0]), product(factor, a[1])


def _over(a: Plane, divisor: Expr) -> Plane:
    return call("div", a[0], divisor), call("div", a[1], divisor)


def _left(a: Plane) -> Plane:
    return product(Number(-1.0), a[1]), a[0]


def turned_by(a: Plane, cosine: Expr, sine: Expr) -> Plane:
    """Return a direction turned to the left by an angle."""
    return _plus(_scaled(cosine, a), _scaled(sine, _left(a)))


def _dot(a: Plane, b: Plane) -> Expr:
    return sum_of_terms(product(a[0], b[0]), product(a[1], b[1]))


def _cross(a: Plane, b: Plane) -> Expr:
    return difference(product(a[0], b[1]), product(a[1], b[0]))


def _length(a: Plane) -> Expr:
    return call("sqrt", _dot(a, a))
