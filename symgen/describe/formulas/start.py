"""The described start of a mechanism: coordinates before closing, and velocities; displacements by closing.

Algorithms are written once, with the operators of Python and the functions of formulas, over the numbers of one run
(`Scalars`) or arrays with an element for each of many (`symgen.study.ensemble.array_formulas`). Euler parameters (e0,
e1, e2, e3) have length 1; the rotation matrix A that they stand for takes body to ground axes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import FUNCTIONS, Expr
from symgen.base.vocabulary.rotations import (
    EulerParameters,
    Matrix,
    Orientation,
    composed_rotation,
    rotate,
    rotation_matrix_of,
    scalar_product,
)
from symgen.describe.mechanism import AnyBody, Mechanism, SpatialBody
from symgen.describe.modal_body import COORDINATE, SPEED


class Numbers(Protocol):
    """Numbers of one run, or arrays of many."""

    def value(self, expression: Expr, where: str) -> Any:
        """Return the value of a formula; `where` is file and key, for the message."""

    def apply_function(self, function: str, *arguments: Any) -> Any:
        """Return a function of formulas (`symgen.base.vocabulary.expressions.FUNCTIONS`) of numbers."""

    def check_above(self, limit: Any, x: Any, where: str, expected: str, got: str) -> Any:
        """Return `x`, which must be above a limit."""


@dataclass(frozen=True)
class Scalars:
    """The numbers of one run; what is undefined is an error.

    Attributes
    ----------
    evaluate : callable
        Value of a formula; the second argument is file and key, for the message.
    """

    evaluate: Callable[[Expr, str], float]

    def value(self, expression: Expr, where: str) -> float:
        """Return the value of a formula.

        Raises
        ------
        InputError
            If it has none.
        """
        return self.evaluate(expression, where)

    def apply_function(self, function: str, *arguments: float) -> float:
        """Return a function of formulas."""
        return FUNCTIONS[function][1](*arguments)

    def check_above(self, limit: float, x: float, where: str, expected: str, got: str) -> float:
        """Return `x`.

        Raises
        ------
        InputError
            If it is at or below the limit.
        """
        if not x > limit:
            raise InputError(where, expected, got)
        return x


def described_start(mechanism: Mechanism, numbers: Numbers) -> tuple[list[Any], list[Any]]:
    """Return q as described and the described velocities, None for others.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    numbers : Numbers
        Numbers of one run, or of many.

    Returns
    -------
    q, v : list
        A number, or an array of many, for each coordinate and velocity [m, rad, m/s, rad/s].
    """
    q: list[Any] = []
    v: list[Any] = []
    for body in mechanism.bodies:
        if body.carried is not None:
            continue
        where = f"{mechanism.name}: bodies.{body.name}"

        def evaluate_speeds(key: str, *speeds: Expr | None, where: str = where) -> list[Any]:
            return [None if e is None else numbers.value(e, f"{where}.{key}") for e in speeds]

        q += _start_coordinates(body, numbers, where)
        v += evaluate_speeds("velocity", *body.velocity)
        if not body.is_point:
            turning = body.angular_velocity if isinstance(body, SpatialBody) else (body.angular_velocity,)
            v += evaluate_speeds("angular_velocity", *turning)
        if body.modal is not None:
            given = {name: numbers.value(e, f"{where}.start.{name}") for name, e in body.modal.start}
            q += [given.get(name, 0.0) for name in body.modal.names(COORDINATE)]
            v += [given.get(name, 0.0) for name in body.modal.names(SPEED)]
    return q, v


def _start_coordinates(body: AnyBody, numbers: Numbers, where: str) -> list[Any]:
    """Return the coordinates of a body: its centre of mass and, unless it is a point mass, its orientation."""
    position = [numbers.value(e, f"{where}.position") for e in body.position]
    centre = [numbers.value(e, f"{where}.centre_of_mass") for e in body.centre_of_mass]
    if isinstance(body, SpatialBody):
        turned = euler_parameters(body.orientation, numbers, f"{where}.orientation")
        offset = rotate(rotation_matrix_of(turned), tuple(centre))
        return [x + dx for x, dx in zip(position, offset, strict=True)] + ([] if body.is_point else list(turned))
    angle = numbers.value(body.angle, f"{where}.angle")
    c, s = numbers.apply_function("cos", angle), numbers.apply_function("sin", angle)
    x, y = position[0] + c * centre[0] - s * centre[1], position[1] + s * centre[0] + c * centre[1]
    return [x, y] if body.is_point else [x, y, angle]


def euler_parameters(orientation: Orientation, numbers: Numbers, where: str) -> EulerParameters:
    """Return the Euler parameters of an orientation.

    Parameters
    ----------
    orientation : Orientation
        As written.
    numbers : Numbers
        Numbers of one orientation, or of many.
    where : str
        For the message.

    Raises
    ------
    InputError
        If it is undefined: a quaternion of length 0, an axis of length 0, two parallel axes.
    """
    x = tuple(numbers.value(e, where) for e in orientation.values)
    if orientation.kind == "quaternion":
        length = numbers.check_above(0.0, _vector_length(x, numbers), where, "a quaternion", "one of length 0")
        return x[0] / length, x[1] / length, x[2] / length, x[3] / length
    if orientation.kind == "rotation-vector":
        angle = _vector_length(x, numbers)
        turned = numbers.apply_function("gt", angle, 0.0)
        sine = numbers.apply_function("sin", angle / 2.0) / numbers.apply_function("where", turned, angle, 1.0)
        factor = numbers.apply_function("where", turned, sine, 0.5)
        return numbers.apply_function("cos", angle / 2.0), factor * x[0], factor * x[1], factor * x[2]
    if orientation.kind == "euler-angles":
        result: EulerParameters = (1.0, 0.0, 0.0, 0.0)
        for axis, angle in zip(orientation.convention, x, strict=True):
            turn = [numbers.apply_function("cos", angle / 2.0), 0.0, 0.0, 0.0]
            turn["xyz".index(axis) + 1] = numbers.apply_function("sin", angle / 2.0)
            result = composed_rotation(result, (turn[0], turn[1], turn[2], turn[3]))
        return result
    if orientation.kind == "line":
        along, towards = (x[3] - x[0], x[4] - x[1], x[5] - x[2]), x[6:9]
    else:
        along, towards = x[0:3], x[3:6]
    return euler_parameters_of_matrix(_axes_from_directions(along, towards, numbers, where), numbers)


def _vector_length(vector: tuple[float, ...], numbers: Numbers) -> float:
    length: float = numbers.apply_function("sqrt", scalar_product(vector, vector))
    return length


def _axes_from_directions(along: tuple[float, ...], towards: tuple[float, ...], numbers: Numbers, where: str) -> Matrix:
    """Return the matrix whose first column points along a vector and whose second lies towards another one."""
    length = _vector_length(along, numbers)
    length = numbers.check_above(0.0, length, where, "a direction of the x axis", "a vector of length 0")
    a = tuple(e / length for e in along)
    part = scalar_product(a, towards)
    b = tuple(f - part * e for e, f in zip(a, towards, strict=True))
    limit, expected = 1e-9 * _vector_length(towards, numbers), "a second direction that is not parallel to the first"
    rest = numbers.check_above(limit, _vector_length(b, numbers), where, expected, "a parallel one")
    b = tuple(e / rest for e in b)
    c = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return (a[0], b[0], c[0]), (a[1], b[1], c[1]), (a[2], b[2], c[2])


def euler_parameters_of_matrix(m: Matrix, numbers: Numbers) -> EulerParameters:
    """Return the Euler parameters of a rotation matrix, from its largest diagonal term as Shepperd (1978) does."""
    (a, b, c), (d, e, f), (g, h, i) = m
    rows = (
        (1.0 + a + e + i, h - f, c - g, d - b),
        (h - f, 1.0 + a - e - i, b + d, c + g),
        (c - g, b + d, 1.0 - a + e - i, f + h),
        (d - b, c + g, f + h, 1.0 - a - e + i),
    )
    largest, row = rows[0][0], rows[0]
    for k in range(1, 4):
        better = numbers.apply_function("gt", rows[k][k], largest)
        largest = numbers.apply_function("where", better, rows[k][k], largest)
        w, x, y, z = (numbers.apply_function("where", better, new, old) for new, old in zip(rows[k], row, strict=True))
        row = w, x, y, z
    size = _vector_length(row, numbers)
    sign = numbers.apply_function("where", numbers.apply_function("lt", row[0], 0.0), -1.0, 1.0)
    return sign * row[0] / size, sign * row[1] / size, sign * row[2] / size, sign * row[3] / size


def displacements_of_bodies(
    mechanism: Mechanism, numbers: Scalars, before: Sequence[float], after: Sequence[float]
) -> Iterator[tuple[str, float, str]]:
    """Yield the rotation of each body and the displacements of its points: name, size and unit.

    Points are the named ones, the body's origin and its centre of mass.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    numbers : Scalars
        Values of formulas.
    before, after : sequence of float
        Coordinates of all bodies as described and as closed.
    """
    first = 0
    for body in mechanism.bodies:
        if body.carried is not None:
            continue
        size, where = len(body.coordinates), f"{mechanism.name}: bodies.{body.name}"
        centre = [numbers.value(e, f"{where}.centre_of_mass") for e in body.centre_of_mass]
        named = [(name, [numbers.value(e, where) for e in point]) for name, point in body.points]
        for name, point in (("centre", centre), ("origin", [0.0] * len(centre)), *named):
            at = [x - c for x, c in zip(point, centre, strict=True)]
            ends = [_place_of_point(body, q[first : first + size], at) for q in (before, after)]
            yield f"{body.name}.{name}", math.dist(*ends), "m"
        if not body.is_point:
            yield (
                f"{body.name}.angle",
                _turned_angle(body, before[first : first + size], after[first : first + size]),
                "rad",
            )
        first += size


def _turned_angle(body: AnyBody, before: Sequence[float], after: Sequence[float]) -> float:
    """Return the angle by which a body was turned [rad]; in space the smallest one."""
    if not isinstance(body, SpatialBody):
        return abs(after[2] - before[2])
    lengths = [math.sqrt(scalar_product(q[3:7], q[3:7])) for q in (before, after)]
    cosine = abs(scalar_product(before[3:7], after[3:7])) / (lengths[0] * lengths[1])
    return 2.0 * math.acos(min(1.0, cosine))


def _place_of_point(body: AnyBody, q: Sequence[float], at: Sequence[float]) -> list[float]:
    """Return the position of a point from its coordinates relative to the centre of mass in the body's frame."""
    if body.is_point:
        return list(q)
    if isinstance(body, SpatialBody):
        length = math.sqrt(scalar_product(q[3:7], q[3:7]))
        e0, e1, e2, e3 = (e / length for e in q[3:7])
        turned = rotate(rotation_matrix_of((e0, e1, e2, e3)), (at[0], at[1], at[2]))
        return [x + dx for x, dx in zip(q[:3], turned, strict=True)]
    c, s = math.cos(q[2]), math.sin(q[2])
    return [q[0] + c * at[0] - s * at[1], q[1] + s * at[0] + c * at[1]]
