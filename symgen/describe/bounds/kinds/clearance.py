"""The key ``clearance`` of joints in the plane: a pin or a block with play, which touches, rubs and strikes."""

from __future__ import annotations

import math
from typing import Annotated

import msgspec
from msgspec import Meta

from symgen.base.vocabulary.expressions import ZERO, Expr, Number, call, product
from symgen.base.vocabulary.measures import Component, Direction, Holonomic, Marker
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.contact_rows import CONTACTS
from symgen.describe.bounds.keys import KeyOfJoints
from symgen.describe.bounds.kinds.contact import rows_of_contact
from symgen.describe.contacts.pairs.disc_disc import touch_of_discs
from symgen.describe.contacts.pairs.disc_line import touch_of_line
from symgen.describe.contacts.surfaces import Disc, sign_of
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalar, read_table
from symgen.describe.parts.scope import Scope

ClearanceTable = Annotated[
    dict[str, float | str | dict[str, float | str]],
    Meta(description="a table such as { hole = 0.010, pin = 0.0095, restitution = 0.5, friction = 0.01 }"),
]


class LawOfContact(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What contacts of joints share.

    Parameters
    ----------
    restitution : scalar
        Rate of the gap after an impact over that before, from 0 to 1; 0 by default.
    friction : scalar or table
        As that of contacts; none by default.
    """

    restitution: Scalar = 0.0
    friction: float | str | dict[str, float | str] | None = None


class PinClearance(LawOfContact, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A hole in the first body of a pin joint, and a pin of the second one in it, without the joint's rows.

    Parameters
    ----------
    hole, pin : scalar
        Radii [m].
    """

    hole: Scalar
    pin: Scalar


class SlideClearance(LawOfContact, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Two lines of the first body of a slide, and a block of the second one between them, without the joint's rows.

    Parameters
    ----------
    length, height : scalar
        Of the block, along the axis and across it [m].
    gap : scalar
        Play on either side of the block where it is in the middle [m].
    """

    length: Scalar
    height: Scalar
    gap: Scalar


def read_clearance(scope: Scope, joint: Joint, raw: object) -> tuple[BoundedRow, ...]:
    """Return the contact of a pin in its hole, which has the joint's name, or the contacts of the corners of a block.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    kind = "" if scope.spatial or not joint.rows else joint.kind
    if kind == "revolute":
        return _read_pin(scope, joint, read_table(PinClearance, raw, scope.where("clearance")))
    if kind == "translational":
        return _read_slide(scope, joint, read_table(SlideClearance, raw, scope.where("clearance")))
    got = f"a {joint.kind} joint" + (" in space" if scope.spatial else "")
    raise scope.error("clearance", "a revolute or translational joint in the plane", got)


def _read_pin(scope: Scope, joint: Joint, section: PinClearance) -> tuple[BoundedRow, ...]:
    """Return the contact of a pin in its hole."""
    one, other = _points_of(joint)
    radii = [_length(scope, key, x) for key, x in (("hole", section.hole), ("pin", section.pin))]
    sizes = [scope.value(radius, "clearance") for radius in radii]
    hole = Disc(one, call("neg", radii[0]), -sizes[0])
    touch = touch_of_discs(scope, "clearance", hole, Disc(other, radii[1], sizes[1]))
    return rows_of_contact(scope, "clearance", scope.name, touch, section.friction, section.restitution)


def _read_slide(scope: Scope, joint: Joint, section: SlideClearance) -> tuple[BoundedRow, ...]:
    """Return the contacts of the corners of a block with two lines, named by where they are along the axis."""
    one, other = _points_of(joint)
    ((_, displacement),) = joint.coordinates
    held = joint.rows[1]
    assert isinstance(displacement, Component) and isinstance(held, Holonomic), "a slide has an axis and an angle"
    keys = ("length", section.length), ("height", section.height), ("gap", section.gap)
    length, height, play = (_length(scope, key, x) for key, x in keys)
    along = displacement.along.vector
    axis = _turned(along, held.value)
    half, far = product(Number(0.5), height), call("add", product(Number(0.5), height), play)
    rows = list[BoundedRow]()
    for side, way in (("right", -1.0), ("left", 1.0)):
        on = Marker(one.body, _moved(one.point, _left_of(along), sign_of(far, way)))
        normal = Direction(one.body, tuple(sign_of(x, -way) for x in _left_of(along)))
        for end, sign in (("back", -1.0), ("front", 1.0)):
            corner = _moved(other.point, axis, sign_of(product(Number(0.5), length), sign))
            corner = _moved(corner, _left_of(axis), sign_of(half, way))
            touch = touch_of_line(scope, on, normal, Disc(Marker(other.body, corner), ZERO, 0.0))
            name = f"{scope.name}_{end}_{side}"
            rows += rows_of_contact(scope, "clearance", name, touch, section.friction, section.restitution)
    return tuple(rows)


def _points_of(joint: Joint) -> tuple[Marker, Marker]:
    """Return the points of both bodies of a joint."""
    first = joint.rows[0]
    assert isinstance(first, Holonomic) and isinstance(first.measure, Component), "rows hold components of a vector"
    return first.measure.a, first.measure.b


def _length(scope: Scope, key: str, value: float | str) -> Expr:
    return scope.constant(f"clearance.{key}", value, positive=True)


def _turned(vector: tuple[Expr, ...], angle: Expr) -> tuple[Expr, ...]:
    """Return a direction of the first body in the frame of the second one, which is turned by an angle."""
    if angle == ZERO:
        return vector
    c: Expr
    s: Expr
    if isinstance(angle, Number):
        c, s = (Number(function(angle.value)) for function in (math.cos, math.sin))
    else:
        c, s = call("cos", angle), call("sin", angle)
    x, y = vector
    return call("add", product(c, x), product(s, y)), call("sub", product(c, y), product(s, x))


def _left_of(vector: tuple[Expr, ...]) -> tuple[Expr, ...]:
    x, y = vector
    return call("neg", y), x


def _moved(point: tuple[Expr, ...], direction: tuple[Expr, ...], way: Expr) -> tuple[Expr, ...]:
    return tuple(call("add", x, product(way, part)) for x, part in zip(point, direction, strict=True))


KIND = KeyOfJoints("clearance", CONTACTS, ClearanceTable, read_clearance)
