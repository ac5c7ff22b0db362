"""Pin in slot: a point of one body moves along a straight line fixed in the other."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import Axis, BodyPair, PointPair
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.describe.triads import make_triad
from symgen.joints._space import on_axis
from symgen.vocabulary.measures import Angle, Component, Holonomic


class PinInSlot(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A pin of the first body in a straight slot of the second; both may turn.

    Parameters
    ----------
    between : pair of body names
        The body with the pin, which may be a point mass, and the body with the slot.
    at : pair of points
        The pin, and a point on the slot's centre line.
    axis : direction
        Of the slot, in the frame of the second body; its length does not matter.

    Notes
    -----
    In the plane one row [m]. Multiplier ``NAME.normal`` [N]: force on the pin along the axis turned left by 90
    degrees. Reports ``NAME.displacement``, of the pin along the axis [m], and, where both bodies have one,
    ``NAME.angle`` [rad].

    In space two rows [m], ``NAME.across1`` and ``.across2`` [N]: forces on the pin across the slot.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair
    at: PointPair
    axis: Axis

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance of the pin from the centre line, in space to two."""
        a, b = scope.pair("between", self.between, turns=(False, True))
        pin, slot = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        if scope.spatial:
            triad = make_triad(scope, b, self.axis)
            displacement = Component(slot, pin, triad.axis)
            rows = on_axis(pin, slot, triad)
            return Joint(scope.name, scope.kind, (a, b), rows, (("displacement", displacement),))
        along, normal = scope.axis("axis", b, self.axis)
        angle = (("angle", Angle(a, b)),) if scope.turns(a) else ()
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(Holonomic("normal", Component(pin, slot, normal)),),
            coordinates=(("displacement", Component(slot, pin, along)), *angle),
        )


KIND = PinInSlot
