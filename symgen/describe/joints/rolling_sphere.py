"""Rolling sphere: it rolls without slip on a plane of the ground."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.expressions import call
from symgen.base.vocabulary.measures import Component, Holonomic
from symgen.describe.joints._rolling import RollingContact
from symgen.describe.mechanism import Joint
from symgen.describe.parts.scope import Scope


class RollingSphere(RollingContact, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A sphere that rolls on a plane of the ground; it may spin about the normal. In space only.

    Notes
    -----
    Three rows, with the multipliers of a rolling disc: ``NAME.normal`` [N], the push of the plane, and ``NAME.slip1``,
    ``.slip2`` [N], friction on the sphere.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height of the centre and two velocities of the point of contact."""
        contact = self.contact(scope)
        # from the sphere to the plane, so that a positive multiplier pushes the sphere along the normal
        height = Component(contact.centre, contact.origin, contact.plane.axis)
        return contact.joint(scope, Holonomic("normal", height, call("neg", contact.radius)))


KIND = RollingSphere
