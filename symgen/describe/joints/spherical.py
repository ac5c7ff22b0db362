"""Spherical joint: two points of bodies in space coincide."""

from __future__ import annotations

from typing import ClassVar

from symgen.describe.joints._paired import Paired
from symgen.describe.joints._space import markers_of_joint, rows_of_coincident_points
from symgen.describe.mechanism import Joint
from symgen.describe.parts.scope import Scope
from symgen.describe.spanning_tree import Articulation


class Spherical(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A ball and socket that holds a point of one body on a point of the other; in space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies; point masses may be among them.
    at : pair of points
        The centre of the ball, as a point of the first and of the second body.

    Notes
    -----
    Three rows [m]. Multipliers ``NAME.x``, ``NAME.y``, ``NAME.z`` [N]: the force on the first body, in ground axes.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    def build(self, scope: Scope) -> Joint:
        """Resolve to the three components of the vector between the points."""
        bodies, centres = self.ends(scope, turns=(False, False))
        return Joint(scope.name, scope.kind, bodies, rows_of_coincident_points(*centres))

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        return Articulation(*markers_of_joint(joint), "ball")


KIND = Spherical
