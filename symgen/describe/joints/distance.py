"""Distance joint: a massless link between two points."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Holonomic, LinkStretch, StiffHolonomic
from symgen.describe.joints._paired import Paired
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalar
from symgen.describe.parts.scope import Scope


class Distance(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A massless rod with a ball at either end: two points keep their distance.

    Parameters
    ----------
    between : pair of body names
        The two bodies; point masses may be among them.
    at : pair of points
        The ends, a point of each body.
    length : scalar
        The distance [m], above 0.
    stiffness : scalar
        Of the rod along its axis [N/m], EA/L, above 0: how redundant rods share a load, with the method
        `stiffness-scaled-penalty` only. The rod does not give.

    Notes
    -----
    One row [m], (d^2 - L^2) / (2 L). Multiplier ``NAME.distance`` [N]: the tension of the rod (positive: it pulls).
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    length: Scalar
    stiffness: Scalar | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the stretch of the link."""
        bodies, ends = self.ends(scope, turns=(False, False))
        stretch = LinkStretch(*ends, scope.constant("length", self.length, positive=True))
        row = Holonomic("distance", stretch)
        if self.stiffness is not None:
            stiffness = scope.constant("stiffness", self.stiffness, positive=True)
            row = StiffHolonomic("distance", stretch, stiffness=stiffness)
        return Joint(scope.name, scope.kind, bodies, (row,))


KIND = Distance
