"""Perpendicular: an axis of one body stays perpendicular to an axis of the other."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.vocabulary.measures import Dot, Holonomic
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import BodyPair, DirectionPair
from symgen.describe.parts.scope import Scope


class Perpendicular(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two axes keep a right angle; points and all other turns are free. In space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    axes : pair of directions
        The first body's axis in the first body's frame, and the second body's in the second's.

    Notes
    -----
    One row, ``NAME.cross`` [N m]: torque on the first body about second axis x first axis, as in a universal joint.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    between: BodyPair
    axes: DirectionPair

    def build(self, scope: Scope) -> Joint:
        """Resolve to the product of the two axes."""
        bodies = scope.pair("between", self.between, turns=(True, True))
        u, v = (scope.direction("axes", body, axis) for body, axis in zip(bodies, self.axes, strict=True))
        return Joint(scope.name, scope.kind, bodies, (Holonomic("cross", Dot(u, v), unit="rad"),))


KIND = Perpendicular
