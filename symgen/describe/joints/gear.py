"""Gear pair: the turns of two bodies against a carrier, or two joint coordinates, keep a ratio."""

from __future__ import annotations

from typing import ClassVar, Literal

import msgspec

from symgen.base.vocabulary.expressions import ONE, Expr, call
from symgen.base.vocabulary.measures import GROUND, Angle, Holonomic, Sum
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import BodyName, BodyPair, Efficiency, Pair, Scalar, TextPair
from symgen.describe.parts.scope import Scope


class Gear(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two toothed wheels a, b in mesh on a carrier c: r_a (theta_a - theta_c) + r_b (theta_b - theta_c) = offset.

    The wheels' axes are held by other joints; turns are counted, so nothing jumps after a revolution. In space the two
    angles are those of two joints, which hold the wheels on whatever carries them.

    Parameters
    ----------
    between : pair of body names
        In the plane: the wheels.
    carrier : body name
        In the plane: the body that holds both axes; the ground by default.
    joints : pair of joint names
        In space: the joints that hold the wheels, r_a angle_a + r_b angle_b = offset.
    coordinates : pair of str
        In space: which coordinate of each, where a joint has several. With `ratio` displacements may be among them.
    radii : pair
        Pitch radii r_a and r_b [m], above 0.
    ratio : scalar
        r_b / r_a, above 0, in place of `radii`; the row is then divided by r_a.
    mesh : str
        ``"external"``, or ``"internal"`` where one wheel is a ring: the second term then has the opposite sign.
    offset : scalar
        The constant [m with radii, rad with a ratio]; 0 by default.
    efficiency : scalar or pair
        Part of a power that the teeth pass on, or two: forwards from the first wheel, and backwards, of 0 or less where
        the second one cannot drive; no loss by default.

    Notes
    -----
    One row. Multiplier ``NAME.mesh``: the tooth force [N] with radii, so that r_a times it is the torque on the first
    wheel; that torque [N m] with a ratio. The carrier receives what balances both. In space the torque is that on the
    first body of the first joint.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair | None = None
    carrier: BodyName | None = None
    joints: TextPair | None = None
    coordinates: TextPair | None = None
    radii: Pair | None = None
    ratio: Scalar | None = None
    mesh: Literal["external", "internal"] = "external"
    offset: Scalar = 0.0
    efficiency: Efficiency | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to a weighted sum of two angles."""
        if scope.spatial:
            return self._couple_joints(scope)
        scope.only("between", between=self.between, joints=self.joints, coordinates=self.coordinates)
        a, b = scope.pair("between", self.between or ("", ""), turns=(True, True))
        carrier = scope.body("carrier", self.carrier or GROUND, turns=True)
        if carrier in (a, b):
            raise scope.error("carrier", "a body that is neither wheel", f"'{carrier}'")
        weight_a, weight_b, unit = self._weights_of_angles(scope)
        measure = Sum(((weight_a, Angle(a, carrier)), (weight_b, Angle(b, carrier))))
        # The angles run from wheel to carrier, as everywhere from the first body on, so the constant changes sign.
        value = call("neg", scope.constant("offset", self.offset))
        bodies = (a, b) if carrier == GROUND else (a, b, carrier)
        return Joint(scope.name, scope.kind, bodies, (Holonomic("mesh", measure, value, unit),))

    def _couple_joints(self, scope: Scope) -> Joint:
        scope.only("joints", joints=self.joints, between=self.between, carrier=self.carrier)
        names, labels = self.joints or ("", ""), self.coordinates or (None, None)
        angular = "rad" if self.radii is not None else ""
        coordinates = [
            scope.joint_coordinate(name, label, ("joints", "coordinates"), angular)
            for name, label in zip(names, labels, strict=True)
        ]
        (first, label_a, turn_a), (second, label_b, turn_b) = coordinates
        if (first.name, label_a) == (second.name, label_b):
            raise scope.error("joints", "two different coordinates", f"'{first.name}.{label_a}' twice")
        weight_a, weight_b, unit = self._weights_of_angles(scope)
        measure = Sum(((weight_a, turn_a), (weight_b, turn_b)))
        bodies = tuple(dict.fromkeys((*first.bodies, *second.bodies)))
        unit = Joint.unit(label_a) if self.radii is None else unit
        row = Holonomic("mesh", measure, scope.constant("offset", self.offset), unit)
        return Joint(scope.name, scope.kind, bodies, (row,))

    def _weights_of_angles(self, scope: Scope) -> tuple[Expr, Expr, str]:
        """Return the weights of the angles, and the unit of the sum."""
        if (self.radii is None) == (self.ratio is None):
            raise scope.error("", "either the key radii or the key ratio", "neither" if self.ratio is None else "both")
        if self.radii is not None:
            weight_a, weight_b = (scope.constant("radii", radius, positive=True) for radius in self.radii)
        else:
            weight_a, weight_b = ONE, scope.constant("ratio", self.ratio or 0.0, positive=True)
        return weight_a, call("neg", weight_b) if self.mesh == "internal" else weight_b, "rad" if self.ratio else "m"


KIND = Gear
