"""Screw joint: a nut on a thread."""

from __future__ import annotations

import math
from typing import ClassVar

import msgspec

from symgen.describe.fields import AxisPair, BodyPair, DirectionPair, PointPair, Scalar
from symgen.describe.mechanism import Articulation, Joint
from symgen.describe.scope import Scope
from symgen.joints._space import angle, frames, markers, on_axis, parallel
from symgen.vocabulary.expressions import ONE, call, number
from symgen.vocabulary.measures import Component, Holonomic, Sum


class Screw(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The second body turns about an axis of the first and moves along it by a pitch a turn; in space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        A point of each body; both lie on the axis.
    axis : direction, or pair of directions
        The axis in the first body's frame, or in the frame of each body.
    pitch : scalar
        Displacement along the axis a turn [m]; a left-handed thread has a negative one.
    offset : scalar
        Displacement at angle 0 [m]; 0 by default.
    reference : pair of directions
        Directions across the axis that coincide at angle 0; as the bodies start by default.

    Notes
    -----
    Five rows: displacement = pitch angle / (2 pi) + offset, and those of a cylindrical joint, with its multipliers and
    reported ``NAME.displacement`` and ``NAME.angle``. ``NAME.screw`` [N]: the thread's force on the first body along
    the axis; its torque on it about the axis is -pitch / (2 pi) times that.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    between: BodyPair
    at: PointPair
    axis: AxisPair
    pitch: Scalar
    offset: Scalar = 0.0
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the rows of a cylindrical joint and one that ties its two coordinates together."""
        a, b = scope.pair("between", self.between, turns=(True, True))
        point_a, point_b = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        triad_a, triad_b = scope.triads((a, b), self.axis, self.reference)
        displacement, turn = Component(point_a, point_b, triad_a.axis), angle(triad_a, triad_b)
        slope = call("div", scope.constant("pitch", self.pitch), number(-2.0 * math.pi))
        thread = Holonomic("screw", Sum(((ONE, displacement), (slope, turn))), scope.constant("offset", self.offset))
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(*on_axis(point_a, point_b, triad_a), *parallel(triad_a, triad_b), thread),
            coordinates=(("displacement", displacement), ("angle", turn)),
        )

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        thread = joint.rows[-1]
        assert isinstance(thread, Holonomic) and isinstance(thread.measure, Sum), "a thread ties two coordinates"
        slope = call("neg", thread.measure.terms[1][0])
        return Articulation(*markers(joint), "axis", (), *frames(joint), screw=(slope, thread.value))


KIND = Screw
