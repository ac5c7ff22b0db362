"""Knife edge: a point of a body moves only along a direction fixed in it, as a skate does."""

from __future__ import annotations

import msgspec

from symgen.describe.fields import Axis, BodyName, Point
from symgen.describe.mechanism import Joint
from symgen.describe.scope import CENTRE, Scope
from symgen.vocabulary.expressions import call
from symgen.vocabulary.measures import Direction, Nonholonomic


class KnifeEdge(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A blade or a wheel that does not slip sideways: a condition on the velocity that no position fulfils.

    Parameters
    ----------
    body : body name
        The body with the blade.
    at : point
        Where the blade touches; the centre of mass unless given.
    axis : pair
        Direction of the blade in the body's frame; its length does not matter.

    Notes
    -----
    One nonholonomic row [m/s]. Multiplier ``NAME.normal`` [N]: force on the body along the axis turned left by 90
    degrees.
    """

    body: BodyName
    axis: Axis
    at: Point = CENTRE

    def build(self, scope: Scope) -> Joint:
        """Resolve to the velocity across the blade."""
        body = scope.body("body", self.body, turns=True, ground=False)
        point = scope.marker("at", body, self.at)
        _, left = scope.axis("axis", body, self.axis)
        # To the right, so that the force on the body, -D^T lambda, points to the left.
        right = Direction(body, (call("neg", left.vector[0]), call("neg", left.vector[1])))
        return Joint(scope.name, scope.kind, (body,), (Nonholonomic("normal", point, right),))


KIND = KnifeEdge
