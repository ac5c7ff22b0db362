"""Distance joint: a massless link between two points."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import BodyPair, PointPair, Scalar
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.vocabulary.measures import Holonomic, LinkStretch


class Distance(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A massless rod with a ball at either end: two points keep their distance.

    Parameters
    ----------
    between : pair of body names
        The two bodies; point masses may be among them.
    at : pair of points
        The ends, a point of each body.
    length : scalar
        The distance [m], above 0.

    Notes
    -----
    One row [m], (d^2 - L^2) / (2 L). Multiplier ``NAME.distance`` [N]: the tension of the rod (positive: it pulls).
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair
    at: PointPair
    length: Scalar

    def build(self, scope: Scope) -> Joint:
        """Resolve to the stretch of the link."""
        a, b = scope.pair("between", self.between)
        end_a, end_b = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        length = scope.constant("length", self.length, positive=True)
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(Holonomic("distance", LinkStretch(end_a, end_b, length)),),
        )


KIND = Distance
