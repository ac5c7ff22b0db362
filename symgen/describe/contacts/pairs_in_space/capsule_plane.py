"""A capsule over a plane, which either end touches."""

from __future__ import annotations

from symgen.describe.contacts.pairs_in_space.sphere_plane import touch_of_plane
from symgen.describe.contacts.surfaces import Touch
from symgen.describe.contacts.surfaces_in_space import PairInSpace, Plane, Solid, all_of
from symgen.describe.parts.scope import Scope


def read_ends_over_plane(scope: Scope, key: str, shape: Solid, plane: Plane) -> Touch:
    """Return the gaps of the ends of a capsule, or the corners of a box, over a plane."""
    return all_of(tuple(touch_of_plane(end, plane, shape.outline) for end in shape.ends))


KIND = PairInSpace(("capsule", "plane"), read_ends_over_plane)
