"""Rotations as Euler parameters (e0, e1, e2, e3) of length 1 and as matrices, of numbers or arrays of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number

#: Four Euler parameters.
EulerParameters = tuple[float, float, float, float]
#: Rows of a rotation matrix.
Matrix = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]


def composed_rotation(a: EulerParameters, b: EulerParameters) -> EulerParameters:
    """Return the orientation of a turn `b` about axes turned by `a`."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def rotation_matrix_of(e: EulerParameters) -> Matrix:
    """Return the rotation matrix of Euler parameters of length 1, numbers or arrays of them."""
    a, b, c, d = e
    return (
        (a * a + b * b - c * c - d * d, 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)),
        (2.0 * (b * c + a * d), a * a - b * b + c * c - d * d, 2.0 * (c * d - a * b)),
        (2.0 * (b * d - a * c), 2.0 * (c * d + a * b), a * a - b * b - c * c + d * d),
    )


def scalar_product(a: Iterable[Any], b: Iterable[Any]) -> Any:
    """Return the scalar product of two vectors of numbers or arrays, its terms added one after the other.

    `sum` adds numbers in another way since Python 3.12: a digest of a mechanism would depend on the interpreter.
    """
    result: Any = 0.0
    for x, y in zip(a, b, strict=True):
        result = result + x * y
    return result


def rotate(m: Matrix, v: tuple[float, ...]) -> tuple[float, float, float]:
    """Return the matrix times a vector."""
    x, y, z = (scalar_product(row, v) for row in m)
    return x, y, z


def rotate_back(m: Matrix, v: tuple[float, ...]) -> tuple[float, float, float]:
    """Return the transposed matrix times a vector."""
    x, y, z = (scalar_product(column, v) for column in zip(*m, strict=True))
    return x, y, z


#: All twelve sequences of axes of Euler angles.
CONVENTIONS = tuple(a + b + c for a in "xyz" for b in "xyz" for c in "xyz" if a != b and b != c)


class Orientation(msgspec.Struct, frozen=True):
    """An orientation as written.

    Attributes
    ----------
    kind : {"quaternion", "rotation-vector", "euler-angles", "axes", "line"}
        Meaning of `values`: Euler parameters; axis times angle [rad]; angles [rad] about the moving axes that
        `convention` names, in that order; the body's x axis and a vector towards its y axis, in the ground frame; two
        points that the x axis leads from and to, and a vector towards the y axis.
    """

    kind: str
    values: tuple[Expr, ...]
    convention: str = ""

    @property
    def is_numeric(self) -> bool:
        """Whether it is independent of parameters."""
        return all(isinstance(e, Number) for e in self.values)


IDENTITY = Orientation("quaternion", (ONE, ZERO, ZERO, ZERO))
