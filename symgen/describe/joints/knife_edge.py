"""Knife edge: a point of a body moves only along a direction fixed in it, as a skate does."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.vocabulary.expressions import call
from symgen.base.vocabulary.measures import (
    GROUND,
    BladeSpeed,
    Component,
    Direction,
    Holonomic,
    Marker,
    Nonholonomic,
    PointSpeed,
)
from symgen.describe.joints._space import opposite, plane_of_body
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis, BodyName, Point
from symgen.describe.parts.scope import CENTRE, Scope
from symgen.describe.parts.triads import make_triad


class KnifeEdge(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A blade or a wheel that does not slip sideways: a condition on the velocity that no position fulfils.

    Parameters
    ----------
    body : body name
        The body with the blade.
    at : point
        Where the blade touches; the centre of mass by default.
    axis : direction
        Of the blade, in the body's frame; its length does not matter.
    normal : direction
        In space: normal of the plane of the ground that the blade stands on, in the ground frame; its length does not
        matter.
    on : point
        In space: a point of that plane; the origin by default.

    Notes
    -----
    In the plane one nonholonomic row [m/s]. Multiplier ``NAME.normal`` [N]: force on the body along the axis turned
    left by 90 degrees.

    In space two rows: the point of contact stays on the plane, and moves along the blade as seen along the normal,
    however the body leans. Multiplier ``NAME.normal`` [N]: force of the plane on the body along the normal (contact is
    not released); ``NAME.side`` [N]: force on the body to the left of the blade in the plane, nonholonomic [m/s].
    Singular where the blade stands on end.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    body: BodyName
    axis: Axis
    at: Point = CENTRE
    normal: Axis | None = None
    on: Point | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the velocity across the blade, in space also to the height of the point of contact."""
        body = scope.body("body", self.body, turns=True, ground=False)
        point = scope.marker("at", body, self.at)
        if scope.spatial:
            return self._rows_on_plane(scope, body, point)
        scope.only(normal=self.normal, on=self.on)
        _, left = scope.axis("axis", body, self.axis)
        # To the right, so that the force on the body, -D^T lambda, points to the left.
        right = Direction(body, (call("neg", left.vector[0]), call("neg", left.vector[1])))
        return Joint(scope.name, scope.kind, (body,), (Nonholonomic("normal", PointSpeed(point, right)),))

    def _rows_on_plane(self, scope: Scope, body: str, point: Marker) -> Joint:
        scope.only("normal", normal=self.normal)
        origin, plane = plane_of_body(scope, GROUND, self.on or (0.0, 0.0, 0.0), self.normal or (), None)
        backward = opposite(make_triad(scope, body, self.axis).axis)
        rows = (
            Holonomic("normal", Component(point, origin, plane.axis)),
            Nonholonomic("side", BladeSpeed(point, plane.axis, backward)),  # to the right, as in the plane
        )
        return Joint(scope.name, scope.kind, (body,), rows)


KIND = KnifeEdge
