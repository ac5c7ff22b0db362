"""A disc beside an outline: its segments and arcs offset by the radius, one chain a run between concave corners."""

from __future__ import annotations

import msgspec

from symgen.base.errors import quote, suggest
from symgen.base.vocabulary.expressions import ZERO, Expr, Number, Reading, product, sum_of_terms
from symgen.base.vocabulary.measures import GROUND, Angle, Chain, FormulaMeasure, Lap, Marker, OnChain
from symgen.describe.contacts.chains import (
    TANGENT,
    BodyOutline,
    Value,
    depths_of,
    hollow_corners,
    offset_pieces,
    points_on,
    runs_of,
    turn_between,
)
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.surfaces import Disc, Pair, Touch, check_bodies
from symgen.describe.parts.scope import Scope


class OutlineTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An outline.

    Parameters
    ----------
    outline : str
        Its name in the section of outlines.
    """

    outline: str


def outline_named(scope: Scope, key: str, name: str) -> BodyOutline:
    """Return an outline by its name."""
    outlines = scope.context.outlines
    if name not in outlines:
        raise scope.error(key, "the name of an outline", f"the unknown outline {quote(name)}", suggest(name, outlines))
    return outlines[name]


def read_disc_beside_outline(scope: Scope, key: str, table: OutlineTable, disc: Disc) -> Touch:
    """Return gap and slip of a disc beside each run of an outline, of which one is in touch at a place.

    Raises
    ------
    InputError
        If the disc is a hole, a point beside a corner or an end, or not smaller than a fillet.
    """
    outline = outline_named(scope, f"{key}.outline", table.outline)
    check_bodies(scope, key, outline.body, disc)

    def value(e: Expr) -> float:
        return scope.value(e, key)

    _check_disc(scope, key, outline, disc)
    runs = runs_of(outline, value)
    closed, solid = outline.closed and len(runs) == 1, depths_of(outline, value)
    frame = scope.marker(f"{key}.outline", outline.body, (0.0, 0.0))
    drawn = disc.outline, _drawn(outline, value)
    touches = list[Touch]()
    for run in runs:
        pieces = offset_pieces(run, closed, disc.radius, solid, value)
        hollow = any(value(stretch.curvature) < 0.0 for stretch in run)
        chain = Chain(frame, disc.centre, pieces, closed, hollow)
        way: Expr = Reading(f"{scope.name}.way", Lap(chain) if closed else OnChain(chain, "way"))
        turns = tuple(
            product(Number(sign), disc.radius, Reading(f"{of}.theta", Angle(GROUND, of)))
            for of, sign in ((disc.body, 1.0), (outline.body, -1.0))
            if of != GROUND and scope.turns(of)
        )
        gap = FormulaMeasure(Reading(f"{scope.name}.distance", OnChain(chain, "gap")))
        touches.append(Touch(gap, ZERO, FormulaMeasure(sum_of_terms(way, *turns)), None, drawn))
    first, *others = touches
    return msgspec.structs.replace(first, further=tuple(others))


def _check_disc(scope: Scope, key: str, outline: BodyOutline, disc: Disc) -> None:
    """Refuse a disc that cannot touch all of an outline."""
    if disc.size < 0.0:
        raise scope.error(key, "a disc or a point beside an outline", f"a hole of {-disc.size!r} m")
    pieces = outline.pieces
    for number, piece in enumerate(pieces, 1):
        k = scope.value(piece.curvature, key)
        if k < 0.0 and -k * disc.size >= 1.0:
            got = f"piece {number} of '{outline.name}' with a radius of {-1.0 / k:.6g} m"
            raise scope.error(key, f"hollow arcs with radii above that of the disc, {disc.size:.6g} m", got)
    if disc.size > 0.0:
        return
    sharp = [
        number
        for number, (one, other) in enumerate(zip(pieces, pieces[1:] + pieces[:1], strict=True), 1)
        if (outline.closed or number < len(pieces))
        and abs(turn_between(one, other, lambda e: scope.value(e, key))) > TANGENT
    ]
    if sharp or not outline.closed:
        got = f"the corner after piece {sharp[0]}" if sharp else "one with ends"
        raise scope.error(
            key,
            "a closed outline without corners beside a point",
            f"{got} of '{outline.name}'",
            "fillet rounds corners",
        )


def _drawn(outline: BodyOutline, value: Value) -> Outline:
    """Return the line along an outline with the defaults of parameters."""
    points = [point for stretch in outline.pieces for point in points_on(stretch, value)]
    x, y = outline.pieces[-1].end
    points.append((value(x), value(y)))
    markers = tuple(Marker(outline.body, (Number(x), Number(y))) for x, y in points)
    return Outline(markers, words=_words_on(outline, value))


def _words_on(outline: BodyOutline, value: Value) -> str:
    """Return what `symgen inspect` says of an outline."""
    pieces = outline.pieces
    length = sum(value(piece.length) for piece in pieces)
    hollow = [i + 1 for i in hollow_corners(outline, value)]
    corners = f"hollow corners before pieces {', '.join(map(str, hollow))}" if hollow else "no hollow corner"
    return f"outline {outline.name}: {len(pieces)} pieces, {length:.6g} m, {corners}"


KIND = Pair("outline", OutlineTable, read_disc_beside_outline, None)
