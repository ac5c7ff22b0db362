"""Translational (prismatic) joint: one body slides along an axis of the other without turning."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Angle, Component, Holonomic
from symgen.describe.joints._paired import Axial
from symgen.describe.joints._space import (
    frames_of_joint,
    markers_of_joint,
    row_against_turning,
    rows_of_parallel_axes,
    rows_of_point_on_axis,
)
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalar
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads
from symgen.describe.spanning_tree import Articulation


class Translational(Axial, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A slide: the second body moves along an axis fixed in the first one and does not turn against it.

    Parameters
    ----------
    angle : scalar
        In the plane: angle of the second body less that of the first [rad]; 0 by default.

    Notes
    -----
    In the plane two rows. Multiplier ``NAME.normal`` [N]: force on the first body along the axis turned left by 90
    degrees; ``NAME.angle`` [N m]: torque on the first body. Reports ``NAME.displacement``, along the
    axis from the first body's point to the second's [m].

    In space five rows: ``NAME.across1``, ``.across2`` [N], forces on the first body across the axis, and
    ``NAME.first``, ``.second``, ``.angle`` [N m], torques on it about two directions across the axis and about it.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    angle: Scalar | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance from the axis and the angle, in space to two distances and three angles."""
        bodies, points = self.ends(scope)
        rows: tuple[Holonomic, ...]
        if scope.spatial:
            scope.only(angle=self.angle)
            triads = make_triads(scope, bodies, self.axis, self.reference, fixed=True)
            along = triads[0].axis
            rows = (
                *rows_of_point_on_axis(*points, triads[0]),
                *rows_of_parallel_axes(*triads),
                row_against_turning(*triads),
            )
        else:
            scope.only(reference=self.reference)
            along, normal = scope.axis("axis", bodies[0], self.axis)
            held = Holonomic("angle", Angle(*bodies), scope.constant("angle", self.angle or 0.0), "rad")
            rows = (Holonomic("normal", Component(*points, normal)), held)
        return Joint(scope.name, scope.kind, bodies, rows, (("displacement", Component(*points, along)),))

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        ((_, displacement),) = joint.coordinates
        assert isinstance(displacement, Component), "a displacement is a component"
        slides = (displacement.along,)
        if len(joint.rows) < 5:
            return Articulation(*markers_of_joint(joint), "fixed", slides, angle=joint.rows[1].value)
        return Articulation(*markers_of_joint(joint), "fixed", slides, *frames_of_joint(joint))


KIND = Translational
