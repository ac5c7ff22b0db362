"""Rolling disc: a thin disc rolls on a plane, without slip or on a contact that gives way."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.expressions import Expr, Reading, call, literal_of, product, sum_of_terms
from symgen.base.vocabulary.measures import Direction, Dot, FormulaSpeed, Holonomic, Speed, Sum
from symgen.describe.joints._giving import SlipFriction
from symgen.describe.joints._rolling import Contact, RollingContact
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis, Scalar
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triad


class DiscFriction(SlipFriction, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Friction of a disc that gives way.

    Parameters
    ----------
    direction : scalar
        The one direction in which it acts, as rollers on the rim leave slip across it free: an angle in the plane from
        where the disc rolls as it turns forwards about its axis, towards that axis [rad].
    """

    direction: Scalar | None = None


class RollingDisc(RollingContact, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A thin disc that rolls on a plane of the ground or of a body, leaning as it likes. In space only.

    It is singular where it lies flat.

    Parameters
    ----------
    axis : direction
        The disc's axis of symmetry in the body's frame; its length does not matter.

    Notes
    -----
    Three rows. Multiplier ``NAME.normal`` [N]: the force with which the plane pushes the disc away (negative where it
    would have to pull: contact is not released). ``NAME.slip1``, ``.slip2`` [N]: friction on the disc along two
    directions in the plane; these two rows are nonholonomic [m/s].

    With `stiffness` there are forces in their place, of the same names, and the joint reports ``NAME.gap`` [m].
    Friction has a direction { coefficient, speed, direction } where the rim has rollers; its force is then
    ``NAME.slip`` [N].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    axis: Axis
    friction: DiscFriction | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height of the rim's lowest point and two velocities of the point of contact."""
        contact = self.contact(scope)
        rim, _ = contact.height
        # downwards, so that a positive multiplier pushes the disc along the normal
        return self.joint_of(scope, contact, Holonomic("normal", Sum(((literal_of(-1.0), rim),))))

    def axis_of(self, scope: Scope, body: str) -> Direction:
        """Return the axis of symmetry."""
        return make_triad(scope, body, self.axis).axis

    def slips(self, scope: Scope, contact: Contact) -> list[tuple[str, Speed]]:
        """Return two slips along the plane's directions, or the one that rollers leave."""
        both = super().slips(scope, contact)
        if self.friction is None or self.friction.direction is None:
            return both
        return [("slip", _slip_beside_rollers(scope, contact, self.friction.direction, both))]


def _slip_beside_rollers(
    scope: Scope, contact: Contact, direction: float | str, slips: list[tuple[str, Speed]]
) -> FormulaSpeed:
    """Return the slip along a direction that turns with the heading of the disc.

    In the directions e of the plane a disc with the axis k rolls along ``(k . e2, -k . e1)`` as it turns forwards, and
    its axis points along ``(k . e1, k . e2)``, both as long as the sine of the angle of axis and normal.
    """
    angle = scope.constant("friction.direction", direction)
    axis, (first, second) = contact.axis, (contact.plane.first, contact.plane.second)
    assert axis is not None, "a disc has an axis"
    along = [Reading(f"axis{i + 1}", Dot(e, axis)) for i, e in enumerate((first, second))]
    length = call("sqrt", sum_of_terms(*(call("pow", e, literal_of(2.0)) for e in along)))
    cosine, sine = call("cos", angle), call("sin", angle)
    parts: tuple[Expr, Expr] = (
        sum_of_terms(product(cosine, along[1]), product(sine, along[0])),
        sum_of_terms(product(sine, along[1]), call("neg", product(cosine, along[0]))),
    )
    rates = (Reading(f"{label}.rate", slip, 1) for label, slip in slips)
    return FormulaSpeed(call("div", sum_of_terms(*map(product, parts, rates)), length))


KIND = RollingDisc
