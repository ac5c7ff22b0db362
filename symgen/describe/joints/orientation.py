"""Orientation: two bodies do not turn against each other, wherever they move."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.vocabulary.measures import Angle, Holonomic
from symgen.describe.joints._space import frames_of_joint, row_against_turning, rows_of_parallel_axes
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import AxisPair, BodyPair, DirectionPair, Scalar
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads


class FixedOrientation(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two bodies keep their orientation to each other; their points move freely.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    angle : scalar
        In the plane: angle of the second body relative to the first [rad]; 0 by default.
    axis, reference : direction, or pairs of directions
        In space: two directions of each body that coincide, the second across the first; as the bodies start unless
        given.

    Notes
    -----
    In the plane one row, ``NAME.angle`` [N m]: torque on the first body. In space three, ``NAME.first``, ``.second``
    and ``.angle``, as of a rigid joint.
    """

    frames = staticmethod(frames_of_joint)
    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair
    angle: Scalar | None = None
    axis: AxisPair | None = None
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the angle, in space to three products of directions."""
        bodies = scope.pair("between", self.between, turns=(True, True))
        if scope.spatial:
            scope.only(angle=self.angle)
            triads = make_triads(scope, bodies, self.axis or (0.0, 0.0, 1.0), self.reference, fixed=True)
            return Joint(
                scope.name, scope.kind, bodies, (*rows_of_parallel_axes(*triads), row_against_turning(*triads))
            )
        scope.only(axis=self.axis, reference=self.reference)
        held = Holonomic("angle", Angle(*bodies), scope.constant("angle", self.angle or 0.0), "rad")
        return Joint(scope.name, scope.kind, bodies, (held,))


KIND = FixedOrientation
