"""Keys, rows and forces shared by bodies that roll on a plane."""

from __future__ import annotations

from typing import NamedTuple

from symgen.base.vocabulary.expressions import ZERO, Expr
from symgen.base.vocabulary.measures import (
    GROUND,
    Component,
    Direction,
    Holonomic,
    Marker,
    Measure,
    Nonholonomic,
    RimHeight,
    RollingSpeed,
    Speed,
)
from symgen.describe.joints._giving import GivingContact, gap_of, refuse_damping
from symgen.describe.joints._space import opposite, plane_of_body
from symgen.describe.mechanism import Force, Joint
from symgen.describe.parts.fields import Axis, BodyName, BodyPair, Point, Scalar
from symgen.describe.parts.scope import CENTRE, Scope
from symgen.describe.parts.triads import Triad


class Contact(NamedTuple):
    """A rolling body and its plane.

    Attributes
    ----------
    bodies : tuple of str
        What rolls, then the body with the plane unless that is the ground.
    centre, radius, axis : Marker, Expr, Direction or None
        Of what rolls; a sphere has no axis.
    origin, plane : Marker, Triad
        A point of the plane, and a triad about its normal.
    """

    bodies: tuple[str, ...]
    centre: Marker
    radius: Expr
    axis: Direction | None
    origin: Marker
    plane: Triad

    @property
    def height(self) -> tuple[Measure, Expr]:
        """The height over the plane, and what it is where the body touches."""
        if self.axis is None:
            return Component(self.origin, self.centre, self.plane.axis), self.radius
        return RimHeight(self.origin, self.plane.axis, self.centre, self.axis, self.radius), ZERO

    def slip_along(self, direction: Direction) -> RollingSpeed:
        """Return the velocity of the point that touches, along a direction of the plane."""
        return RollingSpeed(self.centre, direction, self.plane.axis, self.radius, self.axis)

    def held(self, scope: Scope, height: Holonomic) -> Joint:
        """Return the joint without slip: the row of a height, and two of velocities of the point that touches."""
        backward = map(opposite, (self.plane.first, self.plane.second))
        slips = (Nonholonomic(f"slip{i + 1}", self.slip_along(along)) for i, along in enumerate(backward))
        return Joint(scope.name, scope.kind, self.bodies, (height, *slips))


class RollingContact(GivingContact, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A round body on a plane.

    Parameters
    ----------
    body : body name
        What rolls on a plane of the ground.
    between : pair of body names
        In place of `body`: what rolls, and the body with the plane, to which `normal`, `on` and `reference` belong.
    radius : scalar
        Its radius [m], above 0.
    centre : point
        Its centre; the body's centre of mass by default.
    normal : direction
        Normal of the plane, towards what rolls; its length does not matter.
    on : point
        A point of the plane; the origin by default.
    reference : direction
        First direction in the plane; any across the normal by default.
    """

    body: BodyName | None = None
    between: BodyPair | None = None
    radius: Scalar
    normal: Axis
    centre: Point = CENTRE
    on: Point = (0.0, 0.0, 0.0)
    reference: Axis | None = None

    def contact(self, scope: Scope) -> Contact:
        """Return the rolling body and its plane."""
        if (self.body is None) == (self.between is None):
            raise scope.error("", "either the key body or the key between", "neither" if self.body is None else "both")
        if self.between is None:
            body, base = scope.body("body", self.body or "", turns=True, ground=False), GROUND
        else:
            body, base = scope.pair("between", self.between, turns=(True, True))
            if body == GROUND:
                raise scope.error("between", "what rolls and then the body with the plane", f"'{GROUND}' first")
        centre, radius = scope.marker("centre", body, self.centre), scope.constant("radius", self.radius, positive=True)
        origin, plane = plane_of_body(scope, base, self.on, self.normal, self.reference)
        bodies = (body,) if base == GROUND else (body, base)
        return Contact(bodies, centre, radius, self.axis_of(scope, body), origin, plane)

    def axis_of(self, scope: Scope, body: str) -> Direction | None:
        """Return the axis of what rolls, None of a sphere."""
        return None

    def joint_of(self, scope: Scope, contact: Contact, height: Holonomic) -> Joint:
        """Return the joint without slip, or without rows where the contact gives way."""
        refuse_damping(scope, self.stiffness, self.damping)
        if self.stiffness is None:
            return contact.held(scope, height)
        return Joint(scope.name, scope.kind, contact.bodies, (), (gap_of(*contact.height),))

    def give(self, scope: Scope) -> Force | None:
        """Return the force in place of rows, None where there are rows."""
        if self.stiffness is None:
            return None
        contact = self.contact(scope)
        return self.force_of_contact(scope, contact.bodies, *contact.height, self.slips(scope, contact))

    def slips(self, scope: Scope, contact: Contact) -> list[tuple[str, Speed]]:
        """Return the slips that friction acts against, with their labels."""
        along = contact.plane.first, contact.plane.second
        return [(f"slip{i + 1}", contact.slip_along(direction)) for i, direction in enumerate(along)]
