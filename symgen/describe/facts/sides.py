"""Senses of directions that joints hold parallel: the rows also hold with the axis reversed.

Products of directions that are zero make them perpendicular, but do not fix their sense. Closing goes to
what is nearest, so that a body that is described turned too far is held the wrong way round.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from symgen.base.vocabulary.expressions import Number
from symgen.base.vocabulary.measures import Direction, Dot, Holonomic, Sum
from symgen.base.vocabulary.rotations import rotate, rotation_matrix_of, scalar_product
from symgen.describe.mechanism import Joint, Mechanism, SpatialBody
from symgen.describe.parts.kinds import JOINTS
from symgen.describe.parts.topology import articulation_of_joint
from symgen.describe.remembered import compute_once


class Arm(NamedTuple):
    """A direction fixed in a body: index of its Euler parameters, -1 without any, and a vector."""

    first: int
    vector: tuple[float, float, float]


class SidedJoint(NamedTuple):
    """A joint whose directions point the same way, whether they keep bodies from turning, and which they are."""

    joint: str
    held: bool
    pairs: tuple[tuple[Arm, Arm], ...]

    def cosine(self, q: object) -> Any:
        """Return the sum of the products of the directions: below 0 where they point opposite ways.

        Parameters
        ----------
        q : sequence of float, or Array of shape (nq, k)
            Coordinates of all bodies, closed: numbers, or those of many starts.
        """
        return sum(
            x * y
            for a, b in self.pairs
            for x, y in zip(_direction_in_ground(a, q), _direction_in_ground(b, q), strict=True)
        )


def wrong_sides(mechanism: Mechanism, q: Sequence[float]) -> Iterator[tuple[str, bool]]:
    """Yield the joints whose directions point opposite ways, and whether they are held so.

    Those of an axis about which bodies turn mean the same line; a joint that keeps bodies from turning holds one of
    them the wrong way round.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    q : sequence of float
        Coordinates of all bodies, closed.
    """
    for side in sided_joints(mechanism):
        if side.cosine(q) < 0.0:
            yield side.joint, side.held


@compute_once
def sided_joints(mechanism: Mechanism) -> tuple[SidedJoint, ...]:
    """Return the joints with directions that point the same way; none in the plane."""
    if mechanism.space != "spatial":
        return ()
    places, first = dict[str, int](), 0
    for body in mechanism.bodies:
        if isinstance(body, SpatialBody) and not body.is_point:
            # an interface is turned against its body by little
            places[body.name] = first + 3 if body.carried is None else places[body.carried.host]
        first += len(body.coordinates)

    def arm_of_direction(direction: Direction) -> Arm:
        x, y, z = (e.value if isinstance(e, Number) else 0.0 for e in direction.vector)  # in space they are numbers
        return Arm(places.get(direction.body, -1), (x, y, z))

    return tuple(
        SidedJoint(joint.name, held, tuple((arm_of_direction(a), arm_of_direction(b)) for a, b in pairs))
        for joint in mechanism.joints
        for held, pairs in _side_of_joint(joint)
    )


def _side_of_joint(joint: Joint) -> Iterator[tuple[bool, tuple[tuple[Direction, Direction], ...]]]:
    articulation = articulation_of_joint(joint)
    row = joint.rows[-1] if joint.kind == "constant-velocity" else None
    if isinstance(row, Holonomic) and isinstance(row.measure, Sum):
        # half of second . first' - first . second': where the shafts lean, only both products together tell the side
        (_, one), (_, other) = row.measure.terms
        if isinstance(one, Dot) and isinstance(other, Dot):
            yield True, ((other.u, one.v), (one.u, other.v))
    if articulation is not None and articulation.turn in ("axis", "fixed"):
        of_a, of_b, fixed = articulation.of_a, articulation.of_b, articulation.turn == "fixed"
    else:  # primitives hold nothing else
        of = getattr(JOINTS.get(joint.kind, joint.name), "frames", None)
        (of_a, of_b), fixed = of(joint) if of else ((), ()), len(joint.rows) == 3
    if of_a:
        yield False, ((of_a[2], of_b[2]),)
    if of_a and fixed:
        yield True, ((of_a[0], of_b[0]),)


def _direction_in_ground(arm: Arm, q: Any) -> tuple[Any, ...]:
    """Return the vector of a direction in ground axes."""
    if arm.first < 0:
        return arm.vector
    e = q[arm.first : arm.first + 4]
    length = scalar_product(e, e) ** 0.5
    a, b, c, d = (x / length for x in e)
    return rotate(rotation_matrix_of((a, b, c, d)), arm.vector)
