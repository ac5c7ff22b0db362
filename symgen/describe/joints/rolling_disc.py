"""Rolling disc: a thin disc rolls without slip on a plane of the ground."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.expressions import literal_of
from symgen.base.vocabulary.measures import Holonomic, RimHeight, Sum
from symgen.describe.joints._rolling import RollingContact
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triad


class RollingDisc(RollingContact, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A thin disc that rolls on a plane of the ground, leaning as it likes; singular where it lies flat. In space only.

    Parameters
    ----------
    axis : direction
        The disc's axis of symmetry in the body's frame; its length does not matter.

    Notes
    -----
    Three rows. Multiplier ``NAME.normal`` [N]: the force with which the plane pushes the disc away (negative where it
    would have to pull: contact is not released). ``NAME.slip1``, ``.slip2`` [N]: friction on the disc along two
    directions in the plane; these two rows are nonholonomic [m/s].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    axis: Axis

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height of the rim's lowest point and two velocities of the point of contact."""
        contact = self.contact(scope)
        axis = make_triad(scope, contact.body, self.axis).axis
        # downwards, so that a positive multiplier pushes the disc along the normal
        rim = RimHeight(contact.origin, contact.plane.axis, contact.centre, axis, contact.radius)
        return contact.joint(scope, Holonomic("normal", Sum(((literal_of(-1.0), rim),))), axis)


KIND = RollingDisc
