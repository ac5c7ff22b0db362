"""Gear pair: the turns of two bodies against a carrier keep a ratio."""

from __future__ import annotations

from typing import Literal

import msgspec

from symgen.describe.fields import BodyName, BodyPair, Pair, Scalar
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.vocabulary.expressions import ONE, Expr, call
from symgen.vocabulary.measures import GROUND, Angle, Holonomic, Sum


class Gear(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two toothed wheels a, b in mesh on a carrier c: r_a (theta_a - theta_c) + r_b (theta_b - theta_c) = offset.

    The wheels' axes are held by other joints; turns are counted, so nothing jumps after a revolution.

    Parameters
    ----------
    between : pair of body names
        The wheels.
    carrier : body name
        The body that holds both axes; the ground unless given.
    radii : pair
        Pitch radii r_a and r_b [m], above 0.
    ratio : scalar
        r_b / r_a, above 0, in place of `radii`; the row is then divided by r_a.
    mesh : str
        ``"external"``, or ``"internal"`` where one wheel is a ring: the second term then has the opposite sign.
    offset : scalar
        The constant [m with radii, rad with a ratio]; 0 unless given.

    Notes
    -----
    One row. Multiplier ``NAME.mesh``: the tooth force [N] with radii, so that r_a times it is the torque on the first
    wheel; that torque [N m] with a ratio. The carrier receives what balances both.
    """

    between: BodyPair
    carrier: BodyName = GROUND
    radii: Pair | None = None
    ratio: Scalar | None = None
    mesh: Literal["external", "internal"] = "external"
    offset: Scalar = 0.0

    def build(self, scope: Scope) -> Joint:
        """Resolve to a weighted sum of two angles."""
        a, b = scope.pair("between", self.between, turns=(True, True))
        carrier = scope.body("carrier", self.carrier, turns=True)
        if carrier in (a, b):
            raise scope.error("carrier", "a body that is neither wheel", f"'{carrier}'")
        weight_a, weight_b, unit = self._weights(scope)
        if self.mesh == "internal":
            weight_b = call("neg", weight_b)
        measure = Sum(((weight_a, Angle(a, carrier)), (weight_b, Angle(b, carrier))))
        # The angles run from wheel to carrier, as everywhere from the first body on, so the constant changes sign.
        value = call("neg", scope.constant("offset", self.offset))
        bodies = (a, b) if carrier == GROUND else (a, b, carrier)
        return Joint(scope.name, scope.kind, bodies, (Holonomic("mesh", measure, value, unit),))

    def _weights(self, scope: Scope) -> tuple[Expr, Expr, str]:
        if self.radii is not None and self.ratio is None:
            radius_a, radius_b = (scope.constant("radii", radius, positive=True) for radius in self.radii)
            return radius_a, radius_b, "m"
        if self.ratio is not None and self.radii is None:
            return ONE, scope.constant("ratio", self.ratio, positive=True), "rad"
        raise scope.error("", "either the key radii or the key ratio", "neither" if self.ratio is None else "both")


KIND = Gear
