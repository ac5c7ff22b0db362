"""Cylindrical joint: two axes of bodies in space coincide."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import AxisPair, BodyPair, DirectionPair, PointPair
from symgen.describe.mechanism import Articulation, Joint
from symgen.describe.scope import Scope
from symgen.joints._space import angle, frames, markers, on_axis, parallel
from symgen.vocabulary.measures import Component


class Cylindrical(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A shaft in a sleeve: the second body turns about an axis of the first and slides along it; in space only.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        A point of each body; both lie on the axis.
    axis : direction, or pair of directions
        The axis in the first body's frame, or in the frame of each body.
    reference : pair of directions
        Directions across the axis that coincide at angle 0; as the bodies start by default.

    Notes
    -----
    Four rows. Multipliers ``NAME.across1``, ``.across2`` [N]: forces on the first body across the axis; ``NAME.first``,
    ``.second`` [N m]: torques on it about two directions across the axis. Reports ``NAME.displacement``, along the axis
    from the first body's point to the second's [m], and ``NAME.angle`` about the axis [rad], turns counted.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    between: BodyPair
    at: PointPair
    axis: AxisPair
    reference: DirectionPair | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to two distances from the axis and two angles."""
        a, b = scope.pair("between", self.between, turns=(True, True))
        point_a, point_b = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        triad_a, triad_b = scope.triads((a, b), self.axis, self.reference)
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(*on_axis(point_a, point_b, triad_a), *parallel(triad_a, triad_b)),
            coordinates=(
                ("displacement", Component(point_a, point_b, triad_a.axis)),
                ("angle", angle(triad_a, triad_b)),
            ),
        )

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        of_a, of_b = frames(joint)
        return Articulation(*markers(joint), "axis", (of_a[2],), of_a, of_b)


KIND = Cylindrical
