"""Orientation: two bodies do not turn against each other, or as functions of time say, wherever they move."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.errors import quote, suggest
from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number, Reading, call, product, sum_of_terms
from symgen.base.vocabulary.measures import Angle, Direction, Dot, FormulaMeasure, Holonomic, axes
from symgen.base.vocabulary.rotations import CONVENTIONS
from symgen.describe.joints._space import frames_of_joint, row_against_turning, rows_of_parallel_axes
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import AxisPair, BodyPair, DirectionPair, Scalar, Text, TimeVector, value_in_words
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads

#: Square of the angle [rad^2] below which a rotation vector counts as longer, so that it may pass 0 smoothly.
LEAST = 1e-12

_Matrix = tuple[tuple[Expr, Expr, Expr], ...]


class FixedOrientation(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two bodies keep their orientation to each other, or follow one of time; their points move freely.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    angle : scalar
        In the plane: angle of the second body relative to the first [rad]; 0 by default.
    axis, reference : direction, or pairs of directions
        In space: two directions of each body that coincide, the second across the first; as the bodies start unless
        given.
    rotation_vector : vector of functions of time
        In space, in place of these: how the second body is turned against the first, axis times angle [rad].
    euler_angles, convention : vector of functions of time, str
        In space, in place of these: the same as three angles [rad] about axes such as ``"zyx"``, each as the turns
        before have left it.

    Notes
    -----
    In the plane one row, ``NAME.angle`` [N m]: torque on the first body. In space three, ``NAME.first``, ``.second``
    and ``.angle``, as of a rigid joint; where the orientation is one of time about the axes of the second body.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair
    angle: Scalar | None = None
    axis: AxisPair | None = None
    reference: DirectionPair | None = None
    rotation_vector: TimeVector | None = None
    euler_angles: TimeVector | None = None
    convention: Text | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the angle, in space to three products of directions."""
        bodies = scope.pair("between", self.between, turns=(True, True))
        moved = {"rotation_vector": self.rotation_vector, "euler_angles": self.euler_angles}
        if scope.spatial and any(value is not None for value in moved.values()):
            for key in ("angle", "axis", "reference"):
                if (value := getattr(self, key)) is not None:
                    raise scope.error(key, "no such key beside an orientation of time", value_in_words(value))
            return Joint(scope.name, scope.kind, bodies, _rows_of_matrix(bodies, self._matrix_of_time(scope)))
        scope.only(convention=self.convention, **({} if scope.spatial else moved))
        if scope.spatial:
            scope.only(angle=self.angle)
            triads = make_triads(scope, bodies, self.axis or (0.0, 0.0, 1.0), self.reference, fixed=True)
            return Joint(
                scope.name, scope.kind, bodies, (*rows_of_parallel_axes(*triads), row_against_turning(*triads))
            )
        scope.only(axis=self.axis, reference=self.reference)
        held = Holonomic("angle", Angle(*bodies), scope.constant("angle", self.angle or 0.0), "rad")
        return Joint(scope.name, scope.kind, bodies, (held,))

    @staticmethod
    def frames(joint: Joint) -> tuple[tuple[Direction, ...], tuple[Direction, ...]]:
        """Return the frames that coincide; none where they turn with time."""
        moves = any(isinstance(row.measure, FormulaMeasure) for row in joint.rows if isinstance(row, Holonomic))
        return ((), ()) if moves else frames_of_joint(joint)

    def _matrix_of_time(self, scope: Scope) -> _Matrix:
        """Return the matrix of the second body's axes in the first body's frame."""
        if self.rotation_vector is not None and self.euler_angles is not None:
            raise scope.error("", "either the key rotation_vector or the key euler_angles", "both")
        if self.rotation_vector is not None:
            if self.convention is not None:
                raise scope.error("convention", "no such key beside rotation_vector", quote(self.convention))
            return _matrix_of_vector(_three(scope, "rotation_vector", self.rotation_vector))
        if self.convention not in CONVENTIONS:
            got = "no such key" if self.convention is None else quote(self.convention)
            hint = suggest(self.convention or "", CONVENTIONS)
            raise scope.error("convention", "three axes such as 'zyx'", got, hint if self.convention else "")
        result: _Matrix | None = None
        for letter, angle in zip(
            self.convention or "", _three(scope, "euler_angles", self.euler_angles or ()), strict=True
        ):
            turn = _matrix_about("xyz".index(letter), angle)
            result = turn if result is None else _product(result, turn)
        assert result is not None, "there are three angles"
        return result


def _three(scope: Scope, key: str, values: tuple[float | str, ...]) -> tuple[Expr, Expr, Expr]:
    x, y, z = (scope.of_time(f"{key}[{i}]", value) for i, value in enumerate(values))
    return x, y, z


def _matrix_about(axis: int, angle: Expr) -> _Matrix:
    """Return the rotation by an angle about an axis of the frame."""
    c, s = call("cos", angle), call("sin", angle)
    rows: list[list[Expr]] = [[ZERO] * 3 for _ in range(3)]
    j, k = (axis + 1) % 3, (axis + 2) % 3
    rows[axis][axis], rows[j][j], rows[k][k] = ONE, c, c
    rows[j][k], rows[k][j] = call("neg", s), s
    return tuple((a, b, c) for a, b, c in rows)


def _product(a: _Matrix, b: _Matrix) -> _Matrix:
    def entry(i: int, j: int) -> Expr:
        return sum_of_terms(*(product(a[i][k], b[k][j]) for k in range(3)))

    return tuple((entry(i, 0), entry(i, 1), entry(i, 2)) for i in range(3))


def _matrix_of_vector(v: tuple[Expr, Expr, Expr]) -> _Matrix:
    """Return ``cos I + sin/angle [v] + 2 (sin(angle/2)/angle)^2 v v^T``."""
    angle = call("sqrt", sum_of_terms(*(call("mul", x, x) for x in v), Number(LEAST)))
    half = call("div", call("sin", call("mul", Number(0.5), angle)), angle)
    both, turn = product(Number(2.0), half, half), call("div", call("sin", angle), angle)
    cross = {(2, 1): v[0], (0, 2): v[1], (1, 0): v[2]}

    def entry(i: int, j: int) -> Expr:
        along = product(both, v[i], v[j])
        if i == j:
            return sum_of_terms(call("cos", angle), along)
        beside = product(turn, cross[i, j]) if (i, j) in cross else call("neg", product(turn, cross[j, i]))
        return sum_of_terms(beside, along)

    return tuple((entry(i, 0), entry(i, 1), entry(i, 2)) for i in range(3))


def _rows_of_matrix(bodies: tuple[str, str], matrix: _Matrix) -> tuple[Holonomic, ...]:
    """Return the rows that hold the axes of the second body along the columns of a matrix in the first body's frame."""
    first, second = (axes(body, 3) for body in bodies)

    def along(column: int, axis: int) -> Expr:
        """Return the component of an axis of the second body along a column."""
        readings = (Reading(f"axis{axis + 1}.{letter}", Dot(first[k], second[axis])) for k, letter in enumerate("xyz"))
        return sum_of_terms(*(product(matrix[k][column], reading) for k, reading in enumerate(readings)))

    measures = call("neg", along(1, 2)), along(0, 2), along(1, 0)
    return tuple(
        Holonomic(label, FormulaMeasure(of), unit="rad")
        for label, of in zip(("first", "second", "angle"), measures, strict=True)
    )


KIND = FixedOrientation
