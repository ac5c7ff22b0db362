"""The described start of a mechanism: coordinates that are not closed yet, and the velocities that are given."""

from __future__ import annotations

from typing import Any

from symgen.describe.mechanism import AnyBody, Mechanism, SpatialBody
from symgen.describe.numbers import Numbers
from symgen.describe.orientation import euler_parameters
from symgen.vocabulary.expressions import Expr
from symgen.vocabulary.rotations import matrix, rotate


def described_start(mechanism: Mechanism, numbers: Numbers) -> tuple[list[Any], list[Any]]:
    """Return q as described and the given velocities, None where there is none.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    numbers : Numbers
        What is worked out: the start of one run, or of many.

    Returns
    -------
    q, v : list
        A number, or an array of many, for each coordinate and velocity [m, rad, m/s, rad/s].
    """
    q: list[Any] = []
    v: list[Any] = []
    for body in mechanism.bodies:
        where = f"{mechanism.name}: bodies.{body.name}"

        def given(key: str, *speeds: Expr | None, where: str = where) -> list[Any]:
            return [None if e is None else numbers.value(e, f"{where}.{key}") for e in speeds]

        q += _pose(body, numbers, where)
        v += given("velocity", *body.velocity)
        if not body.is_point:
            turning = body.angular_velocity if isinstance(body, SpatialBody) else (body.angular_velocity,)
            v += given("angular_velocity", *turning)
    return q, v


def _pose(body: AnyBody, numbers: Numbers, where: str) -> list[Any]:
    """Return the coordinates of a body: its centre of mass and, unless it is a point mass, its orientation."""
    position = [numbers.value(e, f"{where}.position") for e in body.position]
    centre = [numbers.value(e, f"{where}.centre_of_mass") for e in body.centre_of_mass]
    if isinstance(body, SpatialBody):
        turned = euler_parameters(body.orientation, numbers, f"{where}.orientation")
        offset = rotate(matrix(turned), tuple(centre))
        return [x + dx for x, dx in zip(position, offset, strict=True)] + ([] if body.is_point else list(turned))
    angle = numbers.value(body.angle, f"{where}.angle")
    c, s = numbers.apply("cos", angle), numbers.apply("sin", angle)
    x, y = position[0] + c * centre[0] - s * centre[1], position[1] + s * centre[0] + c * centre[1]
    return [x, y] if body.is_point else [x, y, angle]
