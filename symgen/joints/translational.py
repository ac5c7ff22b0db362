"""Translational (prismatic) joint: one body slides along an axis of the other without turning."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import AxisPair, BodyPair, DirectionPair, PointPair, Scalar
from symgen.describe.mechanism import Articulation, Joint
from symgen.describe.scope import Scope
from symgen.joints._space import frames, markers, not_turned, on_axis, parallel
from symgen.vocabulary.measures import Angle, Component, Holonomic


class Translational(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A slide: the second body moves along an axis fixed in the first one and does not turn against it.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        A point of each body; both lie on the axis.
    axis : direction, or in space pair of directions
        Direction of the slide in the frame of the first body, in space also one in the frame of each body; lengths do
        not matter.
    angle : scalar
        In the plane: angle of the second body less that of the first [rad]; 0 by default.
    reference : pair of directions
        In space: directions across the axis that coincide; as the bodies start by default.

    Notes
    -----
    In the plane two rows. Multiplier ``NAME.normal`` [N]: force on the first body along the axis turned left by 90
    degrees; ``NAME.angle`` [N m]: torque on the first body. Reports ``NAME.displacement``, along the
    axis from the first body's point to the second's [m].

    In space five rows: ``NAME.across1``, ``.across2`` [N], forces on the first body across the axis, and
    ``NAME.first``, ``.second``, ``.angle`` [N m], torques on it about two directions across the axis and about it.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair
    at: PointPair
    axis: AxisPair
    angle: Scalar | None = None
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance from the axis and the angle, in space to two distances and three angles."""
        a, b = scope.pair("between", self.between, turns=(True, True))
        point_a, point_b = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        if scope.spatial:
            scope.only(angle=self.angle)
            triad_a, triad_b = scope.triads((a, b), self.axis, self.reference, fixed=True)
            return Joint(
                name=scope.name,
                kind=scope.kind,
                bodies=(a, b),
                rows=(
                    *on_axis(point_a, point_b, triad_a),
                    *parallel(triad_a, triad_b),
                    not_turned(triad_a, triad_b),
                ),
                coordinates=(("displacement", Component(point_a, point_b, triad_a.axis)),),
            )
        scope.only(reference=self.reference)
        along, normal = scope.axis("axis", a, self.axis)
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(
                Holonomic("normal", Component(point_a, point_b, normal)),
                Holonomic("angle", Angle(a, b), scope.constant("angle", self.angle or 0.0), "rad"),
            ),
            coordinates=(("displacement", Component(point_a, point_b, along)),),
        )

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        ((_, displacement),) = joint.coordinates
        assert isinstance(displacement, Component), "a displacement is a component"
        slides = (displacement.along,)
        if len(joint.rows) < 5:
            return Articulation(*markers(joint), "fixed", slides, angle=joint.rows[1].value)
        return Articulation(*markers(joint), "fixed", slides, *frames(joint))


KIND = Translational
