"""Beam element: an elastic and damped link of a length between two frames, exact for large turns of its ends."""

from __future__ import annotations

import math
from typing import ClassVar

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, call, literal_of, product, sum_of_terms
from symgen.base.vocabulary.measures import Angle, Component, Direction, Dot, Flexure, Marker, Measure, Sum
from symgen.describe.mechanism import Body, Force
from symgen.describe.parts.fields import Across, AxisPair, BodyPair, DirectionPair, PointPair, Scalar, value_in_words
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.strain_times import StrainTimes
from symgen.describe.parts.triads import make_triads, triad_from_directions


class Beam(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A beam element between two frames, such as a leaf spring; `[beams.NAME]` makes whole beams of such elements.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        The ends of the element, origins of the two frames.
    axis : direction, or pair of directions
        Along the beam at its ends: in the frame of each body; or in the first body's frame, from which the second one
        follows by the positions at the start and the curvature.
    reference : pair of directions
        In space, direction y of the section in the frame of each body.
    length : scalar
        Length of the unloaded element [m].
    axial : scalar
        Stiffness E A [N].
    shear : scalar, or pair
        Stiffness k G A [N], in space along y and z; rigid by default.
    torsion : scalar
        In space, stiffness G J [N m^2].
    bending : scalar, or pair
        Stiffness E I [N m^2], in space about y and z.
    curvature : scalar, or three
        Of the unloaded element [1/m]; in space twist and curvatures about y and z. 0 by default.
    damping : scalar, or table
        Time tau of a Kelvin-Voigt material: stress follows strain plus tau times its rate [s]; 0 by default. A table
        ``{ axial, shear, torsion, bending }`` has a time for each strain: cables damp bending and no stretch, which
        would make them stiff.

    Notes
    -----
    The energy depends on the relative position of the two frames alone and is of fourth order in the length of the
    element. An element should bend by less than 1 rad.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair
    at: PointPair
    axis: AxisPair
    reference: DirectionPair | None = None
    length: Scalar
    axial: Scalar
    shear: Across | None = None
    torsion: Scalar | None = None
    bending: Across
    curvature: Across = 0.0
    damping: Scalar | StrainTimes = 0.0

    def build(self, scope: Scope) -> Force:
        """Resolve to a beam element."""
        a, b = scope.pair("between", self.between, turns=(True, True))
        ends = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        length = scope.constant("length", self.length, positive=True)
        scope.only(*(("torsion",) if scope.spatial else ()), torsion=self.torsion)
        bends = scope.several("curvature", self.curvature, 3 if scope.spatial else 1, alike=self.curvature == 0.0)
        rest = (length, *(ZERO,) * (2 if scope.spatial else 1), *(product(length, bend) for bend in bends))
        damping = self._damping(scope)
        turn: Expr = ZERO
        if scope.spatial:
            measures = _deformation_in_space(ends, *self._triads_in_space(scope, (a, b), bends))
        else:
            directions = self._directions_in_plane(scope, (a, b), rest[-1])
            measures, turn = _deformation_in_plane(ends, directions), _bend_beyond_angle(scope, directions, rest[-1])
        flexure = Flexure(measures, length, self._compliances(scope), rest, damping, turn)
        return Force(scope.name, scope.kind, (a, b), (), (flexure,))

    def _damping(self, scope: Scope) -> Expr | tuple[Expr, ...]:
        """Return one time, or a time for each strain."""
        if not isinstance(self.damping, StrainTimes):
            return _time(scope, "damping", self.damping)
        across = 2 if scope.spatial else 1
        if not scope.spatial and self.damping.torsion != 0.0:
            raise scope.error("damping.torsion", "no twist in the plane", value_in_words(self.damping.torsion))
        axial, shear, bending, torsion = (
            _time(scope, f"damping.{key}", getattr(self.damping, key))
            for key in ("axial", "shear", "bending", "torsion")
        )
        twist = (torsion,) if scope.spatial else ()
        times = (axial, *(shear,) * across, *twist, *(bending,) * across)
        return times if any(time != ZERO for time in times) else ZERO

    def _compliances(self, scope: Scope) -> tuple[Expr, ...]:
        """Return the compliances: 1 / E A, shear, 1 / G J in space, and bending."""
        across, compliances = 2 if scope.spatial else 1, list[Expr]()
        for key in ("axial", "shear", "torsion", "bending"):
            value: float | str | tuple[float | str, ...] | None = getattr(self, key)
            count = across if key in ("shear", "bending") else 1
            if value is None:
                compliances += [ZERO] * (count if key == "shear" else 0)
                continue
            for part in value if isinstance(value, tuple) else (value,):
                if isinstance(part, float | int) and not math.isfinite(part):
                    hint = "shear is rigid where that key is left out" if key == "shear" else ""
                    raise scope.error(key, "a finite stiffness", repr(part), hint)
            parts = scope.several(key, value, count, alike=True, positive=True)
            compliances += [call("div", ONE, part) for part in parts]
        return tuple(compliances)

    def _triads_in_space(
        self, scope: Scope, bodies: tuple[str, str], bends: tuple[Expr, ...]
    ) -> tuple[Directions, Directions]:
        """Return the axes of the two frames in space: along the beam, then y and z of the section."""
        axes = [axis for axis in self.axis if isinstance(axis, tuple)]
        if self.reference is None or len(axes) != 2:
            if any(bend != ZERO for bend in bends):
                raise scope.error("axis", "two directions beside the key reference, as the element is curved", "fewer")
            a, b = make_triads(scope, bodies, self.axis, self.reference, fixed=True)
            return (a.axis, a.first, a.second), (b.axis, b.first, b.second)
        return tuple(  # type: ignore[return-value]  # two
            tuple(
                Direction(body, vector)
                for vector in triad_from_directions(scope, "reference", along.vector, side.vector)
            )
            for body, axis, reference in zip(bodies, axes, self.reference, strict=True)
            for along, side in [(scope.direction("axis", body, axis), scope.direction("reference", body, reference))]
        )

    def _directions_in_plane(self, scope: Scope, bodies: tuple[str, str], bend: Expr) -> tuple[Directions, Directions]:
        """Return the axes of the two frames in the plane."""
        first, second = self.axis[0], self.axis[1] if len(self.axis) == 2 else ()
        if isinstance(first, tuple) and isinstance(second, tuple):
            return scope.axis("axis", bodies[0], first), scope.axis("axis", bodies[1], second)
        along = scope.axis("axis", bodies[0], self.axis)
        turned = sum_of_terms(
            *(_described_angle(scope, body, sign) for body, sign in zip(bodies, (1.0, -1.0), strict=True)), bend
        )
        cosine, sine = call("cos", turned), call("sin", turned)
        x, y = along[0].vector
        vector = (
            sum_of_terms(product(cosine, x), product(call("neg", sine), y)),
            sum_of_terms(product(sine, x), product(cosine, y)),
        )
        carried = Direction(bodies[1], vector), Direction(bodies[1], (call("neg", vector[1]), vector[0]))
        return along, carried


#: Axes of a frame.
Directions = tuple[Direction, ...]


def _deformation_in_plane(ends: tuple[Marker, Marker], axes: tuple[Directions, Directions]) -> tuple[Measure, ...]:
    along = (Sum(tuple((ONE, Component(*ends, e)) for e in pair)) for pair in zip(*axes, strict=True))
    return (*along, Angle(ends[0].body, ends[1].body))


def _deformation_in_space(ends: tuple[Marker, Marker], u: Directions, v: Directions) -> tuple[Measure, ...]:
    along = (Sum(tuple((ONE, Component(*ends, e)) for e in pair)) for pair in zip(u, v, strict=True))
    less = literal_of(-1.0)
    turns = (
        Sum(((ONE, Dot(u[(i + 2) % 3], v[(i + 1) % 3])), (less, Dot(u[(i + 1) % 3], v[(i + 2) % 3])))) for i in range(3)
    )
    return (*along, *turns, Sum(tuple((ONE, Dot(a, b)) for a, b in zip(u, v, strict=True))))


def _time(scope: Scope, key: str, value: float | str) -> Expr:
    time = scope.constant(key, value)
    if scope.value(time, key) < 0.0:
        raise scope.error(key, "a time of 0 or more", value_in_words(value))
    return time


def _described_angle(scope: Scope, body: str, sign: float) -> Expr:
    """Return the angle of a planar body as described, times a sign."""
    described = scope.context.bodies.get(body)
    return product(literal_of(sign), described.angle) if isinstance(described, Body) else ZERO


def _bend_beyond_angle(scope: Scope, axes: tuple[Directions, Directions], bend: Expr) -> Expr:
    """Return the bend beyond the angle between the bodies, less whole turns between them as described."""
    turned = [call("atan2", d[0].vector[1], d[0].vector[0]) for d in axes]
    turn = sum_of_terms(turned[1], call("neg", turned[0])) if turned[0] != turned[1] else ZERO
    described = sum_of_terms(
        *(_described_angle(scope, d[0].body, s) for d, s in zip(axes, (-1.0, 1.0), strict=True)), turn
    )
    around = round((scope.value(described, "axis") - scope.value(bend, "curvature")) / math.tau)
    return sum_of_terms(turn, literal_of(-math.tau * around))


KIND = Beam
