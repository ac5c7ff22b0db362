"""Planar joint: a plane of one body slides on a plane of the other."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Component, Holonomic
from symgen.describe.joints._paired import Paired
from symgen.describe.joints._space import angle_about_axis, frames_of_joint, markers_of_joint, rows_of_parallel_axes
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import AxisPair, DirectionPair
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads
from symgen.describe.spanning_tree import Articulation


class Planar(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A plane of the second body lies on a plane of the first, slides and turns on it; in space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        A point of either plane.
    normal : direction, or pair of directions
        Normal of the plane in the first body's frame, or of each plane in the frame of its body.
    reference : pair of directions
        Directions in the planes that coincide at angle 0; as the bodies start by default.

    Notes
    -----
    Three rows. Multipliers ``NAME.normal`` [N]: force on the first body along the normal; ``NAME.first``, ``.second``
    [N m]: torques on it about two directions in the plane, the first one that of `reference`. Reports
    ``NAME.displacement1`` and ``.displacement2``, from the first body's point to the second's along these [m], and
    ``NAME.angle`` about the normal [rad], turns counted.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    normal: AxisPair
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance from the plane and two angles."""
        bodies, ends = self.ends(scope)
        a, b = make_triads(scope, bodies, self.normal, self.reference, ("normal", "reference"))
        rows = (Holonomic("normal", Component(*ends, a.axis)), *rows_of_parallel_axes(a, b))
        slides = ("displacement1", Component(*ends, a.first)), ("displacement2", Component(*ends, a.second))
        return Joint(scope.name, scope.kind, bodies, rows, (*slides, ("angle", angle_about_axis(a, b))))

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        of_a, of_b = frames_of_joint(joint)
        return Articulation(*markers_of_joint(joint), "axis", of_a[:2], of_a, of_b)


KIND = Planar
