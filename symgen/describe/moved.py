"""How far closing a mechanism has moved the points that its description names, and turned bodies."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from symgen.describe.mechanism import AnyBody, Mechanism, SpatialBody
from symgen.describe.numbers import Scalars
from symgen.vocabulary.rotations import matrix, rotate


def moved(
    mechanism: Mechanism, numbers: Scalars, before: Sequence[float], after: Sequence[float]
) -> Iterator[tuple[str, float, str]]:
    """Yield how far each body was turned and its points were moved: name, size and unit.

    Points are those that have names, the body's origin and its centre of mass.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    numbers : Scalars
        What formulas stand for.
    before, after : sequence of float
        Coordinates of all bodies as described and as closed.
    """
    first = 0
    for body in mechanism.bodies:
        size, where = len(body.coordinates), f"{mechanism.name}: bodies.{body.name}"
        centre = [numbers.value(e, f"{where}.centre_of_mass") for e in body.centre_of_mass]
        named = [(name, [numbers.value(e, where) for e in point]) for name, point in body.points]
        for name, point in (("centre", centre), ("origin", [0.0] * len(centre)), *named):
            at = [x - c for x, c in zip(point, centre, strict=True)]
            ends = [_placed(body, q[first : first + size], at) for q in (before, after)]
            yield f"{body.name}.{name}", math.dist(*ends), "m"
        if not body.is_point:
            yield f"{body.name}.angle", _turned(body, before[first : first + size], after[first : first + size]), "rad"
        first += size


def _turned(body: AnyBody, before: Sequence[float], after: Sequence[float]) -> float:
    """Return by which angle a body was turned [rad]; in space the smallest one."""
    if not isinstance(body, SpatialBody):
        return abs(after[2] - before[2])
    lengths = [math.sqrt(sum(e * e for e in q[3:])) for q in (before, after)]
    cosine = abs(sum(a * b for a, b in zip(before[3:], after[3:], strict=True))) / (lengths[0] * lengths[1])
    return 2.0 * math.acos(min(1.0, cosine))


def _placed(body: AnyBody, q: Sequence[float], at: Sequence[float]) -> list[float]:
    """Return where a point is that is given from the centre of mass in the body's frame."""
    if body.is_point:
        return list(q)
    if isinstance(body, SpatialBody):
        length = math.sqrt(sum(e * e for e in q[3:]))
        e0, e1, e2, e3 = (e / length for e in q[3:])
        turned = rotate(matrix((e0, e1, e2, e3)), (at[0], at[1], at[2]))
        return [x + dx for x, dx in zip(q, turned, strict=False)]
    c, s = math.cos(q[2]), math.sin(q[2])
    return [q[0] + c * at[0] - s * at[1], q[1] + s * at[0] + c * at[1]]
