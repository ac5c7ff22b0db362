"""How a spatial body is turned at the start, in the ways people write it down; Euler parameters for all of them.

Euler parameters (e0, e1, e2, e3) have length 1; the rotation matrix A that they stand for takes body to ground axes.
"""

from __future__ import annotations

import msgspec

from symgen.describe.numbers import Numbers
from symgen.vocabulary.expressions import ONE, ZERO, Expr, Number
from symgen.vocabulary.rotations import EulerParameters, Matrix, multiply

#: Orders of axes that Euler angles may be taken about: all twelve.
CONVENTIONS = tuple(a + b + c for a in "xyz" for b in "xyz" for c in "xyz" if a != b and b != c)


class Orientation(msgspec.Struct, frozen=True):
    """An orientation as it was written.

    Attributes
    ----------
    kind : {"quaternion", "rotation-vector", "euler-angles", "axes", "line"}
        How `values` are meant: Euler parameters; axis times angle [rad]; angles [rad] about the moving axes that
        `convention` names, in that order; the body's x axis and a vector towards its y axis, in the ground frame; two
        points that the x axis leads from and to, and a vector towards the y axis.
    """

    kind: str
    values: tuple[Expr, ...]
    convention: str = ""

    @property
    def is_numeric(self) -> bool:
        """Whether it depends on no parameter."""
        return all(isinstance(e, Number) for e in self.values)


IDENTITY = Orientation("quaternion", (ONE, ZERO, ZERO, ZERO))


def euler_parameters(orientation: Orientation, numbers: Numbers, where: str) -> EulerParameters:
    """Return the Euler parameters of an orientation.

    Parameters
    ----------
    orientation : Orientation
        As written.
    numbers : Numbers
        What is worked out: one orientation, or many.
    where : str
        For the message.

    Raises
    ------
    InputError
        If it says nothing: a quaternion of length 0, an axis of length 0, two parallel axes.
    """
    x = tuple(numbers.value(e, where) for e in orientation.values)
    if orientation.kind == "quaternion":
        length = numbers.above(0.0, _length(x, numbers), where, "a quaternion", "one of length 0")
        return x[0] / length, x[1] / length, x[2] / length, x[3] / length
    if orientation.kind == "rotation-vector":
        angle = _length(x, numbers)
        turned = numbers.apply("gt", angle, 0.0)
        sine = numbers.apply("sin", angle / 2.0) / numbers.apply("where", turned, angle, 1.0)
        factor = numbers.apply("where", turned, sine, 0.5)
        return numbers.apply("cos", angle / 2.0), factor * x[0], factor * x[1], factor * x[2]
    if orientation.kind == "euler-angles":
        result: EulerParameters = (1.0, 0.0, 0.0, 0.0)
        for axis, angle in zip(orientation.convention, x, strict=True):
            turn = [numbers.apply("cos", angle / 2.0), 0.0, 0.0, 0.0]
            turn["xyz".index(axis) + 1] = numbers.apply("sin", angle / 2.0)
            result = multiply(result, (turn[0], turn[1], turn[2], turn[3]))
        return result
    if orientation.kind == "line":
        along, towards = (x[3] - x[0], x[4] - x[1], x[5] - x[2]), x[6:9]
    else:
        along, towards = x[0:3], x[3:6]
    return from_matrix(_axes(along, towards, numbers, where), numbers)


def _length(vector: tuple[float, ...], numbers: Numbers) -> float:
    length: float = numbers.apply("sqrt", sum(e * e for e in vector))
    return length


def _axes(along: tuple[float, ...], towards: tuple[float, ...], numbers: Numbers, where: str) -> Matrix:
    """Return the matrix whose first column points along a vector and whose second lies towards another one."""
    length = _length(along, numbers)
    length = numbers.above(0.0, length, where, "a direction of the x axis", "a vector of length 0")
    a = tuple(e / length for e in along)
    part = sum(e * f for e, f in zip(a, towards, strict=True))
    b = tuple(f - part * e for e, f in zip(a, towards, strict=True))
    limit, expected = 1e-9 * _length(towards, numbers), "a second direction that is not parallel to the first"
    rest = numbers.above(limit, _length(b, numbers), where, expected, "a parallel one")
    b = tuple(e / rest for e in b)
    c = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return (a[0], b[0], c[0]), (a[1], b[1], c[1]), (a[2], b[2], c[2])


def from_matrix(m: Matrix, numbers: Numbers) -> EulerParameters:
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
        better = numbers.apply("gt", rows[k][k], largest)
        largest = numbers.apply("where", better, rows[k][k], largest)
        w, x, y, z = (numbers.apply("where", better, new, old) for new, old in zip(rows[k], row, strict=True))
        row = w, x, y, z
    size = _length(row, numbers)
    sign = numbers.apply("where", numbers.apply("lt", row[0], 0.0), -1.0, 1.0)
    return sign * row[0] / size, sign * row[1] / size, sign * row[2] / size, sign * row[3] / size
