"""Rolling sphere: it rolls without slip on a plane of the ground."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import Axis, BodyName, Point, Scalar
from symgen.describe.mechanism import Joint
from symgen.describe.scope import CENTRE, Scope
from symgen.joints._space import plane_of_ground
from symgen.vocabulary.expressions import call
from symgen.vocabulary.measures import Component, Holonomic, Nonholonomic, RollingSpeed


class RollingSphere(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A sphere that rolls on a plane of the ground; it may spin about the normal. In space only.

    Parameters
    ----------
    body : body name
        The sphere.
    radius : scalar
        Of the sphere [m], above 0.
    centre : point
        Of the sphere; the body's centre of mass by default.
    normal : direction
        Normal of the plane in the ground frame, towards the sphere; its length does not matter.
    on : point
        A point of the plane, in the ground frame; the origin by default.
    reference : direction
        First direction in the plane; any across the normal by default.

    Notes
    -----
    Three rows. Multiplier ``NAME.normal`` [N]: the force with which the plane pushes the sphere away (negative where it
    would have to pull: contact is not released). ``NAME.slip1``, ``.slip2`` [N]: friction on the sphere along two
    directions in the plane; these two rows are nonholonomic [m/s].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    body: BodyName
    radius: Scalar
    normal: Axis
    centre: Point = CENTRE
    on: Point = (0.0, 0.0, 0.0)
    reference: Axis | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height of the centre and two velocities of the point of contact."""
        body = scope.body("body", self.body, turns=True, ground=False)
        centre, radius = scope.marker("centre", body, self.centre), scope.constant("radius", self.radius, positive=True)
        origin, plane, backward = plane_of_ground(scope, self.on, self.normal, self.reference)
        slips = tuple(
            Nonholonomic(f"slip{i + 1}", RollingSpeed(centre, along, plane.axis, radius))
            for i, along in enumerate(backward)
        )
        # from the sphere to the plane, so that a positive multiplier pushes the sphere along the normal
        height = Holonomic("normal", Component(centre, origin, plane.axis), call("neg", radius))
        return Joint(scope.name, scope.kind, (body,), (height, *slips))


KIND = RollingSphere
