"""Arcs of an outline that roll on a line: which of them touches depends on how the body is turned alone.

The curve between two segments or hollow parts of an outline is one part of a contact. Of its arcs and corners that one
touches within whose normals the line's is; beyond all of them the curve's end does. With the height A of the body's
origin over the line, its way B along it and the angle phi of its first axis against it, the gap is
``A + x sin(phi) + y cos(phi) - r`` of an arc about (x, y), and the rate of slip ``B' + phi' (A - gap)`` of any.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import reduce

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number, Reading, call, difference, product, sum_of_terms
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Component,
    Direction,
    FormulaMeasure,
    FormulaSpeed,
    Marker,
)
from symgen.describe.contacts.chains import (
    TANGENT,
    BodyOutline,
    OutlinePiece,
    Plane,
    Value,
    angle_between,
    centre_of,
    points_on,
    turn_between,
    turned_by,
)
from symgen.describe.contacts.feet import circle_leaves
from symgen.describe.contacts.surfaces import Touch
from symgen.describe.parts.scope import Scope

#: Largest turn of an arc [rad].
_LARGEST_TURN = 0.55 * math.pi
#: How far a point is beyond both ends of a run at least, over their distance.
_BEYOND = 1e-9


class Rolling(msgspec.Struct, frozen=True):
    """An arc or a corner: centre, radius, the directions of the curve at its ends, and how far they turn."""

    centre: Plane
    radius: Expr
    first: Plane
    last: Plane
    turn: Expr


class ArcRun(msgspec.Struct, frozen=True):
    """Arcs and corners of an outline in order.

    Parameters
    ----------
    parts : tuple of Rolling
        Of each piece with the corner before it, and of the last one with that behind it.
    ends : tuple of two points, or empty
        The curve's ends; none of a whole outline.
    middle : Plane
        The direction of the curve half of the turn after its start.
    pieces : frozenset of int
        The pieces, counted from 0.
    """

    parts: tuple[Rolling, ...]
    ends: tuple[Plane, ...]
    middle: Plane
    pieces: frozenset[int]


def arc_runs(outline: BodyOutline, value: Value) -> list[ArcRun]:
    """Return the runs of convex arcs in which a circle leaves the outline: arcs of other runs are feet."""
    pieces, count = outline.pieces, len(outline.pieces)
    bent = [value(piece.curvature) > 0.0 for piece in pieces]
    whole = outline.closed and all(bent) and all(_turn(outline, i, value) >= -TANGENT for i in range(count))
    runs = [list(range(count))] if whole else list(_stretches_of(outline, bent, value))
    found = list[ArcRun]()
    for run in runs:
        if any(circle_leaves(outline, pieces[i], value) for i in run):
            parts = [each for part in _parts_of(outline, run, whole, value) for each in _split(part, value)]
            # one formula for where one part ends and the next one begins, as between two nothing touches
            begins = [parts[-1].last if whole else parts[0].first, *(part.last for part in parts[:-1])]
            parts = [msgspec.structs.replace(part, first=x) for part, x in zip(parts, begins, strict=True)]
            ends = () if whole else (pieces[run[0]].start, pieces[run[-1]].end)
            found.append(ArcRun(tuple(parts), ends, _middle_of(parts, value), frozenset(run)))
    return found


def stands_on_ends(run: ArcRun, outline: BodyOutline, value: Value) -> bool:
    """Return whether a line may meet both ends of a run at once, as nothing is beyond them."""
    if not run.ends:
        return False
    start, end = (complex(*map(value, point)) for point in run.ends)
    points = [complex(*point) for piece in outline.pieces for point in points_on(piece, value)]
    beyond = max(((point - end) / (start - end)).imag for point in points)
    return beyond <= _BEYOND


def _split(part: Rolling, value: Value) -> Iterator[Rolling]:
    """Yield equal parts of an arc, whose normals at the ends differ by less than half a turn."""
    angle = part.turn
    count = max(1, math.ceil(value(angle) / _LARGEST_TURN))
    if count == 1:
        yield part
        return
    turns = [product(Number(i / count), angle) for i in range(count)]
    ways = [_turned(part.first, turn) for turn in turns]
    for one, other in zip(ways, [*ways[1:], part.last], strict=True):
        yield Rolling(part.centre, part.radius, one, other, product(Number(1.0 / count), angle))


def _turned(direction: Plane, turn: Expr) -> Plane:
    """Return a direction turned to the right."""
    return turned_by(direction, call("cos", turn), call("neg", call("sin", turn)))


def _middle_of(parts: Sequence[Rolling], value: Value) -> Plane:
    """Return the direction of a curve half of its turn after its start."""
    turns = [value(part.turn) for part in parts]
    left = 0.5 * sum(turns)
    for part, turn in zip(parts, turns, strict=True):
        if left <= turn:
            return _turned(part.first, product(Number(left / turn), part.turn))
        left -= turn
    return parts[-1].last


def _turn(outline: BodyOutline, i: int, value: Value) -> float:
    return turn_between(outline.pieces[i - 1], outline.pieces[i], value)


def _stretches_of(outline: BodyOutline, bent: Sequence[bool], value: Value) -> Iterator[list[int]]:
    """Yield the places of arcs that follow each other without a hollow corner."""
    count = len(bent)
    joined = [
        bent[i] and bent[i - 1] and (i > 0 or outline.closed) and _turn(outline, i, value) >= -TANGENT
        for i in range(count)
    ]
    for first in (i for i in range(count) if bent[i] and not joined[i]):
        run = [first]
        while joined[(run[-1] + 1) % count]:
            run.append((run[-1] + 1) % count)
        yield run


def _parts_of(outline: BodyOutline, run: Sequence[int], whole: bool, value: Value) -> Iterator[Rolling]:
    """Yield the arcs of a run, and the corners before and between them and at its end."""
    pieces, count = outline.pieces, len(outline.pieces)
    for i in run:
        if (i > 0 or outline.closed) and _turn(outline, i, value) > TANGENT:
            yield _corner(pieces[i - 1], pieces[i])
        arc, radius = pieces[i], call("div", ONE, pieces[i].curvature)
        yield Rolling(centre_of(arc), radius, arc.first, arc.last, product(arc.curvature, arc.length))
    behind = (run[-1] + 1) % count
    if not whole and (behind > 0 or outline.closed) and _turn(outline, behind, value) > TANGENT:
        yield _corner(pieces[behind - 1], pieces[behind])


def _corner(one: OutlinePiece, other: OutlinePiece) -> Rolling:
    return Rolling(other.start, ZERO, one.last, other.first, angle_between(one.last, other.first))


def touch_of_run(scope: Scope, on: Marker, normal: Direction, outline: BodyOutline, run: ArcRun) -> Touch:
    """Return gap and slip of a run of arcs over the line through a point, with a direction towards it."""
    origin, name = Marker(outline.body, (ZERO, ZERO)), scope.name
    x, y = normal.vector
    along = Direction(on.body, (y, call("neg", x)))
    turns = [
        (sign, Reading(f"{body}.theta", Angle(GROUND, body)))
        for body, sign in ((outline.body, "add"), (on.body, "sub"))
        if body != GROUND and scope.turns(body)
    ]
    phi: Expr = call("neg", call("atan2", *along.vector[::-1]))
    phi = reduce(lambda e, turn: call(turn[0], e, turn[1]), turns, phi)
    sine, cosine = call("sin", phi), call("cos", phi)

    def passed(direction: Plane) -> Expr:
        """Return the condition that the line has turned beyond where it is along a direction of the curve."""
        # that of the outline's normal on the left of the direction is against the line's
        return call("lt", sum_of_terms(product(direction[0], sine), product(direction[1], cosine)), ZERO)

    def height(centre: Plane, radius: Expr) -> Expr:
        return difference(sum_of_terms(product(centre[0], sine), product(centre[1], cosine)), radius)

    first, *others = run.parts
    least = height(first.centre, first.radius)
    if run.ends:
        least = call("where", passed(run.middle), *(height(end, ZERO) for end in run.ends[::-1]))
        others = list(run.parts)
    for part in others:
        within = call("and", passed(part.first), call("not", passed(part.last)))
        least = call("where", within, height(part.centre, part.radius), least)
    above, way = (Component(on, origin, each) for each in (normal, along))
    gap = FormulaMeasure(call("add", Reading(f"{name}.above", above), least))
    lever = difference(Reading(f"{name}.above", above), Reading(f"{name}.distance", gap))
    rates = (msgspec.structs.replace(turn, name=f"{turn.name}.rate", order=1) for _, turn in turns)
    spins = (
        product(Number(1.0 if sign == "add" else -1.0), rate) for (sign, _), rate in zip(turns, rates, strict=True)
    )
    slip = sum_of_terms(Reading(f"{name}.way.rate", way, 1), product(sum_of_terms(*spins), lever))
    return Touch(gap, ZERO, FormulaSpeed(slip))
