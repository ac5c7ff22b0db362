"""Rolling disc: a thin disc rolls without slip on a plane of the ground."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import Axis, BodyName, Point, Scalar
from symgen.describe.mechanism import Joint
from symgen.describe.scope import CENTRE, Scope
from symgen.joints._space import plane_of_ground
from symgen.vocabulary.expressions import number
from symgen.vocabulary.measures import Holonomic, Nonholonomic, RimHeight, RollingSpeed, Sum


class RollingDisc(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A thin disc that rolls on a plane of the ground, leaning as it likes; singular where it lies flat. In space only.

    Parameters
    ----------
    body : body name
        The disc.
    radius : scalar
        Of the disc [m], above 0.
    axis : direction
        The disc's axis of symmetry in the body's frame; its length does not matter.
    centre : point
        Of the disc; the body's centre of mass by default.
    normal : direction
        Normal of the plane in the ground frame, towards the disc; its length does not matter.
    on : point
        A point of the plane, in the ground frame; the origin by default.
    reference : direction
        First direction in the plane; any across the normal by default.

    Notes
    -----
    Three rows. Multiplier ``NAME.normal`` [N]: the force with which the plane pushes the disc away (negative where it
    would have to pull: contact is not released). ``NAME.slip1``, ``.slip2`` [N]: friction on the disc along two
    directions in the plane; these two rows are nonholonomic [m/s].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    body: BodyName
    radius: Scalar
    axis: Axis
    normal: Axis
    centre: Point = CENTRE
    on: Point = (0.0, 0.0, 0.0)
    reference: Axis | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the height of the rim's lowest point and two velocities of the point of contact."""
        body = scope.body("body", self.body, turns=True, ground=False)
        centre, radius = scope.marker("centre", body, self.centre), scope.constant("radius", self.radius, positive=True)
        axis = scope.triad(body, self.axis).axis
        origin, plane, backward = plane_of_ground(scope, self.on, self.normal, self.reference)
        slips = tuple(
            Nonholonomic(f"slip{i + 1}", RollingSpeed(centre, along, plane.axis, radius, axis))
            for i, along in enumerate(backward)
        )
        # downwards, so that a positive multiplier pushes the disc along the normal
        height = Sum(((number(-1.0), RimHeight(origin, plane.axis, centre, axis, radius)),))
        return Joint(scope.name, scope.kind, (body,), (Holonomic("normal", height), *slips))


KIND = RollingDisc
