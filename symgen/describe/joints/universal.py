"""Universal joint: a cross turns about an axis of either body."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.expressions import literal_of
from symgen.base.vocabulary.measures import Dot, Holonomic, Sum, Turn
from symgen.describe.joints._paired import Paired
from symgen.describe.joints._space import markers_of_joint, rows_of_coincident_points, third_direction
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import DirectionPair
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_cross
from symgen.describe.spanning_tree import Articulation


class Universal(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A Cardan or Hooke joint: its massless cross turns about an axis of either body; in space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        The centre of the cross, as a point of the first and of the second body.
    axes : pair of directions
        The first body's axis of the cross in the first body's frame, and the second body's in the second's.
    reference : pair of directions
        Where the second axis lies in the first body's frame at ``angle1`` 0, and the first axis in the second body's
        frame at ``angle2`` 0; as the bodies start by default.

    Notes
    -----
    Four rows. Multipliers ``NAME.x``, ``.y``, ``.z`` [N]: the force on the first body, in ground axes; ``NAME.cross``
    [N m]: the torque on it about second axis x first axis. Reports ``NAME.angle1``, how far the cross has turned about
    the first body's axis, and ``NAME.angle2``, how far the second body has turned against the cross about its own axis
    [rad], turns counted.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    axes: DirectionPair
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the components of the vector between the points and the product of the axes."""
        bodies, centres = self.ends(scope)
        a, b = make_cross(scope, bodies, self.axes, self.reference)
        rows = (*rows_of_coincident_points(*centres), Holonomic("cross", Dot(a.axis, b.axis), unit="rad"))
        # seen from the second body the cross turns backwards
        back = Sum(((literal_of(-1.0), Turn(b.first, b.second, a.axis)),))
        return Joint(
            scope.name, scope.kind, bodies, rows, (("angle1", Turn(a.first, a.second, b.axis)), ("angle2", back))
        )

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        turns = [m for _, m in joint.coordinates]
        of_a = turns[0]
        of_b = turns[1].terms[0][1] if isinstance(turns[1], Sum) else None
        assert isinstance(of_a, Turn) and isinstance(of_b, Turn), "both coordinates are angles"
        frame_a, frame_b = (of_a.zero, of_a.quarter), (of_b.zero, of_b.quarter)
        return Articulation(
            *markers_of_joint(joint),
            "cross",
            (),
            (*frame_a, third_direction(frame_a)),
            (*frame_b, third_direction(frame_b)),
        )


KIND = Universal
