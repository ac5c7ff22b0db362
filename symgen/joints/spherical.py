"""Spherical joint: two points of bodies in space coincide."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import BodyPair, PointPair
from symgen.describe.mechanism import Articulation, Joint
from symgen.describe.scope import Scope
from symgen.joints._space import coincident, markers


class Spherical(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
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

    between: BodyPair
    at: PointPair

    def build(self, scope: Scope) -> Joint:
        """Resolve to the three components of the vector between the points."""
        a, b = scope.pair("between", self.between)
        rows = coincident(scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1]))
        return Joint(name=scope.name, kind=scope.kind, bodies=(a, b), rows=rows)

    @staticmethod
    def articulate(joint: Joint) -> Articulation:
        """Return how the second body moves against the first."""
        return Articulation(*markers(joint), "ball")


KIND = Spherical
