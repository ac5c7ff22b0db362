"""Rolling: a disc rolls without slip on a straight line fixed in another body."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.vocabulary.expressions import ONE, call
from symgen.base.vocabulary.measures import Angle, Component, Holonomic, Sum
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis, BodyPair, Point, Scalar
from symgen.describe.parts.scope import CENTRE, Scope


class Rolling(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A disc of the first body on a line of the second: it keeps its height and does not slip.

    Parameters
    ----------
    between : pair of body names
        The disc, and the body with the line.
    radius : scalar
        Of the disc [m], above 0.
    axis : pair
        Direction of the line in the frame of the second body; the disc is on its left. The length does not matter.
    centre : point
        Of the disc, on the first body; its centre of mass by default.
    on : point
        A point of the line, on the second body.
    offset : scalar
        The constant in displacement + radius (theta_disc - theta_line) = offset [m]; 0 by default.

    Notes
    -----
    Two rows [m]. Multiplier ``NAME.normal`` [N]: the force with which the line pushes the disc away (negative where it
    would have to pull: contact is not released). ``NAME.roll`` [N]: friction on the disc along the axis. Reports
    ``NAME.displacement``, of the centre along the axis [m].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar",)

    between: BodyPair
    radius: Scalar
    axis: Axis
    on: Point
    centre: Point = CENTRE
    offset: Scalar = 0.0

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height above the line and the sum of displacement and turned arc."""
        disc, base = scope.pair("between", self.between, turns=(True, True))
        centre, line = scope.marker("centre", disc, self.centre), scope.marker("on", base, self.on)
        along, normal = scope.axis("axis", base, self.axis)
        radius = scope.constant("radius", self.radius, positive=True)
        offset = scope.constant("offset", self.offset)
        # Both rows run from the disc to the line, so that their multipliers push the disc along normal and axis.
        roll = Sum(((ONE, Component(centre, line, along)), (radius, Angle(disc, base))))
        height = Holonomic("normal", Component(centre, line, normal), call("neg", radius))
        rows = (height, Holonomic("roll", roll, call("neg", offset)))
        return Joint(scope.name, scope.kind, (disc, base), rows, (("displacement", Component(line, centre, along)),))


KIND = Rolling
