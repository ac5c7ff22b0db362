"""A box in a hollow sphere or on a sphere, which its corners touch."""

from __future__ import annotations

from symgen.describe.contacts.pairs_in_space.sphere_sphere import touch_of_spheres
from symgen.describe.contacts.surfaces import Disc, Touch
from symgen.describe.contacts.surfaces_in_space import PairInSpace, Solid, all_of
from symgen.describe.parts.scope import Scope


def read_ends_beside_sphere(scope: Scope, key: str, shape: Solid, sphere: Disc) -> Touch:
    """Return the gaps of the corners of a box, or the ends of a capsule, beside a sphere."""
    return all_of(tuple(touch_of_spheres(scope, key, end, sphere, shape.outline) for end in shape.ends))


KIND = PairInSpace(("box", "sphere"), read_ends_beside_sphere)
