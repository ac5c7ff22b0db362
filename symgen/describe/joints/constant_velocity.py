"""Constant-velocity joint: two shafts that meet turn alike, whatever the angle between them."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.expressions import literal_of
from symgen.base.vocabulary.measures import Dot, Holonomic, Sum
from symgen.describe.joints._paired import Paired
from symgen.describe.joints._space import rows_of_coincident_points
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import AxisPair, DirectionPair
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads


class ConstantVelocity(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A homokinetic joint: the second body may lean against the first in any direction, but not twist; in space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        Where the shafts meet, as a point of the first and of the second body.
    axis : direction, or pair of directions
        Of the shafts: in the first body's frame, where they start in line, or of each in the frame of its body. Both
        point the same way through the joint.
    reference : pair of directions
        Directions across the shafts that coincide where these are in line; as the bodies start by default.

    Notes
    -----
    Four rows. Multipliers ``NAME.x``, ``.y``, ``.z`` [N]: the force on the first body, in ground axes; ``NAME.twist``
    [N m]: the torque on it about half the sum of the shafts' directions. The shafts must lean by less than 180 degrees.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    axis: AxisPair
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the components of the vector between the points and the twist.

        The relative rotation R is one about an axis across the shaft exactly where its antisymmetric part has no
        component along the shaft.
        """
        bodies, centres = self.ends(scope)
        of_a, of_b = make_triads(scope, bodies, self.axis, self.reference, fixed=True)
        half = literal_of(0.5), literal_of(-0.5)
        twist = Sum(((half[0], Dot(of_a.second, of_b.first)), (half[1], Dot(of_a.first, of_b.second))))
        rows = (*rows_of_coincident_points(*centres), Holonomic("twist", twist, unit="rad"))
        return Joint(scope.name, scope.kind, bodies, rows)


KIND = ConstantVelocity
