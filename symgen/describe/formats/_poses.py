"""Places of frames: rotations as three rows, points and directions as triples of numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from symgen.base.vocabulary.rotations import scalar_product

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]

ORIGIN: Vector = (0.0, 0.0, 0.0)
UNIT: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Pose:
    """A frame in another one: its origin [m], and its axes as columns of a rotation."""

    origin: Vector = ORIGIN
    rotation: Matrix = UNIT

    def point_in_outer_frame(self, x: Vector) -> Vector:
        """Return a point of this frame in the other one."""
        return vector_sum(self.origin, matrix_vector(self.rotation, x))

    def __matmul__(self, inner: Pose) -> Pose:
        """Return a frame of this frame in the other one."""
        return Pose(self.point_in_outer_frame(inner.origin), matrix_product(self.rotation, inner.rotation))

    def inverse(self) -> Pose:
        """Return the other frame in this one."""
        back = matrix_transpose(self.rotation)
        return Pose(scaled_vector(-1.0, matrix_vector(back, self.origin)), back)


def vector_sum(x: Vector, y: Vector) -> Vector:
    """Return x + y."""
    return x[0] + y[0], x[1] + y[1], x[2] + y[2]


def scaled_vector(factor: float, x: Vector) -> Vector:
    """Return a multiple of a vector."""
    return factor * x[0], factor * x[1], factor * x[2]


def unit_vector(x: Vector) -> Vector:
    """Return the direction of a vector, which must not be zero."""
    return scaled_vector(1.0 / math.sqrt(scalar_product(x, x)), x)


def matrix_vector(matrix: Matrix, x: Vector) -> Vector:
    """Return the product of a matrix and a vector."""
    return scalar_product(matrix[0], x), scalar_product(matrix[1], x), scalar_product(matrix[2], x)


def matrix_transpose(matrix: Matrix) -> Matrix:
    """Return the transpose."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    return (a, d, g), (b, e, h), (c, f, i)


def matrix_product(x: Matrix, y: Matrix) -> Matrix:
    """Return the product of two matrices."""
    columns = matrix_transpose(y)
    a, b, c = (matrix_vector(columns, row) for row in x)
    return a, b, c


def axis_rotation(axis: Vector, angle: float) -> Matrix:
    """Return the rotation about an axis by an angle [rad] (Rodrigues)."""
    (x, y, z), c, s = unit_vector(axis), math.cos(angle), math.sin(angle)
    d = 1.0 - c
    return (
        (c + x * x * d, x * y * d - z * s, x * z * d + y * s),
        (y * x * d + z * s, c + y * y * d, y * z * d - x * s),
        (z * x * d - y * s, z * y * d + x * s, c + z * z * d),
    )


def rotation_to(direction: Vector) -> Matrix:
    """Return a rotation whose third axis is a direction."""
    z = unit_vector(direction)
    x = perpendicular_direction(z)
    y = z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]
    return matrix_transpose((x, y, z))


def rotation_from_rpy(angles: Sequence[float]) -> Matrix:
    """Return the rotation by roll, pitch and yaw about the fixed axes x, y, z [rad]."""
    roll, pitch, yaw = angles
    x, y, z = UNIT
    return matrix_product(axis_rotation(z, yaw), matrix_product(axis_rotation(y, pitch), axis_rotation(x, roll)))


def rotation_from_quaternion(numbers: Sequence[float]) -> Matrix:
    """Return the rotation of Euler parameters, the scalar first, of any length but 0."""
    size = math.sqrt(scalar_product(numbers, numbers))
    w, x, y, z = (number / size for number in numbers)
    return (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )


def quaternion_of_rotation(rotation: Matrix) -> tuple[float, float, float, float]:
    """Return the Euler parameters of a rotation, the scalar first and not negative (Shepperd)."""
    (a, b, c), (d, e, f), (g, h, i) = rotation
    candidates = (1.0 + a + e + i, 1.0 + a - e - i, 1.0 - a + e - i, 1.0 - a - e + i)
    largest = max(range(4), key=lambda k: candidates[k])
    rows = (
        (candidates[0], h - f, c - g, d - b),
        (h - f, candidates[1], d + b, g + c),
        (c - g, d + b, candidates[2], h + f),
        (d - b, g + c, h + f, candidates[3]),
    )
    numbers, size = rows[largest], 2.0 * math.sqrt(candidates[largest])
    sign = -1.0 if numbers[0] < 0.0 else 1.0
    w, x, y, z = (sign * number / size for number in numbers)
    return w, x, y, z


def perpendicular_direction(axis: Vector) -> Vector:
    """Return a direction across an axis: the coordinate axis farthest from it, made perpendicular."""
    direction = unit_vector(axis)
    nearest = min(range(3), key=lambda k: abs(direction[k]))
    start = UNIT[nearest]
    return unit_vector(vector_sum(start, scaled_vector(-scalar_product(start, direction), direction)))
