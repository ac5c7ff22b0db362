"""Bushing: linear stiffness and damping in all six directions between two frames."""

from __future__ import annotations

from typing import ClassVar, Literal

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Reading, call, literal_of, sum_of_terms
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Component,
    Direction,
    Dot,
    Effort,
    FormulaMeasure,
    Measure,
    Sum,
    axes,
)
from symgen.describe.forces._parts import damper_force, spring_potential
from symgen.describe.mechanism import Force
from symgen.describe.parts.fields import (
    AxisPair,
    BodyPair,
    DirectionPair,
    PointPair,
    Scalar,
    SquareMatrix,
    value_in_words,
)
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads

_LABELS = {False: ("x", "y", "turn_z"), True: ("x", "y", "z", "turn_x", "turn_y", "turn_z")}
#: Numbers in words.
_COUNTS = {3: "three", 6: "six"}
_Matrix = tuple[tuple[Expr, ...], ...]


class Bushing(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An elastic joint: linear springs and dampers, coupled or not, between a frame of either body.

    There are six in space and three in the plane.

    Parameters
    ----------
    between : pair of body names
        The two bodies; point masses may be among them where nothing works on rotations.
    at : pair of points
        The origins of the two frames.
    frame : str
        Axes of the translations: ``"body"``, those of the first body's frame, by default, or ``"ground"``.
    axis, reference : direction, or pairs of directions
        In space: z and x axis of the frames in the bodies' frames; the first body's own axes by default. They coincide
        where the bushing is unloaded: as the bodies start, or for each body as given.
    angle : scalar
        In the plane: angle of the second body relative to the first where it is unloaded [rad]; 0 by default.
    stiffness : list of 6 or six rows, in the plane of 3 or three rows
        Diagonal or whole of a symmetric matrix: [N/m] for translations, [N m/rad] for rotations, [N/rad] between the
        two; 0 by default.
    damping : list of 6 or six rows, in the plane of 3 or three rows
        The same for the rates [N s/m], [N m s/rad], [N s/rad]; 0 by default.

    Notes
    -----
    In space the six displacements u are the second frame's origin along the first frame's axes, or the
    ground's [m], and half the vector of R - R^T of the rotation R of the second frame against the first: for small
    rotations the angles, generally the axis times the sine [rad], so that rotations should stay well below 90 degrees.
    In the plane they are two displacements [m] and the angle [rad], turns counted. The potential is u^T K u / 2, and
    forces are its derivatives: conservative however large the displacements.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair
    at: PointPair
    frame: Literal["body", "ground"] = "body"
    axis: AxisPair | None = None
    reference: DirectionPair | None = None
    angle: Scalar | None = None
    stiffness: SquareMatrix | None = None
    damping: SquareMatrix | None = None

    def build(self, scope: Scope) -> Force:
        """Resolve to efforts along the displacements and, where they are coupled, along sums of two.

        A product is a difference of squares, 2 u w = (u + w)^2 - u^2 - w^2, so that every effort has a potential of its
        own coordinate alone.
        """
        size, labels = 6 if scope.spatial else 3, _LABELS[scope.spatial]
        k, c = (_symmetric_matrix(scope, key, getattr(self, key), size) for key in ("stiffness", "damping"))
        turning = any(row[j] != ZERO for m in (k, c) for row in m for j in range(scope.dimension, size))
        a, b = scope.pair("between", self.between, turns=(turning, turning))
        measures = self._displacement_measures(scope, (a, b), turning)
        efforts = []
        for i in range(len(measures)):
            own = [
                [m[i][i], *(call("neg", m[i][j]) for j in range(size) if j != i and m[i][j] != ZERO)] for m in (k, c)
            ]
            efforts += _effort_of_spring(labels[i], measures[i], sum_of_terms(*own[0]), sum_of_terms(*own[1]))
            for j in range(i):
                both = Sum(((ONE, measures[i]), (ONE, measures[j])))
                efforts += _effort_of_spring(f"{labels[j]}_{labels[i]}", both, k[i][j], c[i][j])
        return Force(scope.name, scope.kind, (a, b), tuple(efforts))

    def _displacement_measures(self, scope: Scope, bodies: tuple[str, str], turning: bool) -> tuple[Measure, ...]:
        """Return the displacements; rotations only where an effort acts on them."""
        ends = scope.marker("at", bodies[0], self.at[0]), scope.marker("at", bodies[1], self.at[1])
        grounded = self.frame == "ground"
        directions = axes(GROUND if grounded else bodies[0], scope.dimension)
        turns: tuple[Measure, ...] = ()
        if not scope.spatial:
            scope.only(axis=self.axis, reference=self.reference)
            turn, rest = Angle(*bodies), scope.constant("angle", self.angle or 0.0)
            turns = (turn if rest == ZERO else FormulaMeasure(call("sub", Reading("angle", turn), rest)),)
        else:
            scope.only(angle=self.angle)
            if turning or not grounded:
                triads = make_triads(scope, bodies, self.axis or (0.0, 0.0, 1.0), self.reference, fixed=True)
                u, v = ((t.first, t.second, t.axis) for t in triads)
                directions, turns = directions if grounded else u, _rotation_sines(u, v)
        return (*(Component(*ends, direction) for direction in directions), *(turns if turning else ()))


def _rotation_sines(u: tuple[Direction, ...], v: tuple[Direction, ...]) -> tuple[Measure, ...]:
    """Return half the vector of R - R^T of the rotation of one frame against another."""
    half = literal_of(0.5), literal_of(-0.5)
    return tuple(
        Sum(((half[0], Dot(u[(i + 2) % 3], v[(i + 1) % 3])), (half[1], Dot(u[(i + 1) % 3], v[(i + 2) % 3]))))
        for i in range(3)
    )


def _symmetric_matrix(
    scope: Scope, key: str, entries: tuple[float | str | tuple[float | str, ...], ...] | None, size: int
) -> _Matrix:
    """Return a symmetric matrix from its diagonal or its rows."""
    if entries is None:
        return ((ZERO,) * size,) * size
    rows = [e for e in entries if isinstance(e, tuple)]
    diagonal = [scope.constant(key, e) for e in entries if not isinstance(e, tuple)]
    if len(diagonal) == size and not rows:
        return tuple(tuple(diagonal[i] if i == j else ZERO for j in range(size)) for i in range(size))
    if len(rows) != size or diagonal or any(len(row) != size for row in rows):
        count = _COUNTS[size]
        raise scope.error(key, f"{count} numbers or {count} rows of {count}", value_in_words(entries))
    return scope.symmetric(key, rows)


def _effort_of_spring(label: str, measure: Measure, stiffness: Expr, damping: Expr) -> list[Effort]:
    """Return the effort of one spring and damper, or none where both are 0."""
    if (stiffness, damping) == (ZERO, ZERO):
        return []
    return [Effort(label, measure, damper_force(damping), spring_potential(stiffness))]


KIND = Bushing
