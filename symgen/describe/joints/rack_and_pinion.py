"""Rack and pinion: a displacement of one joint follows an angle of another."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.vocabulary.expressions import ONE, call
from symgen.base.vocabulary.measures import Holonomic, Sum
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Efficiency, Scalar, Text, TextPair
from symgen.describe.parts.scope import Scope


class RackAndPinion(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A pinion's joint turns by an angle and a rack's joint moves by radius times that; in space only.

    Turns are counted, so nothing jumps after a revolution.

    Parameters
    ----------
    pinion : joint name
        The joint that holds the pinion; it reports an angle.
    rack : joint name
        The joint that guides the rack; it reports a displacement.
    coordinates : pair of str
        Which angle and which displacement, where a joint has several.
    radius : scalar
        Pitch radius of the pinion [m]; negative where the rack runs backwards.
    offset : scalar
        The constant in displacement = radius angle + offset [m]; 0 by default.
    efficiency : scalar or pair
        Part of a power that the teeth pass on, or two: forwards from the pinion, and backwards, of 0 or less where the
        rack cannot drive; no loss by default.

    Notes
    -----
    One row [m]. Multiplier ``NAME.mesh`` [N]: the tooth force along the displacement on the first body of `rack`;
    -radius times it is the torque on the first body of `pinion`.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    pinion: Text
    rack: Text
    radius: Scalar
    coordinates: TextPair | None = None
    offset: Scalar = 0.0
    efficiency: Efficiency | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to the sum of a displacement and an arc."""
        names = (None, None) if self.coordinates is None else self.coordinates
        pinion, _, turn = scope.joint_coordinate(self.pinion, names[0], ("pinion", "coordinates"), "rad")
        rack, _, way = scope.joint_coordinate(self.rack, names[1], ("rack", "coordinates"), "m")
        radius = scope.constant("radius", self.radius)
        measure = Sum(((ONE, way), (call("neg", radius), turn)))
        bodies = tuple(dict.fromkeys((*rack.bodies, *pinion.bodies)))
        row = Holonomic("mesh", measure, scope.constant("offset", self.offset))
        return Joint(scope.name, scope.kind, bodies, (row,))


KIND = RackAndPinion
