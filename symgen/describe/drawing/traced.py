"""Points of a mechanism whose paths are drawn, and which of them no joint ties."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.base.vocabulary.measures import markers_in
from symgen.describe.drawing.scene import Point
from symgen.describe.formulas.evaluate import evaluate_formula

if TYPE_CHECKING:
    from symgen.describe.mechanism import AnyBody, Mechanism, Vec


@dataclass(frozen=True)
class TracedPoint:
    """A point of a body.

    Attributes
    ----------
    name : str
        ``BODY.centre`` or ``BODY.NAME``.
    body : int
        Its index.
    at : Point
        From the centre of mass along the axes of the body [m].
    free : bool
        Whether it has a name and no joint ties it, such as the foot of a leg.
    """

    name: str
    body: int
    at: Point
    free: bool


def traced_points(mechanism: Mechanism, values: Mapping[str, float]) -> list[TracedPoint]:
    """Return the centre of mass and the named points of every body.

    Parameters
    ----------
    mechanism : Mechanism
        Any.
    values : mapping of str to float
        Its parameters.
    """

    def point_as_numbers(point: Vec) -> Point:
        x, y, *z = (evaluate_formula(e, values) for e in point)
        return (x, y, z[0] if z else 0.0)

    def rounded_point(point: Vec) -> Point:
        x, y, z = (round(c, 9) for c in point_as_numbers(point))
        return (x, y, z)

    markers = {m for joint in mechanism.joints for m in markers_in(joint.rows)}
    tied = {(m.body, rounded_point(m.point)) for m in markers}
    points = list[TracedPoint]()
    bodies: tuple[AnyBody, ...] = mechanism.bodies
    for i, body in enumerate(bodies):
        points.append(TracedPoint(f"{body.name}.centre", i, (0.0, 0.0, 0.0), free=False))
        centre = point_as_numbers(body.centre_of_mass)
        for name, point in body.points:
            x, y, z = (p - c for p, c in zip(point_as_numbers(point), centre, strict=True))
            points.append(
                TracedPoint(f"{body.name}.{name}", i, (x, y, z), (body.name, rounded_point(point)) not in tied)
            )
    return points
