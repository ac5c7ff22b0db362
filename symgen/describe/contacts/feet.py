"""Feet of an outline: the corners, ends and round parts with which it stands on other shapes."""

from __future__ import annotations

import cmath
import math

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, call
from symgen.base.vocabulary.measures import Marker
from symgen.describe.contacts.chains import TANGENT, BodyOutline, OutlinePiece, Plane, Value, centre_of, turn_between
from symgen.describe.contacts.surfaces import Disc
from symgen.describe.parts.scope import Scope

#: Part of an outline's size below which distances are 0.
_NEAR = 1e-9


def circle_leaves(outline: BodyOutline, piece: OutlinePiece, value: Value) -> bool:
    """Return whether the circle of a convex arc is not within its outline."""
    centre, far = _number(centre_of(piece), value), 1.0 / value(piece.curvature)
    return min(_distance(each, centre, value) for each in outline.pieces) < far - _NEAR * (abs(centre) + far)


def feet_of(scope: Scope, key: str, outline: BodyOutline, apart: frozenset[int] = frozenset()) -> list[Disc]:
    """Return the convex corners and ends of an outline as points, and its convex arcs as discs.

    Pieces that are `apart`, counted from 0, and corners beside them are left out.

    Raises
    ------
    InputError
        If the disc of an arc is not within the outline.
    """

    def value(e: Expr) -> float:
        return scope.value(e, key)

    pieces = outline.pieces
    ends = () if outline.closed else ((0, pieces[0].start), (len(pieces) - 1, pieces[-1].end))
    places: list[tuple[Plane, Expr]] = [(end, ZERO) for i, end in ends if i not in apart]
    places += [
        (piece.start, ZERO)
        for i, piece in enumerate(pieces)
        if (i or outline.closed)
        and turn_between(pieces[i - 1], piece, value) > TANGENT
        and not {i, (i - 1) % len(pieces)} & apart
    ]
    found = list[tuple[complex, float]]()
    for number, piece in enumerate(pieces, 1):
        if value(piece.curvature) <= 0.0 or number - 1 in apart:
            continue
        place, radius = centre_of(piece), call("div", ONE, piece.curvature)
        centre, far = _number(place, value), value(radius)
        near = _NEAR * (abs(centre) + far)
        if circle_leaves(outline, piece, value):
            got = f"piece {number} of '{outline.name}', whose circle of {far:.6g} m leaves it"
            raise scope.error(key, "convex arcs whose circles lie within the outline", got)
        if all(abs(centre - c) + abs(far - r) > near for c, r in found):
            found.append((centre, far))
            places.append((place, radius))
    return [Disc(Marker(outline.body, place), radius, value(radius)) for place, radius in places]


def _distance(stretch: OutlinePiece, point: complex, value: Value) -> float:
    """Return the distance of a point from a piece."""
    start, end, k = _number(stretch.start, value), _number(stretch.end, value), value(stretch.curvature)
    ends = min(abs(point - start), abs(point - end))
    if k == 0.0:
        along = (point - start) / (end - start)
        return abs(along.imag * (end - start)) if 0.0 <= along.real <= 1.0 else ends
    centre = _number(centre_of(stretch), value)
    turn = -math.copysign(1.0, k) * cmath.phase((point - centre) / (start - centre)) % math.tau
    within = point == centre or turn <= abs(k) * value(stretch.length)
    return abs(abs(point - centre) - 1.0 / abs(k)) if within else ends


def _number(place: Plane, value: Value) -> complex:
    return complex(value(place[0]), value(place[1]))
