"""Cylindrical joint: two axes of bodies in space coincide."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Component
from symgen.describe.joints._paired import Axial
from symgen.describe.joints._space import (
    angle_about_axis,
    frames_of_joint,
    markers_of_joint,
    rows_of_parallel_axes,
    rows_of_point_on_axis,
)
from symgen.describe.mechanism import Joint
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads
from symgen.describe.spanning_tree import Articulation


class Cylindrical(Axial, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A shaft in a sleeve: the second body turns about an axis of the first and slides along it; in space only.

    Notes
    -----
    Four rows. Multipliers ``NAME.across1``, ``.across2`` [N]: forces on the first body across the axis; ``NAME.first``,
    ``.second`` [N m]: torques on it about two directions across the axis. Reports ``NAME.displacement``, along the axis
    from the first body's point to the second's [m], and ``NAME.angle`` about the axis [rad], turns counted.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    def build(self, scope: Scope) -> Joint:
        """Resolve to two distances from the axis and two angles."""
        bodies, points = self.ends(scope)
        triads = make_triads(scope, bodies, self.axis, self.reference)
        rows = (*rows_of_point_on_axis(*points, triads[0]), *rows_of_parallel_axes(*triads))
        reported = (("displacement", Component(*points, triads[0].axis)), ("angle", angle_about_axis(*triads)))
        return Joint(scope.name, scope.kind, bodies, rows, reported)

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        of_a, of_b = frames_of_joint(joint)
        return Articulation(*markers_of_joint(joint), "axis", (of_a[2],), of_a, of_b)


KIND = Cylindrical
