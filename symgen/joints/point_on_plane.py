"""Point on plane: a point of one body stays in a plane of the other."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import Axis, BodyPair, PointPair
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.describe.triads import make_triad
from symgen.vocabulary.measures import Component, Holonomic


class PointOnPlane(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A point of the first body that glides in a plane fixed in the second; in space only.

    Parameters
    ----------
    between : pair of body names
        The body with the point, which may be a point mass, and the body with the plane.
    at : pair of points
        The point, and a point of the plane.
    normal : direction
        Normal of the plane in the frame of the second body; its length does not matter.

    Notes
    -----
    One row [m]. Multiplier ``NAME.normal`` [N]: force on the first body along the normal. Reports
    ``NAME.displacement1`` and ``.displacement2``, of the point in the plane along two directions across the normal [m].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    between: BodyPair
    at: PointPair
    normal: Axis

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance from the plane."""
        a, b = scope.pair("between", self.between, turns=(False, True))
        point, plane = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        triad = make_triad(scope, b, self.normal, keys=("normal", ""))
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(Holonomic("normal", Component(point, plane, triad.axis)),),
            coordinates=(
                ("displacement1", Component(plane, point, triad.first)),
                ("displacement2", Component(plane, point, triad.second)),
            ),
        )


KIND = PointOnPlane
