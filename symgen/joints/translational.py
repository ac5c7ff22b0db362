"""Translational (prismatic) joint: one body slides along an axis of the other without turning."""

from __future__ import annotations

import msgspec

from symgen.describe.fields import Axis, BodyPair, PointPair, Scalar
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.vocabulary.measures import Angle, Component, Holonomic


class Translational(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A slide: the second body moves along an axis fixed in the first one and does not turn against it.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        A point of each body; both lie on the axis.
    axis : pair
        Direction of the slide in the frame of the first body; its length does not matter.
    angle : scalar
        Angle of the second body less that of the first [rad]; 0 unless given.

    Notes
    -----
    Two rows. Multiplier ``NAME.normal`` [N]: force on the first body along the axis turned left by 90 degrees;
    ``NAME.angle`` [N m]: torque on the first body. Reports ``NAME.displacement``, along the axis from the first body's
    point to the second's [m].
    """

    between: BodyPair
    at: PointPair
    axis: Axis
    angle: Scalar = 0.0

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance from the axis and the angle."""
        a, b = scope.pair("between", self.between, turns=(True, True))
        point_a, point_b = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        along, normal = scope.axis("axis", a, self.axis)
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(
                Holonomic("normal", Component(point_a, point_b, normal)),
                Holonomic("angle", Angle(a, b), scope.constant("angle", self.angle), "rad"),
            ),
            coordinates=(("displacement", Component(point_a, point_b, along)),),
        )


KIND = Translational
