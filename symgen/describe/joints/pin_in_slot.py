"""Pin in slot: a point of one body moves along a straight line fixed in the other."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Angle, Component, Holonomic
from symgen.describe.joints._paired import Paired
from symgen.describe.joints._space import rows_of_point_on_axis
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triad


class PinInSlot(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
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

    axis: Axis

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance of the pin from the centre line, in space to two."""
        (a, b), (pin, slot) = self.ends(scope, turns=(False, True))
        if scope.spatial:
            triad = make_triad(scope, b, self.axis)
            displacement = Component(slot, pin, triad.axis)
            rows = rows_of_point_on_axis(pin, slot, triad)
            return Joint(scope.name, scope.kind, (a, b), rows, (("displacement", displacement),))
        along, normal = scope.axis("axis", b, self.axis)
        angle = (("angle", Angle(a, b)),) if scope.turns(a) else ()
        rows = (Holonomic("normal", Component(pin, slot, normal)),)
        return Joint(scope.name, scope.kind, (a, b), rows, (("displacement", Component(slot, pin, along)), *angle))


KIND = PinInSlot
