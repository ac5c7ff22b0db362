"""Two gears with involute teeth: the gaps of both of their flanks, by the law of the line of action.

Flanks touch on the common tangents of the base circles, at any distance of the centres. With the sum R of the base
radii r and r', the distance a, ``cos(alpha) = R / a`` and the directions p and p' of teeth from the line of centres,
the gaps along both tangents are ``h + s`` and ``h - s``, where ``s = r p + r' p'`` but for whole base pitches, and
``h = R (tan(alpha) - alpha)`` less what teeth take and their gaps leave.
"""

from __future__ import annotations

import math

from symgen.base.vocabulary.expressions import (
    ZERO,
    Number,
    Reading,
    call,
    difference,
    product,
    sum_of_terms,
)
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Distance,
    FormulaMeasure,
    Marker,
    Swing,
    Wrapped,
    axes,
)
from symgen.describe.contacts.chains import BodyOutline
from symgen.describe.contacts.gear import Gear
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.surfaces import Touch
from symgen.describe.parts.scope import Scope

#: Largest difference of base pitches over them.
_SAME = 1e-9


def touch_of_gears(
    scope: Scope,
    key: str,
    outlines: tuple[BodyOutline, BodyOutline],
    gears: tuple[Gear, Gear],
    drawn: tuple[Outline, ...],
) -> Touch:
    """Return the gaps of the flanks by which the first gear drives counterclockwise, and of those for the other way.

    Raises
    ------
    InputError
        If the base pitches differ, or a pair of teeth parts before the next one meets.
    """
    one, other = gears
    pitches = [math.tau * scope.value(gear.base, key) / gear.teeth for gear in gears]
    if abs(pitches[0] - pitches[1]) > _SAME * pitches[0]:
        got = f"base pitches of {pitches[0]:.6g} m and {pitches[1]:.6g} m"
        raise scope.error(key, "gears of one module and one pressure angle", got)
    if (ratio := contact_ratio(one, other)) < 1.0:
        got = f"a contact ratio of {ratio:.4g}"
        raise scope.error(key, "teeth that meet before the last ones part", got)
    pitch = product(Number(math.tau / one.teeth), one.base)
    total = sum_of_terms(one.base, other.base)
    centres = tuple(Marker(outline.body, gear.centre) for outline, gear in zip(outlines, gears, strict=True))
    half = product(Number(0.5), total)
    zero, quarter = axes(centres[0].body, 2)
    line = Reading(f"{scope.name}.line", Swing(centres[0], centres[1], zero, quarter, half))
    # directions of teeth from the line of centres, with the sign of the line's
    turns = [Reading(f"{body}.theta", Angle(GROUND, body)) for body in (centres[0].body, centres[1].body)]
    own, its = (
        turn if centre.body != GROUND and scope.turns(centre.body) else ZERO
        for turn, centre in zip(turns, centres, strict=True)
    )
    facing = sum_of_terms(own, call("neg", its), call("neg", other.first), Number(math.pi))
    # the line stands once: of an angle that stands twice looped code would count turns twice
    ways = (product(total, line), call("neg", product(one.base, one.first)), product(other.base, facing))
    way = sum_of_terms(*ways, product(Number(0.5), pitch))
    shifted = Reading(f"{scope.name}.shift", Wrapped(FormulaMeasure(way), pitch))
    apart = Reading(f"{scope.name}.distance", Distance(centres[0], centres[1]))
    root = call("sqrt", difference(product(apart, apart), product(total, total)))
    involute = difference(root, product(total, call("atan2", root, total)))
    taken = [product(Number(gear.half_tooth), gear.base) for gear in gears]
    play = sum_of_terms(involute, product(Number(0.5), pitch), *(call("neg", each) for each in taken))
    first, second = (
        Touch(FormulaMeasure(e), ZERO, None, None, drawn)
        for e in (call("add", play, shifted), call("sub", play, shifted))
    )
    return Touch(first.gap, ZERO, None, None, drawn, (second,))


def contact_ratio(one: Gear, other: Gear) -> float:
    """Return how many pairs of teeth touch on average at the standard distance of the centres."""
    cosine = one.cosine
    line, reached = (one.pitch + other.pitch) * math.sqrt(1.0 - cosine**2), 0.0
    for gear, mate in ((one, other), (other, one)):
        # a tip goes at most to where the flank of the mate begins
        begins = math.sqrt(max(0.0, mate.inner**2 - (mate.pitch * cosine) ** 2))
        reached += min(math.sqrt(gear.outer**2 - (gear.pitch * cosine) ** 2), line - begins)
    return (reached - line) / (math.pi * cosine)
