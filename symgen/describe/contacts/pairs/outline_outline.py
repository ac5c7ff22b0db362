"""Two outlines: the corners of each as points beside the other one, parts of one contact."""

from __future__ import annotations

from symgen.describe.contacts.chains import BodyOutline
from symgen.describe.contacts.feet import feet_of
from symgen.describe.contacts.pairs.disc_outline import as_one, drawn_outline, touches_on_outline
from symgen.describe.contacts.surfaces import OUTLINE, OutlineTable, Pair, Touch, check_bodies, outline_named
from symgen.describe.parts.scope import Scope


def read_two_outlines(scope: Scope, key: str, table: OutlineTable, outline: BodyOutline) -> Touch:
    """Return gap and slip of the corners of either outline beside each run of the other one.

    A face that lies on a face touches it with two corners. Where a corner meets a corner, edges of a billionth of the
    outlines' size do.

    Raises
    ------
    InputError
        If one of them has a convex arc, whose contact with an arc would be a part of its own.
    """
    other = outline_named(scope, key, table)
    check_bodies(scope, key, other.body, outline)
    drawn = tuple(drawn_outline(each, lambda e: scope.value(e, key)) for each in (outline, other))
    touches = list[Touch]()
    for standing, under in ((outline, other), (other, outline)):
        for number, piece in enumerate(standing.pieces, 1):
            if scope.value(piece.curvature, key) > 0.0:
                got = f"the convex arc of piece {number} of '{standing.name}'"
                raise scope.error(key, "segments and hollow arcs of outlines beside each other", got)
        for foot in feet_of(scope, key, standing):
            touches += touches_on_outline(scope, key, under, foot, drawn)
    return as_one(touches)


KIND = Pair(OUTLINE, OutlineTable, read_two_outlines, None, OUTLINE)
