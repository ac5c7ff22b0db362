"""Rolling sphere: it rolls on a plane, without slip or on a contact that gives way."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.expressions import call
from symgen.base.vocabulary.measures import Component, Holonomic
from symgen.describe.joints._rolling import RollingContact
from symgen.describe.mechanism import Joint
from symgen.describe.parts.scope import Scope


class RollingSphere(RollingContact, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A sphere that rolls on a plane of the ground or of a body; it may spin about the normal. In space only.

    Notes
    -----
    Rows and forces have the labels of a rolling disc: ``NAME.normal`` [N], the push of the plane, and ``NAME.slip1``,
    ``.slip2`` [N], friction on the sphere. With `stiffness` they are forces, and the joint reports ``NAME.gap`` [m].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height of the centre and two velocities of the point of contact."""
        contact = self.contact(scope)
        # from the sphere to the plane, so that a positive multiplier pushes the sphere along the normal
        height = Component(contact.centre, contact.origin, contact.plane.axis)
        return self.joint_of(scope, contact, Holonomic("normal", height, call("neg", contact.radius)))


KIND = RollingSphere
