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


def feet_of(scope: Scope, key: str, outline: BodyOutline) -> list[Disc]:
    """Return the convex corners and ends of an outline as points, and its convex arcs as discs.

    Raises
    ------
    InputError
        If the disc of an arc is not within the outline.
    """

    def value(e: Expr) -> float:
        return scope.value(e, key)

    pieces = outline.pieces
    places: list[tuple[Plane, Expr]] = [] if outline.closed else [(pieces[0].start, ZERO), (pieces[-1].end, ZERO)]
    places += [
        (piece.start, ZERO)
        for i, piece in enumerate(pieces)
        if (i or outline.closed) and turn_between(pieces[i - 1], piece, value) > TANGENT
    ]
    found = list[tuple[complex, float]]()
    for number, piece in enumerate(pieces, 1):
        if value(piece.curvature) <= 0.0:
            continue
        place, radius = centre_of(piece), call("div", ONE, piece.curvature)
        centre, far = _number(place, value), value(radius)
        near = _NEAR * (abs(centre) + far)
        if min(_distance(each, centre, value) for each in pieces) < far - near:
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
