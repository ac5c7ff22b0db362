"""Two outlines: the corners and convex arcs of each beside the other one, parts of one contact."""

from __future__ import annotations

import msgspec

from symgen.describe.contacts.chains import EDGE_OF_FEET, BodyOutline
from symgen.describe.contacts.feet import feet_of
from symgen.describe.contacts.gear_pairs import touch_of_gears
from symgen.describe.contacts.pairs.disc_outline import as_one, drawn_outline, touches_on_outline
from symgen.describe.contacts.surfaces import OUTLINE, OutlineTable, Pair, Touch, check_bodies, outline_named
from symgen.describe.parts.scope import Scope


def read_two_outlines(scope: Scope, key: str, table: OutlineTable, outline: BodyOutline) -> Touch:
    """Return gap and slip of the feet of either outline beside each run of the other one.

    A face that lies on a face touches it with two corners. Where a corner meets a corner, edges of a ten-millionth of
    the outlines' size do. An arc that meets an arc or a corner is a foot of the first outline beside the other one, and
    feet of the other one beside faces alone.
    """
    other = outline_named(scope, key, table)
    check_bodies(scope, key, other.body, outline)
    drawn = tuple(drawn_outline(each, lambda e: scope.value(e, key)) for each in (outline, other))
    if outline.gear is not None and other.gear is not None:
        return touch_of_gears(scope, key, (outline, other), (outline.gear, other.gear), drawn)
    touches, feet = list[Touch](), [feet_of(scope, key, each) for each in (outline, other)]
    for standing, under, faces in ((feet[0], other, False), (feet[1], outline, True)):
        for foot in standing:
            touches += touches_on_outline(scope, key, under, foot, drawn, faces, EDGE_OF_FEET)
    changes = all(any(foot.size > 0.0 for foot in each) for each in feet)
    return msgspec.structs.replace(as_one(touches), changes_rows=changes)


KIND = Pair(OUTLINE, OutlineTable, read_two_outlines, None, OUTLINE)
