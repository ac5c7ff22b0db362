"""Rows and coordinates of joints, most of them in space."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import Expr, Number, call, literal_of
from symgen.base.vocabulary.measures import GROUND, Component, Direction, Dot, Holonomic, Marker, Sum, Turn, axes
from symgen.describe.mechanism import Joint
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import Triad, make_triad

_MINUS = literal_of(-1.0)


def rows_of_coincident_points(a: Marker, b: Marker) -> tuple[Holonomic, ...]:
    """Rows that hold two points together, ``x``, ``y``, in space ``z``: forces on the first body in ground axes."""
    along = zip("xyz", axes(GROUND, len(a.point)), strict=False)
    return tuple(Holonomic(label, Component(a, b, axis)) for label, axis in along)


def rows_of_parallel_axes(a: Triad, b: Triad) -> tuple[Holonomic, ...]:
    """Rows that hold two axes parallel, ``first``, ``second``: torques on the first body about its triad's directions.

    With the axes u parallel, the rates of ``-second . u_b`` and ``first . u_b`` are the components of the relative
    angular velocity along first and second.
    """
    return (
        Holonomic("first", Sum(((_MINUS, Dot(a.second, b.axis)),)), unit="rad"),
        Holonomic("second", Dot(a.first, b.axis), unit="rad"),
    )


def row_against_turning(a: Triad, b: Triad) -> Holonomic:
    """Row that keeps the first directions together, ``angle``: torque on the first body about the axis."""
    return Holonomic("angle", Dot(a.second, b.first), unit="rad")


def rows_of_point_on_axis(a: Marker, b: Marker, triad: Triad) -> tuple[Holonomic, ...]:
    """Rows that keep point b on the axis of a through point a, ``across1``, ``across2``: forces across the axis."""
    return (
        Holonomic("across1", Component(a, b, triad.first)),
        Holonomic("across2", Component(a, b, triad.second)),
    )


def plane_of_body(
    scope: Scope,
    body: str,
    on: str | tuple[float | str, ...],
    normal: tuple[float | str, ...],
    reference: tuple[float | str, ...] | None,
) -> tuple[Marker, Triad]:
    """Return a point of a plane of a body or of the ground, and a triad about its normal."""
    plane = make_triad(scope, body, normal, reference, ("normal", "reference"))
    return scope.marker("on", body, on), plane


def opposite(direction: Direction) -> Direction:
    """Return the opposite of a direction: a row on a velocity along it pushes a body along the direction itself."""
    return Direction(direction.body, tuple(call("neg", e) for e in direction.vector))


def angle_about_axis(a: Triad, b: Triad) -> Turn:
    """Angle that the second body has turned about the axis, from the first body's first direction."""
    return Turn(a.first, a.second, b.first)


# -- points and frames of a joint from its rows ------------------------------------------------------------------------


def markers_of_joint(joint: Joint) -> tuple[Marker, Marker]:
    """Return the points that a joint holds together, or on a line or plane of each other."""
    first = joint.rows[0]
    assert isinstance(first, Holonomic) and isinstance(first.measure, Component), "the first row is of two points"
    return first.measure.a, first.measure.b


def third_direction(pair: tuple[Direction, Direction]) -> Direction:
    """Return the direction that makes a right-handed frame of two perpendicular ones."""
    (ax, ay, az), (bx, by, bz) = (d.vector for d in pair)
    products = ((ay, bz, az, by), (az, bx, ax, bz), (ax, by, ay, bx))
    return Direction(pair[0].body, tuple(_determinant(*four) for four in products))


def _determinant(a: Expr, b: Expr, c: Expr, d: Expr) -> Expr:
    """Return a b - c d, as a number where all of them are numbers."""
    if isinstance(a, Number) and isinstance(b, Number) and isinstance(c, Number) and isinstance(d, Number):
        return literal_of(a.value * b.value - c.value * d.value)
    return call("sub", call("mul", a, b), call("mul", c, d))


def frames_of_joint(joint: Joint) -> tuple[tuple[Direction, ...], tuple[Direction, ...]]:
    """Return the frames of a joint whose axes are parallel, with an angle or with `row_against_turning`."""
    rows = {row.label: row.measure for row in joint.rows if isinstance(row, Holonomic)}
    across, first = rows["first"], rows["second"]
    assert isinstance(across, Sum) and isinstance(first, Dot), "parallel axes are two products of directions"
    ((_, second),) = across.terms
    if "angle" in rows:
        held = rows["angle"]
        assert isinstance(held, Dot), "an angle that is held is a product of directions"
        of_b = held.v
    else:
        turn = next(m for _, m in joint.coordinates if isinstance(m, Turn))
        of_b = turn.pointer
    assert isinstance(second, Dot), "parallel axes are two products of directions"
    of_a, axis = (first.u, second.u), first.v
    # axis x first = second
    return (*of_a, third_direction(of_a)), (of_b, third_direction((axis, of_b)), axis)
