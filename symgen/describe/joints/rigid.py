"""Rigid joint: two bodies move as one."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Angle, Holonomic
from symgen.describe.joints._paired import Paired
from symgen.describe.joints._space import (
    frames_of_joint,
    markers_of_joint,
    row_against_turning,
    rows_of_coincident_points,
    rows_of_parallel_axes,
)
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import AxisPair, DirectionPair, Scalar
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads
from symgen.describe.spanning_tree import Articulation


class Rigid(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A weld: a point of one body stays on a point of the other and neither turns against the other.

    Parameters
    ----------
    between : pair of body names
        The two bodies; a point mass is welded by a revolute joint, in space by a spherical one, as it has no angle.
    at : pair of points
        The weld, as a point of the first and of the second body.
    angle : scalar
        In the plane: angle of the second body less that of the first [rad]; 0 by default.
    axis, reference : direction, or pairs of directions
        In space: two directions of each body that coincide, the second across the first; as the bodies start unless
        given.

    Notes
    -----
    In the plane three rows. Multipliers ``NAME.x``, ``NAME.y`` [N] and ``NAME.angle`` [N m]: force, in ground axes, and
    torque on the first body.

    In space six rows: ``NAME.x``, ``.y``, ``.z`` [N], and ``NAME.first``, ``.second``, ``.angle`` [N m], torques on the
    first body about its x, y and z axis, or about the axes that `axis` (third) and `reference` (first) give.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    angle: Scalar | None = None
    axis: AxisPair | None = None
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the components of the vector between the points and the angle, in space three angles."""
        bodies, welds = self.ends(scope)
        if scope.spatial:
            scope.only(angle=self.angle)
            triads = make_triads(scope, bodies, self.axis or (0.0, 0.0, 1.0), self.reference, fixed=True)
            rows = (*rows_of_coincident_points(*welds), *rows_of_parallel_axes(*triads), row_against_turning(*triads))
            return Joint(scope.name, scope.kind, bodies, rows)
        scope.only(axis=self.axis, reference=self.reference)
        held = Holonomic("angle", Angle(*bodies), scope.constant("angle", self.angle or 0.0), "rad")
        return Joint(scope.name, scope.kind, bodies, (*rows_of_coincident_points(*welds), held))

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        if len(joint.rows) < 6:
            return Articulation(*markers_of_joint(joint), angle=joint.rows[2].value)
        return Articulation(*markers_of_joint(joint), "fixed", (), *frames_of_joint(joint))


KIND = Rigid
