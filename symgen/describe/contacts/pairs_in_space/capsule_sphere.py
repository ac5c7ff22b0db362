"""A capsule beside a sphere: its cylinder and its ends, which are smooth pieces of one gap."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import ZERO, Number, Reading, call, product, sum_of_terms
from symgen.base.vocabulary.measures import Component, FormulaMeasure, HalfSquare
from symgen.describe.contacts.pairs_in_space.corners_sphere import read_ends_beside_sphere
from symgen.describe.contacts.surfaces import Disc, Touch
from symgen.describe.contacts.surfaces_in_space import PairInSpace, Solid
from symgen.describe.parts.scope import Scope


def read_capsule_beside_sphere(scope: Scope, key: str, capsule: Solid, sphere: Disc) -> Touch:
    """Return the distance of the sphere's centre from the nearest point of the capsule's axis, less both radii.

    A hollow sphere touches either end.
    """
    if sphere.size < 0.0:
        return read_ends_beside_sphere(scope, key, capsule, sphere)
    assert capsule.axis is not None, "capsules have an axis"
    along = Reading(f"{scope.name}.along", Component(capsule.centre, sphere.centre, capsule.axis))
    half_square = Reading(f"{scope.name}.apart", HalfSquare(capsule.centre, sphere.centre))
    half = product(Number(0.5), capsule.length)
    beyond = call("max", call("sub", call("abs", along), half), ZERO)
    across = call("sub", product(Number(2.0), half_square), product(along, along))
    distance = call("sqrt", sum_of_terms(across, product(beyond, beyond)))
    gap = FormulaMeasure(call("sub", distance, call("add", capsule.radius, sphere.radius)))
    return Touch(gap, ZERO, gap, None, (capsule.outline, sphere.outline))


KIND = PairInSpace(("capsule", "sphere"), read_capsule_beside_sphere)
