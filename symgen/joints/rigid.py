"""Rigid joint: two bodies move as one."""

from __future__ import annotations

import msgspec

from symgen.describe.fields import BodyPair, PointPair, Scalar
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.vocabulary.measures import X_AXIS, Y_AXIS, Angle, Component, Holonomic


class Rigid(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A weld: a point of one body stays on a point of the other and neither turns against the other.

    Parameters
    ----------
    between : pair of body names
        The two bodies; a point mass is welded by a revolute joint, as it has no angle.
    at : pair of points
        The weld, as a point of the first and of the second body.
    angle : scalar
        Angle of the second body less that of the first [rad]; 0 unless given.

    Notes
    -----
    Three rows. Multipliers ``NAME.x``, ``NAME.y`` [N] and ``NAME.angle`` [N m]: force, in ground axes, and torque on
    the first body.
    """

    between: BodyPair
    at: PointPair
    angle: Scalar = 0.0

    def build(self, scope: Scope) -> Joint:
        """Resolve to the two components of the vector between the points and the angle."""
        a, b = scope.pair("between", self.between, turns=(True, True))
        weld_a, weld_b = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(
                Holonomic("x", Component(weld_a, weld_b, X_AXIS)),
                Holonomic("y", Component(weld_a, weld_b, Y_AXIS)),
                Holonomic("angle", Angle(a, b), scope.constant("angle", self.angle), "rad"),
            ),
        )


KIND = Rigid
