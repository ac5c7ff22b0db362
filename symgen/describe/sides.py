"""To which side directions point that joints hold parallel: rows are fulfilled half a turn away as well.

A product of directions that is zero says that they are perpendicular, and not which way they point. Closing goes to
what is nearest, so that a body that is described turned too far is held the wrong way round.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from symgen.describe.mechanism import Joint, Mechanism, SpatialBody
from symgen.describe.orientation import Matrix, matrix, rotate
from symgen.describe.remembered import remembered
from symgen.describe.topology import articulation_of
from symgen.vocabulary.expressions import Number
from symgen.vocabulary.measures import GROUND, Direction, Dot, Holonomic, Sum

#: Directions of two bodies.
_Pair = tuple[Direction, Direction]


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
    sided, first = _sided(mechanism), 0
    axes: dict[str, Matrix | None] = {GROUND: None}
    for body in mechanism.bodies if sided else ():
        turned = isinstance(body, SpatialBody) and not body.is_point
        axes[body.name] = _matrix(q[first + 3 : first + 7]) if turned else None
        first += len(body.coordinates)
    for name, held, pairs in sided:
        if sum(_cosine(axes, *pair) for pair in pairs) < 0.0:
            yield name, held


@remembered
def _sided(mechanism: Mechanism) -> tuple[tuple[str, bool, tuple[_Pair, ...]], ...]:
    """Return the joints with directions that point the same way, and whether these keep bodies from turning."""
    spatial = mechanism.space == "spatial"
    return tuple((j.name, held, pairs) for j in (mechanism.joints if spatial else ()) for held, pairs in _of_joint(j))


def _of_joint(joint: Joint) -> Iterator[tuple[bool, tuple[_Pair, ...]]]:
    found = articulation_of(joint)
    row = joint.rows[-1] if joint.kind == "constant-velocity" else None
    if isinstance(row, Holonomic) and isinstance(row.measure, Sum):
        # half of second . first' - first . second': where the shafts lean, only both products together tell the side
        (_, one), (_, other) = row.measure.terms
        if isinstance(one, Dot) and isinstance(other, Dot):
            yield True, ((other.u, one.v), (one.u, other.v))
    if found is not None and found.of_a and found.turn in ("axis", "fixed"):
        yield False, ((found.of_a[2], found.of_b[2]),)
        if found.turn == "fixed":
            yield True, ((found.of_a[0], found.of_b[0]),)


def _matrix(e: Sequence[float]) -> Matrix:
    length = math.sqrt(sum(x * x for x in e))
    a, b, c, d = (float(x) / length for x in e)
    return matrix((a, b, c, d))


def _cosine(axes: dict[str, Matrix | None], a: Direction, b: Direction) -> float:
    """Return the product of two directions, each turned as its body is."""

    def in_ground(direction: Direction) -> tuple[float, float, float]:
        x, y, z = (e.value if isinstance(e, Number) else 0.0 for e in direction.vector)  # in space they are numbers
        turned = axes[direction.body]
        return (x, y, z) if turned is None else rotate(turned, (x, y, z))

    return sum(x * y for x, y in zip(in_ground(a), in_ground(b), strict=True))
