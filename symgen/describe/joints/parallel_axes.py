"""Parallel axes: an axis of one body stays parallel to an axis of the other."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.joints._space import angle_about_axis, frames_of_joint, rows_of_parallel_axes
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import AxisPair, BodyPair, DirectionPair
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads


class ParallelAxes(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two bodies turn against each other about one direction only; their points move freely. In space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    axis : direction, or pair of directions
        The axis in the first body's frame, or one in the frame of each body.
    reference : pair of directions
        Directions across the axis that coincide at angle 0; as the bodies start by default.

    Notes
    -----
    Two rows, ``NAME.first`` and ``.second`` [N m]: torques on the first body across the axis. Reports ``NAME.angle``.
    """

    frames = staticmethod(frames_of_joint)
    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    between: BodyPair
    axis: AxisPair
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to two products of directions."""
        bodies = scope.pair("between", self.between, turns=(True, True))
        triads = make_triads(scope, bodies, self.axis, self.reference)
        return Joint(
            scope.name, scope.kind, bodies, rows_of_parallel_axes(*triads), (("angle", angle_about_axis(*triads)),)
        )


KIND = ParallelAxes
