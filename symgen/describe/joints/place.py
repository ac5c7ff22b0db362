"""Place: where a point of one body is in the frame of another, as coordinates that a start may prescribe."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Bearing, Component, Direction, Marker, Measure, axes
from symgen.describe.joints._paired import Paired
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis, Flag
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triad


class PointPlace(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The coordinates of a point of the second body in the first body's frame, which hold nothing.

    With ``start = { x = 0.3, y = 0.2 }``, or ``--start NAME.x=0.3``, the mechanism begins with the point there. Forces,
    couplings and rows may read the coordinates and their rates.

    Parameters
    ----------
    between : pair of body names
        The body whose frame it is, and the body with the point.
    at : pair of points
        The origin, a point of the first body, and the point.
    angle : bool
        Whether the direction from the origin to the point is reported too: its angle to the x axis of the first body's
        frame, in space about an axis.
    axis : direction
        In space: what the angle is about, in the frame of the first body. Its length does not matter.
    reference : direction
        In space: where the angle is 0; a direction across the axis by default.

    Notes
    -----
    No rows. Reports ``NAME.x``, ``NAME.y``, in space ``NAME.z`` [m], and with `angle` ``NAME.angle`` [rad], turns
    counted. The angle is not defined where the point is at the origin, or in space on the axis through it.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    angle: Flag = False
    axis: Axis | None = None
    reference: Axis | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the components of the vector between the points, and its direction."""
        bodies, ends = self.ends(scope, turns=(False, False))
        along = zip("xyz", axes(bodies[0], scope.dimension), strict=False)
        coordinates: list[tuple[str, Measure]] = [(label, Component(*ends, axis)) for label, axis in along]
        for key, value in (("axis", self.axis), ("reference", self.reference)):
            if value is not None and not (self.angle and scope.spatial):
                raise scope.error(key, "no such key but in space with angle = true", "a direction")
        if self.angle:
            coordinates.append(("angle", Bearing(*ends, *self._directions_across(scope, ends[0]))))
        return Joint(scope.name, scope.kind, bodies, (), tuple(coordinates))

    def _directions_across(self, scope: Scope, origin: Marker) -> tuple[Direction, Direction]:
        """Return the directions at the angles 0 and 90 degrees."""
        if not scope.spatial:
            zero, quarter = axes(origin.body, 2)
            return zero, quarter
        if self.axis is None:
            raise scope.error("axis", "an axis, as an angle in space is about one", "no such key")
        triad = make_triad(scope, origin.body, self.axis, self.reference)
        return triad.first, triad.second


KIND = PointPlace
