"""Rolling: a disc rolls on a straight line fixed in another body, without slip or on a contact that gives way."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.expressions import ONE, call
from symgen.base.vocabulary.measures import Angle, Component, Direction, Holonomic, Marker, Sum
from symgen.describe.joints._giving import GivingContact, gap_of, refuse_damping
from symgen.describe.mechanism import Force, Joint
from symgen.describe.parts.fields import Axis, BodyPair, Point, Scalar, value_in_words
from symgen.describe.parts.scope import CENTRE, Scope


class Rolling(GivingContact, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A disc of the first body on a line of the second: it keeps its height and does not slip, or gives way.

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

    With `stiffness` there are forces in their place, of the same names, and the joint reports ``NAME.gap`` [m] too.
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
        centre, line, along, normal = self._disc_on_line(scope, disc, base)
        displacement = ("displacement", Component(line, centre, along))
        radius = scope.constant("radius", self.radius, positive=True)
        refuse_damping(scope, self.stiffness, self.damping)
        if self.stiffness is not None:
            if self.offset != 0.0:
                raise scope.error(
                    "offset", "no such key beside stiffness, as the disc slips", value_in_words(self.offset)
                )
            gap = gap_of(Component(line, centre, normal), radius)
            return Joint(scope.name, scope.kind, (disc, base), (), (displacement, gap))
        offset = scope.constant("offset", self.offset)
        # Both rows run from the disc to the line, so that their multipliers push the disc along normal and axis.
        roll = Sum(((ONE, Component(centre, line, along)), (radius, Angle(disc, base))))
        height = Holonomic("normal", Component(centre, line, normal), call("neg", radius))
        rows = (height, Holonomic("roll", roll, call("neg", offset)))
        return Joint(scope.name, scope.kind, (disc, base), rows, (displacement,))

    def _disc_on_line(self, scope: Scope, disc: str, base: str) -> tuple[Marker, Marker, Direction, Direction]:
        """Return the centre of the disc, a point of the line, its direction and its normal."""
        centre, line = scope.marker("centre", disc, self.centre), scope.marker("on", base, self.on)
        return centre, line, *scope.axis("axis", base, self.axis)

    def give(self, scope: Scope) -> Force | None:
        """Return the force in place of rows, None where there are rows."""
        if self.stiffness is None:
            return None
        disc, base = scope.pair("between", self.between, turns=(True, True))
        centre, line, along, normal = self._disc_on_line(scope, disc, base)
        radius = scope.constant("radius", self.radius, positive=True)
        slip = Sum(((ONE, Component(line, centre, along)), (radius, Angle(base, disc))))
        height = Component(line, centre, normal)
        return self.force_of_contact(scope, (disc, base), height, radius, [("roll", slip)])


KIND = Rolling
