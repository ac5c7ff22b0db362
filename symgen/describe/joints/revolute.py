"""Revolute joint: two points coincide; in space two axes do."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Angle
from symgen.describe.joints._paired import Paired
from symgen.describe.joints._space import (
    angle_about_axis,
    frames_of_joint,
    markers_of_joint,
    rows_of_coincident_points,
    rows_of_parallel_axes,
)
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import AxisPair, DirectionPair
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads
from symgen.describe.spanning_tree import Articulation


class Revolute(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A pin that holds a point of one body on a point of the other; in space it has an axis.

    Parameters
    ----------
    between : pair of body names
        The two bodies; in the plane a point mass may be one of them.
    at : pair of points
        The pin, as a point of the first and of the second body.
    axis : direction, or pair of directions
        In space: the axis in the first body's frame, or in the frame of each body.
    reference : pair of directions
        In space: directions across the axis that coincide at angle 0; as the bodies start by default.

    Notes
    -----
    Two rows [m]. Multipliers ``NAME.x``, ``NAME.y`` [N]: the force of the pin on the first body, in ground axes.
    Reports ``NAME.angle``, the second body's angle less the first's [rad].

    In space five rows: ``NAME.x``, ``.y``, ``.z`` [N], and ``NAME.first``, ``.second`` [N m], torques on the first body
    about two directions across the axis. Reports ``NAME.angle`` about the axis, turns counted.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    axis: AxisPair | None = None
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the components of the vector between the points, and in space to two angles."""
        if scope.spatial:
            return self._build_in_space(scope)
        scope.only(axis=self.axis, reference=self.reference)
        (a, b), pins = self.ends(scope, turns=(False, False))
        coordinates = (("angle", Angle(a, b)),) if scope.turns(a) and scope.turns(b) else ()
        return Joint(scope.name, scope.kind, (a, b), rows_of_coincident_points(*pins), coordinates)

    def _build_in_space(self, scope: Scope) -> Joint:
        if self.axis is None:
            raise scope.error("axis", "an axis, as a revolute joint in space has one", "no such key")
        bodies, pins = self.ends(scope)
        triads = make_triads(scope, bodies, self.axis, self.reference)
        rows = (*rows_of_coincident_points(*pins), *rows_of_parallel_axes(*triads))
        return Joint(scope.name, scope.kind, bodies, rows, (("angle", angle_about_axis(*triads)),))

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        if len(joint.rows) < 5:
            return Articulation(*markers_of_joint(joint), turn="axis")
        return Articulation(*markers_of_joint(joint), "axis", (), *frames_of_joint(joint))


KIND = Revolute
