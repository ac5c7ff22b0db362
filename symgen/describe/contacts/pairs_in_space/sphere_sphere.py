"""A sphere or a point beside a sphere, or in a hollow one, whose radius is below 0."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import ZERO, Number
from symgen.base.vocabulary.measures import GROUND, Direction, SphereSlip
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.pairs.disc_disc import gap_of_round
from symgen.describe.contacts.surfaces import Disc, Touch
from symgen.describe.contacts.surfaces_in_space import PairInSpace
from symgen.describe.parts.scope import Scope

#: Axes of the ground by which directions along spheres are told: opposite to the first one, where they have none, no
#: motion of a user's machine is likely to pass, as one of an axis of the ground is.
_OBLIQUE = tuple(tuple(Number(x / 7.0) for x in line) for line in ((2.0, 3.0, 6.0), (3.0, -6.0, 2.0), (6.0, 2.0, -3.0)))


def read_spheres(scope: Scope, key: str, one: Disc, other: Disc) -> Touch:
    """Return the distance of the centres less the sum of the radii."""
    return touch_of_spheres(scope, key, one, other, one.outline)


def touch_of_spheres(scope: Scope, key: str, one: Disc, other: Disc, drawn: Outline) -> Touch:
    """Return the distance of two centres less the sum of the radii; `drawn` is what the first one belongs to."""
    gap, distance, _ = gap_of_round(scope, key, one, other)
    side, radii = Number(-1.0 if min(one.size, other.size) < 0.0 else 1.0), (one.radius, other.radius)
    zero, first, second = (Direction(GROUND, vector) for vector in _OBLIQUE)
    slips = tuple(SphereSlip(one.centre, other.centre, zero, along, radii, side) for along in (first, second))
    return Touch(gap, ZERO, gap, distance, (drawn, other.outline), slips=(slips[0], slips[1]))


KIND = PairInSpace(("sphere", "sphere"), read_spheres)
