"""Kinds of plugins whose joints have a point beside two bodies: under a key of its own, and never under ``at``."""

from typing import ClassVar

import msgspec
import pytest

from describe.measured import Posed
from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ONE, Number
from symgen.describe import MechanismBuilder
from symgen.describe.forces import FORCES
from symgen.describe.joints import JOINTS
from symgen.describe.mechanism import Force
from symgen.extension import GROUND, BodyPair, Distance, Holonomic, Joint, Point, Scalar, Sum


class OfTwo(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The two bodies of a kind."""

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair


class Equidistant(OfTwo, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A point of the ground as far from the centre of one body as from that of another."""

    point: Point

    def build(self, scope) -> Joint:
        bodies = scope.pair("between", self.between)
        point = scope.marker("point", GROUND, self.point)
        first, second = (Distance(point, scope.marker("between", body, "centre")) for body in bodies)
        measure = Sum(((ONE, first), (Number(-1.0), second)))
        return Joint(scope.name, scope.kind, bodies, (Holonomic("far", measure),))


class ByName(OfTwo, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One point, by its name or by coordinates, that may be left out."""

    at: Point | None = None


class ByCoordinates(OfTwo, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One point by coordinates alone."""

    at: tuple[Scalar, Scalar]


class Load(ByCoordinates, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A force at one point beside two bodies."""

    def build(self, scope) -> Force:
        raise AssertionError("nothing is built of a kind that is refused")


def pair() -> MechanismBuilder:
    """Return a mechanism of two points."""
    builder = MechanismBuilder("pair")
    builder.body("a", type="point", mass=1.0, position=[3.0, 4.0])
    return builder.body("b", type="point", mass=1.0, position=[0.0, 2.0])


@pytest.fixture(autouse=True)
def _kinds(monkeypatch):
    own = {"equidistant": Equidistant, "by-name": ByName, "by-coordinates": ByCoordinates}
    monkeypatch.setattr(JOINTS, "_loaded", {**JOINTS._loaded, **own})
    monkeypatch.setattr(FORCES, "_loaded", {**FORCES._loaded, "load": Load})


def test_a_point_under_a_key_of_its_own() -> None:
    mechanism = pair().joint("j", "equidistant", between=["a", "b"], point=[0.0, 0.0]).build()
    (row,) = mechanism.joints[0].rows
    assert Posed(mechanism).residual(row) == pytest.approx(5.0 - 2.0, rel=1e-15)


@pytest.mark.parametrize(("kind", "at"), [("by-name", "c"), ("by-name", ["a", "b"]), ("by-coordinates", [0.0, 0.0])])
def test_one_point_under_at_beside_two_bodies_is_refused(kind: str, at: object) -> None:
    with pytest.raises(InputError) as error:
        pair().joint("j", kind, between=["a", "b"], at=at).build()
    assert str(error.value) == (
        f"builder 'pair': joints.j.type: expected a kind whose 'at' has a point of each body of 'between', "
        f"got '{kind}', whose 'at' is one point; give this key of the plugin another name, such as 'point'"
    )


def test_a_force_at_one_point_beside_two_bodies_is_refused() -> None:
    with pytest.raises(
        InputError, match=r"^builder 'pair': forces\.f\.type: expected a kind whose 'at' has a point of each body"
    ):
        pair().force("f", "load", between=["a", "b"], at=[0.0, 0.0]).build()
