"""Revolute-spherical joint: a massless link with a pin at one end and a ball at the other."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Bearing, Component, Holonomic, LinkStretch
from symgen.describe.joints._paired import Paired
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis, Scalar
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triad


class RevoluteSpherical(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A massless link that turns about an axis of the first body and holds a point of the second; in space only.

    Parameters
    ----------
    between : pair of body names
        The body with the pin, and the body with the ball, which may be a point mass.
    at : pair of points
        Where the link meets the axis of the pin, on the first body, and the centre of the ball, on the second.
    axis : direction
        Of the pin, in the frame of the first body; the link is perpendicular to it. Its length does not matter.
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

    axis: Axis
    length: Scalar
    reference: Axis | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height over the pin's plane and the stretch of the link."""
        bodies, ends = self.ends(scope, turns=(True, False))
        triad = make_triad(scope, bodies[0], self.axis, self.reference)
        stretch = LinkStretch(*ends, scope.constant("length", self.length, positive=True))
        rows = (Holonomic("along", Component(*ends, triad.axis)), Holonomic("distance", stretch))
        return Joint(scope.name, scope.kind, bodies, rows, (("angle", Bearing(*ends, triad.first, triad.second)),))


KIND = RevoluteSpherical
