"""Revolute-spherical joint: a massless link with a pin at one end and a ball at the other."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import Axis, BodyPair, PointPair, Scalar
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.describe.triads import make_triad
from symgen.vocabulary.measures import Bearing, Component, Holonomic, LinkStretch


class RevoluteSpherical(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A massless link that turns about an axis of the first body and holds a point of the second; in space only.

    Parameters
    ----------
    between : pair of body names
        The body with the pin, and the body with the ball, which may be a point mass.
    at : pair of points
        Where the link meets the axis of the pin, on the first body, and the centre of the ball, on the second.
    axis : direction
        Of the pin, in the frame of the first body; the link stands across it. Its length does not matter.
    length : scalar
        Of the link [m], above 0.
    reference : direction
        Where the link points at angle 0, in the frame of the first body; a direction across the axis by default.

    Notes
    -----
    Two rows [m]. Multipliers ``NAME.along`` [N]: force on the first body along the axis; ``NAME.distance`` [N]: the
    tension of the link. Reports ``NAME.angle`` of the link about the axis [rad], turns counted.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    between: BodyPair
    at: PointPair
    axis: Axis
    length: Scalar
    reference: Axis | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height over the pin's plane and the stretch of the link."""
        a, b = scope.pair("between", self.between, turns=(True, False))
        pin, ball = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        triad = make_triad(scope, a, self.axis, self.reference)
        length = scope.constant("length", self.length, positive=True)
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(
                Holonomic("along", Component(pin, ball, triad.axis)),
                Holonomic("distance", LinkStretch(pin, ball, length)),
            ),
            coordinates=(("angle", Bearing(pin, ball, triad.first, triad.second)),),
        )


KIND = RevoluteSpherical
