"""Keys shared by joints that hold a point of one body to a point of another, or whose bodies share an axis."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.measures import Marker
from symgen.describe.parts.fields import AxisPair, BodyPair, DirectionPair, PointPair
from symgen.describe.parts.scope import Scope


class Paired(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two bodies and a point of each; every kind says which."""

    between: BodyPair
    at: PointPair

    def ends(
        self, scope: Scope, turns: tuple[bool, bool] = (True, True)
    ) -> tuple[tuple[str, str], tuple[Marker, Marker]]:
        """Return the bodies, those that `turns` names with an angle, and a point of each."""
        a, b = scope.pair("between", self.between, turns=turns)
        return (a, b), (scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1]))


class Axial(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two bodies with an axis in common.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        A point of each body; both lie on the axis.
    axis : direction, or in space pair of directions
        The axis in the first body's frame, in space also one in the frame of each body; lengths do not matter.
    reference : pair of directions
        In space: directions across the axis that coincide, where the joint turns at angle 0; as the bodies start by
        default.
    """

    axis: AxisPair
    reference: DirectionPair | None = None
