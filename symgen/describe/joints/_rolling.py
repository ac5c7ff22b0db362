"""Keys and rows shared by bodies that roll without slip on a plane of the ground."""

from __future__ import annotations

from typing import NamedTuple

import msgspec

from symgen.base.vocabulary.expressions import Expr
from symgen.base.vocabulary.measures import Direction, Holonomic, Marker, Nonholonomic, RollingSpeed
from symgen.describe.joints._space import plane_of_ground
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis, BodyName, Point, Scalar
from symgen.describe.parts.scope import CENTRE, Scope
from symgen.describe.parts.triads import Triad


class Contact(NamedTuple):
    """A rolling body and its plane.

    Attributes
    ----------
    body, centre, radius : str, Marker, Expr
        What rolls.
    origin, plane : Marker, Triad
        A point of the plane, and a triad about its normal.
    backward : pair of Direction
        The opposites of the plane's directions, see `symgen.describe.joints._space.plane_of_ground`.
    """

    body: str
    centre: Marker
    radius: Expr
    origin: Marker
    plane: Triad
    backward: tuple[Direction, Direction]

    def joint(self, scope: Scope, height: Holonomic, axis: Direction | None = None) -> Joint:
        """Return the joint: the row of a height over the plane, and two of velocities of the point of contact."""
        slips = tuple(
            Nonholonomic(f"slip{i + 1}", RollingSpeed(self.centre, along, self.plane.axis, self.radius, axis))
            for i, along in enumerate(self.backward)
        )
        return Joint(scope.name, scope.kind, (self.body,), (height, *slips))


class RollingContact(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A round body on a plane of the ground.

    Parameters
    ----------
    body : body name
        What rolls.
    radius : scalar
        Its radius [m], above 0.
    centre : point
        Its centre; the body's centre of mass by default.
    normal : direction
        Normal of the plane in the ground frame, towards the body; its length does not matter.
    on : point
        A point of the plane, in the ground frame; the origin by default.
    reference : direction
        First direction in the plane; any across the normal by default.
    """

    body: BodyName
    radius: Scalar
    normal: Axis
    centre: Point = CENTRE
    on: Point = (0.0, 0.0, 0.0)
    reference: Axis | None = None

    def contact(self, scope: Scope) -> Contact:
        """Return the rolling body and its plane."""
        body = scope.body("body", self.body, turns=True, ground=False)
        centre, radius = scope.marker("centre", body, self.centre), scope.constant("radius", self.radius, positive=True)
        return Contact(body, centre, radius, *plane_of_ground(scope, self.on, self.normal, self.reference))
