"""Screw joint: a nut on a thread."""

from __future__ import annotations

import math
from typing import ClassVar

from symgen.base.vocabulary.expressions import ONE, call, literal_of
from symgen.base.vocabulary.measures import Component, Holonomic, Sum
from symgen.describe.joints._paired import Axial
from symgen.describe.joints._space import (
    angle_about_axis,
    frames_of_joint,
    markers_of_joint,
    rows_of_parallel_axes,
    rows_of_point_on_axis,
)
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Efficiency, Scalar
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads
from symgen.describe.spanning_tree import Articulation


class Screw(Axial, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The second body turns about an axis of the first and moves along it by a pitch a turn; in space only.

    Parameters
    ----------
    pitch : scalar
        Displacement along the axis a turn [m]; a left-handed thread has a negative one.
    offset : scalar
        Displacement at angle 0 [m]; 0 by default.
    efficiency : scalar or pair
        Part of a power that the thread passes on, or two: forwards from turning to moving along, and backwards, of 0 or
        less where a load along the axis cannot drive; no loss by default.

    Notes
    -----
    Five rows: displacement = pitch angle / (2 pi) + offset, and those of a cylindrical joint, with its multipliers and
    reported ``NAME.displacement`` and ``NAME.angle``. ``NAME.screw`` [N]: the thread's force on the first body along
    the axis; its torque on it about the axis is -pitch / (2 pi) times that.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    pitch: Scalar
    offset: Scalar = 0.0
    efficiency: Efficiency | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the rows of a cylindrical joint and one that ties its two coordinates together."""
        bodies, points = self.ends(scope)
        triads = make_triads(scope, bodies, self.axis, self.reference)
        displacement, turn = Component(*points, triads[0].axis), angle_about_axis(*triads)
        slope = call("div", scope.constant("pitch", self.pitch), literal_of(-2.0 * math.pi))
        thread = Holonomic("screw", Sum(((ONE, displacement), (slope, turn))), scope.constant("offset", self.offset))
        rows = (*rows_of_point_on_axis(*points, triads[0]), *rows_of_parallel_axes(*triads), thread)
        return Joint(scope.name, scope.kind, bodies, rows, (("displacement", displacement), ("angle", turn)))

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        thread = joint.rows[-1]
        assert isinstance(thread, Holonomic) and isinstance(thread.measure, Sum), "a thread ties two coordinates"
        slope = call("neg", thread.measure.terms[1][0])
        return Articulation(*markers_of_joint(joint), "axis", (), *frames_of_joint(joint), screw=(slope, thread.value))


KIND = Screw
