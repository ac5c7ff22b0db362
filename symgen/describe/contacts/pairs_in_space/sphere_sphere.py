"""A sphere or a point beside a sphere, or in a hollow one, whose radius is below 0."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import ZERO
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.pairs.disc_disc import gap_of_round
from symgen.describe.contacts.surfaces import Disc, Touch
from symgen.describe.contacts.surfaces_in_space import PairInSpace
from symgen.describe.parts.scope import Scope


def read_spheres(scope: Scope, key: str, one: Disc, other: Disc) -> Touch:
    """Return the distance of the centres less the sum of the radii."""
    return touch_of_spheres(scope, key, one, other, one.outline)


def touch_of_spheres(scope: Scope, key: str, one: Disc, other: Disc, drawn: Outline) -> Touch:
    """Return the distance of two centres less the sum of the radii; `drawn` is what the first one belongs to."""
    gap, distance, _ = gap_of_round(scope, key, one, other)
    return Touch(gap, ZERO, gap, distance, (drawn, other.outline))


KIND = PairInSpace(("sphere", "sphere"), read_spheres)
