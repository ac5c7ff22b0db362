"""A joint of your own: a rope over two fixed pulleys, and Atwood's machine made with it."""

from typing import ClassVar

import msgspec

import symgen
from symgen.extension import GROUND, JOINTS, ONE, BodyPair, Distance, Holonomic, Joint, PointPair, Scalar, Sum


class Thread(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A rope over two pulleys of the ground: its two free lengths keep their sum."""

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair
    at: PointPair
    pulleys: PointPair
    length: Scalar

    def build(self, scope) -> Joint:
        """Resolve to one row: distance to the first pulley plus distance to the second is the free length."""
        bodies = scope.pair("between", self.between)
        ends = [scope.marker("at", body, point) for body, point in zip(bodies, self.at, strict=True)]
        pulleys = [scope.marker("pulleys", GROUND, point) for point in self.pulleys]
        measure = Sum(tuple((ONE, Distance(p, e)) for p, e in zip(pulleys, ends, strict=True)))
        length = scope.constant("length", self.length, positive=True)
        return Joint(scope.name, scope.kind, bodies, (Holonomic("rope", measure, length),))


JOINTS.register("thread", Thread)

if __name__ == "__main__":
    builder = symgen.MechanismBuilder("atwood", gravity=(0.0, -9.81))
    builder.body("left", type="point", mass=2.0, position=(0.0, -1.0), velocity=(0.0, 0.0))
    builder.body("right", type="point", mass=1.0, position=(0.5, -1.0), velocity=(0.0, 0.0))
    pulleys = ((0.0, 0.0), (0.5, 0.0))
    builder.joint("rope", "thread", between=("left", "right"), at=("centre", "centre"), pulleys=pulleys, length=2.0)
    result = symgen.load(builder.build()).simulate(until=0.5)
    acceleration = 9.81 * (2.0 - 1.0) / (2.0 + 1.0)
    print(f"fallen {-1.0 - result['left.y'][-1]:.9f} m; by Atwood's formula {acceleration * 0.5**2 / 2:.9f} m")
