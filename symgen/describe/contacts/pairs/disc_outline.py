"""A disc beside an outline: its segments and arcs offset by the radius, one chain a run between concave corners."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr, Number, Reading, product, sum_of_terms
from symgen.base.vocabulary.measures import GROUND, Angle, Chain, FormulaMeasure, Lap, Marker, OnChain
from symgen.describe.contacts.chains import (
    EDGE_OF_POINT,
    BodyOutline,
    OutlinePiece,
    Value,
    continued,
    depths_of,
    edged,
    hollow_corners,
    offset_pieces,
    points_on,
    runs_of,
    stretches_left,
)
from symgen.describe.contacts.outlines import LineInPieces, Outline
from symgen.describe.contacts.surfaces import (
    OUTLINE,
    Disc,
    OutlineTable,
    Pair,
    Touch,
    check_bodies,
    outline_named,
)
from symgen.describe.parts.scope import Scope


def read_disc_beside_outline(scope: Scope, key: str, table: OutlineTable, disc: Disc) -> Touch:
    """Return gap and slip of a disc beside each run of an outline, of which one is in touch at a place.

    Raises
    ------
    InputError
        If the disc is a hole, or not smaller than a hollow arc.
    """
    outline = outline_named(scope, key, table)
    check_bodies(scope, key, outline.body, disc)
    drawn = disc.outline, drawn_outline(outline, lambda e: scope.value(e, key))
    return as_one(touches_on_outline(scope, key, outline, disc, drawn))


def as_one(touches: Sequence[Touch]) -> Touch:
    """Return the touch of several parts of a surface."""
    first, *others = touches
    return msgspec.structs.replace(first, further=tuple(others))


def touches_on_outline(
    scope: Scope,
    key: str,
    outline: BodyOutline,
    disc: Disc,
    drawn: tuple[Outline, ...],
    faces: bool = False,
    edges: float = EDGE_OF_POINT,
) -> list[Touch]:
    """Return gap and slip of a disc beside each run of an outline; a point meets edges in place of corners.

    With `faces` the disc leaves what is convex, whose contacts are those of feet of the outline; `edges` are radii over
    the outline's size.
    """

    def value(e: Expr) -> float:
        return scope.value(e, key)

    _check_disc(scope, key, outline, disc)
    edge: Expr = ZERO
    if disc.size == 0.0:
        outline, edge = edged(outline, value, edges)
    runs, solid = runs_of(outline, value), depths_of(outline, value)
    closed = outline.closed and not hollow_corners(outline, value)
    frame = scope.marker(f"{key}.outline", outline.body, (0.0, 0.0))
    touches = list[Touch]()
    for number, run in enumerate(runs):
        depths, pieces = [solid[stretch] for stretch in run], list(run)
        if edge != ZERO and not closed:
            if outline.closed or number > 0:
                pieces[0] = continued(pieces[0].back).back
            if outline.closed or number < len(runs) - 1:
                pieces[-1] = continued(pieces[-1])
        parts = offset_pieces(pieces, closed, disc.radius, depths, value, edge)
        # a point meets the edges at corners also of faces alone
        bends = [value(part.curvature) for part in parts]
        round_parts = [faces and k > 0.0 and k * value(edge) < 0.5 for k in bends]
        if all(round_parts):
            continue
        hollow = any(value(stretch.curvature) < 0.0 for stretch in run)
        leaving = stretches_left(parts, round_parts, closed) if any(round_parts) else ()
        chain = Chain(frame, disc.centre, parts, closed, hollow, edge != ZERO or bool(leaving), leaving)
        way: Expr = Reading(f"{scope.name}.way", Lap(chain) if closed else OnChain(chain, "way"))
        turns = tuple(
            product(Number(sign), disc.radius, Reading(f"{of}.theta", Angle(GROUND, of)))
            for of, sign in ((disc.body, 1.0), (outline.body, -1.0))
            if of != GROUND and scope.turns(of)
        )
        gap = FormulaMeasure(Reading(f"{scope.name}.distance", OnChain(chain, "gap")))
        touches.append(Touch(gap, ZERO, FormulaMeasure(sum_of_terms(way, *turns)), None, drawn))
    return touches


def _check_disc(scope: Scope, key: str, outline: BodyOutline, disc: Disc) -> None:
    """Refuse a disc that cannot touch all of an outline."""
    if disc.size < 0.0:
        raise scope.error(key, "a disc or a point beside an outline", f"a hole of {-disc.size!r} m")
    for number, piece in enumerate(outline.pieces, 1):
        k = scope.value(piece.curvature, key)
        if k < 0.0 and -k * disc.size >= 1.0:
            got = f"piece {number} of '{outline.name}' with a radius of {-1.0 / k:.6g} m"
            raise scope.error(key, f"hollow arcs with radii above that of the disc, {disc.size:.6g} m", got)


def drawn_outline(outline: BodyOutline, value: Value) -> Outline:
    """Return the line along an outline with the defaults of parameters."""
    fine = outline.gear is None and not outline.source  # arcs of teeth and of drawn curves are short
    parts = [points_on(stretch, value) if fine else _start(stretch, value) for stretch in outline.pieces]
    points, starts = [p for part in parts for p in part], tuple(accumulate(map(len, parts[:-1]), initial=0))
    x, y = outline.pieces[-1].end
    points.append((value(x), value(y)))
    markers = tuple(Marker(outline.body, (Number(x), Number(y))) for x, y in points)
    return LineInPieces(markers, words=_words_on(outline, value), starts=starts)


def _start(stretch: OutlinePiece, value: Value) -> list[tuple[float, float]]:
    return [(value(stretch.start[0]), value(stretch.start[1]))]


def _words_on(outline: BodyOutline, value: Value) -> str:
    """Return what `symgen inspect` says of an outline."""
    pieces = outline.pieces
    length = sum(value(piece.length) for piece in pieces)
    hollow = [i + 1 for i in hollow_corners(outline, value)]
    corners = f"hollow corners before pieces {', '.join(map(str, hollow))}" if hollow else "no hollow corner"
    source = f", {outline.source}" if outline.source else ""
    return f"outline {outline.name}: {len(pieces)} pieces, {length:.6g} m, {corners}{source}"


KIND = Pair(OUTLINE, OutlineTable, read_disc_beside_outline, None)
