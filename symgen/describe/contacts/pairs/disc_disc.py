"""A disc beside a disc, or in a hole, whose radius is below 0."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import ZERO, Expr, Number, Reading, call
from symgen.base.vocabulary.measures import GROUND, Angle, Distance, LinkStretch, Measure, Sum, Swing, axes
from symgen.describe.contacts.surfaces import DISC, Disc, DiscTable, Pair, Touch, read_disc, sign_of
from symgen.describe.parts.scope import Scope


def read_other_disc(scope: Scope, key: str, table: DiscTable, disc: Disc) -> Touch:
    """Return gap and slip of two discs."""
    return touch_of_discs(scope, key, read_disc(scope, key, table), disc)


def touch_of_discs(scope: Scope, key: str, one: Disc, other: Disc) -> Touch:
    """Return the distance of the centres less the sum of the radii, and what the second rolls on the first one.

    With the radii r and R, the direction of the centres phi relative to the body of the first one and the angle theta
    of the other body relative to it, the slip is (r + R) phi - r theta.
    """
    gap, distance, total = gap_of_round(scope, key, one, other)
    return Touch(gap, ZERO, Sum(_terms_of_slip(scope, total, one, other)), distance, (one.outline, other.outline))


def gap_of_round(scope: Scope, key: str, one: Disc, other: Disc) -> tuple[Measure, Expr, Expr]:
    """Return the gap of two discs, or in space spheres, their distance and the sum of their radii.

    The gap is the stretch of a link as long as the sum, which is smooth also where centres meet, as those of a pin and
    its hole do.

    Raises
    ------
    InputError
        If a hole is smaller than what is in it, or there are two.
    """
    if one.size < 0.0 and other.size < 0.0:
        raise scope.error(key, "one hole at most", "two radii below 0")
    apart = one.size + other.size
    inside = min(one.size, other.size) < 0.0
    if apart == 0.0 or (inside and apart > 0.0):
        radii = f"radii of {abs(one.size)!r} m and {abs(other.size)!r} m"
        raise scope.error(key, "a hole larger than its pin" if inside else "a radius above 0", radii)
    total = call("add", one.radius, other.radius)
    length = call("neg", total) if inside else total
    stretch: Measure = LinkStretch(one.centre, other.centre, length)
    gap = Sum(((Number(-1.0), stretch),)) if inside else stretch
    apart_now = Reading(f"{scope.name}.distance", Distance(one.centre, other.centre))
    distance = call("sub", length, apart_now) if inside else call("sub", apart_now, length)
    return gap, distance, total


def _terms_of_slip(scope: Scope, total: Expr, one: Disc, other: Disc) -> tuple[tuple[Expr, Measure], ...]:
    """Return the terms of the slip; centres that touch are farther apart than half of the sum of the radii."""
    half, (zero, quarter) = call("mul", Number(0.5), total), axes(one.body, 2)
    terms: tuple[tuple[Expr, Measure], ...] = ((total, Swing(one.centre, other.centre, zero, quarter, half)),)
    radius = other.radius if other.size != 0.0 else ZERO
    # the angle of the first body enters with (r + R) - R = r, as the direction is relative to it
    for body, sign in ((other.body, -1.0), (one.body, 1.0)):
        if radius != ZERO and body != GROUND and scope.turns(body):
            terms += ((sign_of(radius, sign), Angle(GROUND, body)),)
    return terms


KIND = Pair(DISC, DiscTable, read_other_disc, lambda table: str(table.body))
