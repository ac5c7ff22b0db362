"""Revolute joint: two points coincide."""

from __future__ import annotations

import msgspec

from symgen.describe.fields import BodyPair, PointPair
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.vocabulary.measures import X_AXIS, Y_AXIS, Angle, Component, Holonomic


class Revolute(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A pin that holds a point of one body on a point of the other.

    Parameters
    ----------
    between : pair of body names
        The two bodies; a point mass may be one of them.
    at : pair of points
        The pin, as a point of the first and of the second body.

    Notes
    -----
    Two rows [m]. Multipliers ``NAME.x``, ``NAME.y`` [N]: the force of the pin on the first body, in ground axes.
    Reports ``NAME.angle``, the second body's angle less the first's [rad].
    """

    between: BodyPair
    at: PointPair

    def build(self, scope: Scope) -> Joint:
        """Resolve to the two components of the vector between the points."""
        a, b = scope.pair("between", self.between)
        pin_a, pin_b = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        return Joint(
            name=scope.name,
            kind=scope.kind,
            bodies=(a, b),
            rows=(
                Holonomic("x", Component(pin_a, pin_b, X_AXIS)),
                Holonomic("y", Component(pin_a, pin_b, Y_AXIS)),
            ),
            coordinates=(("angle", Angle(a, b)),) if scope.turns(a) and scope.turns(b) else (),
        )


KIND = Revolute
