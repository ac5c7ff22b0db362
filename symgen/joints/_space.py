"""Rows and coordinates that joints in space are put together from."""

from __future__ import annotations

from symgen.describe.scope import Scope
from symgen.describe.triads import Triad
from symgen.vocabulary.expressions import call, number
from symgen.vocabulary.measures import GROUND, Component, Direction, Dot, Holonomic, Marker, Sum, Turn, axes

_MINUS = number(-1.0)


def coincident(a: Marker, b: Marker) -> tuple[Holonomic, ...]:
    """Rows that hold two points together, ``x``, ``y``, ``z``: forces on the first body in ground axes."""
    return tuple(Holonomic(label, Component(a, b, axis)) for label, axis in zip("xyz", axes(GROUND, 3), strict=True))


def parallel(a: Triad, b: Triad) -> tuple[Holonomic, ...]:
    """Rows that hold two axes parallel, ``first``, ``second``: torques on the first body about its triad's directions.

    With the axes u parallel, the rates of ``-second . u_b`` and ``first . u_b`` are the components of the relative
    angular velocity along first and second.
    """
    return (
        Holonomic("first", Sum(((_MINUS, Dot(a.second, b.axis)),)), unit="rad"),
        Holonomic("second", Dot(a.first, b.axis), unit="rad"),
    )


def not_turned(a: Triad, b: Triad) -> Holonomic:
    """Row that keeps the first directions together, ``angle``: torque on the first body about the axis."""
    return Holonomic("angle", Dot(a.second, b.first), unit="rad")


def on_axis(a: Marker, b: Marker, triad: Triad) -> tuple[Holonomic, ...]:
    """Rows that keep point b on the axis of a through point a, ``across1``, ``across2``: forces across the axis."""
    return (
        Holonomic("across1", Component(a, b, triad.first)),
        Holonomic("across2", Component(a, b, triad.second)),
    )


def plane_of_ground(
    scope: Scope,
    on: str | tuple[float | str, ...],
    normal: tuple[float | str, ...],
    reference: tuple[float | str, ...] | None,
) -> tuple[Marker, Triad, tuple[Direction, Direction]]:
    """Return a point of a plane of the ground, a triad about its normal, and the opposites of its other directions.

    A row on a velocity along an opposite direction has a multiplier that pushes the body along the direction itself.
    """
    plane = scope.triad(GROUND, normal, reference, ("normal", "reference"))
    opposite = [Direction(GROUND, tuple(call("neg", e) for e in d.vector)) for d in (plane.first, plane.second)]
    return scope.marker("on", GROUND, on), plane, (opposite[0], opposite[1])


def angle(a: Triad, b: Triad) -> Turn:
    """Angle that the second body has turned about the axis, from the first body's first direction."""
    return Turn(a.first, a.second, b.first)
