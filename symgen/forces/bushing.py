"""Bushing: linear stiffness and damping in all six directions between two frames."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import AxisPair, BodyPair, DirectionPair, PointPair, SixBySix, words_of
from symgen.describe.mechanism import Force
from symgen.describe.scope import Scope
from symgen.describe.triads import make_triads
from symgen.forces._parts import damper, spring
from symgen.vocabulary.expressions import ONE, ZERO, Expr, call, number, total
from symgen.vocabulary.measures import Component, Dot, Effort, Measure, Sum

_LABELS = ("x", "y", "z", "turn_x", "turn_y", "turn_z")
_Matrix = tuple[tuple[Expr, ...], ...]


class Bushing(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An elastic joint: six linear springs and dampers, coupled or not, between a frame of either body; in space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        The origins of the two frames.
    axis, reference : direction, or pairs of directions
        z and x axis of the frames in the bodies' frames; the first body's own axes by default. They coincide where
        the bushing is unloaded: as the bodies start, or for each body as given.
    stiffness : list of 6 or six rows
        Diagonal or whole of a symmetric matrix: [N/m] for translations, [N m/rad] for rotations, [N/rad] between the
        two; 0 by default.
    damping : list of 6 or six rows
        The same for the rates [N s/m], [N m s/rad], [N s/rad]; 0 by default.

    Notes
    -----
    The six displacements u are those of the second frame's origin along the first frame's axes [m], and half the vector
    of R - R^T of the rotation R of the second frame against the first: for small rotations the angles, generally the
    axis times the sine [rad], so that rotations should stay well below 90 degrees. The potential is u^T K u / 2, and
    forces are its derivatives: conservative however large the displacements.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    between: BodyPair
    at: PointPair
    axis: AxisPair | None = None
    reference: DirectionPair | None = None
    stiffness: SixBySix | None = None
    damping: SixBySix | None = None

    def build(self, scope: Scope) -> Force:
        """Resolve to efforts along the six displacements and, where they are coupled, along sums of two.

        A product is a difference of squares, 2 u w = (u + w)^2 - u^2 - w^2, so that every effort has a potential of its
        own coordinate alone.
        """
        a, b = scope.pair("between", self.between, turns=(True, True))
        measures = self._displacements(scope, a, b)
        k, c = (_matrix(scope, key, getattr(self, key)) for key in ("stiffness", "damping"))
        efforts = []
        for i in range(6):
            own = [[m[i][i], *(call("neg", m[i][j]) for j in range(6) if j != i and m[i][j] != ZERO)] for m in (k, c)]
            efforts += _effort(_LABELS[i], measures[i], total(*own[0]), total(*own[1]))
            for j in range(i):
                both = Sum(((ONE, measures[i]), (ONE, measures[j])))
                efforts += _effort(f"{_LABELS[j]}_{_LABELS[i]}", both, k[i][j], c[i][j])
        return Force(scope.name, scope.kind, (a, b), tuple(efforts))

    def _displacements(self, scope: Scope, a: str, b: str) -> tuple[Measure, ...]:
        ends = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        of_a, of_b = make_triads(scope, (a, b), self.axis or (0.0, 0.0, 1.0), self.reference, fixed=True)
        u, v = ((t.first, t.second, t.axis) for t in (of_a, of_b))
        half = number(0.5), number(-0.5)
        turns = (
            Sum(((half[0], Dot(u[(i + 2) % 3], v[(i + 1) % 3])), (half[1], Dot(u[(i + 1) % 3], v[(i + 2) % 3]))))
            for i in range(3)
        )
        return (*(Component(*ends, direction) for direction in u), *turns)


def _matrix(scope: Scope, key: str, entries: tuple[float | str | tuple[float | str, ...], ...] | None) -> _Matrix:
    """Return a symmetric matrix given as its diagonal or as six rows."""
    if entries is None:
        return ((ZERO,) * 6,) * 6
    rows = [e for e in entries if isinstance(e, tuple)]
    diagonal = [scope.constant(key, e) for e in entries if not isinstance(e, tuple)]
    if len(diagonal) == 6 and not rows:
        return tuple(tuple(diagonal[i] if i == j else ZERO for j in range(6)) for i in range(6))
    if len(rows) != 6 or diagonal or any(len(row) != 6 for row in rows):
        raise scope.error(key, "six numbers or six rows of six", words_of(entries))
    matrix = tuple(tuple(scope.constant(key, e) for e in row) for row in rows)
    for i in range(6):
        for j in range(i):
            if matrix[i][j] != matrix[j][i]:
                raise scope.error(key, "a symmetric matrix", f"different entries {i + 1}{j + 1} and {j + 1}{i + 1}")
    return matrix


def _effort(label: str, measure: Measure, stiffness: Expr, damping: Expr) -> list[Effort]:
    """Return the effort of one spring and damper, or none where both are 0."""
    if (stiffness, damping) == (ZERO, ZERO):
        return []
    return [Effort(label, measure, damper(damping), spring(stiffness))]


KIND = Bushing
