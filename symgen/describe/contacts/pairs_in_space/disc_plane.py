"""The rim of a thin disc over a plane, which its lowest point touches."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import ZERO
from symgen.base.vocabulary.measures import RimHeight, RollingSpeed
from symgen.describe.contacts.surfaces import Touch
from symgen.describe.contacts.surfaces_in_space import PairInSpace, Plane, Solid
from symgen.describe.parts.scope import Scope


def read_rim_over_plane(scope: Scope, key: str, rim: Solid, plane: Plane) -> Touch:
    """Return the height of the lowest point of a rim over a plane."""
    assert rim.axis is not None, "rims have an axis"
    gap = RimHeight(plane.on, plane.normal, rim.centre, rim.axis, rim.radius)
    one, other = (RollingSpeed(rim.centre, along, plane.normal, rim.radius, rim.axis) for along in plane.across)
    return Touch(gap, ZERO, gap, None, (rim.outline, plane.outline), slips=(one, other))


KIND = PairInSpace(("disc", "plane"), read_rim_over_plane)
